// A case of the bench (bench/diagnosis), made small, through the diagnosis from end to end.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "calibration/diagnose.h"
#include "tests/support/bench/bench_dataset.h"
#include "tests/support/bench/real_case.h"
#include "tests/support/in_full.h"

namespace plenum::test {
namespace bench_diagnosis_test {

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

// What the stability of the names says, for a message.
std::string Held(const Diagnosis& diagnosis) {
  std::string text;
  for (const calibration::StabilityChange& change : diagnosis.stability)
    text += "\n  " + change.change + ": " + std::to_string(change.delta_bic.value_or(0.0)) +
            (change.holds ? "" : " does not hold");
  return text;
}

TEST(BenchDiagnosis, CleanCaseIsAdequate) {
  const Diagnosis diagnosis = Diagnosed(Small(DrawCase(1, CaseKind::kClean)));
  EXPECT_EQ(diagnosis.verdict, Verdict::kAdequate) << diagnosis.sentence << Held(diagnosis);
  EXPECT_TRUE(diagnosis.effects.empty());
}

std::set<std::set<std::string>> SetsOf(const Diagnosis& diagnosis) {
  std::set<std::set<std::string>> sets;
  for (const auto& tied : diagnosis.tied) sets.emplace(tied.begin(), tied.end());
  std::set<std::string> named;
  for (const calibration::FittedEffect& effect : diagnosis.effects)
    named.emplace(effect.effect.spec->id);
  if (!named.empty()) sets.insert(named);
  return sets;
}

// A supply that droops and a conductance of its own differ in the source's pressure alone, which
// says nothing of other pairs of the tie: it is to be measured all the same.
TEST(BenchDiagnosis, ATieAsksForTheChannelThatAnyOfItsPairsNeeds) {
  const Diagnosis diagnosis = Diagnosed(TieOfSeries(44, 88));
  ASSERT_EQ(diagnosis.verdict, Verdict::kTie) << diagnosis.sentence << Held(diagnosis);
  const std::set<std::set<std::string>> sets = SetsOf(diagnosis);
  ASSERT_TRUE(sets.contains({"supply_droop"}) && sets.contains({"directional_conductance"}));
  ASSERT_TRUE(diagnosis.next_experiment.has_value());
  EXPECT_EQ(diagnosis.next_experiment->measure,
            std::vector<std::string>{"source_pressure_kpa_gauge"});
}

// Gas that follows the wall within a hundredth of a stroke: from slower starts a fit ends where no
// heat is exchanged at all, far worse than the base model.
TEST(BenchDiagnosis, FastHeatTransferIsFound) {
  const Diagnosis diagnosis = Diagnosed(TieOfSeries(50, 73));
  EXPECT_TRUE(SetsOf(diagnosis).contains({"heat_transfer"}))
      << diagnosis.sentence << Held(diagnosis);
}

// Clocks that are off by parts of a sample, with which the restriction alone does better than with
// an effect that imitates them.
TEST(BenchDiagnosis, ClocksAreTriedInThePlaceOfEachEffect) {
  const Diagnosis diagnosis = Diagnosed(TieOfSeries(50, 89));
  EXPECT_TRUE(SetsOf(diagnosis).contains({"exhaust_restriction"}))
      << diagnosis.sentence << Held(diagnosis);
}

// Heat to a wall that stays warm is a limit of heat to any wall: where the second fits, the first
// is found too.
TEST(BenchDiagnosis, ALimitOfAnEffectIsFoundWithIt) {
  const BenchCase bench = TieOfSeries(44, 5);
  ASSERT_EQ(bench.effects.front().id, "heat_transfer");
  const Diagnosis diagnosis = Diagnosed(bench);
  EXPECT_TRUE(SetsOf(diagnosis).contains({"heat_transfer"}))
      << diagnosis.sentence << Held(diagnosis);
}

// With the clocks fitted creep leaves noise by all tests; a few readings at the start of each
// stroke show that the valve also opens slowly.
TEST(BenchDiagnosis, EffectsThatActInTimeAreTriedBesideTheClocks) {
  const Diagnosis diagnosis = Diagnosed(Small(CaseOfSeries(25, 153)));
  ASSERT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence << Held(diagnosis);
  const std::set<std::set<std::string>> named = {{"creep", "valve_ramp"}};
  EXPECT_EQ(SetsOf(diagnosis), named);
}

#ifndef PLENUM_SANITIZED
// The supply's droop alone ends at a worse optimum; with an offset of the sensor beside it the fit
// finds the better one, from where the offset is not needed.
TEST(BenchDiagnosis, AnOptimumThatAPairFindsIsTriedWithEachOfItsEffects) {
  const Diagnosis diagnosis = Diagnosed(CaseOfSeries(25, 71));
  ASSERT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence << Held(diagnosis);
  const std::set<std::set<std::string>> named = {{"supply_droop"}};
  EXPECT_EQ(SetsOf(diagnosis), named);
}

// A line whose fit alone ended at a wrong length; a lagging sensor beside it takes up some of what
// that leaves.
TEST(BenchDiagnosis, LengthsOfALineAreTriedWithoutTheEffectsBesideIt) {
  PLENUM_ONLY_IN_FULL();
  const Diagnosis diagnosis = Diagnosed(CaseOfSeries(26, 131));
  ASSERT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence << Held(diagnosis);
  const std::set<std::set<std::string>> named = {{"line_dynamics"}};
  EXPECT_EQ(SetsOf(diagnosis), named);
}

// A line imitates a cracking pressure beside an opened valve's conductance better than either of
// them does alone.
// A line that kinks, by a few readings: a bent volume law leaves noise, a conductance that falls as
// the actuator expands fits much better.
TEST(BenchDiagnosis, WhatALearnedTermDoesBetterIsNotNamed) {
  const Diagnosis diagnosis = Diagnosed(RealOfSeries(7341, 141));
  EXPECT_EQ(diagnosis.verdict, Verdict::kUnexplained) << diagnosis.sentence;
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_TRUE(diagnosis.tied.empty());
}

TEST(BenchDiagnosis, PairsAreMadeOfMoreEffectsBeforeAThirdIsAdded) {
  PLENUM_ONLY_IN_FULL();
  const Diagnosis diagnosis = Diagnosed(CaseOfSeries(25, 238));
  ASSERT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence << Held(diagnosis);
  const std::set<std::set<std::string>> named = {{"cracking_pressure", "directional_conductance"}};
  EXPECT_EQ(SetsOf(diagnosis), named);
}

// A supply that droops has three numbers and comes to the noise; an opened valve's conductance and
// the sensor's gain have one each and do better.
TEST(BenchDiagnosis, TwoEffectsOfFewerNumbersAreTriedBesideOne) {
  const Diagnosis diagnosis = Diagnosed(CaseOfSeries(24, 58));
  ASSERT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence << Held(diagnosis);
  const std::set<std::set<std::string>> named = {{"directional_conductance", "sensor_gain"}};
  EXPECT_EQ(SetsOf(diagnosis), named);
}
#endif

}  // namespace bench_diagnosis_test
}  // namespace plenum::test
