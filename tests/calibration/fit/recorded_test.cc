// What is stated of the record itself: the gauge and the instants of commands, on data of the
// independent simulator.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "calibration/diagnose.h"
#include "calibration/fit/recorded/instants.h"
#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace recorded_test {

using test::EffectRig;
using test::MeasuredBench;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// As the reader of measurements states an accuracy.
void StateAccuracy(double accuracy_pa, Dataset& dataset) {
  for (Run& run : dataset.runs) run.sensor.accuracy_pa = accuracy_pa;
  const auto state = [&](Declared number, double share) {
    dataset.relative_uncertainty[static_cast<std::size_t>(number)] = share;
  };
  state(Declared::kSensorZero, accuracy_pa / kSensorZeroPa);
  state(Declared::kSensorGain, accuracy_pa / 1e5);
}

double FactorOf(const Diagnosis& d, Declared number) {
  return d.models.after.state.factor[static_cast<std::size_t>(number)];
}

// The rig as in the other tests, but for its gauge.
Dataset Gauged(double offset_pa, double gain) {
  return MeasuredBench(
      [=](EffectRig& rig) {
        rig.sensor_offset_pa = offset_pa;
        rig.sensor_gain = gain;
      },
      41);
}

TEST(Recorded, AGaugeWithinItsAccuracyIsNoEffect) {
  Dataset dataset = Gauged(900.0, 1.0);
  const Diagnosis exact = Diagnose(dataset, {});
  ASSERT_EQ(exact.verdict, Verdict::kExplained) << exact.sentence;
  EXPECT_EQ(exact.effects.front().effect.spec->id, "sensor_offset");
  StateAccuracy(800.0, dataset);
  const Diagnosis d = Diagnose(dataset, {});
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.sentence;
  EXPECT_TRUE(d.effects.empty());
  EXPECT_NEAR((FactorOf(d, Declared::kSensorZero) - 1.0) * kSensorZeroPa, 900.0, 60.0);
  EXPECT_NEAR(FactorOf(d, Declared::kSensorGain), 1.0, 3e-3);
  EXPECT_LT(*d.after.holdout_rms_pa, 1.1 * test::kBenchNoisePa);
}

TEST(Recorded, AGaugeFarBeyondItsAccuracyIsNamed) {
  Dataset dataset = Gauged(2500.0, 1.0);
  StateAccuracy(200.0, dataset);
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().effect.spec->id, "sensor_offset");
  EXPECT_NEAR(d.effects.front().parameters.front().value, 2500.0, 150.0);
}

TEST(Recorded, DerivativesOfGaugeAndInstantsAgreeWithDifferences) {
  Dataset dataset = MeasuredBench({}, 1, 0.0);
  StateAccuracy(500.0, dataset);
  dataset.runs[0].valve_uncertainty_s = {0.0, 0.05, 0.05, kUnknown, 0.0};
  const ForwardModel forward(dataset);
  ModelState at = forward.Declared();
  at.factor[static_cast<std::size_t>(Declared::kSensorZero)] = 1.01;
  at.factor[static_cast<std::size_t>(Declared::kSensorGain)] = 0.98;
  at.moved_s[0] = {0.0, 0.013, -0.007, 0.031, 0.0};
  const auto inflate = static_cast<std::size_t>(dataset.runs[0].valve[1].state);
  at.shared_sigmas[inflate] = -0.4;
  const PredictOptions tight{.relative_tolerance = 1e-11};
  const std::vector<Parameter> parameters = {
      {.declared = Declared::kSensorZero},
      {.declared = Declared::kSensorGain},
      {.declared = Declared::kRestVolume},
      {.kind = Parameter::Kind::kInstant, .number = 1},
      {.kind = Parameter::Kind::kInstant, .number = 3},
      {.kind = Parameter::Kind::kSharedInstant, .number = inflate}};
  const Prediction p = forward.Predict(0, at, parameters, tight);
  ASSERT_EQ(p.status, model::SimulateStatus::kDone) << p.detail;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const auto moved = [&](double step) {
      ModelState state = at;
      NumberOf(state, parameters[j]) += step;
      return forward.Predict(0, state, {}, tight).reading.pressure_pa;
    };
    const std::vector<double> above = moved(1e-5), below = moved(-1e-5);
    for (std::size_t i = 0; i < above.size(); ++i) {
      const double slope = (above[i] - below[i]) / 2e-5;
      EXPECT_NEAR(p.derivatives[j].pressure_pa[i], slope, 30.0 + 1e-4 * std::abs(slope))
          << j << " " << i;
    }
  }
}

