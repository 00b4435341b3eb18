// Commands that were read off the rows of a log, a row late: recordings by the independent
// simulator.
#include "api/measure/valve/row_instants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/api/measure/diagnosed.h"
#include "tests/api/measure/recorded_bench.h"

namespace plenum::api {
namespace row_instants_test {

// Two searches, which a sanitizer slows down.
constexpr double kTimeLimitS = 900.0;

// Three runs of a chamber that leaks; the log has the vent `late_s` after it.
Json Logged(double late_s) {
  Json document = DeclaredBench();
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 0.25);
  for (const double source_kpa : {150.0, 180.0, 210.0}) {
    test::EffectRig rig;
    rig.source_pa = 1e5 + 1e3 * source_kpa;
    rig.leak = test::OrificeLeak{0.002e-8, 0.3};
    rig.schedule = {{0.0, 0}, {0.2, 1}, {1.2, 0}, {2.0 - late_s, -1}, {3.6, 0}};
    document["runs"].push_back(RecordedBench(
        "r" + std::to_string(static_cast<int>(source_kpa)), rig, source_kpa,
        {{0.0, 0}, {0.2, 1}, {1.2, 0}, {2.0, -1}, {3.6, 0}}, [&] { return noise(random); }));
  }
  return document;
}

std::vector<std::string> NamesOf(const Json& answer) {
  std::vector<std::string> names;
  for (const Json& effect : answer.at("effects")) names.push_back(effect.at("id"));
  return names;
}

TEST(RowInstants, ALateRowIsNoEffect) {
  Json late = Logged(0.0195);
  const Json answer = DiagnosedOf(late, kTimeLimitS);
  EXPECT_EQ(answer.at("verdict"), "explained") << answer.at("sentence");
  EXPECT_THAT(NamesOf(answer), testing::ElementsAre("leak")) << answer.at("sentence");
  EXPECT_THAT(answer.at("warnings").dump(), testing::HasSubstr("stand at times of readings"));
  // The answer says what it took them for, and gives back its curves.
  const Json& valve = answer.at("measurement").at("runs")[0].at("valve");
  EXPECT_NEAR(valve[3].at("uncertainty_s").get<double>(), 0.01155, 1e-4);
  ExpectCurvesAsStated(answer);
  // Who says that they are exact is believed, and the leak alone leaves structure.
  for (Json& run : late["runs"])
    for (Json& command : run["valve"]) command["uncertainty_s"] = 0;
  const Json exact = DiagnosedOf(late, kTimeLimitS);
  EXPECT_FALSE(exact.at("verdict") == "explained" &&
               NamesOf(exact) == std::vector<std::string>{"leak"});
}

TEST(RowInstants, ExactOnesAreLeftAlone) {
  const Json answer = DiagnosedOf(Logged(0.0), kTimeLimitS);
  EXPECT_THAT(NamesOf(answer), testing::ElementsAre("leak")) << answer.at("sentence");
  EXPECT_FALSE(answer.at("measurement").at("runs")[0].at("valve")[3].contains("uncertainty_s"));
}

TEST(RowInstants, AreKnownByWhereTheyStand) {
  const auto are_of_rows = [](const Json& document) { return AreOfRows(document, Read(document)); };
  Json document = Logged(0.0);
  EXPECT_TRUE(are_of_rows(document));
  document["runs"][1]["valve"][2]["t_s"] = 1.21;  // half way between two rows
  EXPECT_FALSE(are_of_rows(document));
  document = Logged(0.0);
  document["runs"][2]["valve"][0]["uncertainty_s"] = 0;
  EXPECT_FALSE(are_of_rows(document));
  document = Logged(0.0);
  for (Json& run : document["runs"])
    run["valve"].erase(run["valve"].begin() + 1, run["valve"].end());
  EXPECT_FALSE(are_of_rows(document));  // the first row is after none
}

}  // namespace row_instants_test
}  // namespace plenum::api
