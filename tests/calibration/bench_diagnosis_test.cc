// A case of the bench (bench/diagnosis), made small, through the diagnosis from end to end.
#include <gtest/gtest.h>

#include "calibration/diagnose.h"
#include "tests/support/bench_dataset.h"

namespace plenum::test {
namespace {

using calibration::Diagnosis;
using calibration::Verdict;

// A step, cycles and the run held out: a diagnosis of all runs takes too long for a test.
BenchCase Small(const BenchCase& bench) {
  BenchCase small = bench;
  small.runs.erase(small.runs.begin() + 2, small.runs.end() - 1);
  small.records.erase(small.records.begin() + 2, small.records.end() - 1);
  return small;
}

Diagnosis Diagnosed(const BenchCase& bench) {
  const calibration::Dataset dataset = ToDataset(bench);
  calibration::DiagnoseOptions options;
  options.threads = 2;
  return calibration::Diagnose(dataset, options);
}

TEST(BenchDiagnosis, CleanCaseIsAdequate) {
  const Diagnosis diagnosis = Diagnosed(Small(DrawCase(1, CaseKind::kClean)));
  EXPECT_EQ(diagnosis.verdict, Verdict::kAdequate) << diagnosis.sentence;
  EXPECT_TRUE(diagnosis.effects.empty());
}

}  // namespace
}  // namespace plenum::test
