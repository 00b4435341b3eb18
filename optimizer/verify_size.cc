#include "optimizer/verify_size.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "model/storage.h"
#include "optimizer/verify_supply.h"

namespace plenum::optimizer {
namespace {

constexpr int kGrid = 500;
constexpr double kPressureTolerance = 1e-9;  // relative
constexpr double kBoundTolerance = 1e-4;     // for an interval of volumes
constexpr double kGap = 2e-7;                // of the objective
constexpr int kLooksMax = 2000, kVolumesMax = 2000;
constexpr int kFirstVolumes = 48;

template <typename Value>
bool Rises(const model::CompressorCurve& curve, double ambient_pa, const Value& value) {
  double before = 0.0;
  for (int i = 0; i < kGrid; ++i) {
    const double pa = ambient_pa + (model::HighestPressure(curve) - ambient_pa) * i / kGrid;
    if (!(model::FreeAirDelivery(curve, pa) > 0.0)) return true;
    const double now = value(pa);
    if (now < before * (1.0 - kSumTolerance)) return false;
    before = now;
  }
  return true;
}

double EnergyPerAir(const model::CompressorCurve& curve, double pressure_pa) {
  return model::ElectricalPower(curve, pressure_pa) / model::FreeAirDelivery(curve, pressure_pa);
}

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
  PressureSizing(const Problem& problem, const Assembly& assembly, const QuickCycles& cycles,
                 Volumes volumes, double slack)
      : problem_(problem),
        assembly_(assembly),
        cycles_(cycles),
        volumes_(volumes),
        slack_(slack),
        totals_(TotalsOf(problem, assembly, volumes.low_m3)),
        stood_(StoodPressures(problem, assembly)) {
    const double ambient_pa = problem.ambient.pressure_pa;
    if (!assembly.compressor) return;
    const model::CompressorCurve& curve = assembly.compressor->curve;
    const bool together = problem.simultaneous || problem.groups.size() == 1;
    rises_ = together ? EnergyPerAirRises(curve, ambient_pa) : PowerRises(curve, ambient_pa);
    if (rises_) return;
    least_j_per_m3_ = kUnlimited;
    for (int i = 0; i < kGrid; ++i) {
      const double pa = ambient_pa + (model::HighestPressure(curve) - ambient_pa) * i / kGrid;
      if (model::FreeAirDelivery(curve, pa) > 0.0)
        least_j_per_m3_ = std::min(least_j_per_m3_, EnergyPerAir(curve, pa));
    }
  }

