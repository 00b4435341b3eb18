// What a request says of the vacuum that evacuates its actuators.
#ifndef PLENUM_API_DESIGN_READ_SUPPLY_VACUUM_READER_H_
#define PLENUM_API_DESIGN_READ_SUPPLY_VACUUM_READER_H_

#include "api/json/reader.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// `vacuum` of `supply`: sets the configurations of an evacuated problem in place of those of
// pressure, and its deepest source pressure (mirrored). Fails where the actuators do not agree:
// some are evacuated and some not, or none is and `vacuum` is given.
void ReadVacuum(Reader& supply, optimizer::Problem& problem);

// The same errors as for sources of pressure: what no choice of parts can mend.
void CheckVacuum(const optimizer::Problem& problem, Errors& errors);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_SUPPLY_VACUUM_READER_H_
