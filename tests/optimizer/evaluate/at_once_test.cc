// Groups at once on a pump's reservoir take as long as in a simulation of the whole cycle, and as
// much of the pumps.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/evaluate/strokes/turn_strokes.h"
#include "tests/support/brute_force.h"
#include "tests/support/pumps/vacuum_problems.h"

namespace plenum::test {
namespace at_once_test {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::OperatingPoint;
using optimizer::Problem;
using optimizer::Strokes;

Problem Drawn(std::uint64_t seed, bool evacuated) {
  Draw draw;
  draw.seed = 8700 + seed;
  draw.configurations = {evacuated ? Configuration::kVacuumPump : Configuration::kCompressor};
  draw.groups = 2 + static_cast<int>(seed % 2);
  draw.severity = 0.1;
  draw.size = {1, 2, 3, 0, 0, 0, 1, 1, 2};
  Problem problem = evacuated ? EvacuatedProblem(draw) : RandomProblem(draw);
  problem.exclude.insert("custom");
  if (seed % 3 == 0) problem.frequency_hz *= 20.0;  // too fast for some
  // Groups of unlike size: one is full while the others still draw.
  for (std::size_t g = 1; g < problem.groups.size(); ++g)
    problem.groups[g].chamber.rest_volume_m3 *= g == 1 ? 0.05 : 4.0;
  return problem;
}

struct Count {
  int asked = 0, compared = 0, open = 0, never_full = 0, slow = 0, unable = 0;
};

void ExpectAsSimulated(const Problem& problem, const Candidate& candidate,
                       const OperatingPoint& point, Count& count) {
  ++count.asked;
  const std::optional<Strokes> at_once = optimizer::StrokesAtOnce(problem, candidate, point);
  if (!at_once) {
    const auto first = optimizer::FirstAtOnce(problem, candidate, point);
    count.unable += !first;
    return;
  }
  const Strokes simulated = optimizer::SimulateStrokes(problem, candidate, point);
  if (simulated.failed) return;
  const double period_s = 1.0 / problem.frequency_hz;
  if (!at_once->works) {  // no other strokes are faster than those from a full reservoir
    ++count.slow;
    EXPECT_FALSE(simulated.works);
    return;
  }
  EXPECT_LE(at_once->pump_on_s, period_s * (1.0 + 1e-9));
  ASSERT_TRUE(simulated.works);
  ++count.compared;
  count.never_full += at_once->pump_on_s > period_s * (1.0 - 1e-9);
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    count.open += !candidate.lines[g]->holds;
    EXPECT_NEAR(at_once->rise_s[g], simulated.rise_s[g], 3e-5 * simulated.rise_s[g]);
    EXPECT_NEAR(at_once->inflate_s[g], simulated.inflate_s[g], 3e-5 * simulated.inflate_s[g]);
    if (!candidate.lines[g]->holds) {
      EXPECT_NEAR(at_once->filled_pa[g], simulated.filled_pa[g], 1e-5 * simulated.filled_pa[g]);
    }
  }
  EXPECT_NEAR(at_once->pump_on_s, simulated.pump_on_s, 1e-4 * simulated.pump_on_s);
  EXPECT_NEAR(at_once->pump_energy_j, simulated.pump_energy_j, 1e-4 * simulated.pump_energy_j);
  EXPECT_NEAR(at_once->pump_air_m3, simulated.pump_air_m3, 1e-4 * simulated.pump_air_m3);
}

Count Compare(bool evacuated) {
  Count count;
  for (std::uint64_t seed = 1; seed <= 14; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed, evacuated);
    if (seed % 2 == 0) problem.frequency_hz *= 1.7;  // some reservoirs are never full again
    int looked = 0;
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (++looked % 5 != 1 || looked > 5 * 8) return;
      const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
      if (window.empty()) return;
      for (double share : {0.003, 0.3, 0.9, 1.0})
        for (double part : {0.02, 1.0}) {
          const double volume_m3 = part * StockVolume(problem, candidate);
          ExpectAsSimulated(
              problem, candidate,
              {window.low_pa + share * (window.high_pa - window.low_pa), volume_m3, volume_m3},
              count);
        }
    });
  }
  return count;
}

TEST(AtOnceTest, AsSimulated) {
  const Count count = Compare(false);
  EXPECT_GT(count.compared, 30);
  EXPECT_GT(count.open, 5);
  EXPECT_GT(count.slow, 5);
  EXPECT_GT(count.never_full, 5);
  EXPECT_LT(count.unable, count.asked / 5);
}

TEST(AtOnceTest, EvacuatedAsSimulated) {
  const Count count = Compare(true);
  EXPECT_GT(count.compared, 20);
  EXPECT_LT(count.unable, count.asked / 5);
}

