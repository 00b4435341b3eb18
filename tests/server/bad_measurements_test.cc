// `plenum diagnose` given files that are truncated, empty, contradictory, unsorted, constant or
// absurd: an error that names the place, or an honest verdict, never a confident name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/server/workbench.h"

namespace plenum::server {
namespace bad_measurements_test {

using api::Json;
using testing::HasSubstr;
using testing::IsEmpty;

// Two closed chambers that hold their pressure.
Json Chambers(const std::function<double(int run, double t_s)>& kpa_gauge) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise_kpa(0.0, 0.1);
  Json document = {{"schema", "measurement/1"},
                   {"name", "closed chambers"},
                   {"rig",
                    {{"actuator",
                      {{"rest_volume_ml", 50.0},
                       {"expansion_ratio", 1.5},
                       {"operating_pressure_kpa_gauge", 100.0}}},
                     {"supply", {{"kind", "none"}}}}}};
  for (int r = 0; r < 2; ++r) {
    Json run = {{"id", "r" + std::to_string(r)}};
    run["valve"] = Json::array({{{"t_s", 0.0}, {"state", "hold"}}});
    for (int i = 0; i < 80; ++i) {
      const double t_s = 0.1 * i;
      run["t_s"].push_back(t_s);
      run["pressure_kpa_gauge"].push_back(kpa_gauge(r, t_s) + noise_kpa(random));
    }
    document["runs"].push_back(std::move(run));
  }
  return document;
}

Json Still() {
  return Chambers([](int run, double) { return run == 0 ? 90.0 : 50.0; });
}

struct Spoilt {
  std::string name;
  std::function<void(Json&)> spoil;
  std::string said;
};

const std::vector<Spoilt>& Spoils() {
  static const std::vector<Spoilt> kSpoils = {
      {"no schema", [](Json& d) { d.erase("schema"); }, "/schema"},
      {"another schema", [](Json& d) { d["schema"] = "designs/1"; }, "/schema"},
      {"no rig", [](Json& d) { d.erase("rig"); }, "/rig"},
      {"no runs", [](Json& d) { d["runs"] = Json::array(); }, "/runs"},
      {"no readings", [](Json& d) { d["runs"][0].erase("pressure_kpa_gauge"); },
       "/runs/0/pressure_kpa_gauge"},
      {"no times", [](Json& d) { d["runs"][1]["t_s"] = Json::array(); }, "/runs/1/t_s"},
      {"cut short", [](Json& d) { d["runs"][0]["pressure_kpa_gauge"].erase(79); },
       "80 sample times, not 79"},
      {"unsorted", [](Json& d) { std::swap(d["runs"][0]["t_s"][5], d["runs"][0]["t_s"][6]); },
       "/runs/0/t_s/6"},
      {"text for a time", [](Json& d) { d["runs"][0]["t_s"][7] = "soon"; }, "/runs/0/t_s/7"},
      {"all missing",
       [](Json& d) {
         for (Json& p : d["runs"][0]["pressure_kpa_gauge"]) p = nullptr;
       },
       "at least 8 readings"},
      {"constant",
       [](Json& d) {
         for (Json& p : d["runs"][0]["pressure_kpa_gauge"]) p = 90.0;
       },
       "all 80 readings are 90"},
      {"pascals",
       [](Json& d) {
         for (Json& p : d["runs"][0]["pressure_kpa_gauge"]) p = 1e3 * p.get<double>();
       },
       "/runs/0/pressure_kpa_gauge/0"},
      {"below vacuum", [](Json& d) { d["runs"][0]["pressure_kpa_gauge"][9] = -160.0; },
       "/runs/0/pressure_kpa_gauge/9"},
      {"volume below zero", [](Json& d) { d["rig"]["actuator"]["rest_volume_ml"] = -50.0; },
       "/rig/actuator/rest_volume_ml"},
      {"shrinking", [](Json& d) { d["rig"]["actuator"]["expansion_ratio"] = 0.5; },
       "/rig/actuator/expansion_ratio"},
      {"inflates without a supply", [](Json& d) { d["runs"][0]["valve"][0]["state"] = "inflate"; },
       "supply is none"},
      {"unknown valve state", [](Json& d) { d["runs"][0]["valve"][0]["state"] = "ajar"; },
       "/runs/0/valve/0/state"},
      {"one id twice", [](Json& d) { d["runs"][1]["id"] = "r0"; }, "/runs/1/id"},
      {"holds out what is not there", [](Json& d) { d["holdout"] = {"r9"}; }, "/holdout/0"},
      {"holds out all",
       [](Json& d) {
         d["holdout"] = {"r0", "r1"};
       },
       "/holdout"},
      {"uncertainty below zero", [](Json& d) { d["relative_uncertainty"]["rest_volume"] = -0.02; },
       "/relative_uncertainty/rest_volume"},
      {"unknown number", [](Json& d) { d["relative_uncertainty"]["resting_volume"] = 0.02; },
       "/relative_uncertainty/resting_volume"},
  };
  return kSpoils;
}

TEST(BadMeasurements, EachIsRefusedWithItsPlace) {
  const Workbench bench;
  ASSERT_GE(Spoils().size(), 20u);
  for (const Spoilt& spoilt : Spoils()) {
    Json document = Still();
    spoilt.spoil(document);
    const auto outcome = bench.Run("diagnose - --json", document.dump());
    EXPECT_EQ(outcome.status, 2) << spoilt.name;
    EXPECT_EQ(outcome.out.size(), 0u) << spoilt.name;
    EXPECT_THAT(outcome.err, HasSubstr(spoilt.said)) << spoilt.name;
  }
}

TEST(BadMeasurements, TextThatIsNoDocumentIsRefused) {
  const Workbench bench;
  const std::string whole = Still().dump();
  for (const std::string& text :
       {std::string(), std::string("run,t_s\n"), std::string("[]"), whole.substr(0, 400),
        whole + whole, std::string("\x00\xff\xfe", 3)}) {
    const auto outcome = bench.Run("diagnose - --json", text);
    EXPECT_EQ(outcome.status, 2) << text.substr(0, 40);
    EXPECT_THAT(outcome.out, IsEmpty());
  }
}

// What can be read and makes no sense is answered, without a name for it.
TEST(BadMeasurements, AbsurdReadingsGetNoConfidentName) {
  const Workbench bench;
  const std::vector<std::function<double(int, double)>> absurd = {
      [](int run, double t_s) { return 60.0 + 30.0 * std::sin((3.0 + run) * t_s * t_s); },
      [](int run, double t_s) { return std::fmod(t_s * (7.0 + run), 1.0) > 0.5 ? 90.0 : 10.0; },
      [](int run, double t_s) { return (run == 0 ? 20.0 : 40.0) + 9.0 * t_s; },  // it fills itself
  };
  for (std::size_t i = 0; i < absurd.size(); ++i) {
    const auto outcome = bench.Run("diagnose - --json --time-limit 5", Chambers(absurd[i]).dump());
    ASSERT_EQ(outcome.status, 0) << i << outcome.err;
    const Json answer = Json::parse(outcome.out);
    EXPECT_NE(answer["verdict"], "explained") << i;
    EXPECT_TRUE(answer["effects"].empty()) << i;
  }
}

}  // namespace bad_measurements_test
}  // namespace plenum::server
