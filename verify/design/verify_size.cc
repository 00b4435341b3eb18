#include "verify/design/verify_size.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "model/physics/storage.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/cycle/verify_group_pressures.h"
#include "verify/design/verify_supply.h"
#include "verify/design/verify_tank.h"

namespace plenum::verify {
namespace {

constexpr double kPressureTolerance = 1e-9;  // relative
// For an interval of volumes pressures are told apart as finely as this share of its width: beyond
// that it is the volumes that want to be divided.
constexpr double kPressureShare = 0.1, kFinest = 1e-9, kCoarsest = 1e-2;
constexpr double kGap = 2e-7;  // of the objective
constexpr int kLooksMax = 2000, kVolumesMax = 2000;
constexpr double kFirstStep = 1e-4, kStepGrowth = 8.0;  // of the source pressure
constexpr double kRoughly = 2e-3;                       // the same
constexpr double kOfIntegration = 1e-5;                 // of strokes, beside those of the simulator
constexpr int kFirstVolumes = 12;
constexpr double kNarrow = 1.01;  // ratio of volumes

// Volumes of the reservoir: the smallest counts while its pressure rises and for all that it takes,
// the largest while it falls.
struct Volumes {
  double low_m3 = 0.0, high_m3 = 0.0;
};

struct Look {
  double source_pa = 0.0;
  Cycle cycle;
  double least_pump_j = 0.0;  // of any of the volumes at this or a higher pressure
};

class PressureSizing {
 public:
  // Below `floor_pa` strokes are known to be too slow.
  PressureSizing(const Problem& problem, const Assembly& assembly, KnownCycles& cycles,
                 Volumes volumes, double slack, double floor_pa = 0.0,
                 const GroupRanges* groups = nullptr)
      : problem_(problem),
        assembly_(assembly),
        cycles_(cycles),
        volumes_(volumes),
        slack_(slack),
        groups_(groups),
        stood_(groups ? groups->Highest() : StoodPressures(problem, assembly)) {
    stood_.low_pa = std::max(stood_.low_pa, floor_pa);
    // All that an open tank bears grows with its fill but for the air, which is more.
    if (IsOpen(assembly))
      stood_.low_pa = std::max(
          stood_.low_pa, LeastOpenFillPa(problem, assembly, (1.0 - slack) * problem.actuations));
    if (volumes.high_m3 > volumes.low_m3)
      resolution_ =
          std::clamp(kPressureShare * (volumes.high_m3 / volumes.low_m3 - 1.0), kFinest, kCoarsest);
    if (assembly.pump() && !assembly.direct()) held_ = cycles.PumpHeld(stood_.high_pa);
  }

  // Known after Run: no lower source pressure is fast enough.
  double floor_pa() const { return floor_pa_; }

