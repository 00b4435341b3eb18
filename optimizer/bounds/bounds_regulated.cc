// Boxes of the configurations with a regulator: cylinder, CO2, mains, tank, and a tank that pumps
// go on filling; and what is the same
// of pumps without a reservoir (bounds_compressor.cc). Where a tank may do without a regulator the
// source pressure of a box is at most its fill and at least what the last stroke finds: strokes are
// bounded by those on a source that stays at the highest.
#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/bounds/box.h"
#include "optimizer/bounds/refill_bound.h"
#include "optimizer/bounds/regulator_box.h"
#include "optimizer/evaluate/filling.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"
#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {
namespace {

constexpr double kRounding = kBoxSlack;
constexpr double kFloorTolerance = 1e-3;

// From a regulator, shared by so many lines, to one actuator.
std::vector<model::FlowElement> Elements(model::FlowElement regulator, const Line& line,
                                         int count) {
  regulator.sonic_conductance_m3_per_s_pa /= count;
  std::vector<model::FlowElement> elements{regulator};
  elements.insert(elements.end(), line.fill.begin(), line.fill.end());
  return elements;
}

double FlowMax(const Problem& problem, Configuration configuration,
               const RegulatorCorner& regulator) {
  return configuration == Configuration::kMains
             ? std::min(regulator.flow_max_m3_per_s, problem.mains.flow_max_m3_per_s)
             : regulator.flow_max_m3_per_s;
}

// One actuator of a group, alone with those of its group on their regulator.
struct Behind {
  Behind(const Problem& problem, const Plan& plan, const Box& box, int g)
      : count(FilledAtOnce(problem, g)),
        elements(Elements(RegulatorAt(plan, box, g).flow, *box.lines[g], count)),
        filling(problem, g, elements, FlowFactor(problem, GasOf(plan.configuration)),
                box.lines[g]->chamber, kBoxSlack,
                FlowMax(problem, plan.configuration, RegulatorAt(plan, box, g)) / count) {}
  Behind(const Behind&) = delete;  // its filling looks at its elements

  int count;
  std::vector<model::FlowElement> elements;
  Filling filling;
};

// Of the gas that a bottle gives, between the least and the most that it may.
double ShareAt(const Problem& problem, const Plan& plan, double inlet_pa) {
  const double low = GasLeft(problem, plan.configuration, plan.bottle_range.low_pa);
  const double high = GasLeft(problem, plan.configuration, plan.bottle_range.high_pa);
  const double left = GasLeft(problem, plan.configuration, inlet_pa);
  return high > low ? std::max(0.0, (left - low) / (high - low)) : 0.0;
}

// Whether the strokes of the last period are in time out of a tank without a regulator, which all
// periods before have drawn on.
bool LastAreInTime(const Problem& problem, const Plan& plan, const Box& box, const TankAt& fullest,
                   double drawn_m3) {
  const double source_pa = LeftPa(fullest, drawn_m3);
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g)
    if (!Behind(problem, plan, box, g).filling.InTime(source_pa)) return false;
  return true;
}

// What the pumps of a vacuum beside the source take at least of the candidate's lines, energy over
// the mission; none where they keep none at which falls are in time. Nothing as long as they are
// not chosen.
struct RailNeed {
  double energy_j = 0.0, current_a = 0.0;
};
std::optional<RailNeed> LeastOfRail(const Problem& problem, const Candidate& candidate) {
  constexpr double kRoom = 1e-7;  // more than settings are found to
  const RailSource source = RailSourceOf(problem, candidate);
  if (!source.curve) return RailNeed{};
  const std::optional<double> rail_pa =
      WeakestRailPa(problem, source, candidate.lines, GasOf(candidate.configuration), kRoom);
  if (!rail_pa) return std::nullopt;
  const double air_m3 = RailAir(problem, candidate.lines) / kRounding;
  const RailLoad load = LoadOf(problem, source, air_m3, *rail_pa);
  return RailNeed{(load.first_fill_j + problem.actuations * load.energy_per_cycle_j) / kRounding,
                  load.current_a / kRounding};
}

