// "phase", "inflate_fraction" and "strokes_per_period" of a group (optimizer/problem/gait.h).
#ifndef PLENUM_API_DESIGN_READ_ACTUATORS_GAIT_READER_H_
#define PLENUM_API_DESIGN_READ_ACTUATORS_GAIT_READER_H_

#include "api/json/reader.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// Of a group of so many actuators. `phase` is a number in [0, 1], 1 being the next period's 0, or a
// list of one for each actuator.
optimizer::Gait ReadGait(Reader& actuator, int count);

// A phase wins over "simultaneous", which is remarked where both are given; pumps without a
// reservoir fill one after another.
void CheckGaits(Reader& request, optimizer::Problem& problem);

// Why the gaits of a problem cannot be guaranteed, or nothing.
std::string WhyGaitNotGuaranteed(const optimizer::Problem& problem);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_ACTUATORS_GAIT_READER_H_
