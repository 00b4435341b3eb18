// What groups leave each other at their node: a bound that refuses no lines that do their work.
#include "optimizer/bounds/node_need.h"

#include <gtest/gtest.h>

#include "optimizer/sizing/sizing.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace node_need_test {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Line;
using optimizer::NodeMeans;
using optimizer::Problem;

// With limits that about half of the lines meet.
Problem Drawn(std::uint64_t seed) {
  Draw draw;
  draw.seed = 8700 + seed;
  draw.configurations = {seed % 3 == 0 ? Configuration::kCo2 : Configuration::kMains};
  draw.groups = 2 + static_cast<int>(seed % 2);
  draw.simultaneous = seed % 4 != 0;
  draw.severity = 0.06 * static_cast<double>(seed);
  draw.size = {2, 2, 3, 1, 1, 2, 0, 1, 0};
  return RandomProblem(draw);
}

bool Admits(const Problem& problem, const Candidate& candidate, double source_pa) {
  const model::Gas gas = optimizer::GasOf(candidate.configuration);
  const optimizer::NodeSource source{problem.parts.regulators[candidate.regulator.index].flow,
                                     source_pa, optimizer::FlowMax(problem, candidate)};
  const std::vector<NodeMeans> most =
      optimizer::HighestNodeMeans(problem, gas, source, candidate.lines);
  for (int g = 0; g < static_cast<int>(candidate.lines.size()); ++g)
    if (!optimizer::LeastNodeMeans(problem, g, gas, *candidate.lines[g]).Within(most[g]))
      return false;
  return true;
}

TEST(NodeNeedTest, RefusesNothingThatWorks) {
  int works = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const Problem problem = Drawn(seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    int looked = 0;
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (++looked % 5 != 1 || looked > 5 * 100) return;
      const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
      if (window.empty()) return;
      for (double share : {0.05, 0.3, 1.0}) {
        const double source_pa = window.low_pa + share * (window.high_pa - window.low_pa);
        const bool admitted = Admits(problem, candidate, source_pa);
        refused += !admitted;
        const optimizer::Evaluation evaluation =
            optimizer::Evaluate(problem, candidate, {source_pa, 0.0, 0.0});
        if (optimizer::StrokeExcess(problem, evaluation) > 0.0) continue;
        ++works;
        EXPECT_TRUE(admitted) << "at " << source_pa;
      }
    });
  }
  EXPECT_GT(works, 100);
  EXPECT_GT(refused, 30);
}

// More conductance needs less, a longer way to the operating pressure more.
TEST(NodeNeedTest, KeepsItsOrder) {
  const Problem problem = Drawn(2);
  Line line = AssembleLine(problem, 0, 0, 0, 0, model::Gas::kAir);
  const NodeMeans before = optimizer::LeastNodeMeans(problem, 0, model::Gas::kAir, line);
  EXPECT_GT(before.rise_pa, problem.ambient.pressure_pa);
  EXPECT_GT(before.inflate_pa, problem.ambient.pressure_pa);
  Line wider = line;
  for (model::FlowElement& element : wider.fill) element.sonic_conductance_m3_per_s_pa *= 1.1;
  const NodeMeans after = optimizer::LeastNodeMeans(problem, 0, model::Gas::kAir, wider);
  EXPECT_LT(after.rise_pa, before.rise_pa);
  EXPECT_LE(after.inflate_pa, before.inflate_pa);
  Line larger = line;
  larger.chamber.dead_volume_m3 += 0.1 * larger.chamber.rest_volume_m3;
  EXPECT_GT(optimizer::LeastNodeMeans(problem, 0, model::Gas::kAir, larger).rise_pa,
            before.rise_pa);
}

}  // namespace node_need_test
}  // namespace plenum::test
