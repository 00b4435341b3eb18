// Bounds against every feasible design of small problems: no bound lies above what it bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "optimizer/evaluate_strokes.h"
#include "optimizer/expand.h"
#include "tests/optimizer/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace {

using optimizer::Candidate;
using optimizer::Child;
using optimizer::Children;
using optimizer::Configuration;
using optimizer::Leaf;
using optimizer::LeafStatus;
using optimizer::Line;
using optimizer::Problem;
using optimizer::Stage;
using optimizer::Tree;

Tree TreeOf(const Problem& problem, Configuration configuration) {
  std::vector<std::shared_ptr<const optimizer::LineSet>> lines;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    lines.push_back(std::make_shared<optimizer::LineSet>(
        optimizer::EnumerateLines(problem, g, optimizer::GasOf(configuration))));
  return optimizer::MakeTree(problem, configuration, std::move(lines));
}

bool Leads(const Tree& tree, std::size_t stage, const Child& child, const Candidate& to) {
  const auto same = [&](const optimizer::Option& option) {
    return child.option.index == option.index && child.option.quantity == option.quantity;
  };
  switch (tree.stages[stage].stage) {
    case Stage::kLine: {
      const Line& line = *to.lines[tree.stages[stage].group];
      return child.line->tubing == line.tubing && child.line->fitting == line.fitting &&
             child.line->valve == line.valve;
    }
    case Stage::kRegulator:
      return same(to.regulator);
    case Stage::kCompressor:
      return same(to.compressor);
    case Stage::kBottle:
      return same(to.bottle);
    case Stage::kBattery:
      return same(to.battery);
    default:
      return same(to.reservoir);
  }
}

// Walks down the tree to a feasible design: each child on the way must be there, with a bound that
// its objective does not undercut. Returns the candidate as the tree builds it.
Candidate Descend(const Problem& problem, const Tree& tree, const Candidate& to, double objective) {
  Candidate at;
  at.configuration = tree.configuration;
  for (std::size_t stage = 0; stage < tree.stages.size(); ++stage) {
    const Children children = optimizer::Expand(problem, tree, at, static_cast<int>(stage));
    const Child* next = nullptr;
    for (const Child& child : children.list)
      if (Leads(tree, stage, child, to)) next = &child;
    if (next == nullptr) {
      ADD_FAILURE() << "a feasible design was pruned at stage " << stage;
      return at;
    }
    EXPECT_LE(next->bound, objective * (1.0 + 1e-9)) << "stage " << stage;
    at = optimizer::Chosen(tree, at, static_cast<int>(stage), children, *next);
  }
  return at;
}

// The pump bound, fed with the least air that the search assumes, against what the pumps did. Every
// actuator ends at its operating pressure at least.
void ExpectPumpNeedHolds(const Problem& problem, const Candidate& candidate, const Leaf& leaf) {
  const model::CompressorCurve& curve = problem.parts.compressors[candidate.compressor.index].curve;
  double air_m3 = 0.0, to_target_m3 = 0.0, source_min_pa = 0.0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const Line& line = *candidate.lines[g];
    air_m3 += optimizer::AirPerStroke(problem, g, line, line.source_min_pa);
    to_target_m3 += optimizer::AirToTarget(problem, g, line.chamber);
    source_min_pa = std::max(source_min_pa, line.source_min_pa);
  }
  const optimizer::PumpNeed need =
      optimizer::LeastPumpNeed(problem, optimizer::MakePumpFacts(problem, curve),
                               candidate.compressor.quantity, air_m3, to_target_m3, source_min_pa);
  const optimizer::Strokes strokes = optimizer::SimulateStrokes(problem, candidate, leaf.point);
  ASSERT_TRUE(strokes.works);
  EXPECT_LE(need.on_s, strokes.pump_on_s * (1.0 + 1e-4)) << candidate.lines[0]->holds;
  EXPECT_LE(need.energy_j, strokes.pump_energy_j * (1.0 + 1e-4)) << candidate.lines[0]->holds;
}

void CheckAll(const Problem& problem, Random& random, double share, int& checked) {
  const Configuration configuration = *problem.configurations.begin();
  const Tree tree = TreeOf(problem, configuration);
  ForEachCombination(problem, [&](const Candidate& candidate) {
    if (candidate.reservoir.index == optimizer::kCustom || !Chance(random, share)) return;
    const Leaf leaf = SizeAlone(problem, candidate);
    if (leaf.status != LeafStatus::kFeasible) return;
    ++checked;
    const Candidate reached = Descend(problem, tree, candidate, leaf.objective);
    if (reached.lines.size() != candidate.lines.size()) return;
    const double volume_m3 = StockVolume(problem, candidate);
    const std::optional<double> needed =
        optimizer::NeededSourcePressure(problem, candidate, {0.0, volume_m3, volume_m3});
    ASSERT_TRUE(needed.has_value());
    for (const Line* line : reached.lines) EXPECT_LE(line->source_min_pa, *needed * (1.0 + 1e-8));
    EXPECT_LE(reached.source_floor_pa, *needed * (1.0 + 1e-8));
    if (configuration == Configuration::kCompressor) ExpectPumpNeedHolds(problem, reached, leaf);
  });
}

Problem Drawn(std::uint64_t seed, Configuration configuration, int groups) {
  Draw draw;
  draw.seed = 6000 + seed;
  draw.configurations = {configuration};
  draw.groups = groups;
  draw.simultaneous = seed % 2 == 0;
  draw.severity = 0.06 * static_cast<double>(seed % 10);
  draw.size = groups == 1 ? CatalogueSize{3, 3, 4, 3, 3, 3, 2, 3, 2}
                          : CatalogueSize{2, 2, 2, 2, 2, 2, 2, 2, 1};
  Problem problem = RandomProblem(draw);
  constexpr optimizer::Objective kObjectives[] = {
      {1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.5, 0.3, 0.0, 0.02}};
  problem.objective = kObjectives[seed % 4];
  return problem;
}

TEST(BoundsTest, RegulatedOneGroup) {
  Random random(1);
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed)
    for (Configuration configuration :
         {Configuration::kCylinder, Configuration::kCo2, Configuration::kMains}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " " + optimizer::Name(configuration));
      CheckAll(Drawn(seed, configuration, 1), random, 0.15, checked);
    }
  EXPECT_GT(checked, 300);
}

TEST(BoundsTest, RegulatedTwoGroups) {
  Random random(2);
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    CheckAll(Drawn(seed, Configuration::kCylinder, 2), random, 0.05, checked);
  }
  EXPECT_GT(checked, 10);
}

TEST(BoundsTest, CompressorOneGroup) {
  Random random(3);
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    Problem problem = Drawn(seed, Configuration::kCompressor, 1);
    if (seed % 3 == 0)
      for (model::Valve& valve : problem.parts.valves) valve.kind = model::ValveKind::kThreeWay;
    problem.parts.valves.resize(2);
    SCOPED_TRACE("seed " + std::to_string(seed));
    CheckAll(problem, random, 0.3, checked);
  }
  EXPECT_GT(checked, 100);
}

}  // namespace
}  // namespace plenum::test
