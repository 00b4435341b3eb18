// Valves that cannot hold, with a guarantee. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_OPEN_VALVES_H_
#define PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_OPEN_VALVES_H_

#include "verify/design/verify_design.h"

namespace plenum::verify {

// Whether every valve can hold.
bool Holding(const Assembly& assembly);

// With a guarantee a valve that cannot hold may pass more than the part that stands for it: an
// actuator then fills at most to where it rests with its source. Pumps run no longer than for the
// stroke of the parts as they are and then, for what that leaves, against the stop pressure, at no
// more than their greatest power. Raises air and pumps of the cycle to that.
void FillOpenOnes(const Problem& problem, const Settings& settings, const Assembly& assembly,
                  Cycle& cycle);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_CYCLE_VERIFY_OPEN_VALVES_H_
