// What a front says of all that it does not list, looked at. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_TREE_VERIFY_GAPS_H_
#define PLENUM_VERIFY_TREE_VERIFY_GAPS_H_

#include <vector>

#include "verify/design/verify_finding.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

using Point = std::vector<double>;  // one value per amount

// The corners of the largest boxes that none of the points lies in: whatever is neither matched nor
// beaten by a point lies below one of them in every amount. +∞ where nothing ends a box.
std::vector<Point> GapsBetween(const std::vector<Point>& points, std::size_t amounts);

// That no design lies below a corner of `gaps`. All combinations are divided once: each box keeps
// the gaps that bounds on the single amounts and on a weighted sum of them leave open, until none
// is, or it is a single combination, which is sized within each of them. How many combinations stay
// open; a design in a gap is a finding. Energy, which has no limit, may only be the first amount.
BigCount CheckGaps(const Problem& problem, const std::vector<Amount>& amounts,
                   const std::vector<Point>& points, const std::vector<Point>& gaps,
                   const Stop& stop, Findings& findings);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_TREE_VERIFY_GAPS_H_
