// One candidate of pumps without a reservoir, from the laws: nothing of the evaluation or the
// sizing is used.
#ifndef PLENUM_TESTS_SUPPORT_PUMPS_DIRECT_SIZING_H_
#define PLENUM_TESTS_SUPPORT_PUMPS_DIRECT_SIZING_H_

#include "optimizer/sizing/sizing.h"

namespace plenum::test {

optimizer::Leaf SizeDirectPump(const optimizer::Problem& problem,
                               const optimizer::Candidate& candidate);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_PUMPS_DIRECT_SIZING_H_
