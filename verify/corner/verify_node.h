// What groups that inflate at once leave each other of the pressure behind a regulator. Internal to
// verify*.cc.
//
// Let p be the pressure behind the regulator and P ≤ p that of a chamber while it fills through a
// line that passes p·q(P/p). For any μ from 0 to ambient, and r = P/p,
//   (p − μ) dt = (1 − μ·r/P)/q(r) · dV ≥ h(P) · dV,   h(P) = min over r of (1 − μ·r/P)/q(r),
// V the air taken, ANR. Neither side falls below 0 afterwards, so that the mean of p until a
// chamber must be full is at least μ + ∫ h dV / T. The regulator passes less the higher p, and its
// flow is concave in p: while it passes the air of all groups p has a mean of at most where it
// passes the mean flow. A group that needs a higher mean than that is too slow, whatever the others
// do. In r the quotient of a falling line and a concave q falls and then rises: its least value
// lies in an interval that is narrowed from both ends, and is bounded by the ends' better halves.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_NODE_H_
#define PLENUM_VERIFY_CORNER_VERIFY_NODE_H_

#include <vector>

#include "verify/corner/verify_line.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Least means, Pa absolute, with which a line fills its chamber by the rise time and by half of the
// period.
NodeMeans LeastMeans(const Problem& problem, int group, const BestLine& line);

// Where the groups draw from: the largest conductance (gas and temperature in `factor`), the
// highest pressure and flow, ANR, of all lines together.
struct NodeSource {
  model::FlowElement regulator;
  double factor, source_pa, flow_max_m3_per_s;
};

// Whether some group is too slow with these lines, or with any that take no less air.
bool TooSlowTogether(const Problem& problem, const NodeSource& source,
                     const std::vector<const BestLine*>& lines);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_NODE_H_
