// How what a pump takes changes with pressure, on a fine grid. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_PUMP_CURVE_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_PUMP_CURVE_H_

#include "model/physics/compressor.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// The least that energy per air, or power alone, at some pressure up to `high_pa` is of what it is
// at a lower one, as a ratio: 1 where it rises all the way.
double EnergyPerAirHeld(const model::CompressorCurve& curve, double low_pa, double high_pa);
double PowerHeld(const model::CompressorCurve& curve, double low_pa, double high_pa);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_PUMP_CURVE_H_
