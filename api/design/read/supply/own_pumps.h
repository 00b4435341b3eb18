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

// `hold_on` of `supply`, after its pumps: whether they run on while what they filled holds. Fails
// where a configuration is not one of pumps without a reservoir.
void ReadHoldOn(Reader& supply, optimizer::Problem& problem);
// Warns where pumps that hold on leave a group for the next one's turn before it is to be emptied.
void WarnOfTurns(const optimizer::Problem& problem);

// Whether the row suits what a feed is: a valve that only vents (2/2) is for pumps of each actuator
// and for nothing else.
bool SuitsFeed(const optimizer::Problem& problem, const catalog::Part& part);
// Why a valve does not, as the end of a sentence that begins with its id.
std::string WhyNotForFeed(const optimizer::Problem& problem);

// Whether the row is a pump that must hold an actuator's pressure while it is off, does not, and no
// check valve of the problem does it in its place (optimizer/problem/joints.h).
bool LacksCheckValve(const optimizer::Problem& problem, const catalog::Part& part);
// Why there are no pumps although parts of their family are allowed; empty: there are some.
std::string WhyNoPumps(const optimizer::Problem& problem);

// How many pieces of a part of the source a design may have, up to so many a feed, in words.
std::string PiecesWanted(int most, int feeds);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_SUPPLY_OWN_PUMPS_H_
