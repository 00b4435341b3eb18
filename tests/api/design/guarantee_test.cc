// What is guaranteed holds in every world that the tolerances allow.
#include "api/design/read/guarantee.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/answer.h"
#include "api/design/guaranteed.h"
#include "api/design/read/selection.h"
#include "optimizer/explain/explained_search.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/sizing/resize.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace guarantee_test {

using optimizer::Answer;
using optimizer::Problem;

// Simulated times may pass a limit by as much (optimizer/sizing/report.cc).
constexpr double kSimulator = 1e-5;

Json Guaranteed(Json request, int count = 3) {
  request["guarantee"] = true;
  request["ranking"] = {{"count", count}, {"time_limit_s", 60}};
  return request;
}

// One group of lone valves and of valves that hold, on each kind of source.
Json OneGroup(const char* configuration) {
  Json request = Parse(R"({
    "schema": "requirements/1",
    "actuators": [ { "name": "a", "count": 4, "rest_volume_ml": 20, "expansion_ratio": 2,
                     "operating_pressure_kpa_gauge": 60, "tube_length_m": 0.5,
                     "rise_time_s_max": 0.3, "fall_time_s_max": 0.6,
                     "pressure_kpa_gauge_max": 105,
                     "relative_uncertainty": { "rest_volume": 0.02, "expansion_ratio": 0.03 } } ],
    "duty": { "frequency_hz": 0.5, "actuations": 500 } })");
  request["supply"] = {{"configurations", {configuration}},
                       {"mains", {{"pressure_kpa_gauge", 500}}},
                       {"mass_kg_max", 12}};
  return request;
}

int Worlds() {
  const char* asked = std::getenv("PLENUM_WORLDS");
#ifdef PLENUM_SANITIZED
  constexpr int kWorlds = 40;
#else
  constexpr int kWorlds = 400;
#endif
  return asked ? std::atoi(asked) : kWorlds;
}

// Actuators of a world: within twice their stated deviation.
void Draw(const std::vector<GroupUncertainty>& groups, std::mt19937_64& random, Problem& world) {
  std::uniform_real_distribution<double> within(-2.0, 2.0);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    model::Chamber& chamber = world.groups[g].chamber;
    chamber.rest_volume_m3 *= 1.0 + groups[g].rest_volume * within(random);
    chamber.expansion_ratio *= 1.0 + groups[g].expansion_ratio * within(random);
  }
}

// What the design misses in a world at its own settings; empty: nothing.
std::string Missed(const Problem& world, optimizer::Design design) {
  for (const optimizer::Choice& choice : design.parts)
    if (choice.family == optimizer::Family::kReservoir && choice.id != kCustomReservoir)
      design.settings.reservoir_volume_m3 =
          choice.quantity *
          world.parts.reservoirs[optimizer::FindPart(world.parts, choice.family, choice.id)]
              .volume_m3;
  const optimizer::AtSettings found = optimizer::EvaluateAtSettings(world, design);
  if (!found.design) return "does not work";
  for (const optimizer::Margin& margin : found.design->margins)
    if (margin.relative_margin < -kSimulator)
      return margin.requirement + " by " + std::to_string(margin.relative_margin);
  return "";
}

// Each listed design in corners and draws of its parts.
void ExpectHolds(const Json& request) {
  const auto parsed = ParseRequirements(request, Project().parts);
  ASSERT_TRUE(std::holds_alternative<DesignRequest>(parsed))
      << ErrorsOf(parsed)[0].pointer << ErrorsOf(parsed)[0].detail;
  const auto& asked = std::get<DesignRequest>(parsed);
  const Problem worst = GuaranteedProblem(asked.problem, *asked.guarantee, Project().parts);
  optimizer::SearchOptions options;
  options.time_limit_s = 60;
  const Answer answer = optimizer::Search(worst, options);
  ASSERT_FALSE(answer.designs.empty());
  const Tolerance& tolerance = asked.guarantee->tolerance;
  const auto rows = [&](bool corners) {
    return MakeDraws(Project().parts, asked.problem, [&, corners](catalog::Part row, int world) {
      if (row.id == kCustomReservoir) return row;
      return corners ? AtCorner(std::move(row), tolerance, world)
                     : Perturbed(std::move(row), tolerance, 7, world);
    });
  };
  const auto corners = rows(true), draws = rows(false);
  std::mt19937_64 random(5);
  for (const optimizer::Design& design : answer.designs)
    for (int i = 0; i < Worlds(); ++i) {
      Problem world = asked.problem;
      world.parts = i % 3 < 2 ? corners(design, i) : draws(design, i);
      Draw(asked.guarantee->groups, random, world);
      ASSERT_EQ(Missed(world, design), "")
          << optimizer::Name(design.configuration) << ", world " << i;
    }
}

