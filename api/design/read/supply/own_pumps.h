// What a request says of the pumps without a reservoir that it asks for (pump_feed.h of the
// problem).
#ifndef PLENUM_API_DESIGN_READ_SUPPLY_OWN_PUMPS_H_
#define PLENUM_API_DESIGN_READ_SUPPLY_OWN_PUMPS_H_

#include <string>

#include "api/json/reader.h"
#include "catalog/fields/part.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// `pumps` of `supply`, after its configurations: sets what a feed is. Fails where no configuration
// is one of pumps without a reservoir; where another is, and pumps are to be of their own; for both
// sides of one actuator; and for pumps of each actuator where actuators of a group have phases of
// their own.
void ReadPumps(Reader& supply, optimizer::Problem& problem);

// Whether the row suits what a feed is: a valve that only vents (2/2) is for pumps of each actuator
// and for nothing else, and these must hold the pressure while they are off.
bool SuitsFeed(const optimizer::Problem& problem, const catalog::Part& part);
// Why it does not, as the end of a sentence that begins with its id.
std::string WhyNotForFeed(const optimizer::Problem& problem, const catalog::Part& part);

// How many pieces of a part of the source a design may have, up to so many a feed, in words.
std::string PiecesWanted(int most, int feeds);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_SUPPLY_OWN_PUMPS_H_
