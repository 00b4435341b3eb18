// The least line of a box against all single lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "optimizer/bounds/box.h"
#include "optimizer/choices/make_line.h"
#include "optimizer/choices/make_plan.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace least_line_test {

using optimizer::Bounds;
using optimizer::Box;
using optimizer::Configuration;
using optimizer::Constraint;
using optimizer::Line;
using optimizer::Plan;
using optimizer::Problem;

Problem Drawn(std::uint64_t seed) {
  Draw draw;
  draw.seed = 6000 + seed;
  draw.configurations = {Configuration::kCylinder};
  draw.groups = 1;
  draw.severity = 0.06 * static_cast<double>(seed % 10);
  draw.size = {3, 3, 4, 3, 3, 3, 2, 3, 2};
  return RandomProblem(draw);
}

// With few lines a box knows the lightest that is fast enough on an unlimited source, whatever its
// corner weighs.
TEST(LeastLineTest, OfABox) {
  int above_corner = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed);
    problem.groups[0].rise_time_max_s *= 0.7;
    problem.groups[0].fall_time_max_s *= 0.7;
    const std::unique_ptr<Plan> plan = optimizer::MakePlan(problem, {Configuration::kCylinder});
    if (plan->empty()) continue;
    const optimizer::GroupTrees& trees = plan->groups[0];
    double least = optimizer::kUnlimited;
    for (std::size_t t = 0; t < trees.tubes.nodes.size(); ++t)
      for (std::size_t f = 0; f < trees.fittings.nodes.size(); ++f)
        for (std::size_t v = 0; v < trees.valves.nodes.size(); ++v) {
          Line line;
          if (trees.tubes.nodes[t].single() && trees.fittings.nodes[f].single() &&
              trees.valves.nodes[v].single() &&
              optimizer::MakeLine(
                  problem, 0, model::Gas::kAir,
                  {trees.tubes.corners[t], trees.fittings.corners[f], trees.valves.corners[v]},
                  true, false, line) == Constraint::kNone)
            least = std::min(least, line.objective);
        }
    Bounds bounds(problem, *plan);
    Box root = bounds.Root();
    const Constraint missed = bounds.Assess(root, -1);
    if (std::isinf(least)) {
      EXPECT_NE(missed, Constraint::kNone);
    } else if (missed == Constraint::kNone) {
      EXPECT_DOUBLE_EQ(root.lines[0]->objective, least);
      above_corner +=
          least > (trees.tubes.corners[0].objective + trees.fittings.corners[0].objective +
                   trees.valves.corners[0].objective) *
                      1.001;
    }
  }
  EXPECT_GT(above_corner, 5);
}

// The strongest line that a group may have is the one of all single lines that needs the least.
TEST(LeastLineTest, Strongest) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Problem problem = Drawn(seed);
    const auto plan = optimizer::MakePlan(problem, {Configuration::kCylinder});
    if (plan->empty()) continue;
    const double source_pa = Bounds(problem, *plan).Root().window.high_pa;
    const optimizer::GroupTrees& trees = plan->groups[0];
    const model::Gas gas = optimizer::GasOf(Configuration::kCylinder);
    const double pressure_pa =
        source_pa > 0.0 ? source_pa : 1.5 * problem.groups[0].chamber.operating_pressure_pa;
    double least = optimizer::kUnlimited;
    const auto needs_of = [&](const optimizer::GroupLines::Nodes& nodes) {
      const optimizer::LineParts parts = optimizer::PartsOf(trees, nodes);
      const auto [tube, fitting, valve] = parts.choices();
      if (!optimizer::PartsMate(problem, tube, fitting, valve) ||
          optimizer::ScreenLine(problem, 0, gas, parts.corners, true) != Constraint::kNone)
        return optimizer::kUnlimited;
      const Line line = optimizer::AssembleLine(problem, 0, gas, parts.corners, true);
      if (line.source_max_pa < pressure_pa || parts.corners.valve.pressure_min_pa > pressure_pa)
        return optimizer::kUnlimited;
      const optimizer::NodeMeans needs = optimizer::LeastNodeMeans(problem, 0, gas, line);
      return needs.rise_pa + needs.inflate_pa;
    };
    const auto leaves = [](const auto& tree) {
      std::vector<int> all;
      for (int i = 0; i < static_cast<int>(tree.nodes.size()); ++i)
        if (tree.nodes[i].single()) all.push_back(i);
      return all;
    };
    for (const int tube : leaves(trees.tubes))
      for (const int fitting : leaves(trees.fittings))
        for (const int valve : leaves(trees.valves))
          least = std::min(least, needs_of({tube, fitting, valve}));
    optimizer::GroupLines lines(problem, *plan, nullptr);
    const auto strongest = lines.StrongestAt(0, pressure_pa);
    if (!strongest) continue;
    ++compared;
    EXPECT_DOUBLE_EQ(needs_of(*strongest), least);
  }
  EXPECT_GT(compared, 10);
}

}  // namespace least_line_test
}  // namespace plenum::test
