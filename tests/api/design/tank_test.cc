// Tanks filled beforehand, from the request to the checked answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace tank_test {

// The example, of a tank alone; `regulated`: the fill is more than the lines stand.
Json Asked(bool regulated) {
  Json request = Example("tank_arm");
  request["supply"]["configurations"] = {"tank"};
  request["ranking"] = {{"count", 3}, {"list", "combinations"}, {"proof", true}};
  if (regulated) {
    request["supply"]["source_pressure_kpa_gauge_max"] = 200;
    request["duty"]["actuations"] = 40;
  }
  return request;
}

bool HasRegulator(const Json& design) {
  return std::any_of(design["parts"].begin(), design["parts"].end(),
                     [](const Json& row) { return row["family"] == "regulator"; });
}

TEST(TankTest, IsDesignedAndVerified) {
  for (const bool regulated : {false, true}) {
    const Json answer = Answered(Asked(regulated));
    EXPECT_EQ(answer["status"], "optimal");
    ASSERT_FALSE(answer["designs"].empty());
    EXPECT_EQ(Refusals(answer), "");
    for (const Json& design : answer["designs"]) {
      EXPECT_EQ(design["configuration"], "tank");
      const double fill_kpa = design["settings"]["tank_fill_kpa_gauge"];
      EXPECT_LE(fill_kpa, 800.0);
      EXPECT_GT(fill_kpa, 100.0);
      EXPECT_GT(design["settings"]["reservoir_volume_ml"].get<double>(), 0.0);
      if (!HasRegulator(design)) {
        EXPECT_EQ(design["settings"]["source_pressure_kpa_gauge"], fill_kpa);
      }
    }
    if (regulated) {
      EXPECT_TRUE(HasRegulator(answer["designs"][0]));
    }
  }
}

TEST(TankTest, VerifyRefusesWhatIsTamperedWith) {
  const Tampering kTamperings[] = {
      {"another fill", "supply",
       [](Json& a) { a["designs"][0]["settings"]["tank_fill_kpa_gauge"] = 900.0; }},
      {"no fill", "supply",
       [](Json& a) { a["designs"][0]["settings"]["tank_fill_kpa_gauge"] = nullptr; }},
      {"no air", "amounts",
       [](Json& a) {
         for (Json& row : a["designs"][0]["parts"])
           if (row["family"] == "reservoir") row["mass_kg"] = row["mass_kg"].get<double>() - 1e-3;
       }},
      {"faster", "strokes", [](Json& a) {
         Json& group = a["designs"][0]["performance"]["groups"][0];
         group["rise_time_s"] = 0.9 * group["rise_time_s"].get<double>();
       }}};
  ExpectRefused(Answered(Asked(false)), kTamperings);
}

TEST(TankTest, IsAskedForByNameAlone) {
  Json request = Example("tank_arm");
  request["supply"].erase("configurations");
  request["supply"].erase("tank_fill_kpa_gauge_max");
  const auto parsed = ParseRequirements(request, Project().parts);
  const auto& problem = std::get<DesignRequest>(parsed).problem;
  EXPECT_FALSE(problem.configurations.contains(optimizer::Configuration::kTank));
  EXPECT_EQ(problem.configurations.size(), 3u);
}

TEST(TankTest, NamesWhatIsWrongWithARequest) {
  Json request = Example("tank_arm");
  request["supply"]["configurations"] = {"cylinder"};
  Errors errors = ErrorsOf(ParseRequirements(request, Project().parts));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].pointer, "/supply/tank_fill_kpa_gauge_max");
  request = Example("tank_arm");
  request["supply"]["tank_fill_kpa_gauge_max"] = -3;
  errors = ErrorsOf(ParseRequirements(request, Project().parts));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].pointer, "/supply/tank_fill_kpa_gauge_max");
  request = Example("tank_arm");
  request["supply"]["configurations"] = {"tank"};
  request["require"] = {{"reservoir", {"custom"}}};
  errors = ErrorsOf(ParseRequirements(request, Project().parts));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].pointer, "/require/reservoir");
}

TEST(TankTest, ADesignIsEvaluatedAsItWasListed) {
  for (const bool regulated : {false, true}) {
    const Json request = Asked(regulated);
    const Json design = Answered(request)["designs"][0];
    const auto evaluated = Evaluated(request, design);
    for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
    const Json& answer = std::get<Json>(evaluated);
    EXPECT_EQ(answer["works"], true);
    EXPECT_NEAR(answer["totals"]["mass_kg"].get<double>(),
                design["totals"]["mass_kg"].get<double>(), 1e-9);
    EXPECT_EQ(answer["margins"].size(), design["margins"].size());
  }
}

