#include "optimizer/expand.h"

#include <algorithm>
#include <cmath>

#include "optimizer/expand_compressor.h"
#include "optimizer/needs.h"
#include "optimizer/sizing.h"

namespace plenum::optimizer {
namespace {

bool Mates(const Problem& problem, const Candidate& candidate, Stage stage, const Option& option) {
  switch (stage) {
    case Stage::kRegulator:
      return RegulatorFits(problem, candidate.configuration, option.index);
    case Stage::kBottle:
      return candidate.configuration != Configuration::kCylinder ||
             RegulatorFitsCylinder(problem, candidate.regulator.index, option.index);
    case Stage::kBattery:
      return candidate.compressor.index == kNone ||
             BatteryFitsCompressor(problem, option.index, candidate.compressor.index);
    default:
      return true;
  }
}

// Objective of the lightest option that mates and bears the need; +∞ if none does.
template <typename Bears>
double LeastThatBears(const Problem& problem, const Candidate& candidate, Stage stage,
                      const OptionSet& set, Bears&& bears) {
  for (const Option& option : set.options)
    if (Mates(problem, candidate, stage, option) && bears(option)) return option.objective;
  return kUnlimited;
}

const OptionSet& Options(const Tree& tree, Stage stage) {
  switch (stage) {
    case Stage::kRegulator:
      return tree.regulators;
    case Stage::kCompressor:
      return tree.compressors;
    case Stage::kBottle:
      return tree.bottles;
    case Stage::kBattery:
      return tree.batteries;
    default:
      return tree.reservoirs;
  }
}

Option& Slot(Candidate& candidate, Stage stage) {
  switch (stage) {
    case Stage::kRegulator:
      return candidate.regulator;
    case Stage::kCompressor:
      return candidate.compressor;
    case Stage::kBottle:
      return candidate.bottle;
    case Stage::kBattery:
      return candidate.battery;
    default:
      return candidate.reservoir;
  }
}

bool Has(const Tree& tree, Stage stage) {
  return std::any_of(tree.stages.begin(), tree.stages.end(),
                     [stage](const StageInfo& info) { return info.stage == stage; });
}

// Bound from below on the objective of the families after the lines.
double SourceRest(const Problem& problem, const Tree& tree, const Candidate& candidate,
                  const Need& need, const Window& window) {
  double rest = 0.0;
  if (Has(tree, Stage::kBottle) && candidate.bottle.index == kNone)
    rest += LeastThatBears(problem, candidate, Stage::kBottle, tree.bottles, [&](const Option& o) {
      return BottleBears(problem, candidate, o, need, window.low_pa);
    });
  if (Has(tree, Stage::kBattery) && candidate.battery.index == kNone)
    rest += LeastBattery(
        problem, tree, candidate,
        {problem.actuations * need.energy_j, need.coil_power_w, PumpCurrent(problem, candidate)});
  if (Has(tree, Stage::kReservoir))
    rest += LeastReservoir(
        problem, tree,
        LeastReservoirVolume(problem, tree.pumps[candidate.compressor.index],
                             candidate.compressor.quantity, need.air_to_target_m3, window.high_pa));
  return rest;
}

void ExpandLines(const Problem& problem, const Tree& tree, const Candidate& parent,
                 const StageInfo& info, const Amounts& amounts, Children& children) {
  const LineSet& set = *tree.lines[info.group];
  children.incompatible = set.incompatible;
  children.infeasible = set.infeasible;
  const Window window = SourceWindow(problem, parent);
  double chosen = ChosenObjective(problem, parent);
  for (std::size_t g = info.group + 1; g < problem.groups.size(); ++g)
    chosen += tree.line_objective_least[g];

  for (const Line& line : set.lines) {
    const double low_pa = std::max(window.low_pa, line.source_min_pa);
    const double high_pa = std::min(window.high_pa, line.source_max_pa);
    Amounts total = amounts;
    total += line.amounts;
    total += info.least;
    bool possible = low_pa <= high_pa && WithinLimits(problem, total);
    double bound = kUnlimited;
    if (possible) {
      const Need need = LeastNeed(problem, tree, parent, &line);
      possible = parent.compressor.index == kNone || PumpBears(problem, parent, need);
      if (possible)
        bound = chosen + LineObjective(problem, line) +
                EnergyObjective(problem, need.pump.energy_j) +
                SourceRest(problem, tree, parent, need, {low_pa, high_pa});
    }
    if (std::isfinite(bound))
      children.list.push_back({bound, {}, &line});
    else
      ++children.infeasible;
  }
}

void ExpandOptions(const Problem& problem, const Tree& tree, const Candidate& parent,
                   const StageInfo& info, const Amounts& amounts, Children& children) {
  const OptionSet& set = Options(tree, info.stage);
  const bool lines_chosen = parent.lines.size() == problem.groups.size();
  Candidate candidate = parent;
  // With all lines and the regulator known the lowest useful source pressure is, too.
  if (info.stage == Stage::kBottle) {
    const std::optional<double> needed = NeededSourcePressure(problem, parent, {});
    if (!needed) {
      children.infeasible = static_cast<long long>(set.options.size());
      return;
    }
    candidate.source_floor_pa = children.source_floor_pa = *needed;
  }
  double chosen = ChosenObjective(problem, parent);
  if (!lines_chosen)
    for (double least : tree.line_objective_least) chosen += least;
  const Need shared = LeastNeed(problem, tree, parent);

  for (const Option& option : set.options) {
    if (!Mates(problem, candidate, info.stage, option)) {
      ++children.incompatible;
      continue;
    }
    Slot(candidate, info.stage) = option;
    Amounts total = amounts;
    total += option.amounts;
    total += info.least;
    bool possible = WithinLimits(problem, total);
    if (info.stage == Stage::kBottle)
      possible =
          possible && BottleBears(problem, candidate, option, shared, candidate.source_floor_pa);
    if (info.stage == Stage::kBattery)
      possible = possible &&
                 BatteryBears(problem, option,
                              {problem.actuations * shared.energy_j, shared.coil_power_w, 0.0});
    const Window window = SourceWindow(problem, candidate);
    possible = possible && !window.empty();
    double bound = kUnlimited;
    if (possible) {
      Need need = shared;
      if (info.stage == Stage::kCompressor || info.stage == Stage::kRegulator)
        need = LeastNeed(problem, tree, candidate);
      possible = info.stage != Stage::kCompressor || PumpBears(problem, candidate, need);
      if (possible)
        bound = chosen + option.objective + EnergyObjective(problem, need.pump.energy_j) +
                SourceRest(problem, tree, candidate, need, window);
    }
    if (std::isfinite(bound))
      children.list.push_back({bound, option, nullptr});
    else
      ++children.infeasible;
  }
}

}  // namespace

Children Expand(const Problem& problem, const Tree& tree, const Candidate& parent, int stage) {
  const StageInfo& info = tree.stages[stage];
  Children children;
  children.source_floor_pa = parent.source_floor_pa;
  children.source_cap_pa = parent.source_cap_pa;
  Amounts amounts;
  for (const Line* line : parent.lines) amounts += line->amounts;
  for (const Option* option :
       {&parent.regulator, &parent.bottle, &parent.compressor, &parent.reservoir, &parent.battery})
    amounts += option->amounts;
  children.unpriced = info.stage == Stage::kLine ? tree.lines[info.group]->unpriced
                                                 : Options(tree, info.stage).unpriced;
  if (info.stage == Stage::kLine)
    ExpandLines(problem, tree, parent, info, amounts, children);
  else if (info.stage == Stage::kReservoir)
    ExpandReservoirs(problem, tree, parent, info, amounts, children);
  else if (info.stage == Stage::kBattery && parent.compressor.index != kNone)
    ExpandPumpBatteries(problem, tree, parent, amounts, children);
  else
    ExpandOptions(problem, tree, parent, info, amounts, children);
  std::stable_sort(children.list.begin(), children.list.end(),
                   [](const Child& a, const Child& b) { return a.bound < b.bound; });
  return children;
}

Candidate Chosen(const Tree& tree, const Candidate& parent, int stage, const Children& children,
                 const Child& child) {
  Candidate candidate = parent;
  candidate.source_floor_pa = children.source_floor_pa;
  candidate.source_cap_pa = children.source_cap_pa;
  if (child.line != nullptr)
    candidate.lines.push_back(child.line);
  else
    Slot(candidate, tree.stages[stage].stage) = child.option;
  return candidate;
}

}  // namespace plenum::optimizer
