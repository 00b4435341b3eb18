// simulation/1 becomes response/1.
#ifndef PLENUM_API_SIMULATE_SIMULATION_H_
#define PLENUM_API_SIMULATE_SIMULATION_H_

#include <vector>

#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "catalog/fields/part.h"

namespace plenum::api {

// Whether a request names parts, which it does only by "part": else no catalogue is asked for.
bool NamesAnyPart(const Json& request);

// At most 200,000 samples and so much work; what stops early says so in `status` and `detail`.
Parsed<Json> RunSimulation(const Json& request, const std::vector<catalog::Part>& parts,
                           double seconds_max = kSimulationSecondsMax);

// The same with the series beside the document, unrounded: in the document each is
// { "$array": its index }. As JSON they take several times as long as the simulation.
struct ResponseWithArrays {
  Json document;
  std::vector<std::vector<double>> arrays;
};
Parsed<ResponseWithArrays> RunSimulationToArrays(const Json& request,
                                                 const std::vector<catalog::Part>& parts,
                                                 double seconds_max = kSimulationSecondsMax);

}  // namespace plenum::api

#endif  // PLENUM_API_SIMULATE_SIMULATION_H_
