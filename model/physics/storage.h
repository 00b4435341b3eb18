// What is carried along: gas in cylinders, liquid CO2, energy in batteries, air in reservoirs.
#ifndef PLENUM_MODEL_PHYSICS_STORAGE_H_
#define PLENUM_MODEL_PHYSICS_STORAGE_H_

#include "model/physics/air.h"

namespace plenum::model {

// Share of a battery's nominal energy that a mission may use (depth of discharge; assumed).
inline constexpr double kDepthOfDischarge = 0.8;

// A pump runs on a pack whose nominal voltage is within this share of its curve's.
inline constexpr double kVoltageTolerance = 0.15;

// Ah·V·DoD in J.
double UsableEnergy(double capacity_ah, double nominal_voltage_v);

// |V_pack − V_pump| ≤ 15 % of V_pump. A pump of 0 V has no motor (an ejector): any pack suits.
bool VoltageMatches(double pack_voltage_v, double pump_voltage_v);

// Gas charge of a cylinder of compressed air, kg, with compressibility:
//   m = V_w/(R·T)·p_fill/Z(p_fill); the gas at ambient pressure that an "empty" bottle holds
//   counts.
double CylinderCharge(double water_volume_m3, double fill_pressure_pa, double temperature_k);

// Usable gas of a cylinder, m³ ANR, down to the lowest inlet pressure at which the regulator holds
// its outlet:  V = V_w/P0·(T0/T)·(p_fill/Z(p_fill) − p_min/Z(p_min)); 0 where p_min ≥ p_fill.
double CylinderUsableVolume(double water_volume_m3, double fill_pressure_pa,
                            double inlet_pressure_min_pa, double temperature_k);

// Air in a tank, kg: m = p·V/(R·T). Ideal, since tanks for tools and robots hold 2 MPa at most,
// where Z is above 0.995.
double TankCharge(double volume_m3, double pressure_pa, double temperature_k);

// Gas that a mass of liquid CO2 gives, m³ ANR (1 g is 0.554 L), less what stays behind as gas at
// the regulator's lowest inlet pressure in the bottle of `water_volume_m3` (0 where not known).
double Co2UsableVolume(double co2_mass_kg, double water_volume_m3, double inlet_pressure_min_pa,
                       double temperature_k);

// Largest steady draw, m³/s ANR, of a bottle over a mission so long, where `endless_m3_per_s` is
// what it may give for ever. Evaporation cools it, (m_b·c_b + m_l·c_l)·dT/dt = −L·q + UA·(T_a − T),
// and it gives for ever what cools it by ΔT, q_e = UA·ΔT/L. A short mission draws on its own heat:
//   q = q_e/(1 − exp(−t/τ)),  τ = (m_b·c_b + m_l·c_l)/UA
// with L = 274 J per standard litre, ΔT = 20 K, c_b = 460 J/(kg·K) (steel, less than aluminium),
// c_l = 3 kJ/(kg·K) of half of the liquid, which is the mean of a bottle that is emptied. Never
// below q_e; falls with the mission.
double Co2Draw(double endless_m3_per_s, double empty_kg, double co2_kg, double mission_s);

// Saturation pressure of CO2, Pa absolute, 243–304 K (5.73 MPa at 20 °C): ln p interpolated in 1/T
// between reference points; outside the range the end value.
double Co2SaturationPressure(double temperature_k);

// Made-to-measure reservoir (welded or wound to the volume wanted): mass and outer volume by rule,
//   mass = 0.030 kg + V·(0.15 kg/L + 0.09 kg/L per MPa of gauge pressure)
//   body = 1.08·V + 10 mL
// Estimates: ends and port 30 g, 1 mm least wall of aluminium (2700 kg/m³) at litre size, and wall
// for pressure at 60 MPa (yield 240 MPa, safety 4: 2·ρ·p/σ).
struct MadeReservoir {
  double mass_kg;
  double body_volume_m3;
};
MadeReservoir MakeReservoir(double volume_m3, double pressure_gauge_pa);

inline constexpr double kMadeReservoirFixedMassKg = 0.030;
inline constexpr double kMadeReservoirMassPerM3 = 150.0;         // kg/m³
inline constexpr double kMadeReservoirMassPerM3Pa = 90.0 / 1e6;  // kg/(m³·Pa)
inline constexpr double kMadeReservoirSmallestM3 = 10e-6;
inline constexpr double kMadeReservoirLargestM3 = 20e-3;
inline constexpr double kMadeReservoirPressureMaxGaugePa = 1.0e6;

}  // namespace plenum::model

#endif  // PLENUM_MODEL_PHYSICS_STORAGE_H_
