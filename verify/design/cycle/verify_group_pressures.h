// The pressures behind regulators of their own. Internal to verify*.cc.
//
// More pressure makes strokes faster. It costs a group whose valve holds nothing: its actuators are
// full at the operating pressure, and its coils are on for less time. One whose valve cannot hold
// takes more air. Bottles and tanks must keep the highest of all. So every setting is no better
// than the one with the same highest pressure where the holding groups are as near to it as they
// may and the others as low as they may.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_GROUP_PRESSURES_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_GROUP_PRESSURES_H_

#include <vector>

#include "verify/design/cycle/verify_known_cycles.h"
#include "verify/design/verify_supply.h"

namespace plenum::verify {

// Per group where its strokes keep their limits, which they may miss by `slack`.
struct GroupRanges {
  bool known = true, feasible = true;  // else nothing below is valid
  std::vector<Pressures> groups;
  Pressures Highest() const;  // of all groups
};
GroupRanges RangesOf(KnownCycles& cycles, const Assembly& assembly, double slack);

// As above.
std::vector<double> PressuresAt(const GroupRanges& ranges, const Assembly& assembly,
                                double highest_pa);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_GROUP_PRESSURES_H_
