// Bounds against every feasible design of small problems: no bound lies above what it bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "optimizer/bounds/box.h"
#include "optimizer/choices/make_plan.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/pump/stroke_bound.h"
#include "optimizer/sizing/sizing.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace bounds_test {

using optimizer::Bounds;
using optimizer::Box;
using optimizer::BoxNode;
using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Constraint;
using optimizer::Family;
using optimizer::Leaf;
using optimizer::LeafStatus;
using optimizer::Line;
using optimizer::Option;
using optimizer::Plan;
using optimizer::Problem;

// Position of the candidate's choice in a slot; −1 where dominance has left it out.
int PositionOf(const optimizer::Slot& slot, const Candidate& to) {
  const auto find = [&](int index, int quantity) {
    for (int i = 0; i < static_cast<int>(slot.options->size()); ++i) {
      const Option& option = (*slot.options)[i];
      if (option.index == index && option.quantity == quantity) return i;
    }
    return -1;
  };
  switch (slot.family) {
    case Family::kTubing:
      return find(to.lines[slot.group]->tubing, 1);
    case Family::kFitting:
      return to.lines[slot.group]->fitting < 0 ? 0 : find(to.lines[slot.group]->fitting, 1);
    case Family::kValve:
      return find(to.lines[slot.group]->valve, 1);
    case Family::kRegulator:
      return find(to.regulator.index, to.regulator.quantity);
    case Family::kCylinder:
    case Family::kCo2:
      return find(to.bottle.index, to.bottle.quantity);
    case Family::kCompressor:
      return find(to.compressor.index, to.compressor.quantity);
    case Family::kBattery:
      return find(to.battery.index, to.battery.quantity);
    default:
      return find(to.reservoir.index, to.reservoir.quantity);
  }
}

// That what boxes knew of their lines holds for those of the single combination that they held.
void ExpectAmongChoices(
    const std::vector<std::shared_ptr<const std::vector<optimizer::LineChoice>>>& seen,
    const Box& single) {
  double objective = 0.0, coil_power_w = 0.0;
  for (const auto& line : single.lines) {
    objective += line->objective;
    coil_power_w += line->coil_power_w;
  }
  for (const auto& choices : seen)
    EXPECT_TRUE(std::any_of(choices->begin(), choices->end(), [&](const auto& choice) {
      return choice.objective <= objective * (1.0 + 1e-12) &&
             choice.coil_power_w <= coil_power_w * (1.0 + 1e-12);
    }));
}

// Divides boxes on the way to a feasible design, now the widest slot and now any: none of them may
// be closed, and no bound may lie above its objective. Gives the box of the single combination.
Box Descend(Random& random, const Plan& plan, Bounds& bounds, const std::vector<int>& positions,
            const Candidate& to, double objective) {
  Box box = bounds.Root();
  EXPECT_EQ(bounds.Assess(box, -1), Constraint::kNone);
  std::vector<std::shared_ptr<const std::vector<optimizer::LineChoice>>> seen;
  const auto check = [&](Constraint missed) {
    EXPECT_EQ(missed, Constraint::kNone);
    if (box.choices) seen.push_back(box.choices);
    EXPECT_LE(box.bound, objective * (1.0 + 1e-6));
    for (std::size_t g = 0; g < box.lines.size() && missed == Constraint::kNone; ++g) {
      EXPECT_LE(box.lines[g]->fall_time_s, to.lines[g]->fall_time_s * (1.0 + 1e-9));
      EXPECT_LE(box.lines[g]->coil_power_w, to.lines[g]->coil_power_w * (1.0 + 1e-12));
      EXPECT_LE(box.lines[g]->amounts.mass_kg, to.lines[g]->amounts.mass_kg * (1.0 + 1e-12));
    }
    return missed == Constraint::kNone;
  };
  const auto forget_some = [&] {
    const double bound = box.bound;
    if (Chance(random, 0.2)) bounds.Forget(box, Uniform(random, 0.8, 1.1) * objective);
    EXPECT_EQ(box.bound, bound);
  };
  while (!bounds.IsSingle(box)) {
    forget_some();
    while (bounds.CanFindSource(box))
      if (!check(bounds.FindSource(box))) return box;
    int slot = bounds.WidestSlot(box, optimizer::DivideFor::kProof);
    if (const int other = Pick(random, 0, static_cast<int>(plan.slots.size()) - 1);
        !(*plan.slots[other].nodes)[box.nodes[other]].single())
      slot = other;
    const std::vector<BoxNode>& tree = *plan.slots[slot].nodes;
    const BoxNode& node = tree[box.nodes[slot]];
    box.nodes[slot] = positions[slot] < tree[node.right].first ? node.left : node.right;
    if (!check(bounds.Assess(box, slot))) return box;
  }
  forget_some();
  while (bounds.CanFindSource(box))
    if (!check(bounds.FindSource(box))) return box;
  ExpectAmongChoices(seen, box);
  return box;
}

