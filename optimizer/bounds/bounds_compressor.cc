// Boxes of the compressor configuration, whose families share one source pressure: it rises as the
// reservoir shrinks, and the battery grows with it. And boxes of pumps without a reservoir, which
// have no settings.
#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/bounds/box.h"
#include "optimizer/choices/hash.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/filling.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/problem/pump_feed.h"
#include "optimizer/sizing/group_pressures.h"
#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {
namespace {

constexpr double kFoundTolerance = 5e-7;
constexpr double kMeetTolerance = 1e-3;

NeededPressure HighestNeeded(const GroupPressures& groups) {
  return {groups.status, groups.least_pa(), groups.least_pa()};
}

}  // namespace

// True also while one of the two is not chosen. Ejectors need air, and no pack.
bool Bounds::PackDrivesPump(const Box& box) const {
  const auto drives = [&](const std::vector<model::Compressor>& pumps, int slot) {
    if (slot < 0 || !Node(box, slot).single()) return true;
    const Option& chosen = OptionOf(box, slot);
    const model::Compressor& pump = pumps[chosen.index];
    if (!AirSuffices(problem_, pump, chosen.quantity)) return false;
    if (plan_.battery_slot < 0 || !Node(box, plan_.battery_slot).single()) return true;
    return model::VoltageMatches(
        problem_.parts.batteries[OptionOf(box, plan_.battery_slot).index].nominal_voltage_v,
        pump.curve.voltage_v);
  };
  return drives(PumpsOf(problem_, plan_.configuration), plan_.compressor_slot) &&
         drives(problem_.parts.vacuum_pumps, plan_.rail.pump_slot);
}

// Window, strokes and needs of pumps without a reservoir. The lower end of the window is what is
// between pumps and valves at least: a constant source at the highest pressure there is faster, so
// that what lines ask of one bounds it, too.
Constraint Bounds::NeedOfDirect(Box& box) {
  AddLines(box);
  const CompressorCorner& pump = CornerAt(plan_.compressors, box, plan_.compressor_slot);
  box.window.high_pa = std::min(box.window.high_pa, pump.pressure_max_pa);
  if (box.window.empty() || direct_.feeds_meet()) return Constraint::kPressure;
  std::vector<const Line*> lines;
  lines.reserve(box.lines.size());
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g) {
    const int valve_slot = kSlotsPerGroup * (g + 1) - 1;  // after tube and fitting
    const double inlet_pa = CornerAt(plan_.groups[g].valves, box, valve_slot).pressure_min_pa;
    if (!box.lines[g]->holds || inlet_pa > problem_.ambient.pressure_pa)
      return Constraint::kPressure;
    lines.push_back(box.lines[g].get());
  }
  const bool chosen = CoreIsSingle(box);
  const Candidate candidate = chosen ? CandidateOf(box) : Candidate{};
  const std::optional<DirectNeed> need =
      direct_.Least(PumpOf(box), lines, box.window.high_pa, chosen ? &candidate : nullptr);
  if (!need) return Constraint::kRise;
  box.window.low_pa = std::max(box.window.low_pa, need->node_pa);
  if (box.window.empty()) return Constraint::kPressure;
  if (need->on_s * problem_.frequency_hz > pump.duty_max * kBoxSlack) return Constraint::kPump;
  box.energy_beyond_j = problem_.actuations * need->energy_j;
  box.energy_j = box.energy_beyond_j + problem_.actuations * CoilEnergy(problem_, box);
  return Constraint::kNone;
}

Constraint Bounds::AssessCompressor(Box& box, int changed) {
  const bool all = changed < 0;
  if (all || DecidesSource(changed))
    if (const Constraint missed = NeedOfCompressor(box); missed != Constraint::kNone) return missed;
  if (!PackDrivesPump(box)) return Constraint::kMating;
  if (all || changed == plan_.reservoir_slot) RestrictVolumes(box);
  if (changed == plan_.battery_slot)
    for (VolumeNeed& volume : box.volumes.Own()) BoundRest(box, volume);
  else if (changed != plan_.reservoir_slot)
    RenewLooks(box);
  return RestOfCompressor(box);
}

Constraint Bounds::RestOfCompressor(Box& box) {
  double least = box.forgotten;
  if (!box.volumes->empty()) {
    box.lowest = Lowest(box);
    least = std::min(least, TotalOf(box, (*box.volumes)[box.lowest]));
  }
  if (std::isinf(least)) return box.volumes->empty() ? Constraint::kPump : Constraint::kBattery;
  box.bound = std::max(box.bound, least);
  return Constraint::kNone;
}

