// A case as the program's own values: the declared rig and the readings, and the true model.
#ifndef PLENUM_TESTS_SUPPORT_BENCH_BENCH_DATASET_H_
#define PLENUM_TESTS_SUPPORT_BENCH_BENCH_DATASET_H_

#include <vector>

#include "api/json/json.h"
#include "calibration/values/dataset.h"
#include "model/effects/effect.h"
#include "tests/support/bench/bench_case.h"

namespace plenum::test {

// One run of the case with a record of it.
calibration::Run ToRun(const BenchCase& bench, const BenchRun& run, const Record& record);

calibration::Dataset ToDataset(const BenchCase& bench);

// The same without the sensor's faults: clean readings at their true times.
calibration::Dataset NoiseFree(const BenchCase& bench);

// The case's listed effects as the model has them.
std::vector<model::Effect> ListedOf(const BenchCase& bench);
std::vector<model::Effect> ListedOf(const api::Json& truth);  // see bench_json.h

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BENCH_BENCH_DATASET_H_
