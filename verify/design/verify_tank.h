// A tank filled beforehand: its fill, and what the mission leaves of it. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_TANK_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_TANK_H_

#include <algorithm>

#include "model/physics/storage.h"
#include "verify/design/verify_design.h"

namespace plenum::verify {

inline constexpr double kFillRoom = 1.0 + 1e-9;

// Whether strokes come straight out of the tank.
inline bool IsOpen(const Assembly& a) { return a.tank != nullptr && a.regulators.empty(); }

inline double TankVolume(const Assembly& a) { return a.tank ? a.tanks * a.tank->volume_m3 : 0.0; }

inline double ChargeKg(const Problem& problem, const model::Reservoir& tank, double pressure_pa) {
  return model::StandardVolume(tank.volume_m3 * pressure_pa, problem.ambient.temperature_k) *
         model::kReferenceDensityKgPerM3;
}

// The highest operating pressure: no tank is emptied further.
inline double LeastLeftPa(const Problem& problem) {
  double left_pa = problem.ambient.pressure_pa;
  for (const ActuatorGroup& group : problem.groups)
    left_pa = std::max(left_pa, group.chamber.operating_pressure_pa);
  return left_pa;
}

// What the tank, and a regulator's inlet, stand and the request allows.
inline double MostFillPa(const Problem& problem, const Assembly& a) {
  double most_pa = std::min(problem.tank_fill_max_pa, a.tank->pressure_max_pa);
  for (const model::Regulator* regulator : a.regulators)
    most_pa = std::min(most_pa, regulator->inlet_pressure_max_pa);
  return most_pa;
}

// Down to which the tank gives air to a source of this pressure.
inline double InletPa(const Problem& problem, const Assembly& a, double source_pa) {
  double inlet_pa = IsOpen(a) ? LeastLeftPa(problem) : source_pa;
  for (const model::Regulator* regulator : a.regulators)
    inlet_pa = std::max(inlet_pa, regulator->inlet_pressure_min_pa);
  if (!IsOpen(a)) return inlet_pa;
  for (const LineParts& line : a.lines) inlet_pa = std::max(inlet_pa, line.valve->pressure_min_pa);
  return inlet_pa;
}

// Air of one stroke of a group that fills up to its operating pressure, m³ ANR.
inline double StrokeAir(const Problem& problem, const Assembly& a, int g) {
  const model::Chamber chamber = ChamberOf(problem.groups[g], a.lines[g]);
  return problem.groups[g].count *
         model::StandardVolume(model::Content(chamber, chamber.operating_pressure_pa) -
                                   model::Content(chamber, problem.ambient.pressure_pa),
                               problem.ambient.temperature_k);
}

// Of an open tank, by the strokes of all groups in so many periods.
inline double FallPa(const Problem& problem, const Assembly& a, double periods) {
  double air_m3 = 0.0;
  for (int g = 0; g < static_cast<int>(a.lines.size()); ++g)
    air_m3 += problem.groups[g].gait.strokes_per_period * StrokeAir(problem, a, g);
  return periods * air_m3 / model::StandardVolume(TankVolume(a), problem.ambient.temperature_k);
}

// The least fill for so much air, with room for rounding; of an open tank the source pressure.
inline double LeastFillPa(const Problem& problem, const Assembly& a, double source_pa,
                          double air_m3) {
  if (IsOpen(a)) return source_pa;
  const double fall_pa =
      air_m3 / model::StandardVolume(TankVolume(a), problem.ambient.temperature_k);
  return std::min(MostFillPa(problem, a), InletPa(problem, a, source_pa) + kFillRoom * fall_pa);
}

// The same of an open tank for the strokes of so many periods.
inline double LeastOpenFillPa(const Problem& problem, const Assembly& a, double periods) {
  return InletPa(problem, a, 0.0) + kFillRoom * FallPa(problem, a, periods);
}

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_TANK_H_
