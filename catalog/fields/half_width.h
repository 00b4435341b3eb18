// How far a number of a part may be from what stands in the catalogue.
#ifndef PLENUM_CATALOG_FIELDS_HALF_WIDTH_H_
#define PLENUM_CATALOG_FIELDS_HALF_WIDTH_H_

#include <optional>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// Half-widths, as shares of the number, by provenance. Defaults: data sheets of pneumatic parts
// give flow and mass within a few per cent; another's measurement or bill of materials is coarser,
// and so is what is computed from such numbers; the rules of catalog/data/README.md miss by a
// quarter; what was fitted to measurements of the part itself is the best that there is.
struct Tolerance {
  double datasheet = 0.05, third_party = 0.10, derived = 0.10, estimated = 0.25, measured = 0.02;
  double Of(Provenance provenance) const;
  // Of a number that says how uncertain it is: twice that, at most 0.95 of the number; else that of
  // its provenance.
  double Of(Provenance provenance, const std::optional<double>& uncertainty) const;
  bool operator==(const Tolerance&) const = default;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_HALF_WIDTH_H_
