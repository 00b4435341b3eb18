#include "verify/design/verify_pump_curve.h"

#include <algorithm>

#include "verify/design/verify_finding.h"

namespace plenum::verify {
namespace {

constexpr int kGrid = 500;

template <typename Value>
double Held(const model::CompressorCurve& curve, double low_pa, double high_pa,
            const Value& value) {
  double most = 0.0, held = 1.0;
  for (int i = 0; i <= kGrid; ++i) {
    const double pa = low_pa + (high_pa - low_pa) * i / kGrid;
    if (!(model::FreeAirDelivery(curve, pa) > 0.0)) break;
    const double now = value(pa);
    if (now < most * (1.0 - kSumTolerance)) held = std::min(held, now / most);
    most = std::max(most, now);
  }
  return held;
}

}  // namespace

double EnergyPerAirHeld(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  return Held(curve, low_pa, high_pa, [&](double pa) {
    return model::ElectricalPower(curve, pa) / model::FreeAirDelivery(curve, pa);
  });
}

double PowerHeld(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  return Held(curve, low_pa, high_pa, [&](double pa) { return model::ElectricalPower(curve, pa); });
}

}  // namespace plenum::verify
