// A group behind its own regulator, or an equal part of it on pumps of its own, as a design by
// itself: what it does has nothing to do with the others. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_ALONE_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_ALONE_H_

#include <optional>
#include <vector>

#include "verify/design/verify_design.h"

namespace plenum::verify {

// A problem of one group, without parts, and that group's line and regulator at the same source, or
// its own pumps.
struct Alone {
  Problem problem;
  Assembly assembly;
  int feeds = 1;  // as many of them are the group
};
Alone AloneOf(const Problem& problem, const Assembly& assembly, int group);
Settings AloneAt(double group_pressure_pa);

// The cycles of all groups as one, each so often as it has feeds; none where one of them is not
// known.
std::optional<Cycle> Joined(const std::vector<std::optional<Cycle>>& cycles,
                            const std::vector<int>& feeds);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_ALONE_H_