// The pump bounds against what the pumps did at the design's own operating point: there, from a
// lower stop pressure, and for an interval of volumes.
void ExpectPumpNeedHolds(const Problem& problem, const Candidate& candidate, const Leaf& leaf) {
  const optimizer::PumpFacts facts =
      optimizer::MakePumpFacts(problem, problem.parts.compressors[candidate.compressor.index].curve,
                               candidate.compressor.quantity);
  const double source_pa = leaf.point.source_pa, volume_m3 = leaf.point.reservoir_m3;
  const optimizer::PumpLoad load = optimizer::MakePumpLoad(problem, candidate.lines);
  const optimizer::Strokes strokes = optimizer::SimulateStrokes(problem, candidate, leaf.point);
  ASSERT_TRUE(strokes.works);
  const bool energy_rises = optimizer::PumpEnergyRises(problem, candidate);
  for (const double lower : {1.0, 0.97})
    for (const double wider : {1.0, 1.1, 2.0}) {
      const std::optional<optimizer::PumpNeed> need = optimizer::LeastPumpNeed(
          problem, facts, load, {lower * source_pa}, volume_m3 / wider, volume_m3 * wider);
      ASSERT_TRUE(need.has_value());
      EXPECT_LE(need->on_s, strokes.pump_on_s * (1.0 + 1e-4)) << candidate.lines[0]->holds;
      if (lower == 1.0 || energy_rises) {
        EXPECT_LE(need->energy_j, strokes.pump_energy_j * (1.0 + 1e-4))
            << candidate.lines[0]->holds;
      }
      EXPECT_LE(
          optimizer::LeastInflateTime(problem, 0, *candidate.lines[0], facts,
                                      {source_pa, source_pa, volume_m3 / wider, volume_m3 * wider}),
          strokes.inflate_s[0] * (1.0 + 1e-6));
    }
}

// At the one stop pressure that is left coils take as long as the strokes there.
void ExpectMissionEnergyHolds(const Problem& problem, const Candidate& candidate,
                              const Leaf& leaf) {
  const optimizer::PumpFacts facts =
      optimizer::MakePumpFacts(problem, problem.parts.compressors[candidate.compressor.index].curve,
                               candidate.compressor.quantity);
  const double source_pa = leaf.point.source_pa, volume_m3 = leaf.point.reservoir_m3;
  const optimizer::PumpLoad load = optimizer::MakePumpLoad(problem, candidate.lines);
  const std::optional<optimizer::ReservoirNeed> need =
      optimizer::LeastReservoirNeed(problem, facts, load, {}, {source_pa, source_pa},
                                    {.low_m3 = volume_m3, .high_m3 = volume_m3}, 1e-3);
  ASSERT_TRUE(need.has_value());
  const double energy_j = optimizer::LeastMissionEnergy(problem, facts, load, *need, 8);
  double coils_j = 0.0;
  for (int g = 0; g < static_cast<int>(load.lines.size()); ++g) {
    const optimizer::Line& line = *load.lines[g];
    const double inflate_s =
        std::max(line.inflate_time_least_s,
                 optimizer::LeastInflateTime(problem, g, line, facts,
                                             {source_pa, source_pa, need->low_m3, need->high_m3}));
    coils_j += problem.actuations *
               optimizer::CoilEnergyPerCycle(problem, g, line, line.all_hold ? inflate_s : 0.0);
  }
  EXPECT_GE(energy_j, 0.999 * (need->energy_j - problem.actuations * load.coil_j + coils_j));
  EXPECT_LE(energy_j, optimizer::Evaluate(problem, candidate, leaf.point).energy_total_j * 1.0001);
}

