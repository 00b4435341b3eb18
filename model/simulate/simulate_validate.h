// Is a rig something that the simulator can run?
#ifndef PLENUM_MODEL_SIMULATE_SIMULATE_VALIDATE_H_
#define PLENUM_MODEL_SIMULATE_SIMULATE_VALIDATE_H_

#include <string>

#include "model/simulate/simulate_rig.h"

namespace plenum::model {

// The first field outside its valid range, its value and the range; empty if there is none.
std::string WhyInvalid(const Rig& rig);
std::string WhyInvalid(const SimulateOptions& options);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_SIMULATE_VALIDATE_H_
