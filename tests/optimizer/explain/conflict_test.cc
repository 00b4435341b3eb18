// Impossible problems of each kind, and what the answer says about them.
#include "optimizer/explain/conflict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "optimizer/explain/demands.h"
#include "optimizer/explain/explained_search.h"
#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace conflict_test {

using optimizer::Configuration;
using optimizer::Conflict;
using optimizer::Problem;
using optimizer::Status;

void Set(int& limit, double value) { limit = static_cast<int>(std::lround(value)); }

// What no price is known of costs nothing.
void ForgetPrices(Problem& problem) {
  model::Parts& parts = problem.parts;
  for (auto& part : parts.tubing) part.per_metre.cost_eur = part.per_metre.cost_eur.value_or(0.0);
  const auto forget = [](auto& family) {
    for (auto& part : family) part.basics.cost_eur = part.basics.cost_eur.value_or(0.0);
  };
  forget(parts.fittings), forget(parts.valves), forget(parts.compressors), forget(parts.batteries);
  forget(parts.cylinders), forget(parts.co2), forget(parts.regulators), forget(parts.reservoirs);
}

// Every requirement that can be loosened, by pointer: where it is set, in the field's units.
std::map<std::string, std::function<void(Problem&, double)>> Fields() {
  return {
      {"/actuators/0/rise_time_s_max",
       [](Problem& p, double value) { p.groups[0].rise_time_max_s = value; }},
      {"/actuators/0/fall_time_s_max",
       [](Problem& p, double value) { p.groups[0].fall_time_max_s = value; }},
      {"/supply/mass_kg_max", [](Problem& p, double value) { p.mass_max_kg = value; }},
      {"/supply/volume_l_max", [](Problem& p, double value) { p.volume_max_l = value; }},
      {"/supply/cost_eur_max", [](Problem& p, double value) { p.cost_max_eur = value; }},
      {"/duty/actuations", [](Problem& p, double value) { p.actuations = value; }},
      {"/duty/frequency_hz", [](Problem& p, double value) { p.frequency_hz = value; }},
      {"/supply/source_pressure_kpa_gauge_max",
       [](Problem& p, double value) { p.source_pressure_max_pa = 1e5 + 1e3 * value; }},
      {"/supply/mains/flow_l_per_min_anr_max",
       [](Problem& p, double value) { p.mains.flow_max_m3_per_s = value / 60e3; }},
      {"/actuators/0/pressure_kpa_gauge_max",
       [](Problem& p, double value) { p.groups[0].pressure_max_pa = 1e5 + 1e3 * value; }},
      {"/limits/compressors_max",
       [](Problem& p, double value) { Set(p.limits.compressors, value); }},
      {"/limits/batteries_max", [](Problem& p, double value) { Set(p.limits.batteries, value); }},
      {"/limits/cylinders_max", [](Problem& p, double value) { Set(p.limits.cylinders, value); }},
      {"/limits/co2_max", [](Problem& p, double value) { Set(p.limits.co2, value); }},
      {"/limits/reservoirs_max", [](Problem& p, double value) { Set(p.limits.reservoirs, value); }},
      {"prices", [](Problem& p, double) { ForgetPrices(p); }},
  };
}

bool MoreIsHarder(const std::string& pointer) { return pointer.starts_with("/duty/"); }

void Loosen(Problem& problem, const std::string& pointer) {
  const double loosest = pointer == "/duty/actuations"     ? 1.0
                         : pointer == "/duty/frequency_hz" ? 1e-4
                         : pointer.starts_with("/limits/") ? 16.0
                                                           : optimizer::kUnlimited;
  Fields().at(pointer)(problem, loosest);
}

bool Feasible(const Problem& problem) {
  const optimizer::Answer answer = optimizer::SearchTrees(problem, Within(100.0));
  EXPECT_NE(answer.status == Status::kOptimal, answer.status == Status::kInfeasible);
  return answer.status == Status::kOptimal;
}

void ExpectMinimal(const Problem& problem, const std::vector<Conflict>& conflict) {
  Problem only = problem;
  for (const auto& [pointer, set] : Fields()) {
    const bool kept =
        std::any_of(conflict.begin(), conflict.end(),
                    [&, &named = pointer](const Conflict& c) { return c.requirement == named; });
    if (!kept) Loosen(only, pointer);
  }
  EXPECT_FALSE(Feasible(only));
  for (const Conflict& dropped : conflict) {
    Problem rest = only;
    Loosen(rest, dropped.requirement);
    EXPECT_TRUE(Feasible(rest)) << "without " << dropped.requirement;
  }
}