  Sizing Run(double enough) {
    Sizing sizing{.status = Sized::kInfeasible, .lower_bound = kUnlimited};
    if (!(stood_.low_pa <= stood_.high_pa)) return sizing;
    const auto alone = cycles_.EachAlone(SettingsAt(stood_.high_pa, volumes_.high_m3), Rising());
    if (alone && StrokeExcess(*alone) > slack_ + kOfIntegration) return sizing;
    const auto fastest = CycleAt(stood_.high_pa);
    if (!fastest) return {};
    if (StrokeExcess(*fastest) > slack_) return sizing;
    std::optional<Floor> floor = RoughFloor();
    if (!floor) return {};
    floor_pa_ = floor->slow_pa;
    if (!(volumes_.high_m3 > volumes_.low_m3)) {
      const double least = LeastAbove(*floor);
      if (std::isinf(least)) return sizing;
      if (least > enough) return {.status = Sized::kUnknown, .lower_bound = least};
      const auto fast = At(floor->fast_pa);
      if (!fast) return {};
      Offer(*fast, sizing);
      if (least >= sizing.objective * (1.0 - kGap))  // no setting changes it
        return {Sized::kFeasible, sizing.objective, std::min(least, sizing.objective)};
    }
    floor = Divided(*floor, resolution_ > 0.0 ? resolution_ : kPressureTolerance);
    if (!floor) return {};
    const double lowest_pa = resolution_ > 0.0 ? floor->slow_pa : floor->fast_pa;
    floor_pa_ = lowest_pa;
    const auto highest = At(stood_.high_pa), lowest = At(lowest_pa);
    if (!highest || !lowest) return {};
    Open(*lowest, *highest);
    Offer(*lowest, sizing);
    if (problem_.objective.energy_wh > 0.0) Offer(*highest, sizing);
    while (!open_.empty() && open_.top().bound < sizing.objective * (1.0 - kGap)) {
      if (open_.top().bound > enough || looks_ > kLooksMax || open_.top().width() < resolution_) {
        sizing.status = Sized::kUnknown;
        break;
      }
      const Interval interval = open_.top();
      open_.pop();
      const auto middle = At(0.5 * (interval.low.source_pa + interval.high.source_pa));
      if (!middle) return {};
      Open(interval.low, *middle);
      Open(*middle, interval.high);
      Offer(*middle, sizing);
    }
    if (!open_.empty()) sizing.lower_bound = open_.top().bound;
    sizing.lower_bound = std::min(sizing.lower_bound, sizing.objective);
    if (std::isfinite(sizing.objective)) sizing.status = Sized::kFeasible;
    return sizing;
  }

  // Pumps without a reservoir have no settings.
  Sizing RunDirect() {
    Sizing sizing{.status = Sized::kInfeasible, .lower_bound = kUnlimited};
    if (!(stood_.low_pa <= stood_.high_pa)) return sizing;
    const auto cycle = CycleAt(stood_.high_pa);
    if (!cycle) return {};
    if (!(cycle->node_pa <= stood_.high_pa * (1.0 + slack_))) return sizing;
    const auto [excess, objective] = Judge(cycle->node_pa, *cycle);
    if (!(excess <= slack_)) return sizing;
    sizing.status = Sized::kFeasible;
    sizing.objective = sizing.lower_bound = objective;
    return sizing;
  }

 private:
  struct Interval {
    Look low, high;
    double bound;
    // Lowest bound on top; of equal ones the narrowest, which tells soonest whether any is left.
    bool operator<(const Interval& other) const {
      return bound != other.bound ? bound > other.bound : width() > other.width();
    }
    double width() const { return high.source_pa / low.source_pa - 1.0; }
  };

  Settings SettingsAt(double source_pa, double volume_m3) const {
    Settings settings;
    settings.source_pressure_pa = source_pa;
    if (groups_) settings.group_pressure_pa = PressuresAt(*groups_, assembly_, source_pa);
    if (assembly_.pump() && !assembly_.direct()) settings.reservoir_volume_m3 = volume_m3;
    return settings;
  }

  // With strokes at most as slow as with each of the volumes.
  const std::optional<Cycle>& CycleAt(double source_pa) {
    return cycles_.At(SettingsAt(source_pa, volumes_.high_m3), Rising());
  }
  double Rising() const { return volumes_.low_m3 + assembly_.ReservoirSpread(); }

  std::optional<Look> At(double source_pa) {
    ++looks_;
    std::optional<Cycle> cycle = CycleAt(source_pa);
    if (!cycle) return std::nullopt;
    const double pump_j = held_ * cycle->pump_j;
    if (!(volumes_.high_m3 > volumes_.low_m3)) return Look{source_pa, std::move(*cycle), pump_j};
    const auto low = cycles_.At(SettingsAt(source_pa, volumes_.low_m3), volumes_.high_m3);
    if (!low) return std::nullopt;
    return Look{source_pa, std::move(*cycle),
                LeastPumpEnergy(problem_, assembly_, volumes_.low_m3 / volumes_.high_m3, held_,
                                source_pa, *low)};
  }

