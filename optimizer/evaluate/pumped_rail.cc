#include "optimizer/evaluate/pumped_rail.h"

#include <algorithm>
#include <cmath>

#include "model/flow/series.h"
#include "model/strokes/stroke.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/root.h"

namespace plenum::optimizer {
namespace {

constexpr double kTolerance = 1e-9;  // relative, of the rail's pressures

bool OnRail(const ActuatorGroup& group) { return group.chamber.low_pressure_pa > 0.0; }

// By how much so much air lets the rail rise, Pa.
double RisePa(const Problem& problem, const RailSource& source, double air_m3) {
  return std::isinf(source.volume_m3)
             ? 0.0
             : air_m3 / model::StandardVolume(source.volume_m3, problem.ambient.temperature_k);
}

// How long one pump takes for the air of a period, which it pumps between two mirrored pressures: a
// pump of 1 W takes as many joules as seconds.
double PumpSeconds(const Problem& problem, const RailSource& source, double air_m3, double low_pa,
                   double stop_pa) {
  const model::CompressorCurve& curve = *source.curve;
  if (std::isinf(source.volume_m3)) {
    const double flow = model::FreeAirDelivery(curve, low_pa);
    return flow > 0.0 ? air_m3 / flow : kUnlimited;
  }
  model::CompressorCurve of_one_watt = curve;
  of_one_watt.voltage_v = 1.0;
  of_one_watt.current_a = {{low_pa, stop_pa}, {1.0, 1.0}};
  return model::EnergyToFill(of_one_watt, source.volume_m3, low_pa, stop_pa,
                             problem.ambient.temperature_k);
}

// What a group's line takes by the pressure of the rail.
struct Fall {
  model::Series exhaust;
  model::Chamber chamber;
  double target_pa, temperature_k;
  double Seconds(double rail_pa) {
    chamber.exhaust_pressure_pa = rail_pa;
    return model::EmptyTime(exhaust, chamber, chamber.operating_pressure_pa, target_pa,
                            temperature_k);
  }
};
Fall FallOf(const Problem& problem, int g, const Line& line, double factor) {
  return {model::MakeSeries(line.exhaust, factor), line.chamber,
          FallTarget(problem, problem.groups[g]), problem.ambient.temperature_k};
}

// The groups on the rail, with what their falls may take.
class Falls {
 public:
  Falls(const Problem& problem, std::span<const Line* const> lines, double factor) {
    for (int g = 0; g < static_cast<int>(lines.size()); ++g) {
      if (!OnRail(problem.groups[g])) continue;
      const ActuatorGroup& group = problem.groups[g];
      falls_.push_back({FallOf(problem, g, *lines[g], factor),
                        std::min(group.fall_time_max_s, DeflateWindow(problem, g))});
    }
  }

  // The largest of what they are late by, relative.
  double Excess(double rail_pa) {
    double excess = -kUnlimited;
    for (auto& [fall, limit_s] : falls_)
      excess = std::max(excess, fall.Seconds(rail_pa) / limit_s - 1.0);
    return excess;
  }

