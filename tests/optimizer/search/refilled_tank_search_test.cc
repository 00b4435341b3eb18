// Tanks that pumps go on filling, in the search: against plain enumeration, against looser
// problems, against tanks and pumps alone, and before the verifier, which sizes them in its own
// way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/enumerated_search.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace refilled_tank_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;

Problem Drawn(std::uint64_t seed, int groups = 1, bool simultaneous = true) {
  Draw draw;
  draw.seed = 9100 + seed;
  draw.configurations = {Configuration::kTankAndPump};
  draw.severity = 0.03 * static_cast<double>(seed % 20);
  draw.groups = groups;
  draw.simultaneous = simultaneous;
  draw.size = groups == 1 ? CatalogueSize{2, 2, 3, 2, 0, 0, 3, 3, 3}
                          : CatalogueSize{2, 2, 2, 2, 0, 0, 2, 2, 2};
  Problem problem = RandomProblem(draw);
  Random random(seed);
  problem.limits.reservoirs = Pick(random, 1, 2);
  problem.actuations = std::round(LogUniform(random, 5.0, 2000.0));
  if (Chance(random, 0.5)) problem.tank_fill_max_pa = kAmbientPa + Uniform(random, 4.0, 9.0) * kBar;
  if (Chance(random, 0.3))
    for (model::Compressor& pump : problem.parts.compressors) MakePowerFall(random, pump.curve);
  return problem;
}

struct Tally {
  int feasible = 0, infeasible = 0, pumped = 0, idle = 0;
};

void Compare(const Problem& problem, Tally& tally) {
  const bool found = ExpectAsEnumerated(problem, [&](const Design& design, const Enumerated&) {
    ASSERT_TRUE(design.settings.tank_fill_pa && design.settings.pump_stop_pa);
    EXPECT_LE(*design.settings.pump_stop_pa, *design.settings.tank_fill_pa * (1.0 + 1e-9));
    (*design.settings.compressor_duty > 0.0 ? tally.pumped : tally.idle)++;
  });
  ++(found ? tally.feasible : tally.infeasible);
}

TEST(RefilledTankSearch, ListsWhatEnumerationLists) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Compare(Drawn(seed), tally);
  }
  EXPECT_GT(tally.feasible, 10);
  EXPECT_GT(tally.infeasible, 2);
  EXPECT_GT(tally.pumped, 20);
}

TEST(RefilledTankSearch, ListsWhatEnumerationListsForOtherObjectivesAndLimits) {
  constexpr optimizer::Objective kObjectives[] = {
      {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {1.0, 0.3, 0.0, 0.0}, {0.5, 0.0, 0.002, 0.0}};
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(100 + seed);
    problem.objective = kObjectives[seed % 4];
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 4);
}

TEST(RefilledTankSearch, EnergyAsTheObjective) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(300 + seed);
    problem.objective = {seed % 2 == 0 ? 0.2 : 0.0, 0.0, 0.0, 1.0};
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 3);
}

TEST(RefilledTankSearch, SeveralGroups) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(200 + seed, 2, seed % 2 == 0);
    problem.limits.batteries = problem.limits.reservoirs = problem.limits.compressors = 1;
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 1);
}

// More to fill, larger ratings, stronger pumps, fewer strokes: never worse.
TEST(RefilledTankSearch, LooserIsNeverWorse) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(400 + seed);
    problem.count = 1;
    problem.tank_fill_max_pa = kAmbientPa + 6.0 * kBar;
    const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    std::vector<Problem> looser(5, problem);
    looser[0].tank_fill_max_pa += 2.0 * kBar;
    for (model::Reservoir& tank : looser[1].parts.tanks) tank.pressure_max_pa *= 1.5;
    looser[2].actuations = std::max(1.0, looser[2].actuations - 1.0);
    for (model::Battery& battery : looser[3].parts.batteries) battery.capacity_ah *= 1.2;
    looser[4].limits.reservoirs += 1;
    ASSERT_NO_FATAL_FAILURE(ExpectNeverWorse(answer, looser));
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

// A tank that lasts by itself is lighter without pumps, and the search of both says so.
TEST(RefilledTankSearch, BesideTanksAndPumpsAlone) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(500 + seed);
    problem.configurations = {Configuration::kTank, Configuration::kTankAndPump};
    const Answer answer = Recorded(problem, 60.0);
    EXPECT_EQ(answer.proof.undecided, 0);
    if (answer.designs.empty()) continue;
    ++tally.feasible;
    ExpectVerified(problem, answer);
  }
  EXPECT_GT(tally.feasible, 2);
}

TEST(RefilledTankSearch, TheVerifierRefusesWhatIsTamperedWith) {
  int looked_at = 0;
  for (std::uint64_t seed = 1; seed <= 30 && looked_at < 3; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(600 + seed);
    const Answer answer = Recorded(problem);
    if (answer.designs.empty() || *answer.designs.front().settings.compressor_duty == 0.0) continue;
    ASSERT_TRUE(Accepts(problem, answer));
    const auto refused = [&](const auto& change) { return RefusesFirst(problem, answer, change); };
    EXPECT_TRUE(refused([](Design& d) { *d.settings.tank_fill_pa *= 1.01; }));
    EXPECT_TRUE(refused([](Design& d) { *d.settings.pump_stop_pa *= 1.01; }));
    EXPECT_TRUE(refused([](Design& d) { d.settings.pump_stop_pa.reset(); }));
    EXPECT_TRUE(refused([](Design& d) { *d.settings.compressor_duty *= 0.98; }));
    EXPECT_TRUE(refused([](Design& d) { d.totals.energy_j *= 0.98; }));
    EXPECT_TRUE(refused([](Design& d) {
      std::erase_if(d.parts, [](const optimizer::Choice& row) {
        return row.family == optimizer::Family::kCompressor;
      });
    }));
    ++looked_at;
  }
  EXPECT_GE(looked_at, 2);
}

}  // namespace refilled_tank_search_test
}  // namespace plenum::test
