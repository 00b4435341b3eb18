// What a functional mock-up unit holds: the supply of a design with its actuators, each driven by
// itself, and what is on board.
#ifndef PLENUM_FMU_FMU_UNIT_H_
#define PLENUM_FMU_FMU_UNIT_H_

#include <limits>
#include <string>
#include <vector>

#include "model/simulate/simulate_rig.h"

namespace plenum::fmu {

// A valve that is there to be driven.
struct DrivenValve {
  double coil_power_w = 0.0;
  // It closes both ways; one that cannot (a lone 3/2) is energised while it inflates, and vents
  // else.
  bool holds = true;
  bool operator==(const DrivenValve&) const = default;
};

struct Unit {
  std::string name;
  // One group for each actuator (`count` 1), without commands, at ambient pressure; without
  // effects.
  model::Rig rig;
  std::vector<DrivenValve> valves;  // as many
  double regulator_power_w = 0.0;
  double energy_available_j = std::numeric_limits<double>::infinity();  // of the batteries
  double air_available_m3 = std::numeric_limits<double>::infinity();    // ANR, on board
};

}  // namespace plenum::fmu

#endif  // PLENUM_FMU_FMU_UNIT_H_
