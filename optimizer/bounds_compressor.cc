// Boxes of the compressor configuration, whose families share one source pressure: it rises as the
// reservoir shrinks, and the battery grows with it. So the reservoir's volume is divided into
// intervals, each with its least source pressure, least energy and so its lightest battery.
#include <algorithm>
#include <cmath>

#include "model/storage.h"
#include "optimizer/box.h"
#include "optimizer/evaluate_strokes.h"
#include "optimizer/line.h"
#include "optimizer/sizing.h"

namespace plenum::optimizer {
namespace {

// Intervals of made-to-measure volumes are halved down to this ratio of their ends; where
// compressor and lines are single choices down to ever smaller ones.
constexpr double kBoxRatio = 2.0;
constexpr double kRatioSteps[] = {1.25, 1.06, 1.015};
constexpr double kFinestRatio = 1.004;
// Of the least source pressure, whose lower end is used.
constexpr double kBoxTolerance = 1e-2;
constexpr double kSingleTolerance = 1e-3;
constexpr double kFoundTolerance = 5e-7;

}  // namespace

Constraint Bounds::AssessCompressor(Box& box, bool source_changed, bool reservoir_changed) {
  if (source_changed)
    if (const Constraint missed = NeedOfCompressor(box, reservoir_changed);
        missed != Constraint::kNone)
      return missed;
  if (Node(box, plan_.compressor_slot).single() && Node(box, plan_.battery_slot).single() &&
      !model::VoltageMatches(
          problem_.parts.batteries[OptionOf(box, plan_.battery_slot).index].nominal_voltage_v,
          problem_.parts.compressors[OptionOf(box, plan_.compressor_slot).index].curve.voltage_v))
    return Constraint::kMating;

  DivideVolumes(box);
  return RestOfCompressor(box);
}

Constraint Bounds::RestOfCompressor(Box& box) {
  if (box.volumes.empty()) return Constraint::kPump;
  double chosen = CornerAt(plan_.compressors, box, plan_.compressor_slot).objective;
  for (const std::shared_ptr<const Line>& line : box.lines) chosen += line->objective;
  double rest = kUnlimited;
  for (const VolumeNeed& volume : box.volumes) rest = std::min(rest, volume.rest);
  if (std::isinf(rest)) return Constraint::kBattery;
  box.bound = std::max(box.bound, chosen + rest);
  return Constraint::kNone;
}

const PumpFacts& Bounds::PumpOf(const Box& box) {
  const int node = box.nodes[plan_.compressor_slot];
  const auto [entry, fresh] = pumps_.try_emplace(node);
  if (fresh) {
    if (Node(box, plan_.compressor_slot).single()) {
      const Option& option = OptionOf(box, plan_.compressor_slot);
      entry->second =
          MakePumpFacts(problem_, problem_.parts.compressors[option.index].curve, option.quantity);
    } else {
      entry->second = MakePumpFacts(problem_, plan_.highest_pump_pa,
                                    CornerAt(plan_.compressors, box, plan_.compressor_slot).pump);
    }
  }
  return entry->second;
}

Constraint Bounds::NeedOfCompressor(Box& box, bool reservoir_changed) {
  const CompressorCorner& compressor = CornerAt(plan_.compressors, box, plan_.compressor_slot);
  const ReservoirCorner& reservoir = CornerAt(plan_.reservoirs, box, plan_.reservoir_slot);
  AddLines(box);
  box.window.high_pa =
      std::min({box.window.high_pa, compressor.pressure_max_pa, reservoir.pressure_max_pa});
  if (box.window.empty()) return Constraint::kPressure;
  if (reservoir_changed) {
    VolumeNeed all;
    all.need.low_m3 = reservoir.low_m3;
    all.need.high_m3 = reservoir.high_m3;
    all.objective = reservoir.objective;
    box.volumes = {all};
  }
  for (VolumeNeed& volume : box.volumes) volume.fresh = false;
  return Constraint::kNone;
}

// Objective of reservoir, battery and energy with a volume in the interval, at least.
double Bounds::RestAt(const Box& box, const VolumeNeed& volume) {
  double beyond_j = volume.need.energy_j;  // what the shares of the lines do not count
  double current_a = 0.0;
  if (volume.need.energy_j > 0.0) {
    beyond_j -= problem_.actuations * HalfPeriod(problem_) * box.coil_power_w;
    current_a = PumpOf(box).current_a.At(std::max(box.window.low_pa, volume.need.source_pa));
  }
  Amounts others = LeastBesidesBattery(box);
  const ReservoirCorner& reservoir = CornerAt(plan_.reservoirs, box, plan_.reservoir_slot);
  if (reservoir.custom && Node(box, plan_.reservoir_slot).single()) {  // not just the smallest
    const Amounts made = CustomReservoir(problem_, volume.need.low_m3);
    others.mass_kg += made.mass_kg - reservoir.amounts.mass_kg;
    others.volume_m3 += made.volume_m3 - reservoir.amounts.volume_m3;
  }
  return volume.objective + LeastBattery(box, volume.need.energy_j, current_a, others) +
         EnergyShare(std::max(0.0, beyond_j));
}

// Looks at the interval that has the lowest bound until that bound is of this box: an interval is
// dropped where nothing in it will do, and halved while it is wide.
void Bounds::DivideVolumes(Box& box) {
  const PumpFacts& pump = PumpOf(box);
  const bool custom = CornerAt(plan_.reservoirs, box, plan_.reservoir_slot).custom &&
                      Node(box, plan_.reservoir_slot).single();
  const double ratio_max = !custom                      ? kUnlimited
                           : box.volume_ratio_max > 0.0 ? box.volume_ratio_max
                                                        : kBoxRatio;
  const double tolerance = CoreIsSingle(box) ? kSingleTolerance : kBoxTolerance;
  std::vector<const Line*> lines;
  for (const std::shared_ptr<const Line>& line : box.lines) lines.push_back(line.get());
  const PumpLoad load = MakePumpLoad(problem_, lines, box.window.low_pa);
  const PumpLimits limits{CornerAt(plan_.compressors, box, plan_.compressor_slot).duty_max,
                          CornerAt(plan_.batteries, box, plan_.battery_slot).energy_j};
  for (VolumeNeed& volume : box.volumes) volume.rest = RestAt(box, volume);
  while (!box.volumes.empty()) {
    const auto lowest =
        std::min_element(box.volumes.begin(), box.volumes.end(),
                         [](const VolumeNeed& a, const VolumeNeed& b) { return a.rest < b.rest; });
    VolumeNeed volume = *lowest;
    const bool wide = volume.need.high_m3 > ratio_max * volume.need.low_m3;
    if (volume.fresh && !wide) return;
    box.volumes.erase(lowest);
    const double middle_m3 = std::sqrt(volume.need.low_m3 * volume.need.high_m3);
    const auto look = [&](double low_m3, double high_m3) {
      ReservoirNeed known = volume.need;
      known.low_m3 = low_m3;
      known.high_m3 = high_m3;
      const std::optional<ReservoirNeed> need =
          LeastReservoirNeed(problem_, pump, load, limits, box.window, known, tolerance);
      if (!need) return;
      const double objective =
          custom ? ObjectiveOf(problem_.objective, CustomReservoir(problem_, low_m3))
                 : volume.objective;
      box.volumes.push_back({*need, objective, 0.0, true});
      box.volumes.back().rest = RestAt(box, box.volumes.back());
    };
    if (volume.fresh) {
      look(volume.need.low_m3, middle_m3);
      look(middle_m3, volume.need.high_m3);
    } else {
      look(volume.need.low_m3, volume.need.high_m3);
    }
  }
}

Constraint Bounds::FindSource(Box& box) {
  if (plan_.configuration == Configuration::kCompressor)
    return OptionOf(box, plan_.reservoir_slot).index == kCustom ? RefineVolumes(box)
                                                                : FindStockSource(box);
  box.source_known = true;
  const Candidate candidate = CandidateOf(box);
  const NeededPressure needed = NeededSourcePressure(problem_, candidate, {});
  if (needed.status == LeafStatus::kInfeasible) return Constraint::kRise;
  if (needed.status == LeafStatus::kUndecided) return Constraint::kNone;
  box.source_floor_pa = needed.source_pa;
  if (const Constraint missed = NeedOfRegulated(box); missed != Constraint::kNone) return missed;
  return RestOfRegulated(box);
}

Constraint Bounds::RefineVolumes(Box& box) {
  double next = kFinestRatio;
  for (double ratio : kRatioSteps)
    if (box.volume_ratio_max == 0.0 || ratio < box.volume_ratio_max) {
      next = ratio;
      break;
    }
  box.volume_ratio_max = next;
  box.source_known = next == kFinestRatio;
  DivideVolumes(box);
  return RestOfCompressor(box);
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
  VolumeNeed& volume = box.volumes.front();
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
    const double duty_max = problem_.parts.compressors[candidate.compressor.index].duty_max;
    if (!(least.compressor_duty <= duty_max)) return Constraint::kPump;
    // Of several groups each look at another pressure would be a simulation.
    const bool cheap = problem_.groups.size() == 1;
    volume.need.energy_j = std::max(
        volume.need.energy_j, cheap ? LeastEnergy(candidate, point, least) : least.energy_total_j);
  }
  volume.rest = RestAt(box, volume);
  return RestOfCompressor(box);
}

}  // namespace plenum::optimizer
