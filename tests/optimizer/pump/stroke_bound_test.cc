// Bounds on strokes out of a reservoir against the strokes themselves.
#include "optimizer/pump/stroke_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/simulate/periodic.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/pump/pump_bounds.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace stroke_bound_test {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::OperatingPoint;
using optimizer::Problem;

Problem PumpProblem(std::uint64_t seed, int groups) {
  Random random(seed);
  Problem problem = EasyProblem(seed, {Configuration::kCompressor});
  for (int g = 1; g < groups; ++g) {
    problem.groups.push_back(problem.groups[0]);
    problem.groups[g].chamber.rest_volume_m3 *= Uniform(random, 0.3, 3.0);
  }
  problem.simultaneous = false;
  problem.frequency_hz *= Uniform(random, 1.0, 4.0);
  return problem;
}

// Calls `visit` for some candidates with a random volume and stop pressure.
void ForSome(const Problem& problem, Random& random, double share,
             const std::function<void(const Candidate&, const OperatingPoint&,
                                      const optimizer::PumpFacts&)>& visit) {
  ForEachCombination(problem, [&](const Candidate& candidate) {
    if (candidate.reservoir.index != optimizer::kCustom || !Chance(random, share)) return;
    const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
    if (window.empty()) return;
    const double volume_m3 = LogUniform(random, 10e-6, 3e-3);
    const double source_pa = Uniform(random, window.low_pa, window.high_pa);
    visit(candidate, {source_pa, volume_m3, volume_m3},
          optimizer::MakePumpFacts(problem,
                                   problem.parts.compressors[candidate.compressor.index].curve,
                                   candidate.compressor.quantity));
  });
}

TEST(StrokeBoundTest, NoStrokeIsFasterAndMostAreHardlySlower) {
  Random random(1);
  int late = 0;
  std::vector<double> slack;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Problem problem = PumpProblem(seed, 1);
    problem.groups[0].rise_time_max_s = optimizer::kUnlimited;
    ForSome(
        problem, random, 0.01,
        [&](const Candidate& candidate, const OperatingPoint& point,
            const optimizer::PumpFacts& pumps) {
          const optimizer::Strokes strokes = optimizer::EvaluateStrokes(problem, candidate, point);
          if (!strokes.works) return;
          // The limit that the stroke just meets.
          Problem tight = problem;
          tight.groups[0].rise_time_max_s = strokes.rise_s[0];
          tight.frequency_hz = 0.5 / strokes.inflate_s[0];
          const double wider = Chance(random, 0.5) ? 1.0 : Uniform(random, 1.0, 1.3);
          const optimizer::StrokeStart start{point.source_pa, point.source_pa,
                                             point.reservoir_m3 / wider,
                                             point.reservoir_m3 * wider};
          const double excess =
              optimizer::LeastStrokeExcess(tight, 0, *candidate.lines[0], pumps, start);
          EXPECT_LE(excess, 1e-6) << "seed " << seed;
          if (wider == 1.0 && point.reservoir_m3 > 1e-4) slack.push_back(-excess);
          // A limit that is out of reach is seen to be.
          tight.groups[0].rise_time_max_s *= 0.5;
          if (point.reservoir_m3 > 1e-4)
            late += optimizer::LeastStrokeExcess(tight, 0, *candidate.lines[0], pumps, start) > 0.0;
        });
  }
  ASSERT_GT(slack.size(), 50u);
  std::sort(slack.begin(), slack.end());
  EXPECT_LT(slack[slack.size() / 2], 0.02);
  EXPECT_LT(slack[slack.size() * 9 / 10], 0.1);
  EXPECT_GT(late, 50);
}

// The periodic state of a pair that takes turns, from the simulator, with the first group's
// command at the start of the period.
std::optional<model::PeriodicState> Periodic(const Problem& problem, const Candidate& candidate,
                                             const OperatingPoint& point) {
  model::Rig rig = optimizer::MakeRig(problem, candidate, point);
  const double period_s = 1.0 / problem.frequency_hz;
  model::SimulateOptions options;
  options.rise_fraction = problem.rise_fraction;
  options.linear_ratio = 1.0 - 1e-5;
  options.sample_hz = 2.0 / period_s;  // where the groups begin
  model::PeriodicState state =
      model::FindPeriodicState(rig, period_s, options, {.tolerance = 1e-7});
  if (state.status != model::PeriodicStatus::kConverged) return std::nullopt;
  return state;
}

TEST(StrokeBoundTest, GroupsThatTakeTurnsFindNoLessThanTheyNeed) {
  Random random(2);
  int compared = 0, refuted = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Problem problem = PumpProblem(20 + seed, 2);
    problem.parts.valves.resize(2);
    problem.parts.fittings.resize(1);
    problem.parts.tubing.resize(1);
    ForSome(problem, random, 0.03,
            [&](const Candidate& candidate, const OperatingPoint& point,
                const optimizer::PumpFacts& pumps) {
              const auto state = Periodic(problem, candidate, point);
              if (!state || !state->groups[0].rise || !state->groups[1].rise) return;
              // Chambers that are empty when their stroke begins.
              for (int g : {0, 1})
                if (candidate.lines[g]->fall_time_s > 0.3 / problem.frequency_hz) return;
              // Limits that the periodic state just meets.
              Problem met = problem;
              for (int g : {0, 1}) {
                met.groups[g].rise_time_max_s = state->groups[g].rise->to_target_s;
                if (!std::isfinite(met.groups[g].rise_time_max_s)) return;
              }
              for (const model::Stroke& stroke : state->response.strokes)
                if (stroke.state == model::ValveState::kInflate &&
                    !(stroke.to_operating_s <= optimizer::InflateWindow(problem, 0)))
                  return;
              const double wider = Chance(random, 0.5) ? 1.0 : 1.1;
              const auto raise = [&](const Problem& of, double high_pa,
                                     std::array<double, 2>& start_pa) {
                return optimizer::RaiseStarts(of, candidate.lines, pumps, high_pa,
                                              point.reservoir_m3 / wider,
                                              point.reservoir_m3 * wider, 1e-3, start_pa);
              };
              std::array<double, 2> start_pa{};
              ++compared;
              ASSERT_TRUE(raise(met, point.source_pa, start_pa)) << "seed " << seed;
              for (int g : {0, 1}) {
                EXPECT_LE(start_pa[g], state->response.source_pressure_pa[g] * (1.0 + 1e-6))
                    << "seed " << seed;
              }
              // Half of the time is too short for strokes that empty the reservoir.
              Problem missed = met;
              for (int g : {0, 1}) missed.groups[g].rise_time_max_s *= 0.5;
              std::array<double, 2> none{};
              refuted += !raise(missed, point.source_pa, none);
            });
  }
  EXPECT_GT(compared, 30);
  EXPECT_GT(refuted, compared / 2);
}

}  // namespace stroke_bound_test
}  // namespace plenum::test
