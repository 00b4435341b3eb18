// Verdicts on data of the independent simulator.
#include "calibration/diagnose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "tests/calibration/bench.h"
#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace diagnose_test {

using test::Change;
using test::EffectRig;
using test::MeasuredBench;

Diagnosis Of(const Change& change, std::uint64_t seed) {
  return Diagnose(MeasuredBench(change, seed), {});
}

// One rule orders the table: what is better by it and not named says why.
void ExpectOneOrder(const Diagnosis& d, const std::vector<std::string>& named) {
  double before = -std::numeric_limits<double>::infinity();
  bool ahead = true;
  for (const Candidate& candidate : d.candidates) {
    EXPECT_GE(candidate.bic, before);
    before = candidate.bic;
    ahead = ahead && candidate.effects != named;
    EXPECT_EQ(ahead, !candidate.reason.empty()) << ::testing::PrintToString(candidate.effects);
  }
  EXPECT_FALSE(ahead);
}

TEST(Diagnose, ACleanBenchIsAdequate) {
  const Diagnosis d = Of(
      [](EffectRig& rig) {
        rig.rest_volume_m3 *= 1.02;
        rig.fill[0].conductance *= 0.98, rig.exhaust[0].conductance *= 0.98;
      },
      21);
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.sentence;
  EXPECT_TRUE(d.effects.empty());
  EXPECT_EQ(d.after.rms_pa, d.before.rms_pa);
  EXPECT_GT(d.declared.rms_pa, d.before.rms_pa);
  EXPECT_NEAR(d.noise_pa, test::kBenchNoisePa, 0.1 * test::kBenchNoisePa);
  ExpectOneOrder(d, {});
}

TEST(Diagnose, ALeakIsNamedWithItsSizeAndHoldsOnTheRunNotSeen) {
  const Diagnosis d = Of([](EffectRig& rig) { rig.leak = test::OrificeLeak{6e-12, 0.3}; }, 22);
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].effect.spec->id, "leak");
  ASSERT_TRUE(d.after.holdout_rms_pa && d.before.holdout_rms_pa);
  EXPECT_LT(*d.after.holdout_rms_pa, 1.1 * test::kBenchNoisePa);
  EXPECT_GT(*d.before.holdout_rms_pa, 1.5 * test::kBenchNoisePa);
  EXPECT_EQ(d.series.size(), 4u);
  EXPECT_EQ(d.unexplained_fraction, 0.0);
  ExpectOneOrder(d, {"leak:orifice"});
}

// Beside a gap, where a stroke begins, the readings alone do not show it as wild.
Dataset LeakingBenchWithAWildReadingHeldOut() {
  Dataset dataset = MeasuredBench(
      [](EffectRig& rig) {
        rig.leak = test::OrificeLeak{6e-12, 0.3};
      },
      22);
  const auto held_out =
      std::find_if(dataset.runs.begin(), dataset.runs.end(),
                   [&](const calibration::Run& run) { return run.id == dataset.holdout.front(); });
  held_out->pressure_pa[12] += 20.0 * test::kBenchNoisePa;
  held_out->pressure_pa[13] = held_out->pressure_pa[14] = std::nan("");
  return dataset;
}