// `best` can be reached with the other requirements as they are, and nothing much better can.
void ExpectTight(const Problem& problem, const Conflict& conflict) {
  ASSERT_TRUE(conflict.best.has_value()) << conflict.requirement;
  const double easier = MoreIsHarder(conflict.requirement) ? 1.0 / 1.005 : 1.005;
  const double harder = MoreIsHarder(conflict.requirement) ? 1.01 : 0.99;
  Problem trial = problem;
  Fields().at(conflict.requirement)(trial, *conflict.best * easier);
  EXPECT_TRUE(Feasible(trial)) << conflict.requirement << " at " << *conflict.best;
  Fields().at(conflict.requirement)(trial, *conflict.best * harder);
  EXPECT_FALSE(Feasible(trial)) << conflict.requirement << " at " << *conflict.best;
}

// The relaxation, asked for, is feasible.
void ExpectFeasible(Problem problem, const std::vector<optimizer::Concession>& relaxation) {
  if (relaxation.empty()) return;
  for (const optimizer::Concession& concession : relaxation)
    if (concession.value)
      Fields().at(concession.requirement)(problem, *concession.value);
    else
      Loosen(problem, concession.requirement);
  EXPECT_TRUE(Feasible(problem));
}

std::vector<Conflict> Analyse(const Problem& problem) {
  const optimizer::Answer answer = optimizer::Search(problem, Within(100.0));
  EXPECT_EQ(answer.status, Status::kInfeasible);
  EXPECT_TRUE(answer.infeasibility.complete);
  EXPECT_EQ(answer.infeasibility.conflicts.size(), 1u);
  ExpectFeasible(problem, answer.infeasibility.relaxation);
  return answer.infeasibility.conflicts.at(0);
}

Problem Base(std::uint64_t seed, Configuration configuration) {
  Problem problem = EasyProblem(seed, {configuration});
  problem.groups[0].chamber.rest_volume_m3 = 40e-6;
  problem.groups[0].chamber.expansion_ratio = 2.0;
  problem.count = 1;
  return problem;
}

struct Impossible {
  const char* pointer;
  double value;
};

class OneImpossibleRequirement : public testing::TestWithParam<Impossible> {};

TEST_P(OneImpossibleRequirement, IsNamedWithWhatCanBeReached) {
  const auto [pointer, value] = GetParam();
  for (Configuration configuration : {Configuration::kCylinder, Configuration::kCo2}) {
    Problem problem = Base(3, configuration);
    ASSERT_TRUE(Feasible(problem));
    Fields().at(pointer)(problem, value);
    SCOPED_TRACE(optimizer::Name(configuration));
    const std::vector<Conflict> conflict = Analyse(problem);
    EXPECT_TRUE(std::any_of(conflict.begin(), conflict.end(),
                            [&, &named = pointer, &required = value](const Conflict& c) {
                              return c.requirement == named && c.required == required;
                            }));
    ExpectMinimal(problem, conflict);
    for (const Conflict& c : conflict)
      if (c.required) ExpectTight(problem, c);
  }
}

INSTANTIATE_TEST_SUITE_P(ConflictTest, OneImpossibleRequirement,
                         testing::Values(Impossible{"/actuators/0/rise_time_s_max", 1e-3},
                                         Impossible{"/actuators/0/fall_time_s_max", 1e-3},
                                         Impossible{"/supply/mass_kg_max", 0.02},
                                         Impossible{"/supply/volume_l_max", 0.02},
                                         Impossible{"/duty/actuations", 1e6},
                                         Impossible{"/duty/frequency_hz", 60.0}),
                         [](const auto& test) {
                           std::string name = test.param.pointer;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); },
                               '_');
                           return name;
                         });

TEST(ConflictTest, CostTooLow) {
  Problem problem = Base(3, Configuration::kMains);
  for (auto* part : {&problem.parts.valves[0].basics, &problem.parts.fittings[0].basics,
                     &problem.parts.tubing[0].per_metre, &problem.parts.regulators[0].basics})
    part->cost_eur = 20.0;
  problem.cost_max_eur = 1.0;
  problem.unpriced_allowed = true;  // as a search goes on where no design has all prices
  const std::vector<Conflict> conflict = Analyse(problem);
  ASSERT_EQ(conflict.size(), 1u);
  EXPECT_EQ(conflict[0].requirement, "/supply/cost_eur_max");
  ExpectMinimal(problem, conflict);
  ExpectTight(problem, conflict[0]);
}

