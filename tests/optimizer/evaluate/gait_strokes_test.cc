// Strokes of a gait against a plain simulation of many periods, whose commands are written here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/simulate/simulate.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "tests/support/brute_force.h"
#include "tests/support/drawn_gait.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace gait_strokes_test {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::Strokes;

constexpr int kPeriods = 40;

Problem Drawn(std::uint64_t seed, Configuration configuration) {
  Draw draw;
  draw.seed = 7700 + seed;
  draw.configurations = {configuration};
  draw.groups = 1 + static_cast<int>(seed % 3);
  draw.severity = 0.25;
  draw.size = configuration == Configuration::kCompressor
                  ? CatalogueSize{1, 2, 3, 0, 0, 0, 2, 1, 1}
                  : CatalogueSize{1, 2, 3, 1, 1, 0, 0, 1, 0};
  Problem problem = RandomProblem(draw);
  problem.exclude.insert("custom");
  Random random(seed);
  DrawGaits(random, problem);
  for (model::Valve& valve : problem.parts.valves)
    if (Chance(random, 0.5)) valve.kind = model::ValveKind::kPair;
  return problem;
}

struct Measured {
  std::vector<double> rise_s, inflate_s;
  double pump_on_s = 0.0, pump_energy_j = 0.0;
  double drawn_m3 = 0.0, given_m3 = 0.0;
  bool done = false;
};

// All actuators one by one, each with the commands of its own phase, for so many periods; the last
// one counts.
Measured Plain(const Problem& problem, const Candidate& candidate, double source_pa,
               double reservoir_m3) {
  model::Rig rig =
      optimizer::MakePeriodicRig(problem, candidate, {source_pa, reservoir_m3, reservoir_m3});
  const std::vector<model::GroupRig> lines = rig.groups;
  rig.groups.clear();
  std::vector<int> group_of;
  const double period_s = 1.0 / problem.frequency_hz;
  std::size_t line = 0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const optimizer::ActuatorGroup& group = problem.groups[g];
    const optimizer::Gait& gait = group.gait;
    const int n = gait.strokes_per_period;
    while (lines[line].name != group.name) ++line;
    for (int unit = 0; unit < group.count; ++unit) {
      double phase =
          problem.simultaneous ? 0.0 : g / static_cast<double>(problem.groups.size()) / n;
      if (!gait.phases.empty())
        phase = gait.phases.size() == 1 ? gait.phases[0] : gait.phases[unit];
      model::GroupRig one = lines[line];
      one.count = 1;
      one.schedule.clear();
      for (int k = 0; k < n; ++k)
        for (int p = 0; p < kPeriods; ++p) {
          const double at = std::fmod(phase + k / static_cast<double>(n), 1.0);
          one.schedule.push_back({(at + p) * period_s, model::ValveState::kInflate});
          one.schedule.push_back(
              {(at + p + gait.inflate_fraction / n) * period_s, model::ValveState::kDeflate});
        }
      std::sort(one.schedule.begin(), one.schedule.end(),
                [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
      rig.groups.push_back(one);
      group_of.push_back(g);
    }
  }
  model::SimulateOptions options = optimizer::StrokeOptions(problem);
  options.relative_tolerance = 1e-9;
  const auto run = [&](double end_s) {
    options.end_s = end_s;
    return model::Simulate(rig, options);
  };
  const model::Response before = run((kPeriods - 2) * period_s);
  const model::Response response = run((kPeriods - 1) * period_s);
  Measured measured;
  measured.done = response.status == model::SimulateStatus::kDone &&
                  before.status == model::SimulateStatus::kDone;
  measured.rise_s.assign(problem.groups.size(), 0.0);
  measured.inflate_s = measured.rise_s;
  for (const model::Stroke& stroke : response.strokes) {
    if (stroke.state != model::ValveState::kInflate) continue;
    // The last of each that is over.
    if (stroke.command_s < (kPeriods - 3) * period_s ||
        stroke.command_s >= (kPeriods - 2) * period_s)
      continue;
    const int g = group_of[stroke.group];
    measured.rise_s[g] = std::max(measured.rise_s[g], stroke.to_target_s);
    measured.inflate_s[g] = std::max(measured.inflate_s[g], stroke.to_operating_s);
  }
  measured.pump_on_s = response.compressor_on_s - before.compressor_on_s;
  measured.pump_energy_j = response.compressor_energy_j - before.compressor_energy_j;
  for (std::size_t i = 0; i < rig.groups.size(); ++i)
    measured.drawn_m3 += response.groups[i].air_drawn_m3 - before.groups[i].air_drawn_m3;
  measured.given_m3 = response.compressor_air_m3 - before.compressor_air_m3;
  return measured;
}

void ExpectSame(double a, double b, double tolerance) {
  if (std::isfinite(a) && std::isfinite(b)) {
    EXPECT_NEAR(a, b, tolerance * b);
  }
}

void Compare(const Problem& problem, int& working) {
  int looked = 0;
  ForEachCombination(problem, [&](const Candidate& candidate) {
    if (++looked > 4) return;
    const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
    if (window.empty()) return;
    const bool pumped = candidate.configuration == Configuration::kCompressor;
    const double reservoir_m3 = optimizer::ReservoirVolume(problem, candidate);
    for (const double share : {0.3, 0.9}) {
      const double source_pa = window.low_pa + share * (window.high_pa - window.low_pa);
      const Strokes strokes =
          optimizer::EvaluateStrokes(problem, candidate, {source_pa, reservoir_m3, reservoir_m3});
      if (strokes.failed) continue;
      bool in_time = strokes.works;
      for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
        in_time = in_time && strokes.inflate_s[g] < 0.98 * optimizer::InflateWindow(problem, g);
      const Measured plain = Plain(problem, candidate, source_pa, reservoir_m3);
      if (!plain.done) continue;
      if (!in_time) continue;
      // Pumps that run all the time may not have come to rest after so few periods.
      const double tolerance =
          pumped && strokes.pump_on_s * problem.frequency_hz > 0.95 ? 3e-3 : 2e-5;
      ++working;
      for (std::size_t g = 0; g < problem.groups.size(); ++g) {
        ExpectSame(strokes.rise_s[g], plain.rise_s[g], tolerance);
        ExpectSame(strokes.inflate_s[g], plain.inflate_s[g], tolerance);
      }
      if (!pumped) continue;
      ExpectSame(strokes.pump_on_s, plain.pump_on_s, tolerance);
      ExpectSame(strokes.pump_energy_j, plain.pump_energy_j, tolerance);
      ExpectSame(plain.given_m3, plain.drawn_m3, tolerance);
    }
  });
}

// How many looks were compared, of so many draws.
int Compared(Configuration configuration, std::uint64_t draws) {
  int working = 0;
  for (std::uint64_t seed = 1; seed <= draws; ++seed) {
    SCOPED_TRACE(seed);
    Compare(Drawn(seed, configuration), working);
  }
  return working;
}

TEST(GaitStrokesTest, BehindARegulatorAsSimulatedPlainly) {
  EXPECT_GT(Compared(Configuration::kMains, 12), 15);
}

TEST(GaitStrokesTest, OutOfAReservoirAsSimulatedPlainly) {
  EXPECT_GT(Compared(Configuration::kCompressor, 14), 8);
}

}  // namespace gait_strokes_test
}  // namespace plenum::test