// Share of the objective of the pumps of the source, and of the vacuum beside it with its
// reservoirs.
double LeastOfPumps(const Plan& plan, const Box& box) {
  const auto least = [&](const auto& tree, int slot) {
    return slot < 0 ? 0.0 : tree.corners[box.nodes[slot]].objective;
  };
  return least(plan.compressors, plan.compressor_slot) +
         least(plan.rail.pumps, plan.rail.pump_slot) +
         least(plan.rail.reservoirs, plan.rail.reservoir_slot);
}

// At so much of the way from the lowest to the highest inlet pressure that matters.
double GasAt(const BottleCorner& corner, double share) {
  return (1.0 - share) * corner.gas_to_low_m3 + share * corner.gas_to_high_m3;
}

}  // namespace

Constraint Bounds::AssessRegulated(Box& box, bool source_changed) {
  const bool direct = IsDirect(plan_.configuration);
  if (source_changed)
    if (const Constraint missed = direct ? NeedOfDirect(box) : NeedOfRegulated(box);
        missed != Constraint::kNone)
      return missed;
  if (!PackDrivesPump(box)) return Constraint::kMating;
  return RestOfRegulated(box);
}

// Window, strokes and needs. Strokes are those of each group alone on the regulator, at the highest
// pressure that parts stand: neighbours and lower pressures only slow them.
Constraint Bounds::NeedOfRegulated(Box& box) {
  if (!InletsSuit(problem_, plan_, box)) return Constraint::kMating;
  AddLines(box);
  if (!NarrowWindow(problem_, plan_, box)) return Constraint::kPressure;
  const Inlet inlet = InletOf(plan_, box);
  if (inlet.all_none)
    for (const std::shared_ptr<const Line>& line : box.lines)
      if (!line->holds) return Constraint::kPressure;

  const double seconds = problem_.actuations / problem_.frequency_hz;
  box.air_m3 = 0.0;
  box.energy_beyond_j = 0.0;
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g) {
    const Line& line = *box.lines[g];
    const ActuatorGroup& group = problem_.groups[g];
    const double strokes = group.gait.strokes_per_period;
    const double high_pa = WindowAt(problem_, plan_, box, g).high_pa;
    Behind behind(problem_, plan_, box, g);
    Filling& filling = behind.filling;
    if (!filling.InTime(high_pa)) return Constraint::kRise;
    box.air_m3 += strokes * LeastAirPerStroke(problem_, g, line);
    if (line.all_hold && line.coil_power_w > 0.0) {  // energised while they inflate, too
      const double inflate_s = problem_.objective.energy_wh > 0.0
                                   ? filling.InflateTime(high_pa)
                                   : filling.InflateTimeAtLeast(high_pa);
      box.energy_beyond_j += problem_.actuations * strokes * line.coil_power_w * inflate_s;
    }
  }
  box.energy_j = box.energy_beyond_j + problem_.actuations * CoilEnergy(problem_, box) +
                 inlet.electrical_power_w * seconds;
  box.coil_power_w += inlet.electrical_power_w;
  if (!shared_) return Constraint::kNone;
  std::vector<GroupLines::Nodes> nodes;
  std::vector<const Line*> lines;
  nodes.reserve(box.lines.size());
  lines.reserve(box.lines.size());
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g) {
    nodes.push_back(KeyOf(box, g).nodes);
    lines.push_back(box.lines[g].get());
  }
  std::vector<LineChoice> choices =
      groups_->LeastBehind(nodes, lines, box.window,
                           {RegulatorAt(plan_, box, 0).flow, 0.0,
                            FlowMax(problem_, plan_.configuration, RegulatorAt(plan_, box, 0))});
  if (choices.empty()) return Constraint::kRise;
  box.choices = std::make_shared<const std::vector<LineChoice>>(std::move(choices));
  return Constraint::kNone;
}

// A source pressure below which some group, alone on the regulator, is too slow; behind regulators
// of their own the highest of the groups'.
double Bounds::RegulatedFloor(const Box& box) const {
  double floor_pa = box.window.low_pa;
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g) {
    const Window window = WindowAt(problem_, plan_, box, g);
    Behind behind(problem_, plan_, box, g);
    const auto late = [&](double source_pa) {
      return behind.filling.LatenessAtLeast(source_pa).value_or(0.0);
    };
    const double from_pa = plan_.own_regulators ? window.low_pa : floor_pa;
    floor_pa =
        std::max(floor_pa, FeasibleBracket(late, from_pa, window.high_pa, kFloorTolerance).low);
  }
  return floor_pa;
}

