// Texts with units in place of numbers, in every document: the same numbers come out, and the
// answer says what was understood.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

#include "api/describe/descriptions.h"
#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/words.h"
#include "api/measure/diagnose_request.h"
#include "api/simulate/map.h"
#include "api/simulate/simulation.h"
#include "catalog/store/store.h"
#include "catalog/units/quantity.h"
#include "tests/api/support.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace quantities_test {

using testing::HasSubstr;

// Every number of a field whose name ends in a unit becomes a text in that unit; lists of plain
// numbers stay. Gives how many.
int WriteWithUnits(Json& document) {
  int written = 0;
  for (auto& [name, value] : document.items()) {
    if (value.is_structured()) {
      written += WriteWithUnits(value);
    } else if (document.is_object() && value.is_number() && !catalog::UnitOf(name).empty()) {
      const std::string units = catalog::UnitNames(name);
      value = Decimal(value.get<double>()) + " " + units.substr(0, units.find(','));
      ++written;
    }
  }
  return written;
}

Json Answered(const Parsed<Json>& answer) {
  for (const Error& error : ErrorsOf(answer)) ADD_FAILURE() << error.pointer << error.detail;
  return std::get<Json>(answer);
}

DesignRequest Read(const Json& document) {
  const auto parsed = ParseRequirements(document, SmallCatalogue());
  for (const Error& error : ErrorsOf(parsed))
    ADD_FAILURE() << error.pointer << ": " << error.detail;
  return std::get<DesignRequest>(parsed);
}

std::string DetailOf(const Json& document, const std::string& pointer) {
  return DetailAt(ErrorsOf(ParseRequirements(document, SmallCatalogue())), pointer);
}

Json Only(const Json& list, const std::string& pointer) {
  for (const Json& row : list)
    if (row["pointer"] == pointer) return row;
  return nullptr;
}

TEST(Quantities, OfRequirementsAreThoseOfTheirNumbers) {
  Json written = Requirements();
  EXPECT_GE(WriteWithUnits(written), 13);
  const DesignRequest plain = Read(Requirements()), given = Read(written);
  const auto &a = plain.problem, &b = given.problem;
  EXPECT_EQ(a.groups[0].chamber, b.groups[0].chamber);
  EXPECT_EQ(a.groups[0].tube_length_m, b.groups[0].tube_length_m);
  EXPECT_EQ(a.groups[0].rise_time_max_s, b.groups[0].rise_time_max_s);
  EXPECT_EQ(a.groups[0].pressure_max_pa, b.groups[0].pressure_max_pa);
  EXPECT_EQ(a.frequency_hz, b.frequency_hz);
  EXPECT_EQ(a.mains.pressure_pa, b.mains.pressure_pa);
  EXPECT_EQ(a.mains.flow_max_m3_per_s, b.mains.flow_max_m3_per_s);
  EXPECT_EQ(a.source_pressure_max_pa, b.source_pressure_max_pa);
  EXPECT_EQ(a.ambient.temperature_k, b.ambient.temperature_k);
  EXPECT_EQ(plain.time_limit_s, given.time_limit_s);
  EXPECT_TRUE(plain.remarks.understood.empty());
  EXPECT_GE(given.remarks.understood.size(), 13u);
  EXPECT_EQ(given.request, written);  // comes back as it was given
}

TEST(Quantities, OfSimulationsMapsAndMeasurementsAreThoseOfTheirNumbers) {
  Json simulation = Simulation();
  EXPECT_GE(WriteWithUnits(simulation), 14);
  Json answer = Answered(RunSimulation(simulation, SmallCatalogue()));
  EXPECT_GE(answer["understood"].size(), 14u);
  answer.erase("understood");
  EXPECT_EQ(answer, Answered(RunSimulation(Simulation(), SmallCatalogue())));

  Json measurement = ExampleMeasurement();
  EXPECT_GE(WriteWithUnits(measurement), 6);
  Remarks remarks;
  const auto given = ParseMeasurement(measurement, &remarks);
  const auto plain = ParseMeasurement(ExampleMeasurement());
  ASSERT_TRUE(ErrorsOf(given).empty());
  const auto& run = std::get<calibration::Dataset>(given).runs[0];
  const auto& same = std::get<calibration::Dataset>(plain).runs[0];
  EXPECT_EQ(run.chamber, same.chamber);
  EXPECT_EQ(run.source_pressure_pa, same.source_pressure_pa);
  EXPECT_EQ(run.pressure_pa, same.pressure_pa);
  EXPECT_EQ(Only(remarks.understood, "/rig/actuator/rest_volume_ml")["unit"], "mL");
}

