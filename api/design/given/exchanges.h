// What becomes of a design with some of its parts exchanged for those of another design.
#ifndef PLENUM_API_DESIGN_GIVEN_EXCHANGES_H_
#define PLENUM_API_DESIGN_GIVEN_EXCHANGES_H_

#include <functional>
#include <vector>

#include "api/catalogue/stores.h"
#include "catalog/fields/part.h"
#include "optimizer/sizing/resize.h"

namespace plenum::api {

// A row of the parts list of one design beside that of another; null: it has none there.
struct RowPair {
  const optimizer::Choice* given = nullptr;
  const optimizer::Choice* other = nullptr;

  // Where it stands in the list: the family and group of either.
  const optimizer::Choice& place() const { return given ? *given : *other; }
};

// Whether two rows are the same part in the same number; a reservoir made to measure is, whatever
// its volume.
bool SamePart(const RowPair& pair);

// Rows in which two designs of one problem differ, in part or number or in what that comes to.
std::vector<RowPair> Differences(const optimizer::Design& given, const optimizer::Design& other);

// The given design with some rows as in the other, at the settings that suit it best.
struct Exchange {
  std::vector<RowPair> rows;
  optimizer::Remade made;
};

// Each differing row by itself where the parts then still fit each other; else all that differ in
// the same line, or in the source. For designs of one configuration; none where all rows differ at
// once in the same way. `stop` ends it, what was not looked at by then is undecided.
std::vector<Exchange> Exchanges(const optimizer::Problem& problem,
                                const std::vector<catalog::Part>& catalogue,
                                const optimizer::Design& given, const optimizer::Design& other,
                                const std::function<bool()>& stop);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_GIVEN_EXCHANGES_H_