// The lightest bottle and battery of the box that bear the needs.
Constraint Bounds::RestOfRegulated(Box& box) {
  const bool direct = IsDirect(plan_.configuration);
  const Inlet inlet = direct ? Inlet{} : InletOf(plan_, box);
  const auto rail = PumpsRail(problem_) ? LeastOfRail(problem_, CandidateOf(box)) : RailNeed{};
  if (!rail) return Constraint::kPump;
  double bound = inlet.objective + LeastOfPumps(plan_, box) +
                 EnergyShare(box.energy_beyond_j + rail->energy_j);
  Refilling refilling;  // of pumps without a reservoir the current
  if (direct)
    refilling.current_a = direct_.feeds_at_once() * PumpOf(box).rates.CurrentAt(box.window.low_pa);
  if (plan_.bottle_slot >= 0) {
    const double inlet_pa = std::max(box.window.low_pa, inlet.min_pa);
    const double air_m3 = problem_.actuations * box.air_m3;
    // Without a regulator the last stroke may take a tank below the least that it asks.
    const double above_m3 = inlet.some_none ? air_m3 - box.air_m3 : air_m3;
    const bool tank = HasTank(plan_.configuration), refilled = tank && plan_.compressor_slot >= 0;
    const double fill_max_pa = inlet.all_none ? box.window.high_pa : inlet.max_pa;
    const TankAt fullest{problem_, CornerAt(plan_.bottles, box, plan_.bottle_slot), fill_max_pa,
                         inlet_pa};
    if (inlet.all_none && !LastAreInTime(problem_, plan_, box, fullest, above_m3 / kRounding))
      return Constraint::kRise;
    const double cycle_m3 = box.air_m3 / kRounding;
    if (refilled)
      refilling = LeastRefilling(
          fullest, cycle_m3, CornerAt(plan_.compressors, box, plan_.compressor_slot),
          PumpOf(box).rates,
          Node(box, plan_.compressor_slot).single() ? &OptionOf(box, plan_.compressor_slot)
                                                    : nullptr);
    if (!refilling.works) return Constraint::kGas;
    // What bottles must hold, at least: of a tank that pumps fill the air of one period.
    const double held_m3 =
        std::max(above_m3 / kRounding - refilling.most_m3, refilled ? cycle_m3 : 0.0);
    const double open_m3 = inlet.all_none ? air_m3 / kRounding : 0.0;
    double charge_m3 = refilled ? held_m3 : tank ? air_m3 / kRounding : 0.0;
    if (refilled && Node(box, plan_.bottle_slot).single()) charge_m3 += LeftM3(fullest);
    const double air_kg = charge_m3 * model::kReferenceDensityKgPerM3;
    bound += EnergyShare(refilling.energy_j) + problem_.objective.mass_kg * air_kg;
    const double share = ShareAt(problem_, plan_, inlet_pa);
    const Amounts all = LeastOfAll(box), counted = fullest.tank.amounts;
    const Amounts others{all.mass_kg - counted.mass_kg + air_kg, all.volume_m3 - counted.volume_m3,
                         all.cost_eur - counted.cost_eur};
    const double bottle =
        LeastObjective(plan_.bottles, box.nodes[plan_.bottle_slot], [&](const BottleCorner& c) {
          return c.fill_pressure_pa <= inlet.max_pa && GasAt(c, share) >= held_m3 &&
                 (!tank || Gives({problem_, c, fill_max_pa, inlet_pa}, held_m3, open_m3)) &&
                 c.flow_sustained_m3_per_s * kRounding >= box.air_m3 * problem_.frequency_hz &&
                 WithinLimits(others, c.amounts);
        });
    if (std::isinf(bottle)) return Constraint::kGas;
    bound += bottle;
  }
  int unknown = -1;
  const BatteryLoad load{(box.energy_j + rail->energy_j + refilling.energy_j) / kRounding,
                         refilling.current_a + rail->current_a, box.coil_power_w,
                         LeastBesidesBattery(box)};
  const double lines = LeastWithLines(box, load, LeastBattery(box, load, unknown));
  if (std::isinf(lines)) return Constraint::kBattery;
  box.bound = std::max(box.bound, bound + lines);
  return Constraint::kNone;
}

}  // namespace plenum::optimizer
