// The part ids of a design, by which ties are ordered. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_IDS_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_IDS_H_

#include <string>
#include <utility>
#include <vector>

#include "verify/design/verify_values.h"

namespace plenum::verify {

// Ids in the order of a parts list, with pieces where parts of the source stand in parallel.
using Ids = std::vector<std::pair<std::string, int>>;
Ids IdsOf(const Design& design);
std::string Text(const Ids& ids);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_IDS_H_
