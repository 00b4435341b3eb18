#include "verify/design/cycle/verify_pump_curve.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "verify/design/verify_finding.h"

namespace plenum::verify {
namespace {

constexpr int kGrid = 500;
constexpr double kNodeTolerance = 1e-13;  // of a pressure
constexpr int kPanels = 64, kHalvings = 12;
// Gauss' rule with three points.
constexpr double kGaussNodes[] = {-0.7745966692414834, 0.0, 0.7745966692414834};
constexpr double kGaussWeights[] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

// Of one pump; the highest pressure itself is reached.
double DeliveryUpToTheEnd(const model::CompressorCurve& curve, double pressure_pa) {
  const model::MonotoneCurve& flow = curve.free_air_m3_per_s;
  return flow(std::clamp(pressure_pa, flow.front(), flow.back()));
}

template <typename Value>
double Held(const model::CompressorCurve& curve, double low_pa, double high_pa,
            const Value& value) {
  double most = 0.0, held = 1.0;
  for (int i = 0; i <= kGrid; ++i) {
    const double pa = low_pa + (high_pa - low_pa) * i / kGrid;
    if (!(model::FreeAirDelivery(curve, pa) > 0.0)) break;
    const double now = value(pa);
    if (now < most * (1.0 - kSumTolerance)) held = std::min(held, now / most);
    most = std::max(most, now);
  }
  return held;
}

}  // namespace

double EnergyPerAirHeld(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  return Held(curve, low_pa, high_pa, [&](double pa) {
    return model::ElectricalPower(curve, pa) / model::FreeAirDelivery(curve, pa);
  });
}

double PowerHeld(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  return Held(curve, low_pa, high_pa, [&](double pa) { return model::ElectricalPower(curve, pa); });
}

// With the smallest volume while the reservoir falls and the largest while it rises its pressure is
// at every time below that of each volume, and the pumps deliver no less. Where energy per air
// rises with pressure the air of a cycle thus takes at least what the cheapest bits of that run
// take; what it pumps beyond takes at most the greatest power at the least delivery. Where it falls
// on the way the same holds for the largest curve below it that does rise, of which the run takes
// at least the share `held`.
double LeastPumpEnergy(const Problem& problem, const Assembly& assembly, double volume_ratio,
                       double held, double source_pa, const Cycle& low) {
  // One group that is filled up to the stop pressure ends there without end, and takes its air.
  const bool alone = UnitsOf(problem).size() == 1;
  if (!alone && !std::isfinite(*std::max_element(low.inflate_s.begin(), low.inflate_s.end())))
    return 0.0;
  const model::CompressorCurve& curve = assembly.pump()->curve;
  const double beyond_m3 =
      alone ? low.pump_air_m3 - low.air_m3 : (1.0 - volume_ratio) * low.pump_air_m3;
  if (!(beyond_m3 > 0.0)) return held * low.pump_j;
  const double delivery =
      curve.free_air_m3_per_s(std::min(source_pa, model::HighestPressure(curve)));
  const double power_w =
      curve.voltage_v * model::LargestCurrent(curve, problem.ambient.pressure_pa, source_pa);
  return std::max(0.0, held * low.pump_j - beyond_m3 * power_w / delivery);
}

double FillSecondsMax(const Problem& problem, const Assembly& assembly, int g) {
  double most_s = FillWindow(problem, g);
  if (!assembly.direct()) return most_s;
  const std::vector<Unit> units = UnitsOf(problem);
  for (const Unit& unit : units)
    if (unit.group == g) most_s = std::min(most_s, UntilNext(problem, units, unit));
  return most_s;
}

double HoldingWatts(const Problem& problem, const Assembly& assembly, int group) {
  return assembly.compressors *
         model::ElectricalPower(assembly.pump()->curve,
                                problem.groups[group].chamber.operating_pressure_pa);
}

double NodePressure(const Assembly& assembly, const model::Series& fill, double mirror_pa,
                    int count, double chamber_pa) {
  const model::CompressorCurve& curve = assembly.pump()->curve;
  const auto more_than_taken = [&](double p) {
    return assembly.compressors * DeliveryUpToTheEnd(curve, p) -
           count * model::FlowBetween(fill, mirror_pa, p, chamber_pa);
  };
  double low_pa = chamber_pa, high_pa = model::HighestPressure(curve);
  if (!(low_pa < high_pa)) return kUnlimited;
  double low = more_than_taken(low_pa), high = more_than_taken(high_pa);
  if (high >= 0.0) return high_pa;
  // Regula falsi, with the value that stays halved (Illinois).
  while (high_pa - low_pa > kNodeTolerance * high_pa) {
    double p = low_pa + (high_pa - low_pa) * low / (low - high);
    if (!(p > low_pa && p < high_pa)) p = 0.5 * (low_pa + high_pa);
    const double value = more_than_taken(p);
    if (value == 0.0) return p;
    if (value > 0.0) {
      low_pa = p, low = value;
      high *= 0.5;
    } else {
      high_pa = p, high = value;
      low *= 0.5;
    }
  }
  return 0.5 * (low_pa + high_pa);
}

double HighestNode(const Assembly& assembly, const std::vector<model::GroupRig>& groups,
                   double factor) {
  double highest_pa = 0.0;
  for (const model::GroupRig& group : groups)
    highest_pa = std::max(highest_pa, NodePressure(assembly, model::MakeSeries(group.fill, factor),
                                                   model::MirrorPa(group.chamber), group.count,
                                                   group.chamber.operating_pressure_pa));
  return highest_pa;
}

DirectFills::Fill DirectFills::Make(const Problem& problem, const Assembly& assembly,
                                    const Unit& unit, const model::Series& fill) {
  const model::Chamber chamber = ChamberOf(problem.groups[unit.group], assembly.lines[unit.group]);
  const model::CompressorCurve& curve = assembly.pump()->curve;
  const double ambient_pa = problem.ambient.pressure_pa;
  const double operating_pa = chamber.operating_pressure_pa;
  const double target_pa = ambient_pa + problem.rise_fraction * (operating_pa - ambient_pa);
  const double air_per_content = model::StandardVolume(1.0, problem.ambient.temperature_k);
  const double mirror_pa = model::MirrorPa(chamber);
  const int count = unit.count / unit.feeds;  // of one feed
  const double end_pa = NodePressure(assembly, fill, mirror_pa, count, operating_pa);
  Fill found;
  found.node_pa = end_pa;
  if (!std::isfinite(end_pa) || !(DeliveryUpToTheEnd(curve, end_pa) > 0.0)) return found;
  double seconds = 0.0, joules = 0.0;
  const auto panel = [&](double from_pa, double to_pa) {
    for (int i = 0; i < 3; ++i) {
      const double p = 0.5 * (from_pa + to_pa) + 0.5 * (to_pa - from_pa) * kGaussNodes[i];
      const double node_pa = NodePressure(assembly, fill, mirror_pa, count, p);
      const double flow = std::min(assembly.compressors * DeliveryUpToTheEnd(curve, node_pa),
                                   count * model::FlowBetween(fill, mirror_pa, node_pa, p));
      const double time = 0.5 * (to_pa - from_pa) * kGaussWeights[i] * count *
                          model::ContentSlope(chamber, p) * air_per_content / flow;
      seconds += time;
      joules += time * assembly.compressors * model::ElectricalPower(curve, node_pa);
    }
  };
  // Finer towards the end, where the flow may nearly vanish.
  const auto fill_to = [&](double from_pa, double to_pa) {
    const double width_pa = (to_pa - from_pa) / kPanels;
    for (int i = 0; i + 1 < kPanels; ++i)
      panel(from_pa + i * width_pa, from_pa + (i + 1) * width_pa);
    double left_pa = width_pa;
    for (int i = 0; i < kHalvings; ++i, left_pa *= 0.5)
      panel(to_pa - left_pa, to_pa - 0.5 * left_pa);
    panel(to_pa - left_pa, to_pa);
  };
  fill_to(ambient_pa, target_pa);
  found.rise_s = seconds;
  if (operating_pa > target_pa) fill_to(target_pa, operating_pa);
  found.inflate_s = seconds;
  found.pump_j = joules;
  return found;
}

double DirectFills::Add(const Problem& problem, const Assembly& assembly, const Unit& unit,
                        const model::Series& fill, Cycle& cycle) {
  const int g = unit.group;
  const double strokes = problem.groups[g].gait.strokes_per_period;
  const LineParts& line = assembly.lines[g];
  const auto [entry, fresh] =
      known_.try_emplace({g, unit.count / unit.feeds, line.tube, line.fitting, line.valve,
                          assembly.pump(), assembly.compressors});
  if (fresh) entry->second = Make(problem, assembly, unit, fill);
  const Fill& found = entry->second;
  cycle.rise_s[g] = std::max(cycle.rise_s[g], found.rise_s);
  cycle.inflate_s[g] = std::max(cycle.inflate_s[g], found.inflate_s);
  cycle.pump_j += strokes * unit.feeds * found.pump_j;
  cycle.node_pa = std::max(cycle.node_pa, found.node_pa);
  return strokes * found.inflate_s;
}

}  // namespace plenum::verify
