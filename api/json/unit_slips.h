// Numbers that are allowed, and look as if they were meant in another unit.
#ifndef PLENUM_API_JSON_UNIT_SLIPS_H_
#define PLENUM_API_JSON_UNIT_SLIPS_H_

#include <string>
#include <string_view>

namespace plenum::api {

// Why a plain number at a pointer looks like another unit, in a sentence that says how it is read
// all the same; empty for what looks right.
std::string LooksLikeAnotherUnit(std::string_view pointer, double value);

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_UNIT_SLIPS_H_
