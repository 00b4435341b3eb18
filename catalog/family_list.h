// The families that plenum has. Families() (fields.h) lists them, in a file of its own: a program
// may be linked with a list that has a further one.
#ifndef PLENUM_CATALOG_FAMILY_LIST_H_
#define PLENUM_CATALOG_FAMILY_LIST_H_

#include <vector>

#include "catalog/fields.h"

namespace plenum::catalog {

std::vector<Family> OwnFamilies();

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FAMILY_LIST_H_
