#include "api/measure/diagnosis_document.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "tests/support/sample_diagnosis.h"

namespace plenum::api {
namespace diagnosis_document_test {

using calibration::Dataset;
using calibration::Diagnosis;
using test::MakeSampleDiagnosis;

// The example of the contract, letter by letter; values are not compared.
constexpr const char* kContractExample = R"({
  "schema": "diagnosis/1",
  "verdict": "explained",
  "noise_kpa": 0.21,
  "before": { "rms_kpa": 3.4, "rms_percent": 3.4, "peak_kpa": 9.1, "holdout_rms_kpa": 3.6, "runs": { "r1": 2.9 } },
  "after":  { "rms_kpa": 0.23, "rms_percent": 0.23, "peak_kpa": 0.8, "holdout_rms_kpa": 0.24, "runs": { "r1": 0.22 } },
  "effects": [ { "id": "creep", "parameters": { "fraction": { "value": 0.15, "ci95": [0.14, 0.16] }, "time_constant_s": { "value": 2.0, "ci95": [1.8, 2.3] } } } ],
  "candidates": [ { "effects": ["creep"], "bic": -8123.0, "delta_bic": 0.0, "rms_kpa": 0.23, "holdout_rms_kpa": 0.24 } ],
  "tied": [], "next_experiment": null,
  "residual": { "white": true, "independent_of_inputs": true, "phases": [ { "run": "r1", "phase": "hold", "mean_kpa": -1.2, "trend_kpa_per_s": -0.3 } ] },
  "fitted": { "sonic_conductance": { "value": 0.0507, "ci95": [0.0505, 0.0509] } },
  "unexplained_fraction": 0.0
})";

// Every field of `expected` is in `given` with a value of the same type (null fits where there may
// be none); of lists the first elements are compared.
void ExpectShape(const Json& expected, const Json& given, const std::string& where) {
  if (expected.is_null() || given.is_null()) return;
  ASSERT_EQ(expected.is_number(), given.is_number()) << where;
  if (expected.is_number()) return;
  ASSERT_STREQ(expected.type_name(), given.type_name()) << where;
  if (expected.is_object()) {
    for (const auto& [name, value] : expected.items()) {
      ASSERT_TRUE(given.contains(name)) << where << "/" << name;
      ExpectShape(value, given.at(name), std::string(where).append("/").append(name));
    }
  } else if (expected.is_array() && !expected.empty()) {
    ASSERT_FALSE(given.empty()) << where;
    ExpectShape(expected.front(), given.front(), where + "/0");
  }
}

Json RenderSample() {
  const test::SampleDiagnosis sample = MakeSampleDiagnosis(401);
  return RenderDiagnosis(sample.diagnosis, sample.dataset, {{{"bench.json", "ab12"}}, 7});
}

TEST(RenderDiagnosis, HasEveryFieldOfTheContract) {
  ExpectShape(Json::parse(kContractExample), RenderSample(), "");
}

TEST(RenderDiagnosis, SpeaksTheContractsUnits) {
  const Json answer = RenderSample();
  EXPECT_EQ(answer.at("noise_kpa"), 0.21);
  EXPECT_EQ(answer.at("verdict"), "explained");
  const Json& fitted = answer.at("fitted").at("sonic_conductance");
  EXPECT_NEAR(fitted.at("value").get<double>(), 0.051, 1e-9);  // dm³/(s·bar): 1.02 · 0.05
  EXPECT_NEAR(fitted.at("ci95")[0].get<double>(), 0.05075, 1e-9);
  EXPECT_NEAR(fitted.at("ci95")[1].get<double>(), 0.05125, 1e-9);
  EXPECT_EQ(fitted.at("declared"), 0.05);
  EXPECT_EQ(answer.at("candidates")[1].at("effects"), Json({"leak"}));
  EXPECT_EQ(answer.at("candidates")[1].at("laws").at("leak"), "porous");
  EXPECT_EQ(answer.at("tied"), Json::parse(R"([["creep"], ["leak"]])"));
  const Json& next = answer.at("next_experiment");
  EXPECT_EQ(next.at("source_pressure_kpa_gauge"), 200.0);
  EXPECT_EQ(next.at("blocked"), false);
  EXPECT_EQ(next.at("valve")[1], Json::parse(R"({"t_s": 1.3, "state": "hold"})"));
  EXPECT_EQ(next.at("measure"), Json({"pressure_kpa_gauge", "flow_l_per_min_anr"}));
  EXPECT_EQ(next.at("expected_difference_kpa"), 2.3);
  const Json& series = answer.at("series")[2];
  EXPECT_EQ(series.at("held_out"), true);
  EXPECT_EQ(series.at("declared_kpa")[0], 0.0);
  for (const char* name :
       {"phase", "t_s", "measured_kpa", "declared_kpa", "before_kpa", "after_kpa"})
    EXPECT_EQ(series.at(name).size(), 401u) << name;
  EXPECT_EQ(answer.at("provenance").at("files")[0].at("sha256"), "ab12");
  EXPECT_EQ(answer.at("provenance").at("seed"), 7);
}

