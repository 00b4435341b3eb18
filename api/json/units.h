// Conversion between the contract's units and SI with absolute pressures: at the edge, once.
#ifndef PLENUM_API_JSON_UNITS_H_
#define PLENUM_API_JSON_UNITS_H_

#include "model/physics/air.h"

namespace plenum::api {

inline constexpr double kPaPerKpa = 1e3;
inline constexpr double kM3PerMl = 1e-6;
inline constexpr double kM3PerL = 1e-3;
inline constexpr double kMPerMm = 1e-3;
inline constexpr double kSPerMs = 1e-3;
inline constexpr double kM3PerSPerLPerMin = 1e-3 / 60.0;
inline constexpr double kM3PerSPaPerDm3PerSBar = 1e-8;
inline constexpr double kJPerWh = 3600.0;

inline double PaFromKpaGauge(double kpa_gauge, const model::Ambient& ambient) {
  return ambient.pressure_pa + kpa_gauge * kPaPerKpa;
}
inline double KpaGaugeFromPa(double pressure_pa, const model::Ambient& ambient) {
  return (pressure_pa - ambient.pressure_pa) / kPaPerKpa;
}

// On which side of ambient the pressures of a rig are. Under vacuum the model is told their mirror
// images (model/physics/chamber.h).
enum class Side { kPressure, kVacuum };
inline double PaFromKpaGauge(double kpa_gauge, const model::Ambient& ambient, Side side) {
  return PaFromKpaGauge(side == Side::kVacuum ? -kpa_gauge : kpa_gauge, ambient);
}
inline double KpaGaugeFromPa(double pressure_pa, const model::Ambient& ambient, Side side) {
  const double image_kpa = KpaGaugeFromPa(pressure_pa, ambient);
  return side == Side::kVacuum ? -image_kpa : image_kpa;
}
// Gauge pressures down to the deepest vacuum.
inline double DeepestKpaGauge(const model::Ambient& ambient) {
  return (model::kDeepestVacuumPa - ambient.pressure_pa) / kPaPerKpa;
}

inline double PaFromKpaAbs(double kpa_abs) { return kpa_abs * kPaPerKpa; }
inline double M3FromMl(double ml) { return ml * kM3PerMl; }
inline double MlFromM3(double m3) { return m3 / kM3PerMl; }
inline double M3FromL(double l) { return l * kM3PerL; }
inline double LFromM3(double m3) { return m3 / kM3PerL; }
inline double MFromMm(double mm) { return mm * kMPerMm; }
// Litres per minute of free air (ANR).
inline double M3PerSFromLPerMin(double l_per_min) { return l_per_min * kM3PerSPerLPerMin; }
inline double LPerMinFromM3PerS(double m3_per_s) { return m3_per_s / kM3PerSPerLPerMin; }
// 1 dm³/(s·bar) = 1e-8 m³/(s·Pa).
inline double ConductanceFromDm3PerSBar(double c) { return c * kM3PerSPaPerDm3PerSBar; }
inline double SFromMs(double ms) { return ms * kSPerMs; }
inline double WhFromJ(double j) { return j / kJPerWh; }

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_UNITS_H_
