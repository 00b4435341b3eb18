// A case as the contract's measurement document, which says nothing of the truth, and the truth as
// a document of its own.
#ifndef PLENUM_TESTS_SUPPORT_BENCH_BENCH_JSON_H_
#define PLENUM_TESTS_SUPPORT_BENCH_BENCH_JSON_H_

#include "api/json/json.h"
#include "tests/support/bench/bench_case.h"

namespace plenum::test {

api::Json RunJson(const BenchCase& bench, const BenchRun& run, const Record& record);

api::Json MeasurementJson(const BenchCase& bench);

// Kind, effects in the contract's units, true values of the declared numbers, noise floor, size,
// supply and faults of the record, and by run the RMS of reading − clean over the readings that are
// neither missing, clipped nor outliers.
api::Json TruthJson(const BenchCase& bench);

// The case that a truth of make_cases is of, by its series, index and kind.
BenchCase CaseOfTruth(const api::Json& truth);

// A proposed experiment ("next_experiment" of a diagnosis): schedule, source, "t_end_s" and
// "sample_hz". A supply that is measured keeps to the level asked for.
BenchRun ExperimentFromJson(const BenchCase& bench, const api::Json& experiment);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BENCH_BENCH_JSON_H_
