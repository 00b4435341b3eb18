// Numbers that a part must have and a foreign table does not give, by the laws of the seed.
#ifndef PLENUM_CATALOG_FIELDS_LAWS_ESTIMATE_MISSING_H_
#define PLENUM_CATALOG_FIELDS_LAWS_ESTIMATE_MISSING_H_

#include "catalog/fields/part.h"

namespace plenum::catalog {

// Gives the part each required number that it lacks and that a law predicts from the numbers that
// it has: `estimated`, with the law as source and its error as uncertainty; where the law takes a
// number that is itself estimated, both errors count. What no law gives stays missing, and Validate
// says so.
void EstimateMissing(Part& part);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_LAWS_ESTIMATE_MISSING_H_
