// What a pump's table says of energy and air, on a fine grid. Internal to verify*.cc.
#ifndef PLENUM_OPTIMIZER_VERIFY_PUMP_CURVE_H_
#define PLENUM_OPTIMIZER_VERIFY_PUMP_CURVE_H_

#include "model/compressor.h"

namespace plenum::optimizer {

// Whether energy per air, or power alone, rises with pressure.
bool EnergyPerAirRises(const model::CompressorCurve& curve, double ambient_pa);
bool PowerRises(const model::CompressorCurve& curve, double ambient_pa);

// J/m³ ANR, at the pressure where it is least.
double LeastEnergyPerAir(const model::CompressorCurve& curve, double ambient_pa);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_PUMP_CURVE_H_
