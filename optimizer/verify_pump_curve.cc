#include "optimizer/verify_pump_curve.h"

#include <algorithm>

#include "optimizer/verify.h"

namespace plenum::optimizer {
namespace {

constexpr int kGrid = 500;

template <typename Value>
bool Rises(const model::CompressorCurve& curve, double ambient_pa, const Value& value) {
  double before = 0.0;
  for (int i = 0; i < kGrid; ++i) {
    const double pa = ambient_pa + (model::HighestPressure(curve) - ambient_pa) * i / kGrid;
    if (!(model::FreeAirDelivery(curve, pa) > 0.0)) return true;
    const double now = value(pa);
    if (now < before * (1.0 - kSumTolerance)) return false;
    before = now;
  }
  return true;
}

double EnergyPerAir(const model::CompressorCurve& curve, double pressure_pa) {
  return model::ElectricalPower(curve, pressure_pa) / model::FreeAirDelivery(curve, pressure_pa);
}

}  // namespace

bool EnergyPerAirRises(const model::CompressorCurve& curve, double ambient_pa) {
  return Rises(curve, ambient_pa, [&](double pa) { return EnergyPerAir(curve, pa); });
}

bool PowerRises(const model::CompressorCurve& curve, double ambient_pa) {
  return Rises(curve, ambient_pa, [&](double pa) { return model::ElectricalPower(curve, pa); });
}

double LeastEnergyPerAir(const model::CompressorCurve& curve, double ambient_pa) {
  double least = kUnlimited;
  for (int i = 0; i < kGrid; ++i) {
    const double pa = ambient_pa + (model::HighestPressure(curve) - ambient_pa) * i / kGrid;
    if (model::FreeAirDelivery(curve, pa) > 0.0) least = std::min(least, EnergyPerAir(curve, pa));
  }
  return least;
}

}  // namespace plenum::optimizer
