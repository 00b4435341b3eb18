// The highest source pressure of all lines of a group.
#ifndef PLENUM_OPTIMIZER_BOUNDS_HIGHEST_SOURCE_H_
#define PLENUM_OPTIMIZER_BOUNDS_HIGHEST_SOURCE_H_

#include "optimizer/choices/plan.h"

namespace plenum::optimizer {

// Absolute: what any line stands and its peak allows (closing.h) that is fast enough, by boxes of
// lines, the one that stands most first. 0 where no line is fast enough. It rules out at once what
// boxes of several groups show only when all but this one are single choices: that a group needs
// more than another stands. So it is looked for where another group's operating pressure is above
// this one's limit, and given up after some thousand boxes; kUnlimited then.
double HighestSource(const Problem& problem, const Plan& plan, int group);

// The least of all groups.
double HighestSource(const Problem& problem, const Plan& plan);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_HIGHEST_SOURCE_H_