TEST(Quantities, OfAnEvaluationAreToldWithTheirPlace) {
  const auto parts =
      catalog::Store(test::SourceDir() / "catalog.db", catalog::Access::kRead).List();
  Json evaluation = ExampleEvaluation();
  const Json plain = Answered(RunEvaluation(evaluation, parts, {}));
  evaluation["requirements"]["actuators"][0]["operating_pressure_kpa_gauge"] = "0.8 bar";
  evaluation["design"]["settings"]["source_pressure_kpa_gauge"] = "183 kPa abs";
  evaluation["design"]["note"] = "as built";
  Json answer = Answered(RunEvaluation(evaluation, parts, {}));
  const Json& understood = answer["understood"];
  EXPECT_EQ(understood.size(), 2u);
  const std::string at = "/requirements/actuators/0/operating_pressure_kpa_gauge";
  EXPECT_EQ(Only(understood, at)["value"], 80.0);
  EXPECT_EQ(Only(understood, "/design/settings/source_pressure_kpa_gauge")["value"], 83.0);
  EXPECT_EQ(Only(answer["notes"], "/design")["note"], "as built");
  answer.erase("understood");
  answer.erase("notes");
  EXPECT_EQ(answer, plain);
}

TEST(Quantities, AreConvertedByTheRulesOfTheirField) {
  const DesignRequest request =
      Read(With(With(With(Requirements(), "/actuators/0/operating_pressure_kpa_gauge", "14.5 psi"),
                     "/actuators/0/rise_time_s_max", "200 ms"),
                "/supply/mains/flow_l_per_min_anr_max", "100 Nl/min (0 °C)"));
  EXPECT_NEAR(request.problem.groups[0].chamber.operating_pressure_pa, 199'974, 1);
  EXPECT_DOUBLE_EQ(request.problem.groups[0].rise_time_max_s, 0.2);
  EXPECT_NEAR(request.problem.mains.flow_max_m3_per_s * 60e3, 108.744, 1e-3);
  const Json& understood = request.remarks.understood;
  const Json pressure = Only(understood, "/actuators/0/operating_pressure_kpa_gauge");
  EXPECT_EQ(pressure["given"], "14.5 psi");
  EXPECT_NEAR(pressure["value"].get<double>(), 99.97398, 1e-5);
  EXPECT_EQ(pressure["unit"], "kPa gauge");
  EXPECT_EQ(Only(understood, "/supply/mains/flow_l_per_min_anr_max")["condition"],
            "0 °C and 101.325 kPa (DIN 1343)");
}

TEST(Quantities, MakeAbsolutePressuresGaugeByTheAmbientOfTheDocument) {
  Json document = With(Requirements(), "/ambient/pressure_kpa_abs", "0.8 bar");
  document["actuators"][0]["operating_pressure_kpa_gauge"] = "1.8 bar(a)";
  const auto& problem = Read(document).problem;
  EXPECT_DOUBLE_EQ(problem.groups[0].chamber.operating_pressure_pa, 180e3);
  EXPECT_DOUBLE_EQ(problem.ambient.pressure_pa, 80e3);
}

TEST(Quantities, ThatCannotBeReadNameFieldValueAndRange) {
  const auto detail = [](const char* text) {
    return DetailOf(With(Requirements(), "/actuators/0/operating_pressure_kpa_gauge", text),
                    "/actuators/0/operating_pressure_kpa_gauge");
  };
  EXPECT_EQ(detail("15 kg"),
            "must be a finite number, or a text of a number and one of kPa, Pa, mbar, bar, MPa, "
            "psi, inHg, mmHg, cmH2O; is \"15 kg\"; allowed are ≥ -99 and ≤ 10000 kPa gauge");
  EXPECT_THAT(detail("15"), HasSubstr("is \"15\": the unit is missing; allowed are ≥ -99"));
  EXPECT_EQ(detail("20 MPa"), "must be ≥ -99 and ≤ 10000 kPa gauge, not 20000 (\"20 MPa\")");
  EXPECT_THAT(detail("1,500 kPa"), HasSubstr("the comma may stand before decimals"));
  EXPECT_THAT(DetailOf(With(Requirements(), "/supply/mains/flow_l_per_min_anr_max", "9 Nl/min"),
                       "/supply/mains/flow_l_per_min_anr_max"),
              HasSubstr("at 0 °C or at 20 °C"));
  // No unit in the name, no text.
  EXPECT_EQ(DetailOf(With(Requirements(), "/actuators/0/expansion_ratio", "2 x"),
                     "/actuators/0/expansion_ratio"),
            "must be a number ≥ 1 and ≤ 1000, not the text \"2 x\"");
}

TEST(Quantities, SharesMayBeInPercent) {
  Json request = Requirements();
  request["actuators"][0]["phase"] = 0.0;
  request["actuators"][0]["inflate_fraction"] = "25 %";
  const DesignRequest read = Read(request);
  EXPECT_EQ(read.problem.groups[0].gait.inflate_fraction, 0.25);
  EXPECT_THAT(read.remarks.understood.dump(), HasSubstr("\"25 %\""));
  const auto detail = [](const char* text) {
    Json wrong = With(Requirements(), "/actuators/0/inflate_fraction", text);
    return DetailOf(With(wrong, "/actuators/0/phase", 0.0), "/actuators/0/inflate_fraction");
  };
  EXPECT_EQ(detail("250 %"), "must be ≥ 0.01 and ≤ 0.99, not 2.5 (\"250 %\")");
  EXPECT_EQ(detail("a quarter"), "must be a number ≥ 0.01 and ≤ 0.99, not the text \"a quarter\"");
  // More than one of a thing is no share.
  EXPECT_EQ(DetailOf(With(Requirements(), "/actuators/0/expansion_ratio", "150 %"),
                     "/actuators/0/expansion_ratio"),
            "must be a number ≥ 1 and ≤ 1000, not the text \"150 %\"");
}

TEST(Quantities, AreNotReadInsideSampleArrays) {
  Json measurement = ExampleMeasurement();
  measurement["runs"][0]["pressure_kpa_gauge"][3] = "86.2 kPa";
  EXPECT_THAT(DetailAt(ErrorsOf(ParseMeasurement(measurement)), "/runs/0/pressure_kpa_gauge/3"),
              HasSubstr("must be a number or null, not the text"));
}

// 6 in by 3/8 in hold 10.859 mL; the ratio at a contraction of 0.2 from 25° by the length of its
// threads, as physics/actuator_shapes_test.cc has it.
TEST(Quantities, TheGloveInPsiAndInchesFindsADesign) {
  const auto parts =
      catalog::Store(test::SourceDir() / "catalog.db", catalog::Access::kRead).List();
  std::ifstream file(test::SourceDir() / "examples/mckibben_glove.json");
  Json document = Parse(std::string(std::istreambuf_iterator<char>(file), {}));
  document["ranking"] = {{"count", 1}, {"time_limit_s", 200}};
  const auto parsed = ParseRequirements(document, parts);
  ASSERT_TRUE(ErrorsOf(parsed).empty());
  const auto& request = std::get<DesignRequest>(parsed);
  const auto& group = request.problem.groups[0];
  EXPECT_NEAR(group.chamber.rest_volume_m3, 10.8593e-6, 1e-9);
  EXPECT_NEAR(group.chamber.operating_pressure_pa - group.chamber.ambient_pressure_pa, 206'843, 1);
  EXPECT_NEAR(group.chamber.expansion_ratio, 2.12449, 1e-5);
  const Json answer = AnswerRequest(request, {}, parts);
  EXPECT_EQ(answer["status"], "optimal");
  EXPECT_EQ(answer["designs"].size(), 1u);
  EXPECT_GE(answer["understood"].size(), 13u);
  EXPECT_EQ(answer["requirements"], document);
}

TEST(Notes, StandInEveryObjectAndComeBackUnchanged) {
  Json document = Simulation();
  std::map<std::string, Json> given;
  // Every object, lists included.
  const auto add = [&](auto&& self, Json& at, const std::string& pointer) -> void {
    if (at.is_array())
      for (std::size_t i = 0; i < at.size(); ++i)
        self(self, at[i], pointer + "/" + std::to_string(i));
    if (!at.is_object()) return;
    for (auto& [name, value] : at.items())
      self(self, value, std::string(pointer).append("/").append(name));
    at["note"] = "measured on “Tuesday” at " + pointer;
    given[pointer] = at["note"];
  };
  add(add, document, "");
  const Json answer = Answered(RunSimulation(document, SmallCatalogue()));
  std::map<std::string, Json> back;
  for (const Json& note : answer["notes"]) back[note["pointer"]] = note["note"];
  EXPECT_EQ(back, given);
  EXPECT_GE(back.size(), 10u);
}

TEST(Notes, OfRequirementsAndMapsComeBack) {
  Json document = With(Requirements(), "/actuators/0/note", "left leg");
  document["note"] = Json{{"ticket", 17}};
  const Remarks remarks = Read(document).remarks;
  EXPECT_EQ(Only(remarks.notes, "/actuators/0")["note"], "left leg");
  EXPECT_EQ(Only(remarks.notes, "")["note"], (Json{{"ticket", 17}}));
  const Json answer = Answered(RunMap(With(Map(), "/note", "coarse")));
  EXPECT_EQ(answer["notes"], Json::parse(R"([{"pointer": "", "note": "coarse"}])"));
}

TEST(Slips, AreWarnedOfAndChangeNothing) {
  const struct {
    const char* pointer;
    double value;
    const char* meant;
  } cases[] = {{"/actuators/0/operating_pressure_kpa_gauge", 14.5, "14.5 psi"},
               {"/actuators/0/rise_time_s_max", 500, "500 ms"},
               {"/actuators/0/fall_time_s_max", 600, "600 ms"},
               {"/actuators/0/rest_volume_ml", 0.05, "0.05 L"},
               {"/supply/mains/pressure_kpa_gauge", 6, "6 bar"},
               {"/supply/source_pressure_kpa_gauge_max", 6, "6 bar"},
               {"/supply/mass_kg_max", 2500, "2500 g"},
               {"/actuators/0/tube_length_m", 50, "50 cm"}};
  EXPECT_TRUE(Read(Requirements()).remarks.warnings.empty());
  for (const auto& [pointer, value, meant] : cases) {
    Json document = With(Requirements(), "/actuators/0/operating_pressure_kpa_gauge", 2);
    document["actuators"][0].erase("pressure_kpa_gauge_max");
    document = With(document, pointer, value);
    const DesignRequest request = Read(document);
    const Json warning = Only(request.remarks.warnings, pointer);
    ASSERT_FALSE(warning.is_null()) << pointer;
    EXPECT_THAT(warning["detail"].get<std::string>(), HasSubstr(std::string("is ") + meant));
    EXPECT_EQ(request.request, document);
  }
  // A text says its unit: there is nothing to warn of.
  const Json sure = With(Requirements(), "/actuators/0/operating_pressure_kpa_gauge", "14.5 kPa");
  EXPECT_TRUE(Read(sure).remarks.warnings.empty());
}

TEST(Slips, OfAMeasurementStandAmongItsWarnings) {
  DiagnosisRequest request;
  Json measurement = ExampleMeasurement();
  measurement["rig"]["actuator"]["rest_volume_ml"] = 0.05;
  measurement["rig"]["actuator"]["note"] = "silicone";
  const auto parsed = ParseMeasurement(measurement, &request.remarks);
  request.dataset = std::get<calibration::Dataset>(parsed);
  request.time_limit_s = 0.01;
  const Json answer = RunDiagnosis(request, {}).answer;
  EXPECT_THAT(answer["warnings"].dump(), HasSubstr("/rig/actuator/rest_volume_ml is read as 0.05"));
  EXPECT_EQ(answer["notes"][0]["note"], "silicone");
}

TEST(Quantities, ActuationsMayBeATime) {
  const auto problem_of = [](Json duty) {
    Json request = Parse(R"({ "schema": "requirements/1",
      "actuators": [ { "rest_volume_ml": 50, "expansion_ratio": 2,
                       "operating_pressure_kpa_gauge": 100, "tube_length_m": 0.5 } ] })");
    request["duty"] = std::move(duty);
    return Read(request).problem;
  };
  const optimizer::Problem often =
      problem_of({{"frequency_hz", "every 3 s"}, {"actuations", "2 h"}});
  EXPECT_NEAR(often.frequency_hz, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(often.actuations, 2400);
  EXPECT_EQ(problem_of({{"frequency_hz", 0.3}, {"actuations", "1 min"}}).actuations, 18);
  EXPECT_EQ(problem_of({{"frequency_hz", 0.3}, {"actuations", "61 s"}}).actuations, 19);
  for (const char* text : {"2 bar", "-2 h", "1e9 h", "long"}) {
    Json request = Requirements();
    request["duty"]["actuations"] = text;
    EXPECT_THAT(DetailOf(request, "/duty/actuations"), HasSubstr("for how long")) << text;
  }
}

}  // namespace quantities_test
}  // namespace plenum::api
