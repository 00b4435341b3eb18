// Several chambers behind one valve, of the rig of a measurement (calibration/values/several.h).
//
//   "chambers": [ { "name", the fields of an actuator, "line", "from" }, … ]
// in place of "actuator". In a row (the default) the rig's line leads to the first, and the line of
// each other one from the one before, or from the earlier one that `from` names. Side by side
// ("arrangement": "side_by_side") each branches off a junction of `junction_volume_ml` behind the
// rig's line. `pressure_of` names the chamber that the runs' pressure_kpa_gauge is of, the first
// one by default.
#ifndef PLENUM_API_MEASURE_RIG_SEVERAL_CHAMBERS_H_
#define PLENUM_API_MEASURE_RIG_SEVERAL_CHAMBERS_H_

#include <functional>
#include <string>
#include <vector>

#include "api/json/reader.h"
#include "calibration/values/dataset.h"

namespace plenum::api {

// Its `gauge` is the chamber of `pressure_of`; no `shot`.
calibration::Several ReadSeveral(Reader& rig, const model::Ambient& ambient);

// The readings of the other chambers, by chamber of `several`; empty where there are none.
using ChamberReadings = std::vector<std::vector<double>>;

// "chambers" of a run's channels, { name: [readings] }. `read` reads one list by its name.
ChamberReadings ReadChamberChannels(
    Reader& channels, const calibration::Several& several,
    const std::function<std::vector<double>(Reader&, const std::string&)>& read);

// What a run of several chambers cannot say.
void CheckSeveral(Reader& owner, const calibration::Run& run);

// The run of each other gauge, "r1[tip]": of the same recording, without channels that are
// compared. Sets what each chamber starts above the one with the gauge, in `run`, too.
std::vector<calibration::Run> RunsOfGauges(calibration::Run& run, const ChamberReadings& readings);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_RIG_SEVERAL_CHAMBERS_H_
