#include "optimizer/box.h"

#include <algorithm>
#include <cmath>

#include "optimizer/evaluate_strokes.h"
#include "optimizer/line.h"
#include "optimizer/make_line.h"

namespace plenum::optimizer {
namespace {

constexpr std::size_t kLinesKept = 20000;

}  // namespace

Bounds::Bounds(const Problem& problem, const Plan& plan)
    : problem_(problem), plan_(plan), gas_(GasOf(plan.configuration)) {}

Box Bounds::Root() const {
  Box box;
  box.nodes.assign(plan_.slots.size(), 0);
  return box;
}

bool Bounds::IsSingle(const Box& box) const {
  for (std::size_t s = 0; s < box.nodes.size(); ++s)
    if (!Node(box, static_cast<int>(s)).single()) return false;
  return true;
}

bool Bounds::CoreIsSingle(const Box& box) const {
  for (std::size_t s = 0; s < box.nodes.size(); ++s)
    if (DecidesSource(static_cast<int>(s)) && !Node(box, static_cast<int>(s)).single())
      return false;
  return true;
}

int Bounds::WidestSlot(const Box& box) const {
  // What a pump or a reservoir adds to the others of its source is not in its own share.
  constexpr double kSourceWeight = 10.0;
  const auto spread = [&](int s) {
    const BoxNode& node = Node(box, s);
    return (node.objective_high - node.objective_low) *
           (DecidesSource(s) && plan_.slots[s].group < 0 ? kSourceWeight : 1.0);
  };
  const auto wider = [&](int a, int b) {
    return spread(a) != spread(b) ? spread(a) > spread(b)
                                  : Node(box, a).size() > Node(box, b).size();
  };
  int widest = -1;
  for (const bool core : {true, false}) {
    for (int s = 0; s < static_cast<int>(box.nodes.size()); ++s)
      if (DecidesSource(s) == core && !Node(box, s).single() && (widest < 0 || wider(s, widest)))
        widest = s;
    if (widest >= 0) break;
  }
  return widest;
}

BigCount Bounds::Count(const Box& box) const {
  BigCount count = 1;
  for (std::size_t s = 0; s < box.nodes.size(); ++s) count *= Node(box, static_cast<int>(s)).size();
  return count;
}

Constraint Bounds::RemakeLine(Box& box, int group) {
  const int first = kSlotsPerGroup * group;
  const LineKey key{group, box.nodes[first], box.nodes[first + 1], box.nodes[first + 2]};
  if (lines_.size() > kLinesKept) lines_.clear();
  const auto [entry, fresh] = lines_.try_emplace(key);
  auto& [constraint, kept] = entry->second;
  if (fresh) {
    const GroupTrees& trees = plan_.groups[group];
    const bool exact =
        Node(box, first).single() && Node(box, first + 1).single() && Node(box, first + 2).single();
    Line line;
    constraint =
        MakeLine(problem_, group, gas_,
                 {CornerAt(trees.tubes, box, first), CornerAt(trees.fittings, box, first + 1),
                  CornerAt(trees.valves, box, first + 2)},
                 exact, exact || plan_.configuration == Configuration::kCompressor, line);
    if (exact) {
      line.tubing = OptionOf(box, first).index;
      line.fitting = OptionOf(box, first + 1).index;
      line.valve = OptionOf(box, first + 2).index;
      if (!PartsMate(problem_, line)) constraint = Constraint::kMating;
    }
    if (constraint == Constraint::kNone) kept = std::make_shared<const Line>(std::move(line));
  }
  box.lines[group] = kept;
  return constraint;
}

Constraint Bounds::Assess(Box& box, int changed) {
  const int groups = static_cast<int>(plan_.groups.size());
  box.lines.resize(groups);
  for (int g = 0; g < groups; ++g)
    if (changed < 0 || changed / kSlotsPerGroup == g)
      if (const Constraint missed = RemakeLine(box, g); missed != Constraint::kNone) return missed;
  if (!WithinAmounts(box)) return Constraint::kAmounts;
  const bool source_changed = changed < 0 || DecidesSource(changed);
  return plan_.configuration == Configuration::kCompressor
             ? AssessCompressor(box, source_changed, changed < 0 || changed == plan_.reservoir_slot)
             : AssessRegulated(box, source_changed);
}

bool Bounds::WithinAmounts(const Box& box) const {
  Amounts least;
  for (const std::shared_ptr<const Line>& line : box.lines) least += line->amounts;
  const auto add = [&](const auto& tree, int slot) {
    if (slot >= 0) least += CornerAt(tree, box, slot).amounts;
  };
  add(plan_.regulators, plan_.regulator_slot);
  add(plan_.bottles, plan_.bottle_slot);
  add(plan_.compressors, plan_.compressor_slot);
  add(plan_.reservoirs, plan_.reservoir_slot);
  add(plan_.batteries, plan_.battery_slot);
  constexpr double kRounding = 1.0 + 1e-12;  // sums in another order
  return least.mass_kg <= problem_.mass_max_kg * kRounding &&
         least.volume_m3 * 1e3 <= problem_.volume_max_l * kRounding &&
         least.cost_eur <= problem_.cost_max_eur * kRounding;
}

void Bounds::AddLines(Box& box) const {
  box.window = {std::max(problem_.ambient.pressure_pa, box.source_floor_pa),
                std::min(problem_.source_pressure_max_pa, box.source_cap_pa)};
  box.coil_power_w = 0.0;
  for (const std::shared_ptr<const Line>& line : box.lines) {
    box.window.low_pa = std::max(box.window.low_pa, line->source_min_pa);
    box.window.high_pa = std::min(box.window.high_pa, line->source_max_pa);
    box.coil_power_w += line->coil_power_w;
  }
}

double Bounds::EnergyShare(double energy_j) const {
  return problem_.objective.energy_wh * energy_j / 3600.0;
}

double Bounds::LeastBattery(const Box& box, double energy_j, double pump_current_a) const {
  if (plan_.battery_slot < 0) return 0.0;
  const Kinds pump = plan_.compressor_slot < 0
                         ? ~Kinds{0}
                         : CornerAt(plan_.compressors, box, plan_.compressor_slot).voltages;
  return LeastObjective(plan_.batteries, box.nodes[plan_.battery_slot],
                        [&](const BatteryCorner& c) {
                          return (c.voltages & pump) && energy_j <= c.energy_j &&
                                 pump_current_a + box.coil_power_w / c.voltage_v <= c.current_max_a;
                        });
}

Candidate Bounds::CandidateOf(const Box& box) const {
  Candidate candidate;
  candidate.configuration = plan_.configuration;
  candidate.source_floor_pa = box.source_floor_pa;
  candidate.source_cap_pa = box.source_cap_pa;
  for (const std::shared_ptr<const Line>& line : box.lines) candidate.lines.push_back(line.get());
  const auto choose = [&](int slot, Option& option) {
    if (slot >= 0 && Node(box, slot).single()) option = OptionOf(box, slot);
  };
  choose(plan_.regulator_slot, candidate.regulator);
  choose(plan_.bottle_slot, candidate.bottle);
  choose(plan_.compressor_slot, candidate.compressor);
  choose(plan_.reservoir_slot, candidate.reservoir);
  choose(plan_.battery_slot, candidate.battery);
  return candidate;
}

bool Bounds::CanFindSource(const Box& box) const { return !box.source_known && CoreIsSingle(box); }

}  // namespace plenum::optimizer