void CheckAll(const Problem& problem, Random& random, double share, int& checked) {
  const Configuration configuration = *problem.configurations.begin();
  const std::unique_ptr<Plan> plan = optimizer::MakePlan(problem, {configuration});
  if (plan->empty()) return;
  Bounds bounds(problem, *plan);
  ForEachCombination(problem, [&](const Candidate& candidate) {
    if (candidate.reservoir.index == optimizer::kCustom && !Chance(random, 0.1)) return;
    if (!Chance(random, share)) return;
    std::vector<int> positions;
    for (const optimizer::Slot& slot : plan->slots) {
      positions.push_back(PositionOf(slot, candidate));
      if (positions.back() < 0) return;
    }
    const Leaf leaf = SizeAlone(problem, candidate);
    if (leaf.status != LeafStatus::kFeasible) return;
    ++checked;
    const Box reached = Descend(random, *plan, bounds, positions, candidate, leaf.objective);
    if (!bounds.IsSingle(reached) || candidate.reservoir.index == optimizer::kCustom) return;
    const double volume_m3 = StockVolume(problem, candidate);
    const optimizer::NeededPressure needed =
        optimizer::NeededSourcePressure(problem, candidate, {0.0, volume_m3, volume_m3});
    ASSERT_EQ(needed.status, LeafStatus::kFeasible);
    for (const auto& line : reached.lines)
      EXPECT_LE(line->source_min_pa, needed.source_pa * (1.0 + 1e-8));
    EXPECT_NEAR(reached.source_floor_pa, needed.source_pa, 1e-6 * needed.source_pa);
    if (configuration == Configuration::kCompressor && problem.groups.size() == 1) {
      ExpectPumpNeedHolds(problem, candidate, leaf);
      ExpectMissionEnergyHolds(problem, bounds.CandidateOf(reached), leaf);
    }
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

// All that can be found of a box; whether it misses nothing.
bool FindAll(Bounds& bounds, Box& box) {
  while (bounds.CanFindSource(box))
    if (bounds.FindSource(box) != Constraint::kNone) return false;
  return true;
}

// A part of a box with the same strokes has its lines and looks from it, and they are those that it
// would have found itself.
TEST(BoundsTest, PartsTakeOverWhatHoldsForThem) {
  int taken_over = 0, not_looked_at_anew = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Problem problem = Drawn(seed, Configuration::kCompressor, 1);
    const std::unique_ptr<Plan> plan = optimizer::MakePlan(problem, {Configuration::kCompressor});
    if (plan->empty()) continue;
    Bounds bounds(problem, *plan);
    Box root = bounds.Root();
    if (bounds.Assess(root, -1) != Constraint::kNone || !FindAll(bounds, root)) continue;
    for (int slot = 0; slot < optimizer::kSlotsPerGroup; ++slot) {
      const BoxNode& node = (*plan->slots[slot].nodes)[0];
      if (node.single()) continue;
      for (int child : {node.left, node.right}) {
        Box part = root;
        part.nodes[slot] = child;
        if (bounds.Assess(part, slot) != Constraint::kNone || !part.lines_finished) continue;
        ++taken_over;
        Bounds alone(problem, *plan);
        Box same = alone.Root();
        same.nodes = part.nodes;
        ASSERT_EQ(alone.Assess(same, -1), Constraint::kNone);
        while (!same.lines_finished) ASSERT_EQ(alone.FindSource(same), Constraint::kNone);
        const Line& line = *part.lines[0];
        const Line& expected = *same.lines[0];
        EXPECT_EQ(line.objective, expected.objective);
        EXPECT_EQ(line.coil_power_w, expected.coil_power_w);
        EXPECT_EQ(line.choices, expected.choices);
        EXPECT_EQ(line.source_min_pa, expected.source_min_pa);
        EXPECT_EQ(line.inflate_time_least_s, expected.inflate_time_least_s);
        EXPECT_EQ(line.fill, expected.fill);
        EXPECT_EQ(line.chamber, expected.chamber);
        not_looked_at_anew += part.look == root.look;
        ASSERT_EQ(FindAll(alone, same), FindAll(bounds, part));
        EXPECT_GE(part.bound, same.bound * (1.0 - 1e-9));
      }
    }
  }
  EXPECT_GT(taken_over, 20);
  EXPECT_GT(not_looked_at_anew, 10);
}

// The lightest lines and the battery that makes do with the least coils are not of one design.
TEST(BoundsTest, CoilsCountWithTheirLines) {
  int raised = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Problem problem = Drawn(seed, Configuration::kCompressor, 1);
    const std::vector<model::Valve> valves = problem.parts.valves;
    for (model::Valve valve : valves) {  // the same with weaker coils, but heavier
      valve.basics.id += "-w";
      valve.basics.mass_kg += 0.3;
      valve.basics.body_volume_m3 += 3e-4;
      valve.coil_power_w *= 0.1;
      problem.parts.valves.push_back(valve);
    }
    const model::Battery whole = problem.parts.batteries.front();
    for (int i = 1; i < 60; ++i) {  // of any size
      model::Battery battery = whole;
      battery.basics.id += "-" + std::to_string(i);
      battery.basics.mass_kg *= 0.05 * i;
      battery.basics.body_volume_m3 *= 0.05 * i;
      battery.capacity_ah *= 0.05 * i;
      problem.parts.batteries.push_back(battery);
    }
    const std::unique_ptr<Plan> plan = optimizer::MakePlan(problem, {Configuration::kCompressor});
    if (plan->empty()) continue;
    Bounds bounds(problem, *plan);
    Box root = bounds.Root();
    if (bounds.Assess(root, -1) != Constraint::kNone || !FindAll(bounds, root)) continue;
    raised += std::any_of(root.volumes->begin(), root.volumes->end(), [&](const auto& volume) {
      return volume.with_lines > (root.lines[0]->objective + volume.rest) * (1.0 + 1e-9);
    });
  }
  EXPECT_GT(raised, 0);
}

// A combination that is outdone comes behind as many feasible ones as are wanted.
TEST(BoundsTest, OutdoneCombinations) {
  int outdone = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed, Configuration::kCylinder, 1);
    problem.limits = {1, 1, 1, 1, 1};
    problem.count = 3;
    const auto add_heavier = [](auto parts) {
      const std::size_t size = parts.size();
      for (std::size_t i = 0; i < size; ++i) {
        parts.push_back(parts[i]);
        parts.back().basics.id += "-h";
        parts.back().basics.mass_kg *= 1.2;
        parts.back().basics.body_volume_m3 *= 1.2;
        if (parts.back().basics.cost_eur) *parts.back().basics.cost_eur *= 1.2;
      }
      return parts;
    };
    problem.parts.valves = add_heavier(problem.parts.valves);
    problem.parts.regulators = add_heavier(problem.parts.regulators);
    const std::unique_ptr<Plan> plan = optimizer::MakePlan(problem, {Configuration::kCylinder});
    if (plan->empty()) continue;
    const Bounds bounds(problem, *plan);
    std::vector<double> objectives, of_outdone;
    ForEachCombination(problem, [&](const Candidate& candidate) {
      Box box = bounds.Root();
      for (std::size_t s = 0; s < plan->slots.size(); ++s) {
        const int position = PositionOf(plan->slots[s], candidate);
        if (position < 0) return;
        const std::vector<BoxNode>& tree = *plan->slots[s].nodes;
        while (!tree[box.nodes[s]].single()) {
          const BoxNode& node = tree[box.nodes[s]];
          box.nodes[s] = position < tree[node.right].first ? node.left : node.right;
        }
      }
      const Leaf leaf = SizeAlone(problem, candidate);
      if (leaf.status != LeafStatus::kFeasible) return;
      objectives.push_back(leaf.objective);
      if (bounds.IsOutdone(box)) of_outdone.push_back(leaf.objective);
    });
    outdone += static_cast<int>(of_outdone.size());
    for (double objective : of_outdone)
      EXPECT_GT(std::count_if(objectives.begin(), objectives.end(),
                              [&](double other) { return other <= objective * (1.0 + 1e-9); }),
                problem.count);
  }
  EXPECT_GT(outdone, 0);
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