// The recorded fill of one run comes three readings late, its vent two early.
Dataset OffByReadings() {
  Dataset dataset = MeasuredBench({}, 43);
  dataset.runs[0].valve[1].time_s += 0.06;
  dataset.runs[0].valve[2].time_s += 0.06;
  dataset.runs[0].valve[3].time_s -= 0.04;
  return dataset;
}

TEST(Recorded, UncertainInstantsAreFitted) {
  Dataset dataset = OffByReadings();
  EXPECT_NE(Diagnose(dataset, {}).verdict, Verdict::kAdequate);
  dataset.runs[0].valve_uncertainty_s.assign(5, 0.04);
  const Diagnosis d = Diagnose(dataset, {});
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.sentence;
  const auto moved_s = [&](std::size_t command) {
    return MovedBy(dataset.runs[0], 0, command, d.models.after.state);
  };
  EXPECT_NEAR(moved_s(1), -0.06, 0.004);
  EXPECT_NEAR(moved_s(2), -0.06, 0.004);
  EXPECT_NEAR(moved_s(3), 0.04, 0.004);
}

// Of a run that no fit saw, too.
TEST(Recorded, InstantsThatAreNotKnownAreFoundInTheReadings) {
  Dataset dataset = MeasuredBench({}, 44);
  const auto told = dataset.runs;
  for (const std::size_t i : {0u, 1u, 3u}) {
    auto& run = dataset.runs[i];
    run.valve_uncertainty_s = {0.0, kUnknown, kUnknown, kUnknown, 0.0};
    for (std::size_t k = 1; k < 4; ++k) run.valve[k].time_s = kNaN;
    GuessInstants(run);
    for (std::size_t k = 1; k < 4; ++k)
      EXPECT_NEAR(run.valve[k].time_s, told[i].valve[k].time_s, 0.2) << run.id << " " << k;
  }
  const Diagnosis d = Diagnose(dataset, {});
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.sentence;
  for (const std::size_t i : {0u, 1u, 3u})
    for (std::size_t k = 1; k < 4; ++k)
      EXPECT_NEAR(dataset.runs[i].valve[k].time_s + d.models.after.state.moved_s[i][k],
                  told[i].valve[k].time_s, 0.006)
          << dataset.runs[i].id << " " << k;
  EXPECT_THAT(d.warnings, testing::Contains(testing::HasSubstr("command 2 of low at 0.")));
  EXPECT_LT(*d.after.holdout_rms_pa, 1.1 * test::kBenchNoisePa);
}

// What is missing is still named beside them.
TEST(Recorded, ALeakIsNamedBesideInstantsThatAreNotKnown) {
  Dataset dataset = MeasuredBench(
      [](EffectRig& rig) {
        rig.leak = test::OrificeLeak{0.002e-8, 0.3};
      },
      45);
  for (auto& run : dataset.runs) run.valve_uncertainty_s = {0.0, kUnknown, kUnknown, kUnknown, 0.0};
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().effect.spec->id, "leak");
}

