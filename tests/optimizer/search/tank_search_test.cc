// Tanks in the search: against plain enumeration, against looser problems, and before the verifier.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "optimizer/explain/explained_search.h"
#include "optimizer/problem/kind.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace tank_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;
using optimizer::Status;

Problem Drawn(std::uint64_t seed, int groups = 1, bool simultaneous = true) {
  Draw draw;
  draw.seed = 7000 + seed;
  draw.configurations = {Configuration::kTank};
  draw.severity = 0.03 * static_cast<double>(seed % 25);
  draw.groups = groups;
  draw.simultaneous = simultaneous;
  draw.size = groups == 1 ? CatalogueSize{3, 3, 4, 2, 0, 0, 0, 2, 4}
                          : CatalogueSize{2, 2, 3, 2, 0, 0, 0, 2, 3};
  Problem problem = RandomProblem(draw);
  Random random(seed);
  problem.limits.reservoirs = Pick(random, 1, 3);
  problem.actuations = std::round(LogUniform(random, 2.0, 25.0));
  if (Chance(random, 0.5)) problem.tank_fill_max_pa = kAmbientPa + Uniform(random, 3.0, 9.0) * kBar;
  return problem;
}

bool IsOpen(const Design& design) {
  return std::none_of(design.parts.begin(), design.parts.end(), [](const optimizer::Choice& row) {
    return row.family == optimizer::Family::kRegulator;
  });
}

struct Tally {
  int feasible = 0, infeasible = 0, open = 0, regulated = 0;
};

void Compare(const Problem& problem, Tally& tally) {
  const bool found = ExpectAsEnumerated(problem, [&](const Design& design, const Enumerated&) {
    (IsOpen(design) ? tally.open : tally.regulated)++;
  });
  ++(found ? tally.feasible : tally.infeasible);
}

TEST(TankSearch, ListsWhatEnumerationLists) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Compare(Drawn(seed), tally);
  }
  EXPECT_GT(tally.feasible, 15);
  EXPECT_GT(tally.infeasible, 2);
  EXPECT_GT(tally.open, 20);
  EXPECT_GT(tally.regulated, 20);
}

TEST(TankSearch, ListsWhatEnumerationListsForOtherObjectivesAndLimits) {
  constexpr optimizer::Objective kObjectives[] = {
      {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {1.0, 0.3, 0.0, 0.0}, {0.5, 0.0, 0.002, 0.0}};
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(100 + seed);
    problem.objective = kObjectives[seed % 4];
    const BruteForce all = Enumerate(problem);
    if (all.designs.empty()) continue;
    if (seed % 3 == 0) problem.mass_max_kg = 1.2 * all.designs[0].mass_kg + 0.5;
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 8);
}

TEST(TankSearch, SeveralGroups) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(200 + seed, 2, seed % 2 == 0);
    problem.limits.batteries = 1;
    problem.limits.reservoirs = 1;
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 2);
}

TEST(TankSearch, BesideOtherSupplies) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(800 + seed);
    Random random(seed);
    problem.parts.cylinders = RandomParts(random, {0, 0, 0, 0, 2, 0, 0, 0, 0}).cylinders;
    problem.configurations = {Configuration::kTank, Configuration::kCylinder,
                              Configuration::kMains};
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 8);
}

TEST(TankSearch, EnergyAsTheObjective) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(300 + seed);
    problem.objective = {seed % 2 == 0 ? 0.2 : 0.0, 0.0, 0.0, 1.0};
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 3);
}

// More to fill, larger ratings, fewer strokes: never worse.
TEST(TankSearch, LooserIsNeverWorse) {
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
    looser[3].groups[0].rise_time_max_s *= 1.3;
    looser[4].limits.reservoirs += 1;
    ASSERT_NO_FATAL_FAILURE(ExpectNeverWorse(answer, looser));
    ++compared;
  }
  EXPECT_GT(compared, 8);
}

