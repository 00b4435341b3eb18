#include "model/physics/storage.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plenum::model {
namespace {

constexpr double kSecondsPerHour = 3600.0;

// Roundings of decimal volts must not decide at the edge of the rule.
constexpr double kRounding = 1e-9;

struct Saturation {
  double temperature_k;
  double pressure_pa;
};

// Span and Wagner's vapour pressure of CO2, up to the critical point.
constexpr std::array<Saturation, 8> kSaturation{{{243.15, 1.4278e6},
                                                 {253.15, 1.9696e6},
                                                 {273.15, 3.4851e6},
                                                 {283.15, 4.5022e6},
                                                 {293.15, 5.7291e6},
                                                 {298.15, 6.4342e6},
                                                 {303.15, 7.2137e6},
                                                 {304.13, 7.3773e6}}};

double EffectivePressure(double pressure_pa) {
  return pressure_pa / CompressibilityOfAir(pressure_pa);
}

}  // namespace

double UsableEnergy(double capacity_ah, double nominal_voltage_v) {
  return capacity_ah * kSecondsPerHour * nominal_voltage_v * kDepthOfDischarge;
}

bool VoltageMatches(double pack_voltage_v, double pump_voltage_v) {
  return pump_voltage_v == 0.0 || std::abs(pack_voltage_v - pump_voltage_v) <=
                                      (kVoltageTolerance + kRounding) * pump_voltage_v;
}

double CylinderCharge(double water_volume_m3, double fill_pressure_pa, double temperature_k) {
  return water_volume_m3 * EffectivePressure(fill_pressure_pa) /
         (kGasConstantAirJPerKgK * temperature_k);
}

double CylinderUsableVolume(double water_volume_m3, double fill_pressure_pa,
                            double inlet_pressure_min_pa, double temperature_k) {
  if (inlet_pressure_min_pa >= fill_pressure_pa) return 0.0;
  const double drop =
      EffectivePressure(fill_pressure_pa) - EffectivePressure(inlet_pressure_min_pa);
  return StandardVolume(water_volume_m3 * drop, temperature_k);
}

double TankCharge(double volume_m3, double pressure_pa, double temperature_k) {
  return volume_m3 * pressure_pa / (kGasConstantAirJPerKgK * temperature_k);
}

double Co2UsableVolume(double co2_mass_kg, double water_volume_m3, double inlet_pressure_min_pa,
                       double temperature_k) {
  const double released = co2_mass_kg / kReferenceDensityCo2KgPerM3;
  const double left = StandardVolume(water_volume_m3 * inlet_pressure_min_pa, temperature_k);
  return std::max(released - left, 0.0);
}

double Co2Draw(double endless_m3_per_s, double empty_kg, double co2_kg, double mission_s) {
  constexpr double kLatentJPerM3 = 274e3, kCooledK = 20.0;
  constexpr double kMetalJPerKgK = 460.0, kLiquidJPerKgK = 3000.0;
  const double loss_w_per_k = endless_m3_per_s * kLatentJPerM3 / kCooledK;
  const double heat_j_per_k = empty_kg * kMetalJPerKgK + 0.5 * co2_kg * kLiquidJPerKgK;
  return endless_m3_per_s / -std::expm1(-mission_s * loss_w_per_k / heat_j_per_k);
}

double Co2SaturationPressure(double temperature_k) {
  const double t = std::clamp(temperature_k, kSaturation.front().temperature_k,
                              kSaturation.back().temperature_k);
  const auto above = std::find_if(kSaturation.begin() + 1, kSaturation.end() - 1,
                                  [t](const Saturation& s) { return s.temperature_k >= t; });
  const Saturation& low = *(above - 1);
  const Saturation& high = *above;
  const double share =
      (1.0 / low.temperature_k - 1.0 / t) / (1.0 / low.temperature_k - 1.0 / high.temperature_k);
  return low.pressure_pa * std::pow(high.pressure_pa / low.pressure_pa, share);
}

MadeReservoir MakeReservoir(double volume_m3, double pressure_gauge_pa) {
  const double mass_per_m3 =
      kMadeReservoirMassPerM3 + kMadeReservoirMassPerM3Pa * pressure_gauge_pa;
  return {.mass_kg = kMadeReservoirFixedMassKg + volume_m3 * mass_per_m3,
          .body_volume_m3 = 1.08 * volume_m3 + 10e-6};
}

}  // namespace plenum::model