  double StrokeExcess(const Cycle& cycle) const {
    double excess = -kUnlimited;
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g)
      excess = std::max({excess, cycle.inflate_s[g] / FillSecondsMax(problem_, assembly_, g) - 1.0,
                         cycle.rise_s[g] / problem_.groups[g].rise_time_max_s - 1.0,
                         cycle.fall_s[g] / VentWindow(problem_, g) - 1.0,
                         cycle.fall_s[g] / problem_.groups[g].fall_time_max_s - 1.0});
    return excess;
  }

  // Where strokes become fast enough, with what they miss and have to spare; equal at the lowest.
  struct Floor {
    double slow_pa, fast_pa;
    double missing = kUnlimited, to_spare = 0.0;
  };

  // False: it is not known how slow strokes are.
  bool Narrow(double source_pa, Floor& floor) {
    ++looks_;
    const auto& cycle = CycleAt(source_pa);
    if (!cycle) return false;
    const double missing = StrokeExcess(*cycle) - slack_;
    if (missing > 0.0) {
      floor.slow_pa = source_pa;
      floor.missing = missing;
    } else {
      floor.fast_pa = source_pa;
      floor.to_spare = -missing;
    }
    return true;
  }

  std::optional<Floor> RoughFloor() {
    Floor floor{stood_.low_pa, stood_.high_pa};
    if (!Narrow(floor.fast_pa, floor) || !Narrow(floor.slow_pa, floor)) return std::nullopt;
    if (floor.fast_pa == floor.slow_pa) return floor;  // often it is a little above
    for (double step = kFirstStep; stood_.low_pa * (1.0 + step) < floor.fast_pa;
         step *= kStepGrowth)
      if (!Narrow(stood_.low_pa * (1.0 + step), floor)) return std::nullopt;
    return Divided(floor, kRoughly);
  }

  // By where the line between both ends crosses, and a little beyond; by halves where that fails.
  std::optional<Floor> Divided(Floor floor, double tolerance) {
    const auto width_pa = [&] { return floor.fast_pa - floor.slow_pa; };
    const auto wide = [&] { return width_pa() > tolerance * floor.fast_pa; };
    while (wide()) {
      const double before_pa = width_pa();
      const double crossing_pa =
          floor.fast_pa - before_pa * floor.to_spare / (floor.to_spare + floor.missing);
      const double step_pa = 0.4 * tolerance * floor.fast_pa;
      const bool crossing = std::isfinite(floor.missing);
      const double first_pa =
          crossing ? std::clamp(crossing_pa, floor.slow_pa + step_pa, floor.fast_pa - step_pa)
                   : floor.fast_pa - 0.5 * before_pa;
      if (!Narrow(first_pa, floor)) return std::nullopt;
      const double second_pa = first_pa + (floor.slow_pa == first_pa ? step_pa : -step_pa);
      if (crossing && wide() && !Narrow(second_pa, floor)) return std::nullopt;
      if (wide() && width_pa() > 0.5 * before_pa &&
          !Narrow(0.5 * (floor.slow_pa + floor.fast_pa), floor))
        return std::nullopt;
    }
    return floor;
  }

  // Least objective of all pressures from the floor on, bounded by a rough one; +∞ where they meet
  // no limits, 0 where that tells nothing.
  double LeastAbove(const Floor& floor) {
    const auto highest = At(stood_.high_pa), fast = At(floor.fast_pa);
    if (!highest || !fast) return 0.0;
    double least = LeastBetween(*fast, *highest);
    if (floor.slow_pa == floor.fast_pa) return least;
    const auto slow = At(floor.slow_pa);
    if (!slow) return 0.0;
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g)
      if (!(slow->cycle.inflate_s[g] <= FillSecondsMax(problem_, assembly_, g))) return 0.0;
    return std::min(least, LeastBetween(*slow, *fast));
  }