TEST(RenderDiagnosis, AnEffectOfSeveralLawsNamesItsOwn) {
  test::SampleDiagnosis sample = MakeSampleDiagnosis(401);
  sample.diagnosis.effects = {{{model::FindEffect("leak", "orifice"), {5e-12, 0.3}},
                               {{5e-12, 4e-12, 6e-12}, {0.3, 0.1, 0.5, false}}}};
  const Json effect = RenderDiagnosis(sample.diagnosis, sample.dataset).at("effects")[0];
  EXPECT_EQ(effect.at("parameters").at("law"), "orifice");
  const Json& conductance = effect.at("parameters").at("sonic_conductance_dm3_per_s_bar");
  EXPECT_NEAR(conductance.at("value").get<double>(), 5e-4, 1e-15);
  EXPECT_EQ(effect.at("parameters").at("critical_ratio").at("identified"), false);
}

TEST(RenderDiagnosis, AnEmptyDiagnosisIsUndecidedAndWhole) {
  const Json answer = RenderDiagnosis(Diagnosis{}, Dataset{});
  EXPECT_EQ(answer.at("verdict"), "undecided");
  EXPECT_TRUE(answer.at("next_experiment").is_null());
  EXPECT_TRUE(answer.at("before").at("holdout_rms_kpa").is_null());
  const Json example = Json::parse(kContractExample);
  for (const auto& [name, value] : example.items()) EXPECT_TRUE(answer.contains(name)) << name;
}

// Strict JSON has no NaN and no infinity, whatever a fit left in the numbers.
void ExpectFinite(const Json& value) {
  if (value.is_structured())
    for (const Json& child : value) ExpectFinite(child);
  if (!value.is_number()) return;
  EXPECT_TRUE(std::isfinite(value.get<double>()));
}

TEST(RenderDiagnosis, SurvivesAnyNumberAndAnyLength) {
  std::mt19937_64 generator(3);
  const auto pick = [&](int count) { return static_cast<int>(generator() % count); };
  const auto number = [&] {
    static constexpr double kValues[] = {0.0,
                                         -0.0,
                                         1.0,
                                         -1e308,
                                         1e308,
                                         5e-324,
                                         1e-9,
                                         std::numeric_limits<double>::quiet_NaN(),
                                         std::numeric_limits<double>::infinity(),
                                         -std::numeric_limits<double>::infinity()};
    return kValues[pick(10)];
  };
  const auto numbers = [&] {
    std::vector<double> values(static_cast<std::size_t>(pick(4)));
    for (double& value : values) value = number();
    return values;
  };
  const auto text = [&] {
    return std::string(static_cast<std::size_t>(pick(3)), "a:\"\n\xff"[pick(5)]);
  };
  const test::SampleDiagnosis sample = MakeSampleDiagnosis(21);
  for (int draw = 0; draw < 500; ++draw) {
    Dataset dataset = sample.dataset;
    Diagnosis diagnosis = sample.diagnosis;
    if (pick(2)) dataset.runs.clear();
    for (calibration::Run& run : dataset.runs) {
      run.ambient.pressure_pa = number();
      run.chamber.operating_pressure_pa = number();
      if (pick(2)) run.line.clear();
    }
    for (auto* error : {&diagnosis.declared, &diagnosis.before, &diagnosis.after})
      *error = {number(), number(), number(), number(), {{text(), number()}}};
    for (auto& effect : diagnosis.effects) {
      effect.parameters.resize(static_cast<std::size_t>(pick(4)));
      for (auto& estimate : effect.parameters)
        estimate = {number(), number(), number(), pick(2) > 0};
    }
    for (auto& candidate : diagnosis.candidates)
      candidate = {{text(), text() + ":" + text()},
                   number(),
                   number(),
                   number(),
                   number(),
                   1,
                   true,
                   1,
                   1,
                   text()};
    diagnosis.slips = {{text(), text()}};
    diagnosis.fitted.clear();
    for (int i = 0; i < calibration::kDeclaredCount; ++i)
      diagnosis.fitted.push_back(
          {static_cast<calibration::Declared>(i), {number(), number(), number()}});
    diagnosis.residual.portmanteau = number();
    for (auto& phase : diagnosis.residual.phases) phase.mean_pa = number();
    diagnosis.next_experiment->run.t_s = numbers();
    diagnosis.next_experiment->run.source_pressure_pa = number();
    diagnosis.discrepancy->places = {{text(), text(), number()}};
    diagnosis.series.push_back({text(), false, {}, numbers(), numbers(), numbers(), {}, numbers()});
    diagnosis.sentence = text();
    const Json answer = RenderDiagnosis(diagnosis, dataset);
    ExpectFinite(answer);
    const std::string dumped = answer.dump(-1, ' ', false, Json::error_handler_t::replace);
    EXPECT_EQ(Json::parse(dumped).at("schema"), "diagnosis/1");
  }
}

}  // namespace diagnosis_document_test
}  // namespace plenum::api