TEST(BoundsTest, CompressorTwoGroups) {
  Random random(4);
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Problem problem = Drawn(seed, Configuration::kCompressor, 2);
    problem.simultaneous = false;
    problem.limits = {1, 1, 1, 1, 1};
    SCOPED_TRACE("seed " + std::to_string(seed));
    CheckAll(problem, random, 0.25, checked);
  }
  EXPECT_GT(checked, 2);
}

// Groups of unlike size, some of which have their targets long before others.
TEST(BoundsTest, CompressorAtOnce) {
  Random random(5);
  int checked = 0;
  for (std::uint64_t seed = 7; seed <= 12; ++seed) {
    Problem problem = Drawn(seed, Configuration::kCompressor, 2 + static_cast<int>(seed % 2));
    problem.simultaneous = true;
    problem.limits = {1, 1, 1, 1, 1};
    for (std::size_t g = 1; g < problem.groups.size(); ++g) {
      problem.groups[g].chamber.rest_volume_m3 *= g == 1 ? 0.1 : 3.0;
      problem.groups[g].rise_time_max_s *= g == 1 ? 0.5 : 6.0;
    }
    SCOPED_TRACE("seed " + std::to_string(seed));
    CheckAll(problem, random, 0.2, checked);
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

}  // namespace bounds_test
}  // namespace plenum::test
