// Records that drive a run's model: the valve's opening, a regulator's setpoint, an imposed volume.
// The readings come from an integrator of the test's own.
#include "calibration/fit/recorded/driving.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "calibration/diagnose.h"
#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace driving_test {

using enum model::ValveState;
using Course = std::function<double(double)>;

constexpr double kC = 0.05e-8, kB = 0.3;  // of the line
constexpr double kNoisePa = 100.0;
constexpr double kStepS = 1e-3, kEverySteps = 20;

double IsoFlow(double conductance, double b, double upstream_pa, double downstream_pa) {
  if (downstream_pa >= upstream_pa) return 0.0;
  const double over = std::max(0.0, (downstream_pa / upstream_pa - b) / (1.0 - b));
  return conductance * upstream_pa * std::sqrt(1.0 - over * over);
}

// A rig with one actuator: 50 mL at rest and 100 mL at 100 kPa gauge, or of an imposed volume.
struct TrueRig {
  Course opening = [](double) { return 1.0; };  // of the valve, signed: below 0 it lets out
  Course source_pa = [](double) { return 3e5; };
  Course volume_m3;     // imposed
  double leak = 0.0;    // conductance to the surroundings
  double droop_m3 = 0;  // a volume that the source refills through `feed`
  double feed = 0.0;
  double start_pa = 1e5;
};

std::vector<double> TruePressures(const TrueRig& rig, std::size_t samples) {
  struct State {
    double p, tank;
  };
  State y = {rig.start_pa, rig.source_pa(0.0)};
  const auto rate = [&](double t, const State& at) {
    const double open = rig.opening(t), source_pa = rig.source_pa(t);
    const double head = rig.droop_m3 > 0.0 ? at.tank : source_pa;
    const double in = IsoFlow(std::max(0.0, open) * kC, kB, head, at.p);
    const double leak = IsoFlow(rig.leak, 0.3, at.p, 1e5) - IsoFlow(rig.leak, 0.3, 1e5, at.p);
    const double out = IsoFlow(std::max(0.0, -open) * kC, kB, at.p, 1e5) + leak;
    State slope = {0.0, 0.0};
    const double net_pa_m3 = 1e5 * (in - out);
    if (rig.volume_m3) {
      constexpr double kH = 1e-6;
      const double growth = (rig.volume_m3(t + kH) - rig.volume_m3(t - kH)) / (2.0 * kH);
      slope.p = (net_pa_m3 - at.p * growth) / rig.volume_m3(t);
    } else {
      slope.p = net_pa_m3 / (50e-6 * (1.0 + (at.p - 1e5) / 1e5) + at.p * 50e-6 / 1e5);
    }
    if (rig.droop_m3 > 0.0)
      slope.tank = 1e5 * (IsoFlow(rig.feed, 0.3, source_pa, at.tank) - in) / rig.droop_m3;
    return slope;
  };
  const auto ahead = [](const State& at, const State& slope, double h) {
    return State{at.p + h * slope.p, at.tank + h * slope.tank};
  };
  std::vector<double> pressure_pa = {y.p};
  while (pressure_pa.size() < samples) {
    for (int i = 0; i < kEverySteps; ++i) {
      const double t = kStepS * (kEverySteps * static_cast<double>(pressure_pa.size() - 1) + i);
      const double mid = t + 0.5 * kStepS, end = t + kStepS * (1.0 - 1e-9);
      const State a = rate(t, y), b = rate(mid, ahead(y, a, 0.5 * kStepS));
      const State c = rate(mid, ahead(y, b, 0.5 * kStepS)), d = rate(end, ahead(y, c, kStepS));
      y.p += kStepS / 6.0 * (a.p + 2.0 * b.p + 2.0 * c.p + d.p);
      y.tank += kStepS / 6.0 * (a.tank + 2.0 * b.tank + 2.0 * c.tank + d.tank);
    }
    pressure_pa.push_back(y.p);
  }
  return pressure_pa;
}

Run Recorded(const char* id, const TrueRig& rig, std::size_t samples, std::uint64_t seed,
             double noise_pa = kNoisePa) {
  Run run;
  run.id = id;
  run.chamber = {.rest_volume_m3 = 50e-6,
                 .expansion_ratio = 2.0,
                 .operating_pressure_pa = 2e5,
                 .volume_curve = {}};
  run.line = {{{kC, kB}, {kC, kB}, {}}};
  run.supply = Supply::kRegulated;
  run.source_pressure_pa = 3e5;
  run.initial_pressure_pa = rig.start_pa;
  for (std::size_t i = 0; i < samples; ++i) run.t_s.push_back(0.02 * static_cast<double>(i));
  run.pressure_pa = TruePressures(rig, samples);
  const std::vector<double> noise = test::WhiteNoise(seed, samples, noise_pa);
  for (std::size_t i = 0; i < samples; ++i) run.pressure_pa[i] += noise[i];
  return run;
}