TEST(Diagnose, AWildReadingOfTheRunNotSeenDoesNotSpeakAgainstTheEffect) {
  const Diagnosis d = Diagnose(LeakingBenchWithAWildReadingHeldOut(), {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  EXPECT_EQ(d.effects[0].effect.spec->id, "leak");
  EXPECT_LT(*d.after.holdout_rms_pa, 1.1 * test::kBenchNoisePa);
  EXPECT_THAT(d.warnings, ::testing::Contains("1 wild readings were left out"));
  // It is not among the readings of the stated error.
  EXPECT_THAT(d.warnings, ::testing::Contains(::testing::StartsWith(
                              "the wild readings are unseen at 0.24 s; with them the error is ")));
}

TEST(Predict, AWildReadingDoesNotSpeakAgainstTheModel) {
  const KnownModel leaks{{{model::FindEffect("leak", "orifice"), {6e-12, 0.3}}}, {}};
  const Diagnosis d = Predict(LeakingBenchWithAWildReadingHeldOut(), leaks, {});
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.sentence;
  EXPECT_LT(*d.after.holdout_rms_pa, 1.1 * test::kBenchNoisePa);
  EXPECT_THAT(d.warnings, ::testing::Contains("1 wild readings were left out"));
}

// In one run a part of a sample may be the clock's or the valve's.
TEST(Diagnose, ALateStrokeOfOneRunIsATieBesideTheClock) {
  Dataset one;
  one.runs = {test::DeclaredRun("only", 3e5, false)};
  test::Measure([](EffectRig& rig) { rig.valve_delay_s = 0.008; }, 26, test::kBenchNoisePa,
                one.runs[0]);
  const Diagnosis d = Diagnose(one, {});
  ASSERT_EQ(d.verdict, Verdict::kTie) << d.sentence;
  EXPECT_THAT(d.tied, ::testing::Contains(std::vector<std::string>{"valve_delay"}));
  EXPECT_THAT(d.warnings, ::testing::Contains(::testing::HasSubstr("the clock of readings")));
  ASSERT_TRUE(d.next_experiment.has_value());
}

// Both clocks are late by a sixth of a sample: any effect that makes strokes late would do instead.
TEST(Diagnose, ClocksThatAreLateAlikeMakeNoEffect) {
  Dataset two;
  two.runs = {test::DeclaredRun("low", 2.6e5, false), test::DeclaredRun("high", 3.4e5, false)};
  two.relative_uncertainty = test::MeasuredBench({}, 1).relative_uncertainty;
  for (std::size_t i = 0; i < 2; ++i) {
    calibration::Run& run = two.runs[i];
    run.t_s.clear();
    for (int k = 0; k <= 100; ++k) run.t_s.push_back(0.05 * k);
    test::Measure([](EffectRig& rig) { rig.sensor_gain = 1.04; }, 28 + i, 1.5 * test::kBenchNoisePa,
                  run);
    for (double& t_s : run.t_s) t_s += 0.008;
  }
  const Diagnosis d = Diagnose(two, {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u) << d.sentence;
  EXPECT_EQ(d.effects[0].effect.spec->id, "sensor_gain");
  EXPECT_THAT(d.warnings, ::testing::Contains(::testing::HasSubstr("the clocks of readings")));
}

#ifndef PLENUM_SANITIZED
// Several sets of effects come near a seam that opens above a pressure, and none to the noise. One
// learned term does.
TEST(Diagnose, WhatOneLearnedTermImitatesIsNoTieBesideStructure) {
  constexpr double kNoisePa = 50.0;
  Dataset one;
  one.runs = {test::DeclaredRun("only", 3e5, false)};
  test::Measure(
      [](EffectRig& rig) {
        rig.unlisted.gaping_seam = test::GapingSeam{1.5e5, 0.1e5, 0.01e-8, 0.3};
      },
      27, kNoisePa, one.runs[0]);
  const Diagnosis d = Diagnose(one, {});
  ASSERT_EQ(d.verdict, Verdict::kUnexplained) << d.sentence;
  EXPECT_TRUE(d.tied.empty());
  EXPECT_THAT(d.warnings, ::testing::Contains(::testing::HasSubstr("one learned term")));
  ASSERT_TRUE(d.discrepancy.has_value());
  EXPECT_EQ(d.discrepancy->equation, model::EffectPlace::kChamber);
  EXPECT_LT(d.discrepancy->rms_after_pa, 1.5 * kNoisePa);
}

TEST(Diagnose, InertiaIsNamedBesideABlockedRun) {
  const Diagnosis d = Of([](EffectRig& rig) { rig.inertia = {12.0, 0.2}; }, 23);
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects[0].effect.spec->id, "inertia");
  EXPECT_LE(d.effects[0].parameters[0].low, 12.0);
  EXPECT_GE(d.effects[0].parameters[0].high, 12.0);
}

#endif

// A chamber shut from the first reading on, which falls.
TEST(Diagnose, AValveThatNeverOpensTellsNothingOfItsLine) {
  Dataset dataset = MeasuredBench({}, 24);
  dataset.runs.resize(1);
  dataset.holdout.clear();
  auto& run = dataset.runs.front();
  run.valve = {{0.0, model::ValveState::kHold}};
  run.initial_pressure_pa = 2e5;
  run.channels = {};
  const std::vector<double> noise = test::WhiteNoise(1, run.t_s.size(), 100.0);
  run.pressure_pa.clear();
  for (std::size_t i = 0; i < run.t_s.size(); ++i)
    run.pressure_pa.push_back(1.8e5 + 2e4 * std::exp(-run.t_s[i]) + noise[i]);
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_FALSE(d.candidates.empty());
  using enum model::EffectPlace;
  for (const Candidate& candidate : d.candidates)
    for (const std::string& name : candidate.effects) {
      const std::string id = name.substr(0, name.find(':'));
      for (const model::EffectSpec* spec : model::Effects())
        EXPECT_TRUE(spec->id != id ||
                    (spec->place != kValve && spec->place != kLine && spec->place != kSupply))
            << name;
    }
}

// Tanks that empty through a bleed of which the declared conductance says nothing, and the ratio
// little.
Dataset EmptyingTanks(const Change& change) {
  Dataset dataset;
  dataset.name = "bleed";
  const double initial_pa[] = {1.17e5, 1.2e5, 1.3e5, 1.31e5, 1.35e5, 1.36e5};
  for (std::uint64_t i = 0; i < std::size(initial_pa); ++i) {
    Run run = test::DeclaredRun("tank_" + std::to_string(i + 1), 1e5, false);
    run.chamber.rest_volume_m3 = 66e-6, run.chamber.expansion_ratio = 1.0;
    run.chamber.operating_pressure_pa = 1.4e5;
    const model::FlowElement pair{0.3e-10, 0.3};
    run.line = {{pair, pair, {}}};
    run.supply = Supply::kNone;
    run.valve = {{0.0, model::ValveState::kDeflate}};
    run.t_s.resize(160);
    for (std::size_t k = 0; k < run.t_s.size(); ++k) run.t_s[k] = 0.025 * static_cast<double>(k);
    const auto emptying = [&](EffectRig& rig) {
      rig.source = EffectRig::Source::kNone;
      rig.rest_volume_m3 = 66e-6, rig.expansion_ratio = 1.0;
      rig.operating_pa = 1.4e5, rig.initial_pa = initial_pa[i];
      rig.exhaust = {{1.3e-10, 0.85}};
      change(rig);
    };
    test::Measure(emptying, 100 + i, 1.0, run);
    run.initial_pressure_pa = run.pressure_pa.front();
    dataset.runs.push_back(run);
  }
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSonicConductance)] = kUnknown;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kCriticalRatio)] = 0.3;
  return dataset;
}

