// An answer is its model: every curve of a diagnosis, simulated from the numbers that the answer
// prints, is off the readings by the error that it states.
#include "api/measure/curves.h"

#include <gtest/gtest.h>

#include <string>

#include "api/measure/diagnose_request.h"
#include "api/measure/inputs_document.h"
#include "api/measure/stated_document.h"
#include "tests/api/support.h"
#include "tests/support/bench/bench_json.h"

namespace plenum::api {
namespace curves_test {

using test::CaseKind;

Json Diagnosed(const Json& measurement) {
  DiagnosisRequest request;
  request.dataset = std::get<calibration::Dataset>(ParseMeasurement(measurement));
  request.measurement = measurement;
  return Parse(RunDiagnosis(request, {}).answer.dump());  // as it is printed
}

Json CurvesOf(const Json& answer, const std::string& model, const Json& more = Json::object()) {
  Json request = {{"schema", "simulation/1"}, {"from", answer}, {"model", model}};
  request.update(more);
  const Parsed<Json> curves = RunCurves(request);
  EXPECT_TRUE(std::holds_alternative<Json>(curves)) << DetailAt(ErrorsOf(curves), "/from");
  return std::holds_alternative<Json>(curves) ? std::get<Json>(curves) : Json();
}

void ExpectSame(const Json& simulated, const Json& stated, const std::string& what) {
  ASSERT_TRUE(simulated.is_number() && stated.is_number()) << what;
  EXPECT_NEAR(simulated.get<double>() / stated.get<double>(), 1.0, 1e-6) << what;
}

void ExpectStatedErrors(const Json& answer) {
  for (const std::string model : kModelsOfADiagnosis) {
    const Json& stated = answer.at(model);
    if (stated.is_null()) continue;
    const Json curves = CurvesOf(answer, model);
    ExpectSame(curves.at("rms_kpa"), stated.at("rms_kpa"), model);
    ASSERT_EQ(curves.at("runs").size(), stated.at("runs").size());
    for (const Json& run : curves.at("runs"))
      ExpectSame(run.at("rms_kpa"), stated.at("runs").at(run.at("id").get<std::string>()),
                 model + " " + run.at("id").get<std::string>());
    if (!curves.at("holdout_rms_kpa").is_null())
      ExpectSame(curves.at("holdout_rms_kpa"), stated.at("holdout_rms_kpa"), model + " held out");
  }
}

TEST(Curves, OfACleanRigAndOfALeakHaveTheStatedErrors) {
  ExpectStatedErrors(Diagnosed(test::MeasurementJson(test::DrawCase(1, CaseKind::kClean))));
  const Json leak = Diagnosed(test::MeasurementJson(test::DrawCase(4, CaseKind::kFull, "leak")));
  ExpectStatedErrors(leak);
  EXPECT_FALSE(leak.at("after").at("effects").empty());
}

// A seam that gapes is no known effect: a term is learned.
TEST(Curves, OfALearnedTermHaveTheStatedErrors) {
#ifdef PLENUM_SANITIZED
  GTEST_SKIP() << "takes minutes; the test above goes the same way";
#endif
  const Json answer =
      Diagnosed(test::MeasurementJson(test::DrawCase(2, CaseKind::kOutside, "gaping_seam")));
  ASSERT_TRUE(answer.at("learned").is_object());
  ExpectStatedErrors(answer);
  const Json& learned = answer.at("learned").at("effects");
  EXPECT_EQ(learned.back().at("id"), answer.at("discrepancy").at("learned").at("id"));
  const Json& saved = answer.at("revision");
  EXPECT_EQ(saved.at("effects"), learned);
  EXPECT_EQ(saved.at("after_rms_kpa"), answer.at("learned").at("rms_kpa"));
}

// A vessel that loses pressure: 12 readings, the start not declared, one run doubled.
Json Hold() {
  Json document = Parse(R"({
    "schema": "measurement/1",
    "rig": { "actuator": { "rest_volume_ml": 100, "expansion_ratio": 1,
                           "operating_pressure_kpa_gauge": 700 },
             "supply": { "kind": "none" } },
    "runs": [ { "id": "a", "blocked": true, "valve": [], "t_s": [], "pressure_kpa_gauge": [] } ] })");
  Json& run = document["runs"][0];
  for (int i = 0; i < 12; ++i) {
    run["t_s"].push_back(0.5 * i);
    run["pressure_kpa_gauge"].push_back(700.0 - 2.0 * i + 0.1 * ((7 * i) % 5));
  }
  return document;
}

TEST(Curves, StartWhereTheAnswerSays) {
  const Json answer = Diagnosed(Hold());
  ExpectStatedErrors(answer);
  const Json curves = CurvesOf(answer, "after", {{"run", "a"}});
  EXPECT_NEAR(curves.at("runs")[0].at("pressure_kpa_gauge")[0].get<double>(),
              answer.at("runs")[0].at("after").at("initial_pressure_kpa_gauge").get<double>(),
              1e-9);
}

TEST(Curves, OfACopyCountOnce) {
  Json doubled = Hold();
  doubled["runs"].push_back(doubled["runs"][0]);
  doubled["runs"][1]["id"] = "b";
  const Json once = Diagnosed(Hold()), twice = Diagnosed(doubled);
  EXPECT_EQ(twice.at("verdict"), once.at("verdict"));
  EXPECT_EQ(twice.at("after").at("rms_kpa"), once.at("after").at("rms_kpa"));
  EXPECT_EQ(twice.at("candidates"), once.at("candidates"));
  EXPECT_EQ(twice.at("runs")[1].at("copy_of"), "a");
  ExpectStatedErrors(twice);
}

TEST(Curves, WhatCannotBeSimulatedIsNamed) {
  const Json answer = Diagnosed(Hold());
  const auto errors_of = [&](const Json& more) {
    Json request = {{"schema", "simulation/1"}, {"from", answer}};
    request.update(more);
    return ErrorsOf(RunCurves(request));
  };
  EXPECT_NE(DetailAt(errors_of({{"run", "aa"}}), "/run").find("nearest id: a"), std::string::npos);
  EXPECT_NE(DetailAt(errors_of({{"model", "learned"}}), "/from/learned").find("no such model"),
            std::string::npos);
  Json old = answer;
  old.erase("runs");
  EXPECT_NE(DetailAt(errors_of({{"from", old}}), "/from").find("diagnose the measurement again"),
            std::string::npos);
  EXPECT_NE(DetailAt(errors_of({{"from", "unknown"}}), "/from").find("diagnosis/1"),
            std::string::npos);
}

TEST(InputsDocument, LongListsStandByTheirHash) {
  Json measurement = Hold();
  Json& t_s = measurement["runs"][0]["t_s"];
  for (std::size_t i = t_s.size(); i <= kInputsListed; ++i) t_s.push_back(i);
  const Json inputs = InputsOf(measurement);
  EXPECT_EQ(inputs["runs"][0]["t_s"]["values"], kInputsListed + 1);
  EXPECT_EQ(std::get<Json>(WithReadings(inputs, &measurement)), measurement);
  EXPECT_NE(DetailAt(ErrorsOf(WithReadings(inputs, nullptr)), "/measurement/runs/0/t_s")
                .find("give the measurement"),
            std::string::npos);
  Json other = measurement;
  other["runs"][0]["t_s"][3] = 1e6;
  EXPECT_NE(DetailAt(ErrorsOf(WithReadings(inputs, &other)), "/measurement/runs/0/t_s")
                .find("is not what was diagnosed"),
            std::string::npos);
}

}  // namespace curves_test
}  // namespace plenum::api