TEST(GuaranteeTest, HoldsInCornersAndDrawsOfTheExosuit) {
  ExpectHolds(Guaranteed(Example("exosuit")));
}
TEST(GuaranteeTest, HoldsForTheGripper) { ExpectHolds(Guaranteed(Example("gripper"))); }
TEST(GuaranteeTest, HoldsForGroupsThatTakeTurns) { ExpectHolds(Guaranteed(Example("crawler"), 2)); }
TEST(GuaranteeTest, HoldsOnAPump) { ExpectHolds(Guaranteed(OneGroup("compressor"))); }
TEST(GuaranteeTest, HoldsOnABottle) { ExpectHolds(Guaranteed(OneGroup("cylinder"), 12)); }
TEST(GuaranteeTest, HoldsOnCo2) { ExpectHolds(Guaranteed(OneGroup("co2"), 12)); }
TEST(GuaranteeTest, HoldsOnTheWall) { ExpectHolds(Guaranteed(OneGroup("mains"), 12)); }

// A valve that cannot hold fills its actuators for half of the period: the period is short, so that
// one that passes more takes more air.
TEST(GuaranteeTest, HoldsForLoneValvesThatDoNotFill) {
  Json request = OneGroup("compressor");
  request["actuators"][0]["pressure_kpa_gauge_max"] = 300;
  request["duty"] = {{"frequency_hz", 1.5}, {"actuations", 500}};
  request["require"] = {{"valve", Json::array()}};
  for (const catalog::Part& part : Project().parts)
    if (part.family == "valve" && part.texts.at("function").value == "3/2")
      request["require"]["valve"].push_back(part.id);
  ExpectHolds(Guaranteed(request));
}

double Objective(const Json& list) { return list.at("designs").at(0).at("objective"); }

// Rows whose numbers have no uncertainty of their own.
std::vector<catalog::Part> Plain() {
  std::vector<catalog::Part> rows = Project().parts;
  for (catalog::Part& row : rows) {
    for (auto& [field, number] : row.numbers) number.uncertainty.reset();
    if (row.curve) row.curve->free_air_uncertainty.reset(), row.curve->current_uncertainty.reset();
  }
  return rows;
}

Json AnsweredWith(const Json& request, const std::vector<catalog::Part>& rows) {
  return AnswerRequest(std::get<DesignRequest>(ParseRequirements(request, rows)), {}, rows);
}

TEST(GuaranteeTest, WithoutTolerancesBothListsAreTheSame) {
  Json request = Guaranteed(OneGroup("mains"), 5);
  request["actuators"][0].erase("relative_uncertainty");
  request["guarantee"] = Parse(R"({ "tolerance": { "measured": 0, "datasheet": 0, "third_party": 0,
                                                   "derived": 0, "estimated": 0 } })");
  const Json answer = AnsweredWith(request, Plain());
  ASSERT_FALSE(answer["designs"].empty());
  ASSERT_EQ(answer["designs"].size(), answer["on_paper"]["designs"].size());
  for (std::size_t i = 0; i < answer["designs"].size(); ++i) {
    const Json &certain = answer["designs"][i], &paper = answer["on_paper"]["designs"][i];
    EXPECT_EQ(certain["objective"], paper["objective"]);
    EXPECT_EQ(certain["parts"], paper["parts"]);
  }
  EXPECT_EQ(answer["guarantee"]["costs"], 0.0);
  EXPECT_TRUE(answer["measure_first"].empty());
}

TEST(GuaranteeTest, WiderTolerancesAreNeverBetter) {
  double before = 0.0;
  for (const double estimated : {0.05, 0.1, 0.2, 0.3}) {
    Json request = Guaranteed(OneGroup("mains"), 1);
    request["guarantee"] = {{"tolerance", {{"estimated", estimated}}}};
    const Json answer = Answered(request);
    ASSERT_EQ(answer["status"], "optimal");
    EXPECT_GE(Objective(answer), before * (1.0 - 1e-6));
    EXPECT_GE(Objective(answer), Objective(answer["on_paper"]) * (1.0 - 1e-6));
    before = Objective(answer);
  }
}

