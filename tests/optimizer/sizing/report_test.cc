// What stands in a listed design.
#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace report_test {

using optimizer::Choice;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Family;
using optimizer::Problem;

void ExpectSums(const Design& design) {
  double mass_kg = 0.0, volume_m3 = 0.0, cost_eur = 0.0;
  bool priced = true;
  for (const Choice& choice : design.parts) {
    mass_kg += choice.mass_kg;
    volume_m3 += choice.volume_m3;
    priced = priced && choice.cost_eur;
    cost_eur += choice.cost_eur.value_or(0.0);
  }
  EXPECT_NEAR(design.totals.mass_kg, mass_kg, 1e-12);
  EXPECT_NEAR(design.totals.volume_m3, volume_m3, 1e-15);
  EXPECT_EQ(design.totals.cost_eur.has_value(), priced);
  EXPECT_NEAR(design.totals.cost_eur.value_or(cost_eur), cost_eur, 1e-9);
}

void ExpectPieces(const Problem& problem, const Design& design) {
  for (const Choice& choice : design.parts) {
    if (choice.family == Family::kValve) {
      const optimizer::ActuatorGroup& group = problem.groups[choice.group];
      for (const model::Valve& valve : problem.parts.valves)
        if (valve.basics.id == choice.id) {
          EXPECT_GE(choice.quantity * valve.channels, group.count);
          EXPECT_LT((choice.quantity - 1) * valve.channels, group.count);
          EXPECT_NEAR(choice.mass_kg, choice.quantity * valve.basics.mass_kg, 1e-12);
        }
    } else if (choice.family == Family::kTubing) {
      const optimizer::ActuatorGroup& group = problem.groups[choice.group];
      EXPECT_NEAR(choice.quantity, group.count * group.tube_length_m, 1e-12);
    } else if (choice.family == Family::kFitting) {
      const optimizer::ActuatorGroup& group = problem.groups[choice.group];
      EXPECT_EQ(choice.quantity, group.count * group.fittings_per_line);
    } else {
      EXPECT_EQ(choice.group, -1);
      EXPECT_EQ(choice.quantity, std::round(choice.quantity));
    }
  }
}

void ExpectMet(const Problem& problem, const Design& design) {
  for (const optimizer::Margin& margin : design.margins)
    EXPECT_GE(margin.relative_margin, -1e-9) << margin.requirement;
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const optimizer::GroupPerformance& group = design.performance.groups[g];
    EXPECT_LE(group.rise_time_s, problem.groups[g].rise_time_max_s * (1.0 + 1e-9));
    EXPECT_LE(group.fall_time_s, problem.groups[g].fall_time_max_s * (1.0 + 1e-9));
    EXPECT_LE(group.inflate_time_s * problem.frequency_hz, 0.5 * (1.0 + 1e-9));
    EXPECT_GE(group.inflate_time_s, group.rise_time_s);
    EXPECT_GT(group.rise_time_s, 0.0);
    EXPECT_NEAR(group.frequency_max_hz * (group.rise_time_s + group.fall_time_s), 1.0, 1e-12);
    EXPECT_NEAR(design.settings.valve_duty[g], group.inflate_time_s * problem.frequency_hz, 1e-12);
  }
  EXPECT_GE(design.performance.frequency_sustained_hz, problem.frequency_hz * (1.0 - 1e-9));
  EXPECT_NEAR(design.performance.run_time_s, problem.actuations / problem.frequency_hz, 1e-9);
  EXPECT_LE(design.settings.source_pressure_pa, problem.source_pressure_max_pa);
}

// Highest pressure of every trace stays within the group's limit, and the operating pressure is
// reached.
void ExpectTrace(const Problem& problem, const Design& design) {
  ASSERT_EQ(design.response.pressure_pa.size(), problem.groups.size());
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    double highest_pa = 0.0;
    for (double pressure_pa : design.response.pressure_pa[g])
      highest_pa = std::max(highest_pa, pressure_pa);
    EXPECT_LE(highest_pa, problem.groups[g].pressure_max_pa * (1.0 + 1e-6));
    EXPECT_GE(highest_pa, problem.groups[g].chamber.operating_pressure_pa * (1.0 - 1e-3));
  }
}

TEST(ReportTest, RowsSumToTotalsAndRequirementsAreMet) {
  int designs = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Draw draw;
    draw.seed = 4000 + seed;
    draw.configurations = {Configuration::kCylinder, Configuration::kCo2, Configuration::kMains};
    draw.groups = seed % 4 == 0 ? 2 : 1;
    draw.simultaneous = seed % 8 != 0;
    draw.severity = 0.3;
    draw.size = {2, 2, 3, 2, 2, 2, 0, 2, 0};
    Problem problem = RandomProblem(draw);
    problem.count = 4;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const optimizer::Answer answer = optimizer::SearchTrees(problem, Within(100.0));
    for (const Design& design : answer.designs) {
      ExpectSums(design);
      ExpectPieces(problem, design);
      ExpectMet(problem, design);
      ExpectTrace(problem, design);
      EXPECT_NEAR(design.objective, design.totals.mass_kg, 1e-9);
      ++designs;
    }
  }
  EXPECT_GT(designs, 50);
}

TEST(ReportTest, StaggeredGroupsOnACompressorBothRise) {
  Problem problem = EasyProblem(5, {Configuration::kCompressor});
  problem.groups.push_back(problem.groups[0]);
  problem.simultaneous = false;
  problem.exclude.insert("custom");
  problem.parts.tubing.resize(1);
  problem.parts.fittings.resize(1);
  problem.parts.valves.resize(2);
  problem.count = 2;
  const optimizer::Answer answer = optimizer::SearchTrees(problem, Within(20.0));
  ASSERT_FALSE(answer.designs.empty());
  for (const Design& design : answer.designs) {
    ExpectMet(problem, design);
    ExpectSums(design);
  }
}

}  // namespace report_test
}  // namespace plenum::test
