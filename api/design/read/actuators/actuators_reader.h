// "actuators" of a request: its groups.
#ifndef PLENUM_API_DESIGN_READ_ACTUATORS_ACTUATORS_READER_H_
#define PLENUM_API_DESIGN_READ_ACTUATORS_ACTUATORS_READER_H_

#include <vector>

#include "api/design/read/guarantee.h"
#include "api/json/reader.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// Fills the groups of the problem, whose ambient is known, and gives the uncertainty of each. A
// double-acting cylinder is two groups with the same ActuatorGroup::entry, the side of the cap and
// then that of the rod, each with valves of its own: two independent chambers, without piston, load
// or friction.
std::vector<GroupUncertainty> ReadActuators(Reader& request, optimizer::Problem& problem);

// Of each double-acting cylinder one side is filled while the other is emptied: says so in the
// gaits, once the duty is known. Groups keep the turns that they have among the entries.
void AlternateSides(optimizer::Problem& problem);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_ACTUATORS_ACTUATORS_READER_H_
