// Double-acting cylinders: two chambers of one entry, filled in turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "api/design/read/requirements_reader.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace double_acting_test {

constexpr double kPi = 3.14159265358979;

Json Asked() {
  Json request = Example("double_acting_lift");
  request["ranking"] = {{"count", 2}, {"proof", true}};
  return request;
}

// The same by hand: both chambers with their volumes, half a period apart.
Json ByHand() {
  Json request = Asked();
  Json cap = request["actuators"][0];
  cap.erase("cylinder");
  const double area_mm2 = kPi / 4 * 16 * 16, rod_mm2 = kPi / 4 * 6 * 6, stroke_mm = 50;
  const double rest_ml = 0.05 * area_mm2 * stroke_mm / 1e3;  // of both sides
  const auto side = [&](const char* name, double mm2, double phase) {
    Json group = cap;
    group["name"] = name;
    group["rest_volume_ml"] = rest_ml;
    group["expansion_ratio"] = 1 + mm2 * stroke_mm / 1e3 / rest_ml;
    group["phase"] = phase;
    return group;
  };
  request["actuators"] =
      Json::array({side("cap", area_mm2, 0.0), side("rod", area_mm2 - rod_mm2, 0.5)});
  return request;
}

const Json& TheAnswer() {
  static const Json answer = Answered(Asked());
  return answer;
}

std::vector<Json> PartIds(const Json& design) {
  std::vector<Json> ids;
  for (const Json& row : design["parts"]) ids.push_back(row["id"]);
  return ids;
}

TEST(DoubleActing, IsTwoChambersWrittenByHand) {
  const Json &answer = TheAnswer(), by_hand = Answered(ByHand());
  EXPECT_EQ(answer["status"], "optimal");
  ASSERT_EQ(answer["designs"].size(), 2U);
  ASSERT_EQ(by_hand["designs"].size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& design = answer["designs"][i];
    const Json& other = by_hand["designs"][i];
    EXPECT_EQ(PartIds(design), PartIds(other));
    EXPECT_NEAR(design["objective"].get<double>(), other["objective"].get<double>(), 1e-9);
    const Json& groups = design["performance"]["groups"];
    ASSERT_EQ(groups.size(), 2U);
    EXPECT_EQ(groups[0]["name"], "lift, cap side");
    EXPECT_EQ(groups[1]["name"], "lift, rod side");
    for (std::size_t g = 0; g < 2; ++g)
      for (const char* field : {"rise_time_s", "fall_time_s", "peak_kpa_gauge"})
        EXPECT_NEAR(groups[g][field].get<double>(),
                    other["performance"]["groups"][g][field].get<double>(), 1e-8)
            << field;
  }
  EXPECT_EQ(Refusals(answer), "");
}

double NumberOf(const std::string& id, const std::string& field) {
  for (const catalog::Part& part : Project().parts)
    if (part.id == id) return part.numbers.at(field).value;
  return std::nan("");
}

// Both sides of two cylinders in each period: p_op·(V_op + tube) − p_a·(V_0 + tube).
TEST(DoubleActing, TakesTheAirThatTheGasLawSays) {
  for (const Json& design : TheAnswer()["designs"]) {
    // A valve that does not hold fills up to the source pressure.
    if (design["performance"]["groups"][0]["peak_kpa_gauge"] != 400.0) continue;
    std::vector<double> bores_mm;
    for (const Json& row : design["parts"])
      if (row["family"] == "tubing") bores_mm.push_back(NumberOf(row["id"], "inner_diameter_mm"));
    ASSERT_EQ(bores_mm.size(), 2U);
    double air_kpa_ml = 0.0;
    for (int side = 0; side < 2; ++side) {
      const double area_mm2 = kPi / 4 * (16 * 16 - (side ? 6 * 6 : 0));
      const double tube_ml = kPi / 4 * bores_mm[side] * bores_mm[side] * 0.5;
      const double rest_ml = 0.05 * kPi / 4 * 16 * 16 * 0.05;
      air_kpa_ml += 500.0 * (area_mm2 * 0.05 + rest_ml + tube_ml) - 100.0 * (rest_ml + tube_ml);
    }
    EXPECT_NEAR(design["performance"]["air_total_l_anr"].get<double>(),
                1000 * 2 * air_kpa_ml / 100 / 1e3, 0.01);
    EXPECT_NEAR(design["performance"]["air_per_actuation_l_anr"].get<double>(),
                air_kpa_ml / 100 / 1e3, 1e-5);
  }
}