const PumpFacts& Bounds::PumpOf(const Box& box) {
  constexpr int kBoxCells = 256;  // while lines are not chosen: there may be many compressors
  const bool fine = CoreIsSingle(box, plan_.reservoir_slot);
  const int node = box.nodes[plan_.compressor_slot];
  const auto [entry, fresh] = (fine ? chosen_pumps_ : pumps_).try_emplace(node);
  if (fresh) {
    if (Node(box, plan_.compressor_slot).single()) {
      const Option& option = OptionOf(box, plan_.compressor_slot);
      entry->second =
          MakePumpFacts(problem_, PumpsOf(problem_, plan_.configuration)[option.index].curve,
                        option.quantity, fine ? kPumpTableCells : kBoxCells);
    } else {
      entry->second = MakePumpFacts(problem_, plan_.highest_pump_pa,
                                    CornerAt(plan_.compressors, box, plan_.compressor_slot).pump);
    }
  }
  return entry->second;
}

Constraint Bounds::NeedOfCompressor(Box& box) const {
  AddLines(box);
  box.window.high_pa = std::min(
      {box.window.high_pa, CornerAt(plan_.compressors, box, plan_.compressor_slot).pressure_max_pa,
       CornerAt(plan_.reservoirs, box, plan_.reservoir_slot).pressure_max_pa});
  return box.window.empty() ? Constraint::kPressure : Constraint::kNone;
}

// What volumes need is found anew where it may have grown, not where lines and pumps fill them as
// those of the larger box do. What hides a change, as an equal hash might, leaves bounds that hold.
void Bounds::RenewLooks(Box& box) const {
  if (!box.lines_finished) return;
  Hash needs, rest;
  needs.Add(box.nodes[plan_.compressor_slot]);
  needs.Add(CoreIsSingle(box, plan_.reservoir_slot));
  for (const std::shared_ptr<const Line>& line : box.lines) needs.Add(line->strokes);
  for (double value : {box.coil_power_w, box.window.low_pa, box.window.high_pa}) needs.Add(value);
  rest.Add(needs.value());
  for (const LineChoice& choice : *box.choices) {
    rest.Add(choice.objective);
    rest.Add(choice.coil_power_w);
  }
  if (limited_) {
    const Amounts amounts = LeastBesidesBattery(box);
    for (double value : {amounts.mass_kg, amounts.volume_m3, amounts.cost_eur,
                         amounts.mass_slack_kg, amounts.volume_slack_m3})
      rest.Add(value);
  }
  if (needs.value() != box.needs_of) ++box.look;
  if (rest.value() != box.rest_of) ++box.rest_look;
  box.needs_of = needs.value();
  box.rest_of = rest.value();
}

// Raises the objective of reservoir, battery and energy with a volume in the interval, at least,
// and the same with the lines.
void Bounds::BoundRest(const Box& box, VolumeNeed& volume) {
  volume.rest_look = box.rest_look;
  double beyond_j = volume.need.energy_j;  // what the shares of the lines do not count
  BatteryLoad load{volume.need.energy_j, 0.0, box.coil_power_w, LeastBesidesBattery(box)};
  if (volume.need.energy_j > 0.0) {
    beyond_j -= problem_.actuations * CoilEnergy(problem_, box);
    load.pump_current_a =
        PumpOf(box).rates.CurrentAt(std::max(box.window.low_pa, volume.need.source_pa));
  }
  const Amounts& counted = CornerAt(plan_.reservoirs, box, plan_.reservoir_slot).amounts;
  const Amounts least = LeastOf(volume);
  load.others.mass_kg += least.mass_kg - counted.mass_kg;
  load.others.volume_m3 += least.volume_m3 - counted.volume_m3;
  load.others.cost_eur += least.cost_eur - counted.cost_eur;
  const double battery = LeastBattery(box, load, volume.battery);
  const double other = volume.objective + EnergyShare(std::max(0.0, beyond_j));
  volume.rest = std::max(volume.rest, other + battery);
  if (box.choices && volume.need.energy_j > 0.0 && std::isfinite(battery))
    volume.with_lines = std::max(volume.with_lines, other + LeastWithLines(box, load, battery));
}

bool Bounds::CanFindSource(const Box& box) const {
  if (IsForgotten(box)) return true;
  if (IsDirect(plan_.configuration)) return false;
  if (KeepsReservoir(plan_.configuration) &&
      !(box.lines_finished && IsSettled(box, (*box.volumes)[box.lowest])))
    return true;
  return CoreIsSingle(box) && (!box.source_known || CanSizeCore(box));
}