// A saving is what a search says that knows the numbers.
TEST(GuaranteeTest, ASavingIsThatOfASearchThatKnows) {
  const Json request = Guaranteed(Example("gripper"), 1);
  const Json answer = Answered(request);
  ASSERT_FALSE(answer["measure_first"].empty());
  for (const Json& test : answer["measure_first"]) {
    std::vector<catalog::Part> rows = Project().parts;
    for (catalog::Part& row : rows)
      for (const Json& number : test["numbers"])
        if (row.id == test["part"] && row.numbers.contains(number.get<std::string>()))
          row.numbers[number.get<std::string>()].uncertainty = 0.0;
    EXPECT_NEAR(Objective(answer) - Objective(AnsweredWith(request, rows)),
                test["saving"].get<double>(), 1e-9);
  }
}

// Limits hold for what a design may come to.
TEST(GuaranteeTest, LimitsHoldAtTheUpperValue) {
  Json request = Guaranteed(OneGroup("mains"), 1);
  const Json free = Answered(request);
  const double most = free["designs"][0]["guarantee"]["mass_kg_max"];
  const double mass = free["designs"][0]["totals"]["mass_kg"];
  ASSERT_GT(most, mass);
  request["supply"]["mass_kg_max"] = most + 1e-6;
  EXPECT_EQ(Objective(Answered(request)), Objective(free));
  request["supply"]["mass_kg_max"] = 0.5 * (most + mass);
  const Json limited = Answered(request);
  EXPECT_TRUE(limited["designs"].empty() ||
              limited["designs"][0]["parts"] != free["designs"][0]["parts"]);
  EXPECT_EQ(Objective(limited["on_paper"]), Objective(free["on_paper"]));
}

// A list of known prices beside one where unknown ones count as 0: their difference says nothing.
TEST(GuaranteeTest, SumsOfKnownPricesAreNotCompared) {
  optimizer::Answer paper, certain;
  paper.designs.emplace_back().objective = 499.3;
  certain.designs.emplace_back().objective = 2.5;
  EXPECT_NEAR(RenderGuarantee({}, certain, paper)["costs"].get<double>(), -496.8, 1e-9);
  certain.lower_bound_prices = true;
  const Json json = RenderGuarantee({}, certain, paper);
  EXPECT_TRUE(json["costs"].is_null());
  EXPECT_TRUE(json["costs_share"].is_null());
  EXPECT_EQ(json["objective_guaranteed"], 2.5);
}

TEST(GuaranteeTest, IsVerifiedAndTamperingRefused) {
  Json request = Guaranteed(OneGroup("cylinder"), 3);
  request["ranking"]["proof"] = true;
  const Json answer = Answered(request);
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(Refusals(answer), "");
  const Tampering tamperings[] = {
      {"costs", "form", [](Json& a) { a["guarantee"]["costs_share"] = 0.0; }},
      {"upper mass", "form", [](Json& a) { a["designs"][0]["guarantee"]["mass_kg_max"] = 0.1; }},
      {"the list on paper in its place", "supply",
       [](Json& a) {
         a["designs"] = a["on_paper"]["designs"];
         a["designs"][0]["guarantee"] = Json::object();
       }},
      {"a better design on paper", "on_paper.amounts",
       [](Json& a) { a["on_paper"]["designs"][0]["objective"] = 0.01; }}};
  ExpectRefused(answer, std::span(tamperings).first(2));
  ExpectRefused(answer, std::span(tamperings).last(1));
}

TEST(GuaranteeTest, WhatCannotBeGuaranteedIsRefusedByName) {
  const auto refused = [](const std::string& pointer, const Json& value) {
    Json request = With(Guaranteed(OneGroup("mains")), pointer, value);
    return ErrorsOf(ParseRequirements(request, Project().parts));
  };
  EXPECT_NE(DetailAt(refused("/objective", {{"minimize", "energy_wh"}}), "/guarantee"), "");
  EXPECT_NE(DetailAt(refused("/robust", Json::object()), "/guarantee"), "");
  EXPECT_NE(DetailAt(refused("/guarantee", {{"retune", true}}), "/guarantee/retune"), "");
  EXPECT_NE(DetailAt(refused("/guarantee", {{"tolerance", {{"estimated", 1.0}}}}),
                     "/guarantee/tolerance/estimated"),
            "");
  EXPECT_NE(DetailAt(refused("/actuators/0/relative_uncertainty", {{"rest_volume", 0.5}}),
                     "/actuators/0/relative_uncertainty/rest_volume"),
            "");
  Json two = Guaranteed(OneGroup("mains"));
  two["actuators"].push_back(two["actuators"][0]);
  two["actuators"][1]["name"] = "b";
  EXPECT_NE(DetailAt(ErrorsOf(ParseRequirements(two, Project().parts)), "/guarantee"), "");
  EXPECT_TRUE(
      ErrorsOf(ParseRequirements(With(two, "/duty/simultaneous", false), Project().parts)).empty());
}

}  // namespace guarantee_test
}  // namespace plenum::api
