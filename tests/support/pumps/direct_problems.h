// Random problems that pumps without a reservoir may meet.
#ifndef PLENUM_TESTS_SUPPORT_PUMPS_DIRECT_PROBLEMS_H_
#define PLENUM_TESTS_SUPPORT_PUMPS_DIRECT_PROBLEMS_H_

#include <cstdint>

#include "optimizer/problem/problem.h"

namespace plenum::test {

// Slow enough for pumps that fill the actuators themselves; several groups take turns. Same seed,
// same problem. `severity`: as that of Draw.
optimizer::Problem DirectPumpProblem(std::uint64_t seed, double severity, int groups);

// Pumps of a feed; those of each actuator feed it past its valve.
optimizer::Problem WithFeed(optimizer::Problem problem, optimizer::PumpFeed feed);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_PUMPS_DIRECT_PROBLEMS_H_