  Sizing Run(double enough) {
    Sizing sizing;
    sizing.status = Sized::kInfeasible;
    sizing.lower_bound = kUnlimited;
    if (!(stood_.low_pa <= stood_.high_pa)) return sizing;
    const auto highest = At(stood_.high_pa);
    if (highest && StrokeExcess(highest->cycle) > slack_) return sizing;
    const auto lowest = highest ? FastEnough(*highest) : std::nullopt;
    if (!lowest) return {};
    Open(*lowest, *highest);
    Offer(*lowest, sizing);
    if (problem_.objective.energy_wh > 0.0) Offer(*highest, sizing);
    while (!open_.empty() && open_.top().bound < sizing.objective * (1.0 - kGap)) {
      if (open_.top().bound > enough || looks_ > kLooksMax) {
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

 private:
  struct Interval {
    Look low, high;
    double bound;
    bool operator<(const Interval& other) const { return bound > other.bound; }  // lowest on top
  };

  Settings SettingsAt(double source_pa, double volume_m3) const {
    Settings settings;
    settings.source_pressure_pa = source_pa;
    if (assembly_.compressor) settings.reservoir_volume_m3 = volume_m3;
    return settings;
  }

  std::optional<Look> At(double source_pa) {
    ++looks_;
    auto cycle = cycles_.At(SettingsAt(source_pa, volumes_.high_m3), volumes_.low_m3);
    if (!cycle) return std::nullopt;
    const double pump_j = cycle->pump_j;
    if (!(volumes_.high_m3 > volumes_.low_m3)) return Look{source_pa, std::move(*cycle), pump_j};
    const auto low = cycles_.At(SettingsAt(source_pa, volumes_.low_m3), volumes_.high_m3);
    if (!low) return std::nullopt;
    return Look{source_pa, std::move(*cycle), LeastPumpEnergy(source_pa, *low)};
  }

  // With the smallest volume while the reservoir falls and the largest while it rises its pressure
  // is at every time below that of each volume, and the pumps deliver no less. Where energy per air
  // rises with pressure the air of a cycle thus takes at least what the cheapest bits of that run
  // take; what it pumps beyond takes at most the greatest power at the least delivery.
  double LeastPumpEnergy(double source_pa, const Cycle& low) const {
    if (!rises_ || !std::isfinite(*std::max_element(low.inflate_s.begin(), low.inflate_s.end())))
      return 0.0;
    const model::CompressorCurve& curve = assembly_.compressor->curve;
    const double beyond_m3 = problem_.groups.size() == 1
                                 ? low.pump_air_m3 - low.air_m3
                                 : (1.0 - volumes_.low_m3 / volumes_.high_m3) * low.pump_air_m3;
    if (!(beyond_m3 > 0.0)) return low.pump_j;
    const double delivery =
        curve.free_air_m3_per_s(std::min(source_pa, model::HighestPressure(curve)));
    const double power_w =
        curve.voltage_v * model::LargestCurrent(curve, problem_.ambient.pressure_pa, source_pa);
    return std::max(0.0, low.pump_j - beyond_m3 * power_w / delivery);
  }

  double StrokeExcess(const Cycle& cycle) const {
    double excess = -kUnlimited;
    const double half_s = 0.5 / problem_.frequency_hz;
    for (std::size_t g = 0; g < problem_.groups.size(); ++g)
      excess = std::max({excess, cycle.inflate_s[g] / half_s - 1.0,
                         cycle.rise_s[g] / problem_.groups[g].rise_time_max_s - 1.0,
                         cycle.fall_s[g] / half_s - 1.0,
                         cycle.fall_s[g] / problem_.groups[g].fall_time_max_s - 1.0});
    return excess;
  }

  // The lowest source pressure at which strokes are fast enough; for an interval of volumes one a
  // little below.
  std::optional<Look> FastEnough(Look fast) {
    auto slow = At(stood_.low_pa);
    if (!slow || StrokeExcess(slow->cycle) <= slack_) return slow;
    const bool bound = volumes_.high_m3 > volumes_.low_m3;
    const double tolerance = bound ? kBoundTolerance : kPressureTolerance;
    while (fast.source_pa - slow->source_pa > tolerance * fast.source_pa) {
      auto middle = At(0.5 * (slow->source_pa + fast.source_pa));
      if (!middle) return std::nullopt;
      if (StrokeExcess(middle->cycle) <= slack_)
        fast = std::move(*middle);
      else
        slow = std::move(middle);
    }
    return bound ? *slow : fast;
  }

  // Largest share by which the cycle misses a requirement, and the objective.
  std::pair<double, double> Judge(double source_pa, const Cycle& cycle) const {
    const Settings settings = SettingsAt(source_pa, volumes_.low_m3);
    const Supply supply = SupplyOf(problem_, settings, assembly_, cycle);
    double excess = StrokeExcess(cycle);
    for (const auto& [pointer, reached] :
         Requirements(problem_, settings, totals_, assembly_, cycle, supply))
      excess = std::max(excess, -reached.margin());
    if (assembly_.battery)
      excess = std::max(
          excess,
          supply.current_a / (assembly_.batteries * assembly_.battery->current_max_a) - 1.0);
    Totals totals = totals_;
    totals.energy_j = EnergyOf(problem_, supply, cycle);
    return {excess, ObjectiveOf(problem_, totals)};
  }

  void Offer(const Look& look, Sizing& sizing) {
    if (volumes_.high_m3 > volumes_.low_m3) return;  // no reservoir has several volumes
    const auto [excess, objective] = Judge(look.source_pa, look.cycle);
    if (excess <= slack_) sizing.objective = std::min(sizing.objective, objective);
  }

  void Open(const Look& low, const Look& high) {
    Cycle least = low.cycle;
    least.inflate_s = high.cycle.inflate_s;
    least.rise_s = high.cycle.rise_s;
    least.inflating_j = std::min(least.inflating_j, high.cycle.inflating_j);
    least.pump_j = rises_ ? low.least_pump_j : least.air_m3 * least_j_per_m3_;
    const auto [excess, objective] = Judge(low.source_pa, least);
    if (excess <= slack_) open_.push({low, high, objective});
  }

  const Problem& problem_;
  const Assembly& assembly_;
  const QuickCycles& cycles_;
  Volumes volumes_;
  double slack_;
  Totals totals_;
  Pressures stood_;
  bool rises_ = true;
  double least_j_per_m3_ = 0.0;
  int looks_ = 0;
  std::priority_queue<Interval> open_;
};

// A made-to-measure reservoir: intervals of volumes, the one with the lowest bound first.
Sizing SizeMade(const Problem& problem, const Assembly& assembly, double slack, double enough) {
  struct Interval {
    Volumes volumes;
    double bound;
    bool looked_at;
    bool operator<(const Interval& other) const { return bound > other.bound; }
  };
  const QuickCycles cycles(problem, assembly);
  std::priority_queue<Interval> open;
  const auto add = [&](double low_m3, double high_m3, double bound) {
    const double parts = ObjectiveOf(problem, TotalsOf(problem, assembly, low_m3));
    open.push({{low_m3, high_m3}, std::max(bound, parts), false});
  };
  const double ratio = std::pow(model::kMadeReservoirLargestM3 / model::kMadeReservoirSmallestM3,
                                1.0 / kFirstVolumes);
  double low_m3 = model::kMadeReservoirSmallestM3;
  for (int i = 0; i < kFirstVolumes; ++i, low_m3 *= ratio) add(low_m3, low_m3 * ratio, 0.0);
  Sizing best;
  for (int i = 0; !open.empty() && open.top().bound < best.objective * (1.0 - kGap); ++i) {
    if (open.top().bound > enough || i > kVolumesMax) break;
    Interval interval = open.top();
    open.pop();
    const Volumes& v = interval.volumes;
    if (!interval.looked_at) {
      const Sizing all = PressureSizing(problem, assembly, cycles, v, slack).Run(enough);
      if (all.status == Sized::kInfeasible) continue;
      interval.bound = std::max(interval.bound, all.lower_bound);
      interval.looked_at = true;
      open.push(interval);
      continue;
    }
    const Sizing largest = PressureSizing(problem, assembly, cycles, {v.high_m3, v.high_m3}, slack)
                               .Run(best.objective);
    best.objective = std::min(best.objective, largest.objective);
    const double middle_m3 = std::sqrt(v.low_m3 * v.high_m3);
    add(v.low_m3, middle_m3, interval.bound);
    add(middle_m3, v.high_m3, interval.bound);
  }
  best.lower_bound = open.empty() ? best.objective : std::min(best.objective, open.top().bound);
  best.status = std::isfinite(best.objective) ? Sized::kFeasible
                : open.empty()                ? Sized::kInfeasible
                                              : Sized::kUnknown;
  return best;
}

}  // namespace

bool EnergyPerAirRises(const model::CompressorCurve& curve, double ambient_pa) {
  return Rises(curve, ambient_pa, [&](double pa) { return EnergyPerAir(curve, pa); });
}

bool PowerRises(const model::CompressorCurve& curve, double ambient_pa) {
  return Rises(curve, ambient_pa, [&](double pa) { return model::ElectricalPower(curve, pa); });
}

Sizing Size(const Problem& problem, const Assembly& assembly, double slack, double enough) {
  if (assembly.compressor && !assembly.reservoir) return SizeMade(problem, assembly, slack, enough);
  const double volume_m3 =
      assembly.reservoir ? assembly.reservoirs * assembly.reservoir->volume_m3 : 0.0;
  const QuickCycles cycles(problem, assembly);
  return PressureSizing(problem, assembly, cycles, {volume_m3, volume_m3}, slack).Run(enough);
}

}  // namespace plenum::optimizer
