// Gas, ambient and reference state.
//
// All pressures inside plenum are absolute, in Pa; all volumes in m³; gas amounts are counted as
// volume at the reference state (ANR, ISO 8778: 100 kPa, 20 °C), so 1 m³ ANR of air is 1.188 kg.
#ifndef PLENUM_MODEL_PHYSICS_AIR_H_
#define PLENUM_MODEL_PHYSICS_AIR_H_

#include <array>
#include <string_view>

namespace plenum::model {

inline constexpr double kReferencePressurePa = 1e5;
inline constexpr double kReferenceTemperatureK = 293.15;
inline constexpr double kGasConstantAirJPerKgK = 287.05;
inline constexpr double kReferenceDensityKgPerM3 =
    kReferencePressurePa / (kGasConstantAirJPerKgK * kReferenceTemperatureK);
inline constexpr double kGasConstantCo2JPerKgK = 188.9;
inline constexpr double kReferenceDensityCo2KgPerM3 =
    kReferencePressurePa / (kGasConstantCo2JPerKgK * kReferenceTemperatureK);

// Absolute: deeper than any vacuum that parts of this size reach.
inline constexpr double kDeepestVacuumPa = 1e3;

struct Ambient {
  double pressure_pa = kReferencePressurePa;
  double temperature_k = kReferenceTemperatureK;
  bool operator==(const Ambient&) const = default;
};

enum class Gas { kAir, kNitrogen, kOxygen, kHelium, kHydrogen, kArgon, kCo2 };
inline constexpr std::array<std::string_view, 7> kGasNames = {  // in the order of the gases
    "air", "nitrogen", "oxygen", "helium", "hydrogen", "argon", "co2"};

// Factor on the standard volume flow of air that `gas` reaches through the same element: the ratio
// of the ideal choked nozzle flows, √(κR)·(2/(κ+1))^((κ+1)/(2(κ−1))) of the gas over that of air;
// used both ways and at any ratio. 1 for air, 0.79 for CO2.
double FlowFactor(Gas gas);

// Ratio of heat capacities κ = c_p/c_v at 20 °C: 1.4 for air, 1.29 for CO2.
double HeatCapacityRatio(Gas gas);

// Dynamic viscosity at 20 °C and pressures that pneumatics has, Pa·s.
double ViscosityPaS(Gas gas);

// Density at the reference state, kg/m³.
double ReferenceDensity(Gas gas);

// Volume at the reference state (m³ ANR) of gas that fills `content_pa_m3` = ∫p dV, i.e. the
// product p·V, at temperature T: n = pV/P0 · T0/T.
double StandardVolume(double content_pa_m3, double temperature_k);

// Compressibility factor Z(p) of air at 300 K for 0.1–30 MPa absolute: linear interpolation of
// Perry's values (100 bar 0.993, 150 1.007, 200 1.033, 300 1.109; 1 at ambient). Outside the table
// the end value is used; ideal gas would overstate a 300 bar fill by 11 %.
double CompressibilityOfAir(double pressure_pa);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_PHYSICS_AIR_H_
