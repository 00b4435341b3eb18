// Runs of several pieces of the actuator, from the document to the answer and back to curves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "api/measure/csv/measurement_csv.h"
#include "api/measure/curves.h"
#include "api/measure/measurement.h"
#include "tests/api/measure/diagnosed.h"
#include "tests/api/measure/read_dataset.h"
#include "tests/api/support.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::api {
namespace specimen_runs_test {

// A piece of 50 mL as declared, whose volume is `share` of that: 100 kPa, filled and emptied once.
Json RunOf(const std::string& id, const std::string& specimen, double share, bool blocked) {
  Json run = Parse(R"({ "source_pressure_kpa_gauge": 200, "initial": { "pressure_kpa_gauge": 0 },
    "valve": [ { "t_s": 0.0, "state": "hold" }, { "t_s": 0.2, "state": "inflate" },
               { "t_s": 0.6, "state": "hold" }, { "t_s": 2.0, "state": "deflate" } ] })");
  run["id"] = id;
  run["blocked"] = blocked;
  if (!specimen.empty()) run["specimen"] = specimen;
  test::EffectRig rig;
  rig.rest_volume_m3 *= share;
  rig.blocked = blocked;
  rig.fill = rig.exhaust = {{0.05e-8, 0.3}};
  rig.schedule = {{0.0, 0}, {0.2, 1}, {0.6, 0}, {2.0, -1}};
  std::vector<double> t_s;
  for (int i = 0; i <= 150; ++i) t_s.push_back(0.02 * i);
  const std::vector<double> pressure_pa = test::SimulateEffects(rig, t_s, 5e-4).measured_pa;
  std::mt19937_64 random(static_cast<std::uint64_t>(id.back()));
  std::normal_distribution<double> noise(0.0, 0.15);
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    run["t_s"].push_back(t_s[i]);
    run["pressure_kpa_gauge"].push_back((pressure_pa[i] - 1e5) / 1e3 + noise(random));
  }
  return run;
}

Json Bench(std::vector<Json> runs) {
  Json document = Parse(R"({
    "schema": "measurement/1", "name": "three fingers",
    "rig": { "actuator": { "rest_volume_ml": 50, "expansion_ratio": 2,
                           "operating_pressure_kpa_gauge": 100 },
             "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
             "supply": { "kind": "regulated" },
             "ambient": { "pressure_kpa_abs": 100, "temperature_k": 293.15 } },
    "relative_uncertainty": { "rest_volume": 0.1, "sonic_conductance": 0.01 } })");
  for (Json& run : runs) document["runs"].push_back(std::move(run));
  return document;
}

// Two named pieces, the runs of one of them apart, and one without a name.
Json ThreePieces() {
  return Bench({RunOf("r1", "thin", 0.9, false), RunOf("r2", "thick", 1.1, false),
                RunOf("r3", "thin", 0.9, true), RunOf("r4", "", 1.0, false)});
}

Json CurvesFrom(const Json& answer, const std::string& model, const std::string& run) {
  const Json request = {
      {"schema", "simulation/1"}, {"from", answer}, {"model", model}, {"run", run}};
  const Parsed<Json> curves = RunCurves(request);
  EXPECT_TRUE(std::holds_alternative<Json>(curves)) << DetailAt(ErrorsOf(curves), "/from");
  return std::holds_alternative<Json>(curves) ? std::get<Json>(curves) : Json();
}

