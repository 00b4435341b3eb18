// The file of a unit (.fmu): description, binary for 64-bit Linux, the unit itself.
#ifndef PLENUM_FMU_UNIT_FILE_H_
#define PLENUM_FMU_UNIT_FILE_H_

#include <string>

#include "fmu/fmu_unit.h"

namespace plenum::fmu {

// Where the unit's text stands in the file, below its resources.
inline constexpr char kUnitFile[] = "unit.txt";

// Whether this build has the binary: one with sanitizers has not.
bool MakesUnits();

// `tool`: by whom. Empty where no units are made.
std::string UnitFile(const Unit& unit, const std::string& tool);

}  // namespace plenum::fmu

#endif  // PLENUM_FMU_UNIT_FILE_H_
