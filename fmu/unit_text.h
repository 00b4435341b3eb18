// A unit as a text, which is what stands in its file.
#ifndef PLENUM_FMU_UNIT_TEXT_H_
#define PLENUM_FMU_UNIT_TEXT_H_

#include <optional>
#include <string>
#include <string_view>

#include "fmu/fmu_unit.h"

namespace plenum::fmu {

// Numbers are exact: what is read is what was written.
std::string WriteUnit(const Unit& unit);

// None where the text is no unit of this version.
std::optional<Unit> ReadUnit(std::string_view text);

// Tells one unit from another, "{…}".
std::string GuidOf(std::string_view text);

}  // namespace plenum::fmu

#endif  // PLENUM_FMU_UNIT_TEXT_H_
