// A box as ranges of choices. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_RANGES_H_
#define PLENUM_VERIFY_CORNER_VERIFY_RANGES_H_

#include <utility>
#include <vector>

#include "verify/design/verify_values.h"

namespace plenum::verify {

using Ranges = std::vector<std::pair<int, int>>;  // of choices per slot, half-open

// Calls `visit(item)` for the choices of a slot in the box until one gives true.
template <typename Visit>
bool Any(const ProofPlan& plan, const Ranges& ranges, int slot, const Visit& visit) {
  for (int i = ranges[slot].first; i < ranges[slot].second; ++i)
    if (visit(plan.slots[slot].choices[i])) return true;
  return false;
}

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_RANGES_H_
