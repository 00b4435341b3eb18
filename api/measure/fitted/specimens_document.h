// What each piece of the actuator has of its own, as a diagnosis found it.
#ifndef PLENUM_API_MEASURE_FITTED_SPECIMENS_DOCUMENT_H_
#define PLENUM_API_MEASURE_FITTED_SPECIMENS_DOCUMENT_H_

#include "api/json/json.h"
#include "calibration/values/dataset.h"
#include "calibration/values/diagnosis.h"

namespace plenum::api {

// Where a run names its specimen, adds
//   specimens: [ { name, runs, fitted: { rest_volume, … }, words } ]
// in the order of their first runs, and specimen_spread: the standard deviation between the fitted
// specimens over their mean, by number, where at least two were fitted. Of several chambers a list
// of them, `chambers`, whose runs are those of their gauges.
void AddSpecimens(const calibration::Diagnosis& diagnosis, const calibration::Dataset& dataset,
                  Json& answer);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_FITTED_SPECIMENS_DOCUMENT_H_
