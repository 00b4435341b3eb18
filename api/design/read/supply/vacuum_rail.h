// What a request says of actuators under pressure that are pulled below ambient
// (`low_pressure_kpa_gauge`), and of the vacuum that does it.
#ifndef PLENUM_API_DESIGN_READ_SUPPLY_VACUUM_RAIL_H_
#define PLENUM_API_DESIGN_READ_SUPPLY_VACUUM_RAIL_H_

#include <string>

#include "api/json/reader.h"
#include "catalog/fields/part.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// Whether a problem has any: their chambers have a low pressure, where strokes begin, and a vacuum
// to empty into. All its valves hold, and close at the low pressure, too.
bool HasVacuumRail(const optimizer::Problem& problem);

// `supply.vacuum` of such a request: pumps, by default, or the wall's vacuum, as deep as each low
// pressure. Sets what their chambers empty into at the deepest, and keeps of the configurations
// those that go with it; fails where the request names others.
void ReadVacuumRail(Reader& supply, optimizer::Problem& problem);

// The wall's vacuum has no limit on its flow.
void RefuseFlow(Reader& wall);

// Whether a configuration may stand beside the vacuum.
bool GoesWithVacuumRail(optimizer::Configuration configuration);

// Whether the row may be in a line of such a request, true of other requests and parts: it stands
// the vacuum, and a valve closes both ways.
bool SuitsVacuumRail(const optimizer::Problem& problem, const catalog::Part& part);
// Why it may not, as the end of a sentence that begins with its id.
std::string WhyNotForVacuumRail(const catalog::Part& part);

// Of a design on the wall's, kPa gauge; and what one on pumps may have.
double VacuumRailKpa(const optimizer::Problem& problem);
Range PumpedRailRange(const optimizer::Problem& problem);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_SUPPLY_VACUUM_RAIL_H_