std::vector<double> Sampled(const std::vector<double>& t_s, const Course& course,
                            std::uint64_t seed, double noise) {
  std::vector<double> values = test::WhiteNoise(seed, t_s.size(), noise);
  for (std::size_t i = 0; i < t_s.size(); ++i) values[i] += course(t_s[i]);
  return values;
}

Dataset DatasetOf(std::vector<Run> runs) {
  Dataset dataset;
  dataset.name = "driven";
  dataset.runs = std::move(runs);
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)] = 0.02;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSonicConductance)] = 0.03;
  dataset.holdout = {dataset.runs.back().id};
  return dataset;
}

constexpr double kRestS = 1.5 * std::numbers::pi;  // where the third swing ends

// A proportional valve that swings between filling and letting out, `size` of it.
Dataset Proportional(double late_s, double leak, std::uint64_t seed) {
  std::vector<Run> runs;
  const std::vector<std::pair<const char*, double>> sizes = {
      {"a", 0.6}, {"b", 1.0}, {"c", 0.35}, {"unseen", 0.8}};
  for (const auto& [id, size] : sizes) {
    const double most = size;
    const Course command = [most](double t) {
      return most * std::sin(2.0 * t) * (t < kRestS ? 1 : 0);
    };
    TrueRig rig;
    rig.leak = leak;
    rig.opening = [=](double t) { return t < late_s ? 0.0 : command(t - late_s); };
    Run run = Recorded(id, rig, 251, ++seed);
    const Course size_of = [command](double t) { return std::abs(command(t)); };
    run.channels.valve_opening = Sampled(run.t_s, size_of, 1000 + seed, 5e-4);
    const double turn_s = 0.5 * std::numbers::pi;
    run.valve = {{0.0, kInflate}, {turn_s, kDeflate}, {2.0 * turn_s, kInflate}};
    runs.push_back(std::move(run));
  }
  return DatasetOf(std::move(runs));
}

// RMS of what the model as declared is off the readings.
double DeclaredError(const Dataset& dataset) {
  const ForwardModel forward(dataset);
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Prediction p = forward.Predict(i, forward.Declared(), {}, {});
    for (std::size_t k = 0; k < p.reading.pressure_pa.size(); ++k, ++count)
      squares += std::pow(p.reading.pressure_pa[k] - dataset.runs[i].pressure_pa[k], 2);
  }
  return std::sqrt(squares / count);
}

TEST(DrivingRecords, AnOpeningDrivesTheLine) {
  Dataset dataset = Proportional(0.0, 0.0, 10);
  const Diagnosis d = Diagnose(dataset, {});
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.sentence;
  EXPECT_LT(d.after.rms_pa, 1.1 * kNoisePa);
  EXPECT_LT(*d.after.holdout_rms_pa, 1.1 * kNoisePa);
  for (auto& run : dataset.runs) run.channels.valve_opening.clear();
  EXPECT_GT(DeclaredError(dataset), 20.0 * kNoisePa);
}

