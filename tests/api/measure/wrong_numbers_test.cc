// Declared numbers that are wrong, in the answer and out of the saved model.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "api/measure/curves.h"
#include "api/measure/diagnose_request.h"
#include "api/measure/diagnosis_document.h"
#include "api/measure/revision_of_diagnosis.h"
#include "tests/api/measure/recorded_bench.h"
#include "tests/api/support.h"
#include "tests/support/sample_diagnosis.h"

namespace plenum::api {
namespace wrong_numbers_test {

using calibration::Declared;

test::SampleDiagnosis WithAWrongSource() {
  test::SampleDiagnosis sample = test::MakeSampleDiagnosis(101);
  sample.diagnosis.numbers = {{.number = Declared::kSourcePressure,
                               .factor = 0.8,
                               .deviation_sigma = -20.0,
                               .instead_of = {"supply_droop", "leak"}}};
  sample.diagnosis.stability = {{"even readings", 31.5, true}, {"without r1", {}, false}};
  sample.diagnosis.candidates[0].effects = {"creep", "number:source_pressure"};
  sample.diagnosis.fitted = {{Declared::kSourcePressure, {0.8, 0.79, 0.81, true}},
                             {Declared::kSonicConductance, {1.02, 1.015, 1.025, true}}};
  return sample;
}

TEST(WrongNumbersDocument, SaysDeclaredAndFittedInTheContractsUnits) {
  const test::SampleDiagnosis sample = WithAWrongSource();
  const Json answer = RenderDiagnosis(sample.diagnosis, sample.dataset);
  ASSERT_EQ(answer.at("numbers").size(), 1u);
  const Json& number = answer.at("numbers")[0];
  EXPECT_EQ(number.at("name"), "source_pressure");
  EXPECT_NEAR(number.at("declared").get<double>(), 150.0, 1e-9);  // of the first run, kPa gauge
  EXPECT_NEAR(number.at("fitted").get<double>(), 120.0, 1e-9);
  EXPECT_EQ(number.at("unit"), "kpa_gauge");
  EXPECT_EQ(number.at("deviation_sigma"), -20.0);
  EXPECT_EQ(number.at("instead_of"), Json({"supply_droop", "leak"}));
  EXPECT_EQ(answer.at("candidates")[0].at("effects"), Json({"creep", "number:source_pressure"}));
  EXPECT_TRUE(answer.at("candidates")[0].at("laws").empty());
  EXPECT_EQ(answer.at("stability"),
            Json::parse(R"([{ "change": "even readings", "delta_bic": 31.5, "holds": true },
                            { "change": "without r1", "delta_bic": null, "holds": false }])"));
}

TEST(WrongNumbersDocument, SaysWhatToSettleAndWhetherUnseenRunsArePredictedBetter) {
  test::SampleDiagnosis sample = test::MakeSampleDiagnosis(101);
  EXPECT_TRUE(RenderDiagnosis(sample.diagnosis, sample.dataset).at("slips").empty());
  sample.diagnosis.slips = {{"the runs fit better if the readings are in psi, not kPa", "psi"}};
  sample.diagnosis.before.holdout_rms_pa = 900.0;
  sample.diagnosis.after.holdout_rms_pa = 910.0;
  Json answer = RenderDiagnosis(sample.diagnosis, sample.dataset);
  EXPECT_EQ(answer.at("slips")[0].at("assume"), "psi");
  EXPECT_EQ(answer.at("predicts_better"), false);
  sample.diagnosis.after.holdout_rms_pa.reset();
  EXPECT_TRUE(RenderDiagnosis(sample.diagnosis, sample.dataset).at("predicts_better").is_null());
}

// The rows of what stays, in their order.
TEST(WrongNumbersDocument, StaysOutOfTheSavedModel) {
  test::SampleDiagnosis sample = WithAWrongSource();
  sample.diagnosis.covariance.assign(4, std::vector<double>(4, 0.0));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      sample.diagnosis.covariance[i][j] = static_cast<double>(10 * std::min(i, j) + std::max(i, j));
  const SavedModel saved = RevisionOf(sample.diagnosis, {});
  ASSERT_EQ(saved.factors.size(), 1u);
  EXPECT_EQ(saved.factors[0].first, Declared::kSonicConductance);
  EXPECT_THAT(saved.covariance.parameters,
              testing::ElementsAre("creep.fraction", "creep.time_constant_s", "sonic_conductance"));
  const std::vector<std::vector<double>> rows = {{0, 1, 3}, {1, 11, 13}, {3, 13, 33}};
  EXPECT_EQ(saved.covariance.rows, rows);
}

// Two runs of a chamber that is fed from 120 kPa where 150 are declared, by the independent
// simulator; what the answer states gives back its curves.
Json Measured() {
  Json document = DeclaredBench();
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.15);
  for (const double source_kpa : {150.0, 200.0}) {
    test::EffectRig rig;
    rig.source_pa = 1e5 + 0.8e3 * source_kpa;
    rig.schedule = {{0.0, 0}, {0.2, 1}, {1.2, 0}, {2.0, -1}, {3.5, 0}};
    document["runs"].push_back(RecordedBench(source_kpa == 150.0 ? "low" : "high", rig, source_kpa,
                                             rig.schedule, [&] { return noise(random); }));
  }
  return document;
}

TEST(WrongNumbersDocument, AnAnswerOfANumberAloneIsItsModel) {
  DiagnosisRequest request;
  request.measurement = Measured();
  request.dataset = std::get<calibration::Dataset>(ParseMeasurement(request.measurement));
  const DiagnosisAnswer found = RunDiagnosis(request, {});
  const Json& answer = found.answer;
  ASSERT_EQ(answer.at("verdict"), "explained") << answer.at("sentence");
  EXPECT_TRUE(answer.at("effects").empty());
  ASSERT_EQ(answer.at("numbers").size(), 1u);
  EXPECT_EQ(answer.at("numbers")[0].at("name"), "source_pressure");
  EXPECT_NEAR(answer.at("numbers")[0].at("fitted").get<double>(), 120.0, 1.2);
  EXPECT_NEAR(answer.at("after").at("factors").at("source_pressure").get<double>(), 0.8, 0.008);
  EXPECT_EQ(answer.at("stability").size(), 6u);
  const Json printed = Parse(answer.dump());
  const Parsed<Json> curves =
      RunCurves({{"schema", "simulation/1"}, {"from", printed}, {"model", "after"}});
  ASSERT_TRUE(std::holds_alternative<Json>(curves));
  EXPECT_NEAR(std::get<Json>(curves).at("rms_kpa").get<double>() /
                  answer.at("after").at("rms_kpa").get<double>(),
              1.0, 1e-6);
  ASSERT_TRUE(found.revision.has_value());
  EXPECT_TRUE(found.revision->factors.empty());
}

}  // namespace wrong_numbers_test
}  // namespace plenum::api