// Each requirement of the entry stands once, with the worse of both sides.
TEST(DoubleActing, RequirementsAreOfTheEntry) {
  for (const Json& design : TheAnswer()["designs"]) {
    const Json& groups = design["performance"]["groups"];
    int rises = 0;
    for (const Json& margin : design["margins"]) {
      EXPECT_FALSE(margin["requirement"].get<std::string>().starts_with("/actuators/1"));
      if (margin["requirement"] != "/actuators/0/rise_time_s_max") continue;
      ++rises;
      EXPECT_EQ(margin["achieved"].get<double>(), std::max(groups[0]["rise_time_s"].get<double>(),
                                                           groups[1]["rise_time_s"].get<double>()));
    }
    EXPECT_EQ(rises, 1);
  }
  Json hopeless = Asked();
  hopeless["actuators"][0]["rise_time_s_max"] = 1e-4;
  const Json none = Answered(hopeless);
  EXPECT_EQ(none["status"], "infeasible");
  ASSERT_EQ(none["conflict"].size(), 1U);
  EXPECT_EQ(none["conflict"][0]["requirement"], "/actuators/0/rise_time_s_max");
}

TEST(DoubleActing, ADesignIsEvaluatedAsItWasListed) {
  for (const Json& design : TheAnswer()["designs"]) {
    const auto evaluated = Evaluated(Asked(), design);
    for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
    const Json& answer = std::get<Json>(evaluated);
    EXPECT_EQ(answer["works"], true);
    EXPECT_EQ(answer["margins"].size(), design["margins"].size());
    EXPECT_NEAR(answer["totals"]["mass_kg"].get<double>(),
                design["totals"]["mass_kg"].get<double>(), 1e-9);
  }
}

TEST(DoubleActing, VerifyRefusesWhatIsTamperedWith) {
  const Tampering kTamperings[] = {
      {"another rod", "strokes",
       [](Json& a) { a["requirements"]["actuators"][0]["cylinder"]["rod_mm"] = 12; }},
      {"a quicker side", "strokes", [](Json& a) {
         Json& group = a["designs"][0]["performance"]["groups"][1];
         group["rise_time_s"] = 0.9 * group["rise_time_s"].get<double>();
       }}};
  ExpectRefused(TheAnswer(), kTamperings);
}

TEST(DoubleActing, SaysWhatItIsNot) {
  const auto parsed = ParseRequirements(Asked(), Project().parts);
  ASSERT_TRUE(std::holds_alternative<DesignRequest>(parsed));
  const Json& warnings = std::get<DesignRequest>(parsed).remarks.warnings;
  const bool said = std::any_of(warnings.begin(), warnings.end(), [](const Json& warning) {
    return warning["pointer"] == "/actuators/0/cylinder";
  });
  EXPECT_TRUE(said) << warnings.dump();
}

TEST(DoubleActing, NamesWhatIsWrong) {
  const auto errors = [](const Json& request) {
    return DetailAt(ErrorsOf(ParseRequirements(request, Project().parts)),
                    "/actuators/0/cylinder/rod_mm");
  };
  Json request = Asked();
  EXPECT_EQ(errors(request), "");
  request["actuators"][0]["cylinder"]["rod_mm"] = 16;
  EXPECT_NE(errors(request), "");

  request = Asked();
  Json second = request["actuators"][0];
  second["name"] = "lift, rod side";
  second["cylinder"]["acting"] = "single";
  request["actuators"].push_back(second);
  EXPECT_NE(DetailAt(ErrorsOf(ParseRequirements(request, Project().parts)), "/actuators/1/name"),
            "");

  Json simulation = Simulation();
  simulation["actuators"][0].erase("rest_volume_ml");
  simulation["actuators"][0].erase("expansion_ratio");
  simulation["actuators"][0]["cylinder"] = Asked()["actuators"][0]["cylinder"];
  bool refused = false;
  for (const Error& error : ErrorsOf(RunSimulation(simulation, SmallCatalogue())))
    refused = refused || error.pointer == "/actuators/0/cylinder/acting";
  EXPECT_TRUE(refused);
}

}  // namespace double_acting_test
}  // namespace plenum::api