  // Largest share by which the cycle misses a requirement, and the objective.
  std::pair<double, double> Judge(double source_pa, const Cycle& cycle) const {
    Settings settings = SettingsAt(source_pa, volumes_.low_m3);
    if (assembly_.tank)
      settings.tank_fill_pa = FillFor(problem_, assembly_, source_pa, cycle, slack_);
    const Supply supply = SupplyOf(problem_, settings, assembly_, cycle);
    double excess = StrokeExcess(cycle);
    Totals totals = TotalsOf(problem_, assembly_, settings);
    for (const auto& [pointer, reached] :
         RequirementsBesidePeaks(problem_, settings, totals, assembly_, cycle, supply))
      excess = std::max(excess, -reached.margin());
    if (assembly_.battery)
      excess = std::max(
          excess,
          supply.current_a / (assembly_.batteries * assembly_.battery->current_max_a) - 1.0);
    totals.energy_j = EnergyOf(problem_, supply, cycle);
    return {excess, ObjectiveOf(problem_, totals)};
  }

  void Offer(const Look& look, Sizing& sizing) {
    if (volumes_.high_m3 > volumes_.low_m3) return;  // no reservoir has several volumes
    const auto [excess, objective] = Judge(look.source_pa, look.cycle);
    if (excess <= slack_) sizing.objective = std::min(sizing.objective, objective);
  }

  // Of any pressure between the two; +∞ where none meets the limits.
  double LeastBetween(const Look& low, const Look& high) const {
    Cycle least = low.cycle;
    least.inflate_s = high.cycle.inflate_s;
    least.rise_s = high.cycle.rise_s;
    least.inflating_j = std::min(least.inflating_j, high.cycle.inflating_j);
    least.pump_j = low.least_pump_j;
    const auto [excess, objective] = Judge(low.source_pa, least);
    return excess <= slack_ ? objective : kUnlimited;
  }

  void Open(const Look& low, const Look& high) {
    const double bound = LeastBetween(low, high);
    if (std::isfinite(bound)) open_.push({low, high, bound});
  }

  const Problem& problem_;
  const Assembly& assembly_;
  KnownCycles& cycles_;
  Volumes volumes_;
  double slack_;
  const GroupRanges* groups_;  // with regulators of their own: by the highest of their pressures
  Pressures stood_;
  double floor_pa_ = 0.0;
  double resolution_ = 0.0;  // of pressures, relative; 0 where there is one volume
  double held_ = 1.0;        // of the pump's energy per air, or of its power, on the way up
  int looks_ = 0;
  std::priority_queue<Interval> open_;
};

