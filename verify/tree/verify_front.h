// A front, checked anew. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_TREE_VERIFY_FRONT_H_
#define PLENUM_VERIFY_TREE_VERIFY_FRONT_H_

#include "verify/design/verify_finding.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Whether no point beats another, and the status claims no more than that nothing is unexplored.
//
// A whole front claims that every other design is matched or beaten by a point, within the front's
// resolution: all combinations of the catalogue are divided until each part of them bears that out
// or is sized (verify_gaps.h). Of other fronts what is not listed is not looked at.
void CheckFront(const Problem& problem, const Front& front, const Stop& stop, Findings& findings,
                std::vector<NotRechecked>& open);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_TREE_VERIFY_FRONT_H_
