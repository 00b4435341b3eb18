// The least of the single lines of a box that may work: best first over ranges of its choices.
// Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_LEAST_LINE_H_
#define PLENUM_VERIFY_CORNER_VERIFY_LEAST_LINE_H_

#include <array>
#include <functional>
#include <utility>

#include "verify/corner/verify_ranges.h"

namespace plenum::verify {

struct LineChoices {
  std::array<int, 3> slots;  // of one group
  // Share of the objective of a slot's choices, the least and the most of them.
  std::function<std::pair<double, double>(const Ranges&, int slot)> share;
  std::function<bool(const Ranges&)> fails;  // every line of the box
};

// Sum over the slots, at least, of a line in the box that does not fail; +∞ where all do. After so
// many looks the least of what is not looked at.
double LeastLine(const LineChoices& choices, const Ranges& ranges);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_LEAST_LINE_H_
