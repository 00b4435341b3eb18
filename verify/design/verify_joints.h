// Manifolds, tees and check valves of a design (optimizer/problem/joints.h), looked for row by row
// once more.
// Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_JOINTS_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_JOINTS_H_

#include <map>
#include <utility>
#include <vector>

#include "verify/design/verify_values.h"

namespace plenum::verify {

using JointRows = std::map<std::pair<Family, int>, int>;  // pieces by the index of the part

int Lines(const Problem& problem);  // one for each actuator

// Of all lines together, and of pieces of a part of the source.
JointRows JointOfLines(const Problem& problem);
JointRows JointOfPieces(const Problem& problem, Family family, int part, int pieces);
// Of a group's lines behind its own regulator, and of these regulators at a part of a source, or at
// the mains.
JointRows JointOfGroup(const Problem& problem, int group);
JointRows JointOfRegulators(const Problem& problem, Family family, int part);
JointRows JointOfRegulatorsAtMains(const Problem& problem);
// Of pumps without a reservoir, so many a feed, where each group or each actuator has its own: what
// joins them, of an actuator with its line and the valve that vents it, for all feeds; and check
// valves where the pumps let air back.
JointRows JointsOfFeeds(const Problem& problem, Family family, int part, int pumps);
// The check valve that such pumps have; null: none serves.
const model::CheckValve* CheckValveFor(const Problem& problem);
// Of a design with its other rows.
JointRows JointsOf(const Problem& problem, const Design& design);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_JOINTS_H_