// A made-to-measure reservoir: intervals of volumes, the one with the lowest bound first.
Sizing SizeMade(const Problem& problem, const Assembly& assembly, KnownCycles& cycles, double slack,
                double enough, const Stop& stop) {
  struct Interval {
    Volumes volumes;
    double bound;
    double floor_pa;
    bool looked_at;
    bool operator<(const Interval& other) const { return bound > other.bound; }
  };
  std::priority_queue<Interval> open;
  double least_pa = problem.ambient.pressure_pa;  // that any source stops at
  for (const ActuatorGroup& group : problem.groups)
    least_pa = std::max(least_pa, group.chamber.operating_pressure_pa);
  const auto parts_of = [&](double volume_m3) {
    Settings least;
    least.source_pressure_pa = least_pa;
    least.reservoir_volume_m3 = volume_m3;
    return ObjectiveOf(problem, TotalsOf(problem, assembly, least));
  };
  const auto add = [&](double low_m3, double high_m3, double bound, double floor_pa) {
    const double parts = parts_of(low_m3);
    open.push({{low_m3, high_m3}, std::max(bound, parts), floor_pa, false});
  };
  const double ratio = std::pow(model::kMadeReservoirLargestM3 / model::kMadeReservoirSmallestM3,
                                1.0 / kFirstVolumes);
  double low_m3 = model::kMadeReservoirSmallestM3;
  for (int i = 0; i < kFirstVolumes; ++i, low_m3 *= ratio) add(low_m3, low_m3 * ratio, 0.0, 0.0);
  Sizing best;
  for (int i = 0; !open.empty() && open.top().bound < best.objective * (1.0 - kGap); ++i) {
    if (open.top().bound > enough || i > kVolumesMax || Stopped(stop)) break;
    Interval interval = open.top();
    open.pop();
    const Volumes& v = interval.volumes;
    if (!interval.looked_at) {
      PressureSizing pressures(problem, assembly, cycles, v, slack, interval.floor_pa);
      const Sizing all = pressures.Run(enough);
      if (all.status == Sized::kInfeasible) continue;
      interval.bound = std::max(interval.bound, all.lower_bound);
      interval.floor_pa = pressures.floor_pa();
      interval.looked_at = true;
      open.push(interval);
      continue;
    }
    // A point that is no better than `enough` is of no use, and few of a wide interval are found.
    if (v.high_m3 < kNarrow * v.low_m3 && parts_of(v.high_m3) <= enough)
      best.objective =
          std::min(best.objective, PressureSizing(problem, assembly, cycles, {v.high_m3, v.high_m3},
                                                  slack, interval.floor_pa)
                                       .Run(best.objective)
                                       .objective);
    const double middle_m3 = std::sqrt(v.low_m3 * v.high_m3);
    add(v.low_m3, middle_m3, interval.bound, interval.floor_pa);
    add(middle_m3, v.high_m3, interval.bound, interval.floor_pa);
  }
  best.lower_bound = open.empty() ? best.objective : std::min(best.objective, open.top().bound);
  best.status = std::isfinite(best.objective) ? Sized::kFeasible
                : open.empty()                ? Sized::kInfeasible
                                              : Sized::kUnknown;
  return best;
}

}  // namespace

// What is infeasible at the worst of a guarantee where that is bounded is told as such only if it
// is at the best that may be said of it, too.
Sizing Sizer::Size(const Assembly& assembly, double slack, double enough) {
  Sizing sizing = SizeAsIs(assembly, slack, enough);
  if (!problem_.guarantee || assembly.at_best || sizing.status != Sized::kInfeasible) return sizing;
  Assembly at_best = assembly;
  at_best.at_best = true;
  if (SizeAsIs(at_best, slack, enough).status != Sized::kInfeasible)
    sizing.status = Sized::kUnknown;
  return sizing;
}

Sizing Sizer::SizeAsIs(const Assembly& given, double slack, double enough) {
  const std::optional<Assembly> on_rail = OnItsRail(problem_, given, slack);
  if (!on_rail) return {.status = Sized::kInfeasible, .lower_bound = kUnlimited};
  const Assembly& assembly = *on_rail;
  if (!cycles_ || !cycles_->Serves(assembly)) cycles_.emplace(problem_, assembly, stop_, &fills_);
  if (assembly.direct())
    return PressureSizing(problem_, assembly, *cycles_, {0.0, 0.0}, slack).RunDirect();
  if (assembly.pump() && !assembly.reservoir)
    return SizeMade(problem_, assembly, *cycles_, slack, enough, stop_);
  if (assembly.owns()) {
    const GroupRanges ranges = RangesOf(*cycles_, assembly, slack);
    if (!ranges.known) return {};
    if (!ranges.feasible) return {.status = Sized::kInfeasible, .lower_bound = kUnlimited};
    return PressureSizing(problem_, assembly, *cycles_, {0.0, 0.0}, slack, 0.0, &ranges)
        .Run(enough);
  }
  const double volume_m3 = assembly.ReservoirVolume();
  return PressureSizing(problem_, assembly, *cycles_, {volume_m3, volume_m3}, slack).Run(enough);
}

}  // namespace plenum::verify
