// The laws of catalog/estimates, as its program writes them into laws.csv, which is built into the
// program.
#ifndef PLENUM_CATALOG_FIELDS_LAWS_LAWS_H_
#define PLENUM_CATALOG_FIELDS_LAWS_LAWS_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::catalog {

struct LawPower {
  std::string of;  // a number of the part, or one of ValueFor
  double exponent = 1;
};

// value = factor · Π of^exponent, for the parts that `when` holds for.
struct FieldLaw {
  std::string family, field;
  std::string when;  // "material has steel", "function is 2/2 pair", several with ';'; empty: all
  double factor = 1;
  std::vector<LawPower> powers;
  std::optional<double> uncertainty;  // relative, one standard deviation; none: not known
  std::string source;
};

// In the order in which they are tried.
const std::vector<FieldLaw>& FieldLaws();

// A coefficient of the law of pumps, by name: rows of family "pump". It must be there.
const FieldLaw& PumpCoefficient(std::string_view name);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_LAWS_LAWS_H_