Constraint Bounds::FindSource(Box& box) {
  if (IsForgotten(box)) {
    box.volumes = {};
    box.forgotten = kUnlimited;
    return Assess(box, -1);
  }
  if (KeepsReservoir(plan_.configuration)) {
    if (!box.lines_finished) {
      if (const Constraint missed = FinishLines(box); missed != Constraint::kNone) return missed;
      if (const Constraint missed = NeedOfCompressor(box); missed != Constraint::kNone)
        return missed;
      RenewLooks(box);
      return RestOfCompressor(box);
    }
    const VolumeNeed& lowest = (*box.volumes)[box.lowest];
    if (!IsSettled(box, lowest)) return LookAtLowest(box);
    if (box.source_known) return SizeCore(box);
    return IsMade(lowest) ? RefineVolumes(box) : FindStockSource(box);
  }
  if (!box.source_bounded) {
    box.source_bounded = true;
    box.source_floor_pa = RegulatedFloor(box);
  } else {
    box.source_known = true;
    const Candidate candidate = CandidateOf(box);
    if (IsOpenTank(candidate)) return Constraint::kNone;  // each tank has its own
    const bool meet = StrokesMeet(problem_) && !plan_.own_regulators;
    if (meet && !FastAtHighest(problem_, candidate)) return Constraint::kRise;
    // Where groups meet it is found no closer than bottles have to know it.
    if (meet && plan_.bottle_slot < 0) return Constraint::kNone;
    const NeededPressure needed =
        plan_.own_regulators ? HighestNeeded(NeededGroupPressures(problem_, candidate))
                             : NeededSourcePressure(problem_, candidate, {},
                                                    meet ? kMeetTolerance : kPressureTolerance);
    if (needed.status == LeafStatus::kInfeasible) return Constraint::kRise;
    if (needed.status == LeafStatus::kUndecided) return Constraint::kNone;
    box.source_floor_pa = meet ? needed.floor_pa : needed.source_pa;
  }
  if (const Constraint missed = NeedOfRegulated(box); missed != Constraint::kNone) return missed;
  return RestOfRegulated(box);
}

// Energy of the mission at any source pressure from that of the point on, at least: of each
// interval of pressures the lower end counts for the pumps, whose energy rises, and the upper end
// for the coils, which strokes shorten.
double Bounds::LeastEnergy(const Candidate& candidate, OperatingPoint point,
                           const Evaluation& least) const {
  constexpr double kRatios[] = {1.01, 1.03, 1.08, 1.2};
  const double floor_pa = point.source_pa;
  double least_j = kUnlimited, pumps_j = least.energy_total_j - least.energy_coils_j;
  for (double ratio : kRatios) {
    point.source_pa = floor_pa * ratio;
    if (point.source_pa >= candidate.source_cap_pa || pumps_j + least.energy_coils_j >= least_j)
      break;
    const Evaluation at = Evaluate(problem_, candidate, point);
    if (at.failed || !at.works) break;
    least_j = std::min(least_j, pumps_j + at.energy_coils_j);
    pumps_j = at.energy_total_j - at.energy_coils_j;
  }
  return std::min(least_j, pumps_j + least.energy_coils_j);
}

// No battery changes the strokes. The need at the lowest useful source pressure is the least there
// is where the pump takes no less energy per air at higher pressure.
Constraint Bounds::FindStockSource(Box& box) {
  box.source_known = true;
  VolumeNeed& volume = box.volumes.Own().front();
  const double volume_m3 = volume.need.low_m3;
  Candidate candidate = CandidateOf(box);
  candidate.source_floor_pa = volume.need.source_pa;
  candidate.source_cap_pa = volume.need.source_max_pa;
  OperatingPoint point{0.0, volume_m3, volume_m3};
  const NeededPressure needed = NeededSourcePressure(problem_, candidate, point, kFoundTolerance);
  if (needed.status == LeafStatus::kInfeasible) return Constraint::kRise;
  if (needed.status == LeafStatus::kUndecided) return Constraint::kNone;
  volume.need.source_pa = box.source_floor_pa = point.source_pa = needed.floor_pa;
  box.source_cap_pa = volume.need.source_max_pa;
  if (PumpEnergyRises(problem_, candidate)) {
    const Evaluation least = Evaluate(problem_, candidate, point, {.least_coil_energy = true});
    if (least.failed) return Constraint::kNone;
    const double duty_max = ChosenPump(problem_, candidate).duty_max;
    if (!(least.compressor_duty <= duty_max)) return Constraint::kPump;
    // Of several groups each look at another pressure would be a simulation.
    const bool cheap = MeetingOf(problem_) == Meeting::kAlone;
    volume.need.energy_j = std::max(
        volume.need.energy_j, cheap ? LeastEnergy(candidate, point, least) : least.energy_total_j);
  }
  BoundRest(box, volume);
  return RestOfCompressor(box);
}

}  // namespace plenum::optimizer
