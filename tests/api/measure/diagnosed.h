// A measurement document diagnosed, and what must hold of each answer.
#ifndef PLENUM_TESTS_API_MEASURE_DIAGNOSED_H_
#define PLENUM_TESTS_API_MEASURE_DIAGNOSED_H_

#include <gtest/gtest.h>

#include <variant>

#include "api/measure/curves.h"
#include "api/measure/diagnose_request.h"
#include "tests/api/measure/read_dataset.h"
#include "tests/api/support.h"

namespace plenum::api {

inline Json DiagnosedOf(const Json& measurement, double time_limit_s = kDiagnosisTimeS) {
  DiagnosisRequest request;
  request.time_limit_s = time_limit_s;
  request.dataset = Read(measurement);
  request.measurement = measurement;
  return Parse(RunDiagnosis(request, {}).answer.dump());
}

// The curves of each model of an answer have the errors that it states.
inline void ExpectCurvesAsStated(const Json& answer) {
  for (const char* model : {"declared", "before", "after"}) {
    const Parsed<Json> curves =
        RunCurves({{"schema", "simulation/1"}, {"from", answer}, {"model", model}});
    ASSERT_TRUE(std::holds_alternative<Json>(curves))
        << DetailAt(ErrorsOf(curves), "/from") << DetailAt(ErrorsOf(curves), "/from/after");
    for (const Json& run : std::get<Json>(curves).at("runs"))
      EXPECT_NEAR(run.at("rms_kpa").get<double>(), run.at("stated_rms_kpa").get<double>(),
                  1e-6 * run.at("stated_rms_kpa").get<double>())
          << model << " " << run.at("id");
  }
}

}  // namespace plenum::api

#endif  // PLENUM_TESTS_API_MEASURE_DIAGNOSED_H_
