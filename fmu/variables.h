// The variables of a unit by their value references, which are their places in the list.
#ifndef PLENUM_FMU_VARIABLES_H_
#define PLENUM_FMU_VARIABLES_H_

#include <cstddef>
#include <string>
#include <vector>

#include "fmu/fmu_unit.h"

namespace plenum::fmu {

enum class Quantity {
  kCommand,   // input, integer
  kVolume,    // input
  kPressure,  // these three: output, of an actuator
  kFlow,
  kVolumeNow,
  kSource,  // output, of the supply, as all that follow
  kEnergyUsed,
  kBatteryCharge,
  kAirUsed,
  kAirLeft,
  kCloses  // parameter, boolean
};

struct Variable {
  std::string name;
  Quantity quantity;
  std::size_t actuator = 0;
};

// Only those that mean something: no battery's charge on mains, no air left of a pump.
std::vector<Variable> VariablesOf(const Unit& unit);

}  // namespace plenum::fmu

#endif  // PLENUM_FMU_VARIABLES_H_
