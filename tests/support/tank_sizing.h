// The least fill of a tank for one candidate of one group, from the times of single strokes and the
// balance of air: nothing of the evaluation or the sizing is used.
#ifndef PLENUM_TESTS_SUPPORT_TANK_SIZING_H_
#define PLENUM_TESTS_SUPPORT_TANK_SIZING_H_

#include "optimizer/sizing/sizing.h"

namespace plenum::test {

// One group, a tank, and an objective without energy.
bool CanSizeTank(const optimizer::Problem& problem, const optimizer::Candidate& candidate);

optimizer::Leaf SizeTank(const optimizer::Problem& problem, const optimizer::Candidate& candidate);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_TANK_SIZING_H_
