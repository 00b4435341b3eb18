#include "model/physics/air.h"

#include <array>
#include <cstddef>

namespace plenum::model {

double FlowFactor(Gas gas) { return gas == Gas::kCo2 ? 0.79 : 1.0; }

double HeatCapacityRatio(Gas gas) { return gas == Gas::kCo2 ? 1.29 : 1.4; }

double ReferenceDensity(Gas gas) {
  return gas == Gas::kCo2 ? kReferenceDensityCo2KgPerM3 : kReferenceDensityKgPerM3;
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