// A list of kinds names the tank's series as the source, and none as a regulator.
TEST(TankSearch, KindsHaveTheTanksSeriesAsTheirSource) {
  int listed = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(500 + seed);
    problem.list = optimizer::ListOf::kKinds;
    problem.count = 6;
    problem.limits.per_source = 2;
    for (std::size_t i = 0; i < problem.parts.tanks.size(); ++i)
      problem.parts.tanks[i].basics.series = i % 2 == 0 ? "even" : "odd";
    const Answer answer = Recorded(problem);
    const optimizer::DesignKinds kinds(problem.parts);
    std::set<optimizer::Kind> seen;
    std::map<int, int> of_source;
    for (const Design& design : answer.designs) {
      const optimizer::Kind kind = kinds.Of(design.configuration, design.parts);
      ASSERT_EQ(kind.sources.size(), 1u);
      EXPECT_EQ(kind.regulators.empty(), IsOpen(design));
      EXPECT_TRUE(seen.insert(kind).second);
      EXPECT_LE(++of_source[kind.sources.front()], 2);
      ++listed;
    }
    ExpectVerified(problem, answer);
  }
  EXPECT_GT(listed, 15);
}

// ── what the verifier refuses ──

TEST(TankSearch, TheVerifierRefusesWhatIsTamperedWith) {
  int open = 0, regulated = 0;
  for (std::uint64_t seed = 1; seed <= 30 && (open < 3 || regulated < 3); ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(600 + seed);
    const Answer answer = Recorded(problem);
    if (answer.designs.empty()) continue;
    ASSERT_TRUE(Accepts(problem, answer));
    const auto refused = [&](const auto& change) { return RefusesFirst(problem, answer, change); };
    const auto tank = [](Design& design) -> optimizer::Choice& {
      return *std::find_if(design.parts.begin(), design.parts.end(),
                           [](const auto& row) { return row.family == optimizer::Family::kTank; });
    };
    EXPECT_TRUE(refused([](Design& d) { *d.settings.tank_fill_pa *= 1.01; }));
    EXPECT_TRUE(refused([](Design& d) { d.settings.tank_fill_pa.reset(); }));
    EXPECT_TRUE(refused([](Design& d) { d.settings.source_pressure_pa *= 0.98; }));
    EXPECT_TRUE(refused([](Design& d) { *d.settings.reservoir_volume_m3 *= 1.01; }));
    EXPECT_TRUE(refused([&](Design& d) { tank(d).mass_kg *= 1.001; }));
    EXPECT_TRUE(refused([](Design& d) { d.performance.groups[0].rise_time_s *= 1.01; }));
    EXPECT_TRUE(refused([](Design& d) { d.performance.air_total_m3 *= 1.01; }));
    if (IsOpen(answer.designs.front())) {
      ++open;
    } else {
      ++regulated;
      EXPECT_TRUE(refused([](Design& d) {
        std::erase_if(d.parts, [](const optimizer::Choice& row) {
          return row.family == optimizer::Family::kRegulator;
        });
      }));
    }
    Problem tight = problem;
    tight.tank_fill_max_pa = *answer.designs.front().settings.tank_fill_pa * 0.999;
    EXPECT_FALSE(Accepts(tight, answer));
    Answer shorter = answer;
    shorter.designs.erase(shorter.designs.begin());
    EXPECT_FALSE(Accepts(problem, shorter));
  }
  EXPECT_GE(open, 1);
  EXPECT_GE(regulated, 1);
}

// "No design" is said only with a reason that names the fill where that is it.
TEST(TankSearch, AConflictNamesTheFill) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= 10 && named < 3; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(700 + seed);
    problem.tank_fill_max_pa = optimizer::kUnlimited;
    problem.count = 1;
    if (Recorded(problem).designs.empty()) continue;
    problem.tank_fill_max_pa = problem.groups[0].chamber.operating_pressure_pa + 100.0;
    const Answer answer = optimizer::Search(problem, Within(60.0));
    ASSERT_EQ(answer.status, Status::kInfeasible);
    ASSERT_FALSE(answer.infeasibility.conflicts.empty());
    bool fill = false;
    for (const optimizer::Conflict& entry : answer.infeasibility.conflicts.front())
      fill = fill || entry.requirement == "/supply/tank_fill_kpa_gauge_max";
    EXPECT_TRUE(fill);
    ++named;
  }
  EXPECT_GE(named, 1);
}

}  // namespace tank_search_test
}  // namespace plenum::test
