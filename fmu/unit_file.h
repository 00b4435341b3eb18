// The file of a unit (.fmu): description, binary for 64-bit Linux, the unit itself.
#ifndef PLENUM_FMU_UNIT_FILE_H_
#define PLENUM_FMU_UNIT_FILE_H_

#include <string>

#include "fmu/fmu_unit.h"

namespace plenum::fmu {

// Where the unit's text stands in the file, below its resources.
inline constexpr char kUnitFile[] = "unit.txt";

// `tool`: by whom. Empty in a build without the binary (with sanitizers).
std::string UnitFile(const Unit& unit, const std::string& tool);

}  // namespace plenum::fmu

#endif  // PLENUM_FMU_UNIT_FILE_H_
