#include "model/physics/air.h"

#include <array>
#include <cstddef>

namespace plenum::model {
namespace {

// At 20 °C and 100 kPa (NIST Chemistry WebBook): R = 8.3145 J/(mol·K) over the molar mass.
struct GasFacts {
  double flow_factor;
  double gas_constant_j_per_kg_k;
  double heat_capacity_ratio;
  double viscosity_pa_s;
};
constexpr std::array<GasFacts, kGasNames.size()> kFacts = {{
    {1.0, kGasConstantAirJPerKgK, 1.4, 1.81e-5},
    {1.0168, 296.8, 1.4, 1.76e-5},
    {0.9506, 259.8, 1.397, 2.03e-5},
    {2.8530, 2077.1, 1.667, 1.96e-5},
    {3.7953, 4124.5, 1.405, 0.88e-5},
    {0.9031, 208.1, 1.667, 2.23e-5},
    {0.79, kGasConstantCo2JPerKgK, 1.29, 1.47e-5},
}};

const GasFacts& Of(Gas gas) { return kFacts[static_cast<std::size_t>(gas)]; }

}  // namespace

double FlowFactor(Gas gas) { return Of(gas).flow_factor; }

double HeatCapacityRatio(Gas gas) { return Of(gas).heat_capacity_ratio; }

double ViscosityPaS(Gas gas) { return Of(gas).viscosity_pa_s; }

double ReferenceDensity(Gas gas) {
  return kReferencePressurePa / (Of(gas).gas_constant_j_per_kg_k * kReferenceTemperatureK);
}

double StandardVolume(double content_pa_m3, double temperature_k) {
  return content_pa_m3 / kReferencePressurePa * (kReferenceTemperatureK / temperature_k);
}

double CompressibilityOfAir(double pressure_pa) {
  constexpr std::array<double, 5> kPressurePa = {1e5, 100e5, 150e5, 200e5, 300e5};
  constexpr std::array<double, 5> kZ = {1.0, 0.993, 1.007, 1.033, 1.109};
  if (pressure_pa <= kPressurePa.front()) return kZ.front();
  for (std::size_t i = 1; i < kPressurePa.size(); ++i) {
    if (pressure_pa > kPressurePa[i]) continue;
    const double share = (pressure_pa - kPressurePa[i - 1]) / (kPressurePa[i] - kPressurePa[i - 1]);
    return kZ[i - 1] + share * (kZ[i] - kZ[i - 1]);
  }
  return kZ.back();
}

}  // namespace plenum::model
