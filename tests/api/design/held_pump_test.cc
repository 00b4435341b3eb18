// Pumps without a reservoir that run on while actuators hold, from the request to the checked
// answer.
#include <gtest/gtest.h>

#include "api/design/given/unit_of_design.h"
#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace held_pump_test {

// Slow fingers that are held for most of half of the period.
Json Asked(const std::string& pumps = "shared", int groups = 1) {
  Json request = SlowFingers(groups);
  request["duty"]["actuations"] = 300;
  request["supply"]["pumps"] = pumps;
  request["supply"]["hold_on"] = true;
  return request;
}

Json Stopping(Json request) {
  request["supply"].erase("hold_on");
  return request;
}

double Number(const Json& design, const char* of, const char* field) {
  return design[of][field].get<double>();
}

TEST(HeldPumpTest, IsDesignedAndVerified) {
  for (const std::string pumps : {"shared", "per_group", "per_actuator"}) {
    SCOPED_TRACE(pumps);
    const Json answer = Answered(Asked(pumps));
    EXPECT_EQ(answer["status"], "optimal");
    ASSERT_FALSE(answer["designs"].empty());
    EXPECT_EQ(Refusals(answer), "");
    for (const Json& design : answer["designs"])
      EXPECT_NEAR(Number(design, "settings", "compressor_duty"), 0.5, 1e-9);
    const Json stops = Answered(Stopping(Asked(pumps)));
    EXPECT_GE(answer["designs"][0]["objective"], stops["designs"][0]["objective"]);
  }
}

// The pumps of a design take the power of their row at the operating pressure while they hold, and
// its fill valves stay open.
TEST(HeldPumpTest, HoldingTakesThePowerAtTheOperatingPressure) {
  Json request = Asked();
  const Json held = Answered(request)["designs"][0];
  for (const Json& row : held["parts"])
    if (row["family"] != "manifold") request["require"][row["family"]] = {row["id"]};
  const Json stops = Answered(Stopping(request))["designs"][0];
  double coil_w = 0.0, pump_w = 0.0,
         operating_kpa = request["actuators"][0]["operating_pressure_kpa_gauge"];
  for (const Json& row : held["parts"])
    for (const catalog::Part& part : Project().parts) {
      if (part.id != row["id"]) continue;
      if (row["family"] == "valve") coil_w = 2.0 * part.numbers.at("coil_power_w").value;
      if (row["family"] != "compressor") continue;
      const auto& points = part.curve->points;
      for (std::size_t i = 1; i < points.size(); ++i) {
        const auto &a = points[i - 1], &b = points[i];
        if (a.pressure_kpa_gauge > operating_kpa || b.pressure_kpa_gauge < operating_kpa) continue;
        const double share =
            (operating_kpa - a.pressure_kpa_gauge) / (b.pressure_kpa_gauge - a.pressure_kpa_gauge);
        pump_w = row["quantity"].get<double>() * part.numbers.at("voltage_v").value *
                 (a.current_a + share * (b.current_a - a.current_a));
      }
    }
  ASSERT_GT(pump_w, 0.0);
  const double held_s = 0.5 * 10.0 - Number(stops, "settings", "compressor_duty") * 10.0;
  const double more_wh = 300.0 * held_s * (pump_w + coil_w) / 3600.0;
  const double found_wh =
      Number(held, "totals", "energy_wh") - Number(stops, "totals", "energy_wh");
  EXPECT_NEAR(found_wh, more_wh, 0.02 * more_wh);  // the row's points are not joined by lines
}

TEST(HeldPumpTest, ASharedPumpHoldsWhatItFilledLast) {
  const Json answer = Answered(Asked("shared", 2));
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(Refusals(answer), "");
  // One group begins as the other is to be emptied: it never rests.
  EXPECT_NEAR(Number(answer["designs"][0], "settings", "compressor_duty"), 1.0, 1e-9);
  EXPECT_EQ(answer.dump().find("fill the next actuators"), std::string::npos);
  Json request = Asked("shared", 2);
  for (Json& group : request["actuators"]) group["inflate_fraction"] = 0.7;
  const auto parsed = ParseRequirements(request, Project().parts);
  Json document = Json::object();
  std::get<DesignRequest>(parsed).remarks.AddTo(document);
  EXPECT_NE(document.dump().find("fill the next actuators"), std::string::npos);
}

