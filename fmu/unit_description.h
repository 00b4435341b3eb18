// modelDescription.xml of a unit: FMI 2.0, co-simulation.
#ifndef PLENUM_FMU_UNIT_DESCRIPTION_H_
#define PLENUM_FMU_UNIT_DESCRIPTION_H_

#include <string>

#include "fmu/fmu_unit.h"

namespace plenum::fmu {

// Of the binary, the same for every unit.
inline constexpr char kModelIdentifier[] = "plenum_supply";

std::string DescriptionOf(const Unit& unit, const std::string& guid, const std::string& tool);

}  // namespace plenum::fmu

#endif  // PLENUM_FMU_UNIT_DESCRIPTION_H_
