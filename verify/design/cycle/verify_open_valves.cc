#include "verify/design/cycle/verify_open_valves.h"

#include <algorithm>

#include "model/physics/compressor.h"
#include "verify/design/cycle/verify_gait.h"

namespace plenum::verify {
namespace {

constexpr double kClose = 1e-9;  // of a pressure

// Where the reservoir, of so much volume and full at first, and the actuators come to rest when so
// much air is added, in Pa·m³.
double RestsAt(const Problem& problem, const Assembly& assembly, double stop_pa, double volume_m3,
               double added) {
  double low_pa = problem.ambient.pressure_pa, high_pa = stop_pa;
  const auto taken = [&](double pa) {
    double sum = volume_m3 * (pa - stop_pa);
    for (std::size_t g = 0; g < problem.groups.size(); ++g) {
      const model::Chamber chamber = ChamberOf(problem.groups[g], assembly.lines[g]);
      sum += problem.groups[g].count *
             (model::Content(chamber, pa) - model::Content(chamber, problem.ambient.pressure_pa));
    }
    return sum;
  };
  if (taken(stop_pa) <= added) return stop_pa;
  while (high_pa - low_pa > kClose * high_pa) {
    const double middle_pa = 0.5 * (low_pa + high_pa);
    (taken(middle_pa) <= added ? low_pa : high_pa) = middle_pa;
  }
  return high_pa;
}

// The most that an actuator can hold when its valve stands open for its window.
double OpenPressure(const Problem& problem, const Settings& settings, const Assembly& assembly) {
  const double source_pa = settings.source_pressure_pa;
  if (!assembly.pump()) return source_pa;
  const double falling_m3 = settings.reservoir_volume_m3.value_or(0.0);
  const double lowest_pa = RestsAt(problem, assembly, source_pa, falling_m3, 0.0);
  const double delivery = model::FreeAirDelivery(assembly.pump()->curve, lowest_pa);
  const double pumped_m3 = assembly.compressors * delivery * FillWindow(problem, 0);
  return RestsAt(problem, assembly, source_pa, falling_m3 + assembly.ReservoirSpread(),
                 pumped_m3 / model::StandardVolume(1.0, problem.ambient.temperature_k));
}

}  // namespace

bool Holding(const Assembly& assembly) {
  return std::all_of(assembly.lines.begin(), assembly.lines.end(),
                     [](const LineParts& line) { return model::Holds(line.valve->kind); });
}

void FillOpenOnes(const Problem& problem, const Settings& settings, const Assembly& assembly,
                  Cycle& cycle) {
  if (!problem.guarantee || assembly.at_best || Holding(assembly)) return;
  double more_m3 = 0.0;
  const double open_pa = OpenPressure(problem, settings, assembly);
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    if (model::Holds(assembly.lines[g].valve->kind)) continue;
    const model::Chamber chamber = ChamberOf(problem.groups[g], assembly.lines[g]);
    more_m3 += problem.groups[g].count *
               model::StandardVolume(std::max(0.0, model::Content(chamber, open_pa) -
                                                       model::Content(chamber, cycle.filled_pa[g])),
                                     problem.ambient.temperature_k);
    cycle.filled_pa[g] = std::max(cycle.filled_pa[g], open_pa);
  }
  if (!assembly.pump()) return;
  const model::CompressorCurve& curve = assembly.pump()->curve;
  cycle.pump_air_m3 += more_m3;
  cycle.pump_on_s +=
      more_m3 / (assembly.compressors * model::FreeAirDelivery(curve, settings.source_pressure_pa));
  cycle.pump_j =
      cycle.pump_on_s * assembly.compressors * curve.voltage_v *
      model::LargestCurrent(curve, problem.ambient.pressure_pa, settings.source_pressure_pa);
}

}  // namespace plenum::verify
