// A box as ranges of choices. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_RANGES_H_
#define PLENUM_VERIFY_CORNER_VERIFY_RANGES_H_

#include <utility>
#include <vector>

namespace plenum::verify {

using Ranges = std::vector<std::pair<int, int>>;  // of choices per slot, half-open

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_RANGES_H_