// Where no design has all prices, parts without one count as free: the list is that of a catalogue
// in which they are.
TEST(ConflictTest, AMissingPriceMakesNothingInfeasible) {
  Problem problem = Base(3, Configuration::kMains);
  problem.objective = {.cost_eur = 1.0};
  for (model::Valve& valve : problem.parts.valves) valve.basics.cost_eur.reset();
  const optimizer::Answer answer = optimizer::Search(problem, Within(100.0));
  EXPECT_EQ(answer.status, Status::kOptimal);
  EXPECT_TRUE(answer.lower_bound_prices);
  Problem free = problem;
  ForgetPrices(free);
  const optimizer::Answer expected = optimizer::Search(free, Within(100.0));
  EXPECT_FALSE(expected.lower_bound_prices);
  ASSERT_EQ(answer.designs.size(), expected.designs.size());
  ASSERT_FALSE(answer.designs.empty());
  for (std::size_t i = 0; i < answer.designs.size(); ++i) {
    EXPECT_EQ(KeyOf(answer.designs[i]), KeyOf(expected.designs[i]));
    EXPECT_FALSE(answer.designs[i].totals.cost_eur.has_value());
    EXPECT_DOUBLE_EQ(answer.designs[i].totals.cost_known_eur, *expected.designs[i].totals.cost_eur);
  }
  // What is impossible at any price stays so, and prices are not blamed.
  problem.groups[0].rise_time_max_s = 1e-4;
  for (const auto& conflict : optimizer::Search(problem, Within(100.0)).infeasibility.conflicts)
    for (const Conflict& entry : conflict) EXPECT_NE(entry.requirement, "prices");
}

// Of one configuration alone, beside others, it is said.
TEST(ConflictTest, PricesThatNobodyKnowsAreNamed) {
  Problem problem = Base(3, Configuration::kMains);
  problem.objective = {.cost_eur = 1.0};
  for (model::Valve& valve : problem.parts.valves) valve.basics.cost_eur.reset();
  const std::vector<Conflict> conflict = optimizer::FindOneConflict(problem, Within(100.0), 0.0);
  ASSERT_EQ(conflict.size(), 1u);
  EXPECT_EQ(conflict[0].requirement, "prices");
  EXPECT_FALSE(conflict[0].required.has_value());
  ExpectMinimal(problem, conflict);
}

TEST(ConflictTest, TwoRequirementsThatExcludeEachOther) {
  int pairs = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Problem problem = Base(seed, Configuration::kMains);
    problem.count = 1000;
    const BruteForce all = Enumerate(problem);
    if (all.designs.size() < 2) continue;
    // Only the lightest design's mass, and a rise time that only heavier ones reach.
    Problem fast = problem;
    fast.groups[0].rise_time_max_s = 1e-3;
    const optimizer::Answer answer = optimizer::Search(fast, Within(100.0));
    const auto& conflicts = answer.infeasibility.conflicts;
    if (answer.status != Status::kInfeasible || conflicts.empty() || !conflicts[0][0].best)
      continue;
    problem.groups[0].rise_time_max_s = *conflicts[0][0].best * 1.01;
    problem.mass_max_kg = all.designs[0].leaf.objective * 1.0001;
    if (Feasible(problem)) continue;  // the lightest is also the fastest
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Conflict> conflict = Analyse(problem);
    EXPECT_GE(conflict.size(), 2u);
    ExpectMinimal(problem, conflict);
    for (const Conflict& c : conflict)
      if (c.required) ExpectTight(problem, c);
    ++pairs;
  }
  EXPECT_GT(pairs, 0);
}

TEST(ConflictTest, PressureThatNoPartStandsNamesTheOperatingPressure) {
  Problem problem = Base(3, Configuration::kMains);
  problem.groups[0].chamber.operating_pressure_pa = 30e5;
  problem.groups[0].pressure_max_pa = 31e5;
  const std::vector<Conflict> conflict = Analyse(problem);
  ASSERT_EQ(conflict.size(), 1u);
  EXPECT_EQ(conflict[0].requirement, "/actuators/0/operating_pressure_kpa_gauge");
  EXPECT_NEAR(conflict[0].required.value(), 2900.0, 1e-9);
  EXPECT_FALSE(conflict[0].best.has_value());
}

// Of a robot's supply there is one: what it gives is a demand, how many of it are not.
TEST(ConflictTest, WhatTheRobotGivesIsADemandAndPacksAreNot) {
  Problem problem = EasyProblem(5, {Configuration::kCompressor});
  problem.limits.batteries = 1;
  problem.power.kind = optimizer::PowerKind::kRobot;
  problem.power.voltage_v = 12.0;
  problem.power.current_a_max = 2.0;
  optimizer::SearchOptions options;
  options.select = [](const Problem& p) { return p.parts; };
  const auto has = [&](const std::string& pointer) {
    for (const optimizer::Demand& demand : optimizer::Demands(problem, options))
      if (demand.pointer == pointer) return true;
    return false;
  };
  EXPECT_TRUE(has("/supply/power/current_a_max"));
  EXPECT_FALSE(has("/supply/power/energy_wh_max"));
  EXPECT_FALSE(has("/limits/batteries_max"));
  problem.power = {};
  EXPECT_TRUE(has("/limits/batteries_max"));
  EXPECT_FALSE(has("/supply/power/current_a_max"));
}

}  // namespace conflict_test
}  // namespace plenum::test
