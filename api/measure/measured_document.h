// Measured numbers of parts in the answer of a diagnosis:
//   "measured": [ { "part", "number", "field", "declared", "fitted", "unit", "uncertainty",
//                   "interval_95": [ low, high ], "refused": null or the reason } ]
// `number` is the name in the rig's "measure", `field` that of the part; `uncertainty` is relative,
// one standard deviation, null where the interval holds 0. Of a pump one row for each point of its
// table, with "pressure_kpa_gauge". "measured_refused" holds the reasons for which none of them may
// go into the catalogue (calibration/names/measured_numbers.h).
#ifndef PLENUM_API_MEASURE_MEASURED_DOCUMENT_H_
#define PLENUM_API_MEASURE_MEASURED_DOCUMENT_H_

#include "api/json/json.h"
#include "calibration/values/diagnosis.h"

namespace plenum::api {

void AddMeasured(const calibration::Diagnosis& diagnosis, const calibration::Dataset& dataset,
                 Json& answer);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_MEASURED_DOCUMENT_H_