TEST(SpecimenRuns, StandInTheAnswerWithTheirNumbersAndTheirCurves) {
  const Json answer = DiagnosedOf(ThreePieces());
  EXPECT_EQ(answer.at("verdict"), "adequate") << answer.at("sentence");
  const Json& specimens = answer.at("specimens");
  ASSERT_EQ(specimens.size(), 3u);
  const std::vector<std::pair<Json, double>> truth = {
      {"thin", 45.0}, {"thick", 55.0}, {nullptr, 50.0}};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(specimens[i].at("name"), truth[i].first);
    const Json& volume = specimens[i].at("fitted").at("rest_volume");
    EXPECT_LE(volume.at("ci95")[0], truth[i].second);
    EXPECT_GE(volume.at("ci95")[1], truth[i].second);
    EXPECT_EQ(volume.at("unit"), "ml");
    EXPECT_FALSE(specimens[i].at("fitted").contains("sonic_conductance"));
  }
  EXPECT_EQ(specimens[0].at("runs"), Json({"r1", "r3"}));
  EXPECT_NE(specimens[0].at("words").get<std::string>().find("less than declared"),
            std::string::npos);
  EXPECT_NEAR(answer.at("specimen_spread").at("rest_volume").get<double>(), 0.1, 0.01);
  EXPECT_EQ(answer.at("fitted").at("rest_volume").at("specimen"), "thin");
  EXPECT_EQ(answer.at("fitted").at("rest_volume").at("value"),
            specimens[0].at("fitted").at("rest_volume").at("value"));
  EXPECT_FALSE(answer.at("fitted").at("sonic_conductance").contains("specimen"));
  for (const char* model : {"declared", "before", "after"})
    for (const Json& run : answer.at("runs")) {
      const std::string id = run.at("id");
      const Json curves = CurvesFrom(answer, model, id);
      const double stated = answer.at(model).at("runs").at(id);
      EXPECT_NEAR(curves.at("runs")[0].at("rms_kpa").get<double>() / stated, 1.0, 1e-6)
          << model << " " << id;
    }
  EXPECT_EQ(answer.at("runs")[1].at("after").at("factors").at("rest_volume"),
            specimens[1].at("fitted").at("rest_volume").at("factor"));
}

TEST(SpecimenRuns, OfOneNamedPieceAnswerAsWithoutAName) {
  const auto answer = [](const std::string& name) {
    return DiagnosedOf(Bench({RunOf("r1", name, 1.05, false), RunOf("r2", name, 1.05, true)}));
  };
  Json named = answer("thin"), unnamed = answer("");
  EXPECT_EQ(named.at("specimens").size(), 1u);
  EXPECT_EQ(named.at("specimens")[0].at("fitted").at("rest_volume"),
            unnamed.at("fitted").at("rest_volume"));
  EXPECT_TRUE(named.at("specimen_spread").empty());
  for (const char* field : {"specimens", "specimen_spread", "measurement", "provenance"})
    named.erase(field), unnamed.erase(field);
  EXPECT_EQ(named, unnamed);
}

// What is saved is a piece that was not measured: the mean, off by the scatter.
TEST(SpecimenRuns, AreSavedAsTheirMeanWithTheirScatter) {
  const Json answer = DiagnosedOf(ThreePieces());
  const Json& saved = answer.at("revision");
  double mean = 0.0, squares = 0.0;
  for (const Json& specimen : answer.at("specimens"))
    mean += specimen.at("fitted").at("rest_volume").at("factor").get<double>() / 3.0;
  for (const Json& specimen : answer.at("specimens"))
    squares +=
        std::pow(specimen.at("fitted").at("rest_volume").at("factor").get<double>() - mean, 2);
  EXPECT_NEAR(saved.at("factors").at("rest_volume").get<double>(), mean, 1e-9);
  EXPECT_NEAR(answer.at("after").at("factors").at("rest_volume").get<double>(), mean, 1e-9);
  const Json& names = saved.at("covariance").at("parameters");
  EXPECT_EQ(std::count(names.begin(), names.end(), Json("rest_volume")), 1);
  const auto at = static_cast<std::size_t>(
      std::find(names.begin(), names.end(), Json("rest_volume")) - names.begin());
  const double variance = saved.at("covariance").at("matrix")[at][at];
  EXPECT_GT(variance, squares / 2.0);
  EXPECT_LT(variance, 1.2 * squares / 2.0);
}

