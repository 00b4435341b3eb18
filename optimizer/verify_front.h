// A front, checked anew. Internal to verify*.cc.
#ifndef PLENUM_OPTIMIZER_VERIFY_FRONT_H_
#define PLENUM_OPTIMIZER_VERIFY_FRONT_H_

#include "optimizer/pareto.h"
#include "optimizer/verify.h"

namespace plenum::optimizer {

// Whether no point beats another, and the status claims no more than that nothing is unexplored.
//
// A whole front of two amounts of parts claims of each two neighbours that what takes less of the
// second amount than the one takes no less of the first than the other; and nothing takes less of
// an amount than its end. All combinations of the catalogue are divided until each part of them
// bears that out or is sized. Of other fronts what is not listed is not looked at.
void CheckFront(const Problem& problem, const Front& front, Findings& findings,
                std::vector<NotRechecked>& open);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_FRONT_H_
