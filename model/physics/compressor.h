// Compressors: what a pump delivers and draws against back pressure.
#ifndef PLENUM_MODEL_PHYSICS_COMPRESSOR_H_
#define PLENUM_MODEL_PHYSICS_COMPRESSOR_H_

#include "model/physics/monotone_curve.h"

namespace plenum::model {

// Free air delivery and current as measured tables over absolute outlet pressure. The table is
// never extrapolated: above its last pressure, and at or above `pressure_max_pa`, the pump delivers
// nothing. Below its first pressure the first point holds (a pump delivers at least that). Valid:
// flow ≥ 0 and not rising with pressure, current > 0.
struct CompressorCurve {
  MonotoneCurve free_air_m3_per_s;  // ANR
  MonotoneCurve current_a;
  double voltage_v = 0.0;
  double pressure_max_pa = 0.0;  // absolute
  bool operator==(const CompressorCurve&) const = default;
};

// Highest absolute pressure at which the curve says anything.
double HighestPressure(const CompressorCurve& curve);

// Free air delivery, m³/s ANR, at absolute outlet pressure; 0 past the end of the table.
double FreeAirDelivery(const CompressorCurve& curve, double pressure_pa);

// Electrical power, W, at absolute outlet pressure; the end value past the end of the table.
double ElectricalPower(const CompressorCurve& curve, double pressure_pa);

// Largest current over [low, high], A (over the table's points and both ends).
double LargestCurrent(const CompressorCurve& curve, double low_pa, double high_pa);

// Electrical energy, J, to pump a reservoir of `volume_m3` from `low_pa` to `high_pa` with `count`
// pumps in parallel: E = V/P0·(T0/T)·∫ P_el/Q dp. +∞ where the delivery vanishes on the way.
double EnergyToFill(const CompressorCurve& curve, double volume_m3, double low_pa, double high_pa,
                    double temperature_k);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_PHYSICS_COMPRESSOR_H_
