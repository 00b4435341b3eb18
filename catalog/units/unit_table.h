// The units that a number may be written in, by the end of its field's name.
#ifndef PLENUM_CATALOG_UNITS_UNIT_TABLE_H_
#define PLENUM_CATALOG_UNITS_UNIT_TABLE_H_

#include <span>
#include <string_view>

namespace plenum::catalog {

// x of this unit are (x + offset) · numerator / denominator of the field's. Both factors are
// exact where the definition allows, so that 350 g becomes the double nearest to 0.35.
struct Unit {
  std::string_view name;  // normalised: no blanks, 3 for ³, L for litres
  double numerator = 1, denominator = 1;
  double offset = 0;                // of temperatures
  std::string_view condition = {};  // what a standard volume is counted at, for people
  bool is_alias = false;            // not listed in messages
};

enum class Kind { kPlain, kGauge, kAbsolute, kFlow };

struct Dimension {
  std::string_view suffix;  // of the field's name
  std::string_view unit;    // of the field, for people
  std::span<const Unit> units;
  Kind kind = Kind::kPlain;
};

// What a normal litre is counted at, once its temperature is said: DIN 1343 and ISO 8778.
inline constexpr std::string_view kAtZero = "0 °C and 101.325 kPa (DIN 1343)";
inline constexpr std::string_view kAtTwenty = "20 °C and 100 kPa (ISO 8778)";
inline constexpr double kAnrPerNormalLitre = 293.15 / 273.15 * 1.01325;

// The one of a field; "_max" and "_min" behind the unit do not matter. A name without a unit has
// the dimension without a suffix, whose only unit is %.
const Dimension& DimensionOf(std::string_view field);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_UNITS_UNIT_TABLE_H_