 private:
  struct Limited {
    Fall fall;
    double limit_s;
  };
  std::vector<Limited> falls_;
};

}  // namespace

void SetRailFloor(double floor_pa, Problem& problem) {
  problem.rail_floor_pa = floor_pa;
  for (ActuatorGroup& group : problem.groups)
    if (OnRail(group)) group.chamber.exhaust_pressure_pa = floor_pa;
}

double HighestRailPa(const Problem& problem) {
  double highest_pa = problem.ambient.pressure_pa;
  for (const ActuatorGroup& group : problem.groups)
    if (OnRail(group)) highest_pa = std::min(highest_pa, group.chamber.low_pressure_pa);
  return highest_pa;
}

RailSource RailSourceOf(const Problem& problem, const Candidate& candidate) {
  if (candidate.rail.pump.index == kNone) return {};
  const model::Compressor& pump = problem.parts.vacuum_pumps[candidate.rail.pump.index];
  RailSource source{&pump.curve, candidate.rail.pump.quantity, pump.duty_max};
  const Option& reservoir = candidate.rail.reservoir;
  if (reservoir.index != kNone)
    source.volume_m3 = reservoir.quantity * problem.parts.reservoirs[reservoir.index].volume_m3;
  return source;
}

double RailAir(const Problem& problem, std::span<const Line* const> lines) {
  double air_m3 = 0.0;
  for (int g = 0; g < static_cast<int>(lines.size()); ++g)
    if (OnRail(problem.groups[g]))
      air_m3 +=
          problem.groups[g].gait.strokes_per_period * LeastAirPerStroke(problem, g, *lines[g]);
  return air_m3;
}

RailLoad LoadOf(const Problem& problem, const RailSource& source, double air_m3, double rail_pa) {
  const double ambient_pa = problem.ambient.pressure_pa;
  RailLoad load;
  load.weakest_pa = rail_pa;
  load.stop_pa = rail_pa - RisePa(problem, source, air_m3);
  const double low_pa = 2.0 * ambient_pa - rail_pa, stop_pa = 2.0 * ambient_pa - load.stop_pa;
  if (stop_pa > model::HighestPressure(*source.curve)) return load;
  const double seconds = PumpSeconds(problem, source, air_m3, low_pa, stop_pa) / source.pumps;
  if (std::isinf(seconds)) return load;
  load.duty = seconds * problem.frequency_hz;
  load.current_a = source.pumps * model::LargestCurrent(*source.curve, ambient_pa, stop_pa);
  load.energy_per_cycle_j = seconds * source.curve->voltage_v * load.current_a;
  load.first_fill_j = std::isinf(source.volume_m3)
                          ? 0.0
                          : model::EnergyToFill(*source.curve, source.volume_m3, ambient_pa,
                                                stop_pa, problem.ambient.temperature_k);
  return load;
}

std::optional<double> DeepestRailPa(const Problem& problem, const RailSource& source,
                                    std::span<const Line* const> lines, double room) {
  const double air_m3 = RailAir(problem, lines) * (1.0 - room);
  const double high_pa = HighestRailPa(problem);
  const double low_pa = RisePa(problem, source, air_m3) +
                        std::max(problem.rail_floor_pa, 2.0 * problem.ambient.pressure_pa -
                                                            model::HighestPressure(*source.curve));
  const auto excess = [&](double rail_pa) {
    return LoadOf(problem, source, air_m3, rail_pa).duty / (source.duty_max * (1.0 + room)) - 1.0;
  };
  if (low_pa > high_pa || excess(high_pa) > 0.0) return std::nullopt;
  return SmallestFeasible(excess, low_pa, high_pa, kTolerance);
}

std::optional<double> WeakestRailPa(const Problem& problem, const RailSource& source,
                                    std::span<const Line* const> lines, model::Gas gas,
                                    double room) {
  const std::optional<double> deepest_pa = DeepestRailPa(problem, source, lines, room);
  if (!deepest_pa) return std::nullopt;
  const double mirror_pa = 2.0 * problem.ambient.pressure_pa;
  Falls falls(problem, lines, FlowFactor(problem, gas));
  const auto excess = [&](double image_pa) { return falls.Excess(mirror_pa - image_pa) - room; };
  const double image_pa = mirror_pa - *deepest_pa;
  if (excess(image_pa) > 0.0) return std::nullopt;
  return mirror_pa -
         SmallestFeasible(excess, mirror_pa - HighestRailPa(problem), image_pa, kTolerance);
}

double FallAtRail(const Problem& problem, int g, const Line& line, model::Gas gas, double rail_pa) {
  if (!OnRail(problem.groups[g])) return line.fall_time_s;
  return FallOf(problem, g, line, FlowFactor(problem, gas)).Seconds(rail_pa);
}

}  // namespace plenum::optimizer
