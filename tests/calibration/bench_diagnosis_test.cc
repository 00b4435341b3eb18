// Some of the bench's cases (bench/diagnosis), small ones, through the diagnosis from end to end.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

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

std::vector<std::string> Named(const Diagnosis& diagnosis) {
  std::vector<std::string> ids;
  for (const auto& effect : diagnosis.effects) ids.emplace_back(effect.effect.spec->id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

void ExpectAdequate(std::uint64_t seed) {
  const BenchCase bench = Small(DrawCase(seed, CaseKind::kClean));
  const Diagnosis diagnosis = Diagnosed(bench);
  EXPECT_EQ(diagnosis.verdict, Verdict::kAdequate) << seed << ": " << diagnosis.sentence;
  EXPECT_TRUE(diagnosis.effects.empty());
}

void ExpectExplained(std::uint64_t seed, const std::string& effect) {
  const BenchCase bench = Small(DrawCase(seed, CaseKind::kFull, effect));
  const Diagnosis diagnosis = Diagnosed(bench);
  EXPECT_EQ(diagnosis.verdict, Verdict::kExplained) << effect << ": " << diagnosis.sentence;
  EXPECT_EQ(Named(diagnosis), std::vector<std::string>{effect}) << seed;
  EXPECT_LT(diagnosis.after.rms_pa, 0.5 * diagnosis.before.rms_pa) << effect;
}

TEST(BenchDiagnosis, CleanCaseIsAdequate) { ExpectAdequate(1); }

#ifndef PLENUM_SANITIZED
TEST(BenchDiagnosis, ClearEffectIsNamed) { ExpectExplained(41, "exhaust_restriction"); }
#endif

}  // namespace
}  // namespace plenum::test
