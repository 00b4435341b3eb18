// Random problems of actuators under pressure that are pulled below ambient, small enough to
// enumerate.
#ifndef PLENUM_TESTS_SUPPORT_RAIL_PROBLEMS_H_
#define PLENUM_TESTS_SUPPORT_RAIL_PROBLEMS_H_

#include "tests/support/small_catalogue.h"

namespace plenum::test {

// A draw of pressure with a low pressure for each group, of several sometimes not for the last, and
// a vacuum from the wall; all valves hold.
optimizer::Problem RailProblem(const Draw& draw);

// The same with vacuum pumps and reservoirs of their own in place of the wall. The draw's size has
// compressors, which become vacuum pumps, and reservoirs.
optimizer::Problem PumpedRailProblem(const Draw& draw);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_RAIL_PROBLEMS_H_