TEST(HeldPumpTest, AHoldMayCrossThePeriodsEnd) {
  Json request = Asked("per_group", 2);
  request["duty"].erase("simultaneous");
  request["actuators"][0]["phase"] = 0.95;
  request["actuators"][1]["phase"] = 0.4;
  request["actuators"][1]["strokes_per_period"] = 2;
  const Json answer = Answered(request);
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(Refusals(answer), "");
  EXPECT_NEAR(Number(answer["designs"][0], "settings", "compressor_duty"), 0.5, 1e-9);
}

TEST(HeldPumpTest, ADesignIsEvaluatedAsItWasListed) {
  const Json request = Asked("per_group", 2);
  const Json design = Answered(request)["designs"][0];
  const auto evaluated = Evaluated(request, design);
  for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
  const Json& answer = std::get<Json>(evaluated);
  EXPECT_EQ(answer["works"], true);
  const double energy_wh = Number(design, "totals", "energy_wh");
  EXPECT_NEAR(Number(answer, "totals", "energy_wh"), energy_wh, 1e-6 * energy_wh);
  EXPECT_EQ(answer["margins"].size(), design["margins"].size());
}

TEST(HeldPumpTest, VerifyRefusesWhatIsTamperedWith) {
  const Tampering kTamperings[] = {
      {"pumps that stop", "strokes", [](Json& a) { a["requirements"]["supply"].erase("hold_on"); }},
      {"less energy", "strokes",
       [](Json& a) {
         Json& energy = a["designs"][0]["totals"]["energy_wh"];
         energy = 0.99 * energy.get<double>();
       }},
      {"less duty", "strokes", [](Json& a) {
         Json& duty = a["designs"][0]["settings"]["compressor_duty"];
         duty = 0.4;
       }}};
  ExpectRefused(Answered(Asked()), kTamperings);
}

TEST(HeldPumpTest, NamesWhatIsWrongWithARequest) {
  EXPECT_EQ(Pointers(Asked()), "");
  Json request = Asked();
  request["supply"]["hold_on"] = "yes";
  EXPECT_EQ(Pointers(request), "/supply/hold_on ");
  request = Asked();
  request["supply"]["configurations"] = {"direct_pump", "compressor"};
  EXPECT_EQ(Pointers(request), "/supply/hold_on ");
  request["supply"]["hold_on"] = false;
  EXPECT_EQ(Pointers(request), "");
  request["supply"] = {{"configurations", {"compressor"}}, {"hold_on", true}};
  EXPECT_EQ(Pointers(request), "/supply/hold_on ");
  request = Asked("shared", 2);
  request["duty"]["simultaneous"] = true;
  EXPECT_EQ(Pointers(request), "/duty/simultaneous ");
}

TEST(HeldPumpTest, VacuumPumpsHoldOnWithoutAReservoirAlone) {
  Json request = Example("jamming_gripper");
  request["supply"]["hold_on"] = true;
  request["ranking"] = {{"count", 2}, {"list", "combinations"}, {"proof", true}};
  const Json answer = Answered(request);
  for (const Json& design : answer["designs"])
    EXPECT_EQ(design["configuration"], "direct_vacuum_pump");
  EXPECT_EQ(Refusals(answer), "");
}

TEST(HeldPumpTest, ItIsNoUnitForCoSimulation) {
  const Json request = Asked();
  const Json design = Answered(request)["designs"][0];
  const auto unit =
      MakeUnitFile({{"schema", "evaluation/1"}, {"requirements", request}, {"design", design}},
                   Project().parts, {}, 10.0);
  EXPECT_NE(DetailAt(ErrorsOf(unit), "/requirements/supply/hold_on"), "");
}

}  // namespace held_pump_test
}  // namespace plenum::api
