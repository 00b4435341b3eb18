// The vocabulary of the catalogue: families, their fields, units (in the name) and allowed ranges.
// validate.cc checks a part against them. One table serves validation, the database's checks, CSV
// columns, JSON and filters.
#ifndef PLENUM_CATALOG_FIELDS_FIELDS_H_
#define PLENUM_CATALOG_FIELDS_FIELDS_H_

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::catalog {

struct NumberField {
  std::string_view name;
  double min;
  double max;  // both inclusive and finite
  bool required;
  std::string_view meaning;
};

struct TextField {
  std::string_view name;
  bool required;
  std::vector<std::string_view> allowed;  // empty: free text
  std::string_view meaning;
};

// Pressures of a curve are from ambient up, free air falling, or from the deepest suction pressure
// up to ambient, free air rising.
enum class CurveKind { kNone, kPressure, kSuction };
inline constexpr double kVacuumMinKpaGauge = -101.325;
struct CurvePressures {
  double min, max;
};
constexpr CurvePressures CurvePressuresKpaGauge(CurveKind kind) {
  return kind == CurveKind::kSuction ? CurvePressures{kVacuumMinKpaGauge, 0}
                                     : CurvePressures{0, 5e4};
}

struct Family {
  std::string_view name;
  std::vector<NumberField> numbers;
  std::vector<TextField> texts;
  CurveKind curve = CurveKind::kNone;
  bool has_curve() const { return curve != CurveKind::kNone; }
};

// In family_list.cc alone, so that a program can be linked with a list that has a further one.
std::span<const Family> Families();
std::vector<Family> OwnFamilies();                // what it holds in plenum
const Family* FindFamily(std::string_view name);  // nullptr: unknown

// What is wrong with a part, each with the field it concerns ("" for the whole part) and a sentence
// that names the value and the allowed range. Empty: valid.
struct FieldError {
  std::string field;
  std::string detail;
  bool operator==(const FieldError&) const = default;
};
std::vector<FieldError> Validate(const Part& part);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_FIELDS_H_