TEST(TankTest, ADesignThatCannotBeIsNamed) {
  const Json request = Asked(false);
  const Json design = Answered(request)["designs"][0];
  ASSERT_FALSE(HasRegulator(design));
  const auto pointers = [&](const auto& change) {
    Json changed = design;
    change(changed);
    std::string all;
    for (const Error& error : ErrorsOf(Evaluated(request, changed))) all += error.pointer + " ";
    return all;
  };
  EXPECT_EQ(pointers([](Json& d) { d["settings"]["tank_fill_kpa_gauge"] = 900; }),
            "/design/settings/tank_fill_kpa_gauge /design/settings/tank_fill_kpa_gauge ");
  EXPECT_EQ(pointers([](Json& d) { d["settings"]["tank_fill_kpa_gauge"] = 120; }),
            "/design/settings/tank_fill_kpa_gauge ");
  EXPECT_EQ(pointers([](Json& d) { d["settings"]["reservoir_volume_ml"] = 1; }),
            "/design/settings/reservoir_volume_ml ");
  EXPECT_EQ(pointers([](Json& d) {
              std::erase_if(d["parts"].get_ref<Json::array_t&>(),
                            [](const Json& row) { return row["family"] == "reservoir"; });
            }),
            "/design/parts ");
}

// ── tanks that a pump goes on filling ──

Json Refilled() {
  Json request = Example("refilled_arm");
  request["supply"]["configurations"] = {"tank_and_pump"};
  request["ranking"] = {{"count", 3}, {"list", "combinations"}, {"proof", true}};
  return request;
}

TEST(TankTest, WithAPumpIsDesignedVerifiedAndEvaluated) {
  const Json answer = Answered(Refilled());
  EXPECT_EQ(answer["status"], "optimal");
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(Refusals(answer), "");
  for (const Json& design : answer["designs"]) {
    EXPECT_EQ(design["configuration"], "tank_and_pump");
    EXPECT_TRUE(HasRegulator(design));
    const Json& settings = design["settings"];
    EXPECT_LE(settings["tank_fill_kpa_gauge"].get<double>(), 800.0);
    EXPECT_LE(settings["pump_stop_kpa_gauge"].get<double>(),
              settings["tank_fill_kpa_gauge"].get<double>());
    EXPECT_GE(settings["pump_stop_kpa_gauge"].get<double>(),
              settings["source_pressure_kpa_gauge"].get<double>());
    EXPECT_GE(settings["compressor_duty"].get<double>(), 0.0);
  }
  const Json& first = answer["designs"][0];
  for (const bool stated : {true, false}) {  // what is left out is found
    Json given = first;
    if (!stated) given["settings"].erase("pump_stop_kpa_gauge");
    if (!stated) given["settings"].erase("tank_fill_kpa_gauge");
    const Json evaluated = std::get<Json>(Evaluated(Refilled(), given));
    EXPECT_EQ(evaluated["works"], true);
    EXPECT_NEAR(evaluated["totals"]["mass_kg"].get<double>(),
                first["totals"]["mass_kg"].get<double>(), 1e-8);
    EXPECT_NEAR(evaluated["totals"]["energy_wh"].get<double>(),
                first["totals"]["energy_wh"].get<double>(),
                1e-6 * first["totals"]["energy_wh"].get<double>());
  }
}

TEST(TankTest, APumpThatStopsHigherTakesMore) {
  const Json answer = Answered(Refilled());
  ASSERT_FALSE(answer["designs"].empty());
  Json given = answer["designs"][0];
  ASSERT_GT(given["settings"]["compressor_duty"].get<double>(), 0.0);
  Json& stop = given["settings"]["pump_stop_kpa_gauge"];
  stop = stop.get<double>() + 2.0;
  const Json evaluated = std::get<Json>(Evaluated(Refilled(), given));
  EXPECT_GT(evaluated["totals"]["energy_wh"].get<double>(),
            given["totals"]["energy_wh"].get<double>());
}

TEST(TankTest, AStopPressureIsForPumpsThatFillATank) {
  const Json request = Asked(false);
  Json design = Answered(request)["designs"][0];
  design["settings"]["pump_stop_kpa_gauge"] = 200.0;
  const Errors errors = ErrorsOf(Evaluated(request, design));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_THAT(errors[0].pointer, ::testing::EndsWith("/settings/pump_stop_kpa_gauge"));
}

}  // namespace tank_test
}  // namespace plenum::api