TEST(Diagnose, HeatIsFoundBesideAConductanceThatNobodyKnows) {
  const Diagnosis d = Diagnose(EmptyingTanks([](EffectRig& rig) {
                                 rig.heat_time_constant_s = 1.7;
                                 rig.initial_k = 265.0;
                               }),
                               {});
  ASSERT_EQ(d.effects.size(), 1u) << d.sentence;
  EXPECT_EQ(d.effects[0].effect.spec->id, "heat_transfer");
  EXPECT_NEAR(d.effects[0].effect.parameters[0], 1.7, 0.1);
}

TEST(Diagnose, CancelledIsUndecided) {
  DiagnoseOptions options;
  std::atomic<int> asked = 0;
  options.cancelled = [&] { return ++asked > 40; };
  EXPECT_EQ(Diagnose(MeasuredBench({}, 25), options).verdict, Verdict::kUndecided);
}

TEST(Diagnose, OutOfTimeNamesNothing) {
  DiagnoseOptions options;
  options.time_limit_s = 0.0;
  const Diagnosis d = Diagnose(MeasuredBench({}, 25), options);
  EXPECT_EQ(d.verdict, Verdict::kUndecided);
  EXPECT_THAT(d.sentence, testing::HasSubstr("stopped"));
  EXPECT_TRUE(d.effects.empty());
  EXPECT_GT(d.declared.rms_pa, 0.0);
  EXPECT_LT(d.declared.rms_pa, 1e5);
  EXPECT_FALSE(d.residual.tested);
}

TEST(Diagnose, SeriesOfLongRecordsAreChosenEvenly) {
  Dataset dataset = MeasuredBench({}, 25);
  for (calibration::Run& run : dataset.runs) {
    run.valve.clear();  // a closed chamber
    run.t_s.clear();
    run.pressure_pa = test::WhiteNoise(7, 12'000, 100.0);
    for (int i = 0; i < 12'000; ++i) run.t_s.push_back(5.0 * i / 12'000);
    for (double& pressure_pa : run.pressure_pa) pressure_pa += 1e5;
  }
  DiagnoseOptions options;
  std::atomic<bool> fitted = false;
  options.progress = [&](double, const std::string& what) { fitted = what != "base model"; };
  options.cancelled = [&] { return fitted.load(); };
  const Diagnosis d = Diagnose(dataset, options);
  EXPECT_EQ(d.verdict, Verdict::kUndecided);
  ASSERT_EQ(d.series.size(), 4u);
  for (const Series& series : d.series) {
    ASSERT_EQ(series.t_s.size(), 4'000u);
    for (const auto* list :
         {&series.measured_pa, &series.declared_pa, &series.before_pa, &series.after_pa})
      EXPECT_EQ(list->size(), 4'000u);
    EXPECT_EQ(series.phase.size(), 4'000u);
    EXPECT_DOUBLE_EQ(series.t_s[7], 5.0 * 21 / 12'000);
    EXPECT_EQ(series.measured_pa[7], dataset.runs[0].pressure_pa[21]);
  }
}

// Stopped at any instant: never an effect by name before the search is through, never a number that
// is none.
TEST(Diagnose, StoppedAnywhereIsHonest) {
  const Dataset dataset = MeasuredBench({}, 25);
  for (const int limit : {10, 100, 1'000, 10'000}) {
    DiagnoseOptions options;
    std::atomic<int> asked = 0;
    options.cancelled = [&] { return ++asked > limit; };
    const Diagnosis d = Diagnose(dataset, options);
    for (const ErrorReport* error : {&d.declared, &d.before, &d.after}) {
      EXPECT_TRUE(std::isfinite(error->rms_pa));
      EXPECT_LT(error->rms_pa, 1e6);
    }
    EXPECT_TRUE(d.verdict != Verdict::kUndecided || d.effects.empty());
    for (const Candidate& candidate : d.candidates) EXPECT_FALSE(std::isnan(candidate.rms_pa));
  }
}

}  // namespace diagnose_test
}  // namespace plenum::calibration
