// The settings of a made-to-measure reservoir that many leaves share.
//
// Where energy counts, leaves that differ in the battery alone have the same best settings but
// where the battery's limits bind. So they are sized once, with a battery that bears anything: that
// bounds them all from below, and each battery that bears the best point is sized with it.
#ifndef PLENUM_OPTIMIZER_BOUNDS_CORE_SIZING_H_
#define PLENUM_OPTIMIZER_BOUNDS_CORE_SIZING_H_

#include <memory>
#include <optional>
#include <vector>

#include "optimizer/sizing/custom_sizing.h"

namespace plenum::optimizer {

struct CoreSizing {
  std::vector<std::shared_ptr<const Line>> lines;  // which the sizing points to
  CustomSizing sizing;
  bool done = false;
};

// The leaf of a candidate with a battery at the best settings of its core; none where the battery
// does not bear them, or where they are not proved.
std::optional<Leaf> LeafOfCore(const Problem& problem, const Candidate& candidate,
                               const CoreSizing& core);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_CORE_SIZING_H_