TEST(DrivingRecords, ALeakIsNamedBesideAnOpening) {
  const Diagnosis d = Diagnose(Proportional(0.0, 0.003e-8, 20), {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().effect.spec->id, "leak");
}

// What is recorded is the command, and the spool comes after it.
TEST(DrivingRecords, ADelayBehindAnOpeningIsNamed) {
  const Diagnosis d = Diagnose(Proportional(0.05, 0.0, 30), {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().effect.spec->id, "valve_delay");
  EXPECT_NEAR(d.effects.front().parameters.front().value, 0.05, 0.003);
}

// A regulator that is told steps and ramps.
Dataset Setpoint(double droop_m3, double feed, std::uint64_t seed) {
  std::vector<Run> runs;
  const std::vector<std::pair<const char*, double>> sizes = {
      {"a", 1.0}, {"b", 1.6}, {"c", 0.7}, {"unseen", 1.3}};
  for (const auto& [id, size] : sizes) {
    const double most = size;
    const Course setpoint = [most](double t) {
      return 1e5 + most * 1e5 * (0.3 + 0.7 * std::min(1.0, std::max(0.0, t - 0.5)));
    };
    TrueRig rig;
    rig.source_pa = setpoint;
    rig.droop_m3 = droop_m3, rig.feed = feed;
    rig.opening = [](double t) { return t < 0.2 ? 0.0 : t < 2.6 ? 1.0 : t < 3.0 ? 0.0 : -1.0; };
    Run run = Recorded(id, rig, 251, ++seed);
    run.channels.source_setpoint_pa = Sampled(run.t_s, setpoint, 1, 0.0);
    run.source_pressure_pa = 1e5 + most * 1e5;
    run.valve = {{0.2, kInflate}, {2.6, kHold}, {3.0, kDeflate}};
    runs.push_back(std::move(run));
  }
  return DatasetOf(std::move(runs));
}

TEST(DrivingRecords, ASetpointDrivesTheSource) {
  Dataset dataset = Setpoint(0.0, 0.0, 40);
  const Diagnosis d = Diagnose(dataset, {});
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.sentence;
  EXPECT_LT(*d.after.holdout_rms_pa, 1.1 * kNoisePa);
  for (auto& run : dataset.runs) run.channels.source_setpoint_pa.clear();
  EXPECT_GT(DeclaredError(dataset), 20.0 * kNoisePa);
}

// The regulator does what it is told behind a pipe of its own.
TEST(DrivingRecords, DroopBehindASetpointIsNamed) {
  const Diagnosis d = Diagnose(Setpoint(60e-6, 0.04e-8, 50), {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().effect.spec->id, "supply_droop");
}

// A piston that moves to and fro in a closed cylinder.
Dataset Syringe(double leak, std::uint64_t seed, double noise_pa, double noise_m3) {
  std::vector<Run> runs;
  for (const auto& [id, rate] : {std::pair{"slow", 1.5}, {"fast", 4.0}, {"unseen", 2.5}}) {
    const double w = rate;
    TrueRig rig;
    rig.leak = leak;
    rig.opening = [](double) { return 0.0; };
    rig.volume_m3 = [w](double t) { return 50e-6 - 20e-6 * std::sin(w * t); };
    Run run = Recorded(id, rig, 251, ++seed, noise_pa);
    run.channels.volume_m3 = Sampled(run.t_s, rig.volume_m3, 500 + seed, noise_m3);
    run.volume_imposed = run.blocked = true;
    run.initial_pressure_pa.reset();
    run.supply = Supply::kNone;
    run.source_pressure_pa = 1e5;
    run.line.clear();
    run.valve = {{0.0, kHold}};
    runs.push_back(std::move(run));
  }
  return DatasetOf(std::move(runs));
}

TEST(DrivingRecords, AnImposedVolumeOfAClosedChamberIsBoylesLaw) {
  Dataset dataset = Syringe(0.0, 60, 0.0, 0.0);
  for (auto& run : dataset.runs) run.initial_pressure_pa = 1e5;
  // A straight stroke is the record itself.
  std::vector<double>& volume_m3 = dataset.runs[0].channels.volume_m3;
  for (std::size_t i = 0; i < volume_m3.size(); ++i)
    volume_m3[i] = 50e-6 - 1e-7 * static_cast<double>(std::min<std::size_t>(i, 200));
  const ForwardModel forward(dataset);
  EXPECT_LE(DrivingRecordsOf(dataset.runs[0]).volume_m3.time_s.size(), 12u);
  const Prediction p = forward.Predict(0, forward.Declared(), {}, {.relative_tolerance = 1e-9});
  ASSERT_EQ(p.status, model::SimulateStatus::kDone) << p.detail;
  for (std::size_t i = 0; i < volume_m3.size(); ++i)
    EXPECT_NEAR(p.reading.pressure_pa[i] * volume_m3[i] / (1e5 * 50e-6), 1.0, 1e-6) << i;
  // Of one that bends, too.
  const Prediction bent = forward.Predict(1, forward.Declared(), {}, {.relative_tolerance = 1e-9});
  for (std::size_t i = 0; i < volume_m3.size(); ++i) {
    const double product = bent.reading.pressure_pa[i] * dataset.runs[1].channels.volume_m3[i];
    EXPECT_NEAR(product / (1e5 * 50e-6), 1.0, 1e-3) << i;
  }
}

TEST(DrivingRecords, AnImposedVolumeIsAdequateAndIsNoReading) {
  const Diagnosis d = Diagnose(Syringe(0.0, 70, kNoisePa, 3e-9), {});
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.sentence;
  EXPECT_LT(*d.after.holdout_rms_pa, 1.2 * kNoisePa);
}

TEST(DrivingRecords, ALeakIsNamedBesideAnImposedVolume) {
  const Diagnosis d = Diagnose(Syringe(0.002e-8, 80, kNoisePa, 0.0), {});
  ASSERT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().effect.spec->id, "leak");
}

TEST(DrivingRecords, DerivativesAgreeWithDifferences) {
  Dataset dataset = Syringe(0.0, 90, 0.0, 0.0);
  const ForwardModel forward(dataset);
  const Parameter leak = {.kind = Parameter::Kind::kEffect};
  const PredictOptions tight{.relative_tolerance = 1e-11};
  ModelState at = forward.Declared();
  at.effects = {{model::FindEffect("leak"), {0.01e-8, 0.3}}};
  const Prediction p = forward.Predict(1, at, {&leak, 1}, tight);
  ASSERT_EQ(p.status, model::SimulateStatus::kDone) << p.detail;
  const auto moved = [&](double step) {
    ModelState state = at;
    NumberOf(state, leak) += step;
    return forward.Predict(1, state, {}, tight).reading.pressure_pa;
  };
  const std::vector<double> above = moved(1e-13), below = moved(-1e-13);
  double most = 0.0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    const double slope = (above[i] - below[i]) / 2e-13;
    EXPECT_NEAR(p.derivatives[0].pressure_pa[i], slope, 1e10 + 1e-3 * std::abs(slope)) << i;
    most = std::max(most, std::abs(slope));
  }
  EXPECT_GT(most, 1e12);
}

}  // namespace driving_test
}  // namespace plenum::calibration
