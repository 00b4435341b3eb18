// How much of each family is known, and how much of that is estimated.
#ifndef PLENUM_CATALOG_CHECK_COVERAGE_H_
#define PLENUM_CATALOG_CHECK_COVERAGE_H_

#include <array>
#include <string>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// Numbers and texts of a part by provenance, in the order of ProvenanceNames(); flow and current of
// a curve are one each.
std::array<int, 5> CountValues(const Part& part);
bool HasPrice(const Part& part);

struct Coverage {
  std::string family;
  int parts = 0;
  std::vector<std::string> without_price, without_document;  // ids
  int values = 0;                                            // see CountValues
  int estimated = 0;                                         // of these
  bool operator==(const Coverage&) const = default;
};

// Of every family that has parts, in the order of Families().
std::vector<Coverage> CoverageOf(const std::vector<Part>& parts);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_CHECK_COVERAGE_H_