TEST(SpecimenRuns, HeldOutOfAnotherPieceSayWhatTheyHave) {
  Json document = ThreePieces();
  document["runs"].push_back(RunOf("r5", "other", 1.02, false));
  document["holdout"] = Json::array({"r5"});
  const Json answer = DiagnosedOf(document);
  EXPECT_EQ(answer.at("specimens")[3].at("fitted"), Json::object());
  EXPECT_EQ(answer.at("specimens")[3].at("words"),
            "no fit saw a run of it: it has the mean of the other specimens");
  const Json& warnings = answer.at("warnings");
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const Json& warning) {
    return warning.get<std::string>().starts_with("r5 is of other, of which no fit saw a run");
  }));
  EXPECT_EQ(answer.at("runs")[4].at("after").value("factors", answer.at("after").at("factors")),
            answer.at("after").at("factors"));
  const double stated = answer.at("after").at("runs").at("r5");
  EXPECT_NEAR(CurvesFrom(answer, "after", "r5").at("runs")[0].at("rms_kpa").get<double>(), stated,
              1e-6 * stated);
}

TEST(SpecimenRuns, AreReadInTheOrderOfTheirNames) {
  const calibration::Dataset dataset = Read(ThreePieces());
  EXPECT_EQ(dataset.specimens, (std::vector<std::string>{"thin", "thick", ""}));
  std::vector<std::size_t> places;
  for (const calibration::Run& run : dataset.runs) places.push_back(run.specimen);
  EXPECT_EQ(places, (std::vector<std::size_t>{0, 1, 0, 2}));
  Json none = ThreePieces();
  for (Json& run : none["runs"]) run.erase("specimen");
  EXPECT_TRUE(Read(none).specimens.empty());
  none["runs"][0]["specimen"] = nullptr;
  EXPECT_TRUE(Read(none).specimens.empty());
}

TEST(SpecimenRuns, OfWrongNamesAreRefused) {
  const auto detail = [](const Json& name) {
    Json document = ThreePieces();
    document["runs"][1]["specimen"] = name;
    return DetailAt(ErrorsOf(ParseMeasurement(document)), "/runs/1/specimen");
  };
  EXPECT_NE(detail(3).find("must be the name of the piece"), std::string::npos);
  EXPECT_NE(detail("").find("must have 1 to 100 characters, not 0"), std::string::npos);
  EXPECT_NE(detail(std::string(101, 'x')).find("not 101"), std::string::npos);
  EXPECT_EQ(detail(std::string(100, 'x')), "");
}

// A volume that is written into a part is that of one piece.
TEST(SpecimenRuns, OfSeveralPiecesMeasureNoVolumeOfAPart) {
  Json document = ThreePieces();
  document["rig"]["actuator"]["part"] = "finger";
  document["rig"]["actuator"]["expansion_ratio"] = 1;
  document["rig"]["actuator"]["measure"] = Json::array({"internal_volume"});
  const std::string detail = DetailAt(ErrorsOf(ParseMeasurement(document)), "/runs/1/specimen");
  EXPECT_NE(detail.find("measure each piece by itself"), std::string::npos) << detail;
  for (Json& run : document["runs"]) run["specimen"] = "thin";
  EXPECT_EQ(Read(document).specimens.size(), 1u);
}

TEST(SpecimenRuns, AreAColumnOfATable) {
  const Json rig = Parse(R"({ "rig": { "actuator": { "rest_volume_ml": 50, "expansion_ratio": 1,
      "operating_pressure_kpa_gauge": 100 }, "supply": { "kind": "none" } } })");
  const auto table = [](const std::string& last) {
    std::string text = "run,specimen,t_s,valve,pressure_kpa_gauge\n";
    for (int i = 0; i < 10; ++i)
      for (const char* row : {"a,thin", "b,thick", "c,"})
        text +=
            row + std::string(",") + std::to_string(i) + ",hold," + std::to_string(90 - i) + "\n";
    return text + last;
  };
  const auto document = MeasurementFromCsv(table(""), rig, {});
  ASSERT_TRUE(std::holds_alternative<Json>(document));
  const Json& runs = std::get<Json>(document).at("runs");
  EXPECT_EQ(runs[0].at("specimen"), "thin");
  EXPECT_EQ(runs[1].at("specimen"), "thick");
  EXPECT_FALSE(runs[2].contains("specimen"));
  const Errors errors = ErrorsOf(MeasurementFromCsv(table("a,thick,10,hold,80\n"), rig, {}));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].detail.find("must be one for all rows of run \"a\""), std::string::npos)
      << errors[0].detail;
}

}  // namespace specimen_runs_test
}  // namespace plenum::api