// Chambers that are large beside a reservoir, with time for the pumps to fill them: rigs, and their
// windows of the source pressure.
void ForEachSlow(std::uint64_t seeds, const auto& visit) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(3 * seed + 1, false);
    problem.frequency_hz *= 0.005;
    for (optimizer::ActuatorGroup& group : problem.groups) {
      group.chamber.rest_volume_m3 *= 4.0;
      group.rise_time_max_s = optimizer::kUnlimited;
    }
    int looked = 0;
    ForEachCombination(problem, [&](const Candidate& candidate) {
      const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
      if (!window.empty() && ++looked <= 6) visit(problem, candidate, window);
    });
  }
}

// A reservoir that is small beside the chambers goes with them long before they are full: neither
// that nor a chamber which rises with it beside another asks for a simulation.
TEST(AtOnceTest, SmallReservoirs) {
  Count count;
  ForEachSlow(
      10, [&](const Problem& problem, const Candidate& candidate, const optimizer::Window& window) {
        const double volume_m3 = 1e-5;
        const double stop_pa = window.low_pa + 0.9 * (window.high_pa - window.low_pa);
        ExpectAsSimulated(problem, candidate, {stop_pa, volume_m3, volume_m3}, count);
      });
  EXPECT_GT(count.compared, 10);
  EXPECT_EQ(count.unable, 0);
}

// The bounds of an interval of volumes: one that falls as the largest does, and rises as the least.
// What is small while it rises makes steps small then, however large it is while it falls; and
// chambers that are nearly at rest with it hardly tell by their flow how it goes on.
TEST(AtOnceTest, IntervalsOfVolumes) {
  int asked = 0, works = 0;
  ForEachSlow(
      20, [&](const Problem& problem, const Candidate& candidate, const optimizer::Window& window) {
        for (const double share : {0.02, 0.9}) {
          const double stop_pa = window.low_pa + share * (window.high_pa - window.low_pa);
          const std::optional<Strokes> of_interval =
              optimizer::StrokesAtOnce(problem, candidate, {stop_pa, 0.02, 1e-5});
          const std::optional<Strokes> of_least =
              optimizer::StrokesAtOnce(problem, candidate, {stop_pa, 1e-5, 1e-5});
          ASSERT_TRUE(of_interval && of_least);
          ++asked;
          if (!of_interval->works || !of_least->works) continue;
          ++works;
          // With the least alone no stroke is sooner over.
          for (std::size_t g = 0; g < problem.groups.size(); ++g)
            EXPECT_LE(of_interval->inflate_s[g], of_least->inflate_s[g] * (1.0 + 1e-4));
        }
      });
  EXPECT_GT(asked, 40);
  EXPECT_GT(works, 10);
}

// A group in two halves is the group: one stroke of all chambers, integrated over their pressure.
TEST(AtOnceTest, HalvesAreTheWhole) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem whole = Drawn(seed, false);
    whole.groups.resize(1);
    whole.groups[0].count = 2;
    ForEachCombination(whole, [&](const Candidate& candidate) {
      const optimizer::Window window = optimizer::SourceWindow(whole, candidate);
      if (window.empty()) return;
      const double volume_m3 = StockVolume(whole, candidate);
      const OperatingPoint point{window.high_pa, volume_m3, volume_m3};
      const Strokes one = optimizer::EvaluateStrokes(whole, candidate, point);
      Problem halves = whole;
      halves.groups[0].count = 1;
      halves.groups.push_back(halves.groups[0]);
      Candidate both = candidate;
      both.lines.push_back(both.lines[0]);
      const std::optional<Strokes> two = optimizer::StrokesAtOnce(halves, both, point);
      if (!two) return;
      EXPECT_EQ(two->works, one.works && one.inflate_s[0] <= optimizer::InflateWindow(whole, 0));
      if (!one.works || !two->works) return;
      // Of one group alone a reservoir that would not be full again is not looked at any further.
      if (one.pump_on_s > 1.0 / whole.frequency_hz) return;
      ++compared;
      for (std::size_t g = 0; g < 2; ++g) {
        EXPECT_NEAR(two->rise_s[g], one.rise_s[0], 1e-5 * one.rise_s[0]);
        EXPECT_NEAR(two->inflate_s[g], one.inflate_s[0], 1e-5 * one.inflate_s[0]);
      }
      EXPECT_NEAR(two->pump_on_s, one.pump_on_s, 5e-5 * one.pump_on_s);
      EXPECT_NEAR(two->pump_energy_j, one.pump_energy_j, 5e-5 * one.pump_energy_j);
    });
  }
  EXPECT_GT(compared, 20);
}

}  // namespace at_once_test
}  // namespace plenum::test