// A logger that writes the vent a reading late each time makes no other effect: it is late by one
// number, whether or not each command has an error of its own, too.
TEST(Recorded, ALoggerThatIsLateHidesNoLeakAndIsNone) {
  Dataset dataset = MeasuredBench(
      [](EffectRig& rig) {
        rig.leak = test::OrificeLeak{0.002e-8, 0.3};
      },
      46);
  for (auto& run : dataset.runs) run.valve[3].time_s += 0.0195;
  for (auto& run : dataset.runs) run.valve_uncertainty_s = {0.0, 0.0115, 0.0115, 0.0115, 0.0115};
  const Diagnosis d = Diagnose(dataset, {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u) << d.sentence;
  EXPECT_EQ(d.effects.front().effect.spec->id, "leak");
  for (std::size_t i = 0; i < dataset.runs.size(); ++i)
    EXPECT_NEAR(MovedBy(dataset.runs[i], i, 3, d.models.after.state), -0.0195, 0.004) << i;
}

TEST(Recorded, WhatCommandsShareIsToldWhereItIsMuch) {
  Dataset dataset = MeasuredBench({}, 47);
  for (auto& run : dataset.runs) {
    run.valve[1].time_s -= 0.035;
    run.valve_uncertainty_s = {0.0, 0.0115, 0.0115, 0.0115, 0.0115};
  }
  const Diagnosis d = Diagnose(dataset, {});
  EXPECT_THAT(d.warnings, testing::Contains(testing::HasSubstr("the commands to inflate act 3")));
  EXPECT_THAT(d.warnings, testing::Not(testing::Contains(testing::HasSubstr("to deflate act"))));
}

TEST(Recorded, ManyCommandsHaveSharedErrorsAlone) {
  Dataset dataset = MeasuredBench({}, 1, 0.0);
  calibration::Run& run = dataset.runs[0];
  run.valve.clear();
  for (int i = 0; i < 10; ++i) {
    run.valve.push_back({0.2 + 0.4 * i, model::ValveState::kInflate});
    run.valve.push_back({0.4 + 0.4 * i, model::ValveState::kDeflate});
  }
  run.valve_uncertainty_s.assign(20, 0.01);
  EXPECT_EQ(InstantCoordinates(dataset, {0}).size(), 20u);
  run.t_s.clear();
  for (int i = 0; i < 2500; ++i) run.t_s.push_back(0.002 * i);
  EXPECT_EQ(InstantCoordinates(dataset, {0}).size(), 0u);  // each is a derivative of 2,500 readings
  EXPECT_EQ(SharedInstantCoordinates(dataset, {0}).size(), 2u);
  run.valve_uncertainty_s[3] = kUnknown;  // each such one is sought
  EXPECT_EQ(InstantCoordinates(dataset, {0}).size(), 1u);
  run.valve_uncertainty_s.assign(20, 0.0);
  for (std::size_t k = 0; k < 16; ++k) run.valve_uncertainty_s[k] = 0.01;
  EXPECT_EQ(InstantCoordinates(dataset, {0}).size(), 16u);
}

TEST(Recorded, AnInstantStaysBetweenItsNeighbours) {
  Dataset dataset = MeasuredBench({}, 1, 0.0);
  dataset.runs[0].valve_uncertainty_s = {0.0, kUnknown, kUnknown, 0.05, 0.0};
  const std::vector<Coordinate> c = InstantCoordinates(dataset, {0, 1});
  ASSERT_EQ(c.size(), 3u);
  EXPECT_FALSE(c[0].prior);
  EXPECT_TRUE(c[2].prior);
  EXPECT_NEAR(c[0].Number(c[0].low), -0.2, 1e-12);   // the command before is exact
  EXPECT_NEAR(c[0].Number(c[0].high), 0.45, 1e-12);  // half of the way to the next
  EXPECT_NEAR(c[2].Number(c[2].high), 0.25, 1e-12);  // five of its deviations
  // Where two share an error, its own and the shared one are within the same room together.
  dataset.runs[0].valve_uncertainty_s = {0.0, 0.2, 0.0, 0.0, 0.0};
  dataset.runs[1].valve_uncertainty_s = {0.0, 0.2, 0.0, 0.0, 0.0};
  const std::vector<Coordinate> own = InstantCoordinates(dataset, {0, 1});
  const std::vector<Coordinate> shared = SharedInstantCoordinates(dataset, {0, 1});
  ASSERT_EQ(shared.size(), 1u);
  EXPECT_NEAR(own[0].Number(own[0].low) + 0.2 * shared[0].Number(shared[0].low), -0.2, 1e-12);
}

// Readings of 20 kPa to either side of the guess: nothing to find.
TEST(Recorded, WhereNoReadingLiesBetweenKnownCommandsNothingIsGuessed) {
  auto run = MeasuredBench({}, 1).runs[0];
  run.valve = {{0.201, model::ValveState::kInflate},
               {kNaN, model::ValveState::kHold},
               {0.209, model::ValveState::kDeflate}};
  GuessInstants(run);
  EXPECT_TRUE(std::isnan(run.valve[1].time_s));
}

}  // namespace recorded_test
}  // namespace plenum::calibration
