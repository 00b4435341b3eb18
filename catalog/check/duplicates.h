// The same part under two names.
#ifndef PLENUM_CATALOG_CHECK_DUPLICATES_H_
#define PLENUM_CATALOG_CHECK_DUPLICATES_H_

#include <string>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// Parts of one family that may be one, by id.
struct Duplicates {
  std::string family, why;
  std::vector<std::string> ids;
  bool operator==(const Duplicates&) const = default;
};

// Two parts of a family may be one where, up to case, accents and separators,
//   maker and part number are equal ("SMC Corp.", "VQ-110" and "SMC", "VQ110"); legal forms of a
//   company do not count;
//   a maker and an alias of one are maker and part number, or an alias, of another;
//   the part numbers are equal and the makers are not, the number has a letter and a digit and at
//   least five of them together, and all numbers that both have are equal: one maker is a seller.
// By family and ids; each set of parts once, with the first of these reasons.
std::vector<Duplicates> FindDuplicates(const std::vector<Part>& parts);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_CHECK_DUPLICATES_H_
