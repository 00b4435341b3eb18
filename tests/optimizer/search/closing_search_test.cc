// Valves that close late in the search: against plain enumeration and before the verifier, and what
// their time changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/enumerated_search.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace closing_search_test {

using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;

Problem Drawn(std::uint64_t seed, int groups) {
  Draw draw;
  draw.seed = 9100 + seed;
  draw.configurations = {seed % 4 == 0   ? Configuration::kMains
                         : seed % 4 == 1 ? Configuration::kCylinder
                         : seed % 4 == 2 ? Configuration::kCo2
                                         : Configuration::kCompressor};
  draw.severity = 0.03 * static_cast<double>(seed % 20);
  draw.groups = groups;
  draw.simultaneous = seed % 3 != 0;
  draw.size = groups == 1 ? CatalogueSize{2, 2, 4, 2, 2, 2, 2, 2, 1}
                          : CatalogueSize{1, 2, 3, 1, 1, 2, 1, 2, 1};
  Problem problem = RandomProblem(draw);
  Random random(seed);
  const auto most = [&](const model::FlowElement& flow) {
    return model::FlowElement{flow.sonic_conductance_m3_per_s_pa * Uniform(random, 1.0, 1.3),
                              std::min(0.9, flow.critical_ratio * Uniform(random, 1.0, 1.2))};
  };
  for (model::Valve& valve : problem.parts.valves) {
    valve.closing_scatter_s = Chance(random, 0.8) ? LogUniform(random, 2e-3, 0.3) : 0.0;
    if (seed % 2 == 0) valve.fill_most = most(valve.fill);
  }
  if (seed % 2 == 0)
    for (model::Fitting& fitting : problem.parts.fittings) fitting.flow_most = most(fitting.flow);
  for (optimizer::ActuatorGroup& group : problem.groups)
    if (group.pressure_max_pa < 1.02 * group.chamber.operating_pressure_pa)
      group.pressure_max_pa = Uniform(random, 1.02, 1.2) * group.chamber.operating_pressure_pa;
  return problem;
}

struct Tally {
  int feasible = 0, infeasible = 0, late = 0;
};

void Compare(const Problem& problem, Tally& tally) {
  const bool found = ExpectAsEnumerated(problem, [&](const Design& design, const Enumerated&) {
    for (std::size_t g = 0; g < problem.groups.size(); ++g) {
      const double peak_pa = design.performance.groups[g].highest_pressure_pa;
      EXPECT_LE(peak_pa, problem.groups[g].pressure_max_pa * (1.0 + 1e-9));
      tally.late += peak_pa > 1.01 * problem.groups[g].chamber.operating_pressure_pa;
    }
  });
  ++(found ? tally.feasible : tally.infeasible);
}

TEST(ClosingSearch, ListsWhatEnumerationLists) {
  Tally tally;
  for (int seed = 1; seed <= Draws(40); ++seed) {
    SCOPED_TRACE(seed);
    Compare(Drawn(seed, 1), tally);
  }
  EXPECT_GT(tally.feasible, Draws(20));
  EXPECT_GT(tally.late, Draws(20));
}

TEST(ClosingSearch, ListsWhatEnumerationListsOfSeveralGroups) {
  Tally tally;
  const std::vector<int> seeds{5, 6, 8, 1, 2, 4, 3, 7};  // out of a reservoir, a minute each, last
  for (int i = 0; i < Draws(8); ++i) {
    SCOPED_TRACE(seeds[i]);
    Compare(Drawn(seeds[i], 2), tally);
  }
  EXPECT_GT(tally.feasible, Draws(2));
}

// Two groups of one source: the valves of the small one close too late for the pressure that the
// other needs. That is seen at once, and by the verifier.
TEST(ClosingSearch, AGroupThatNeedsMoreThanAnotherStandsIsRuledOutAtOnce) {
  Problem problem = Drawn(3, 2);
  problem.simultaneous = false;
  for (model::Valve& valve : problem.parts.valves) {
    valve.kind = model::ValveKind::kPair;
    valve.closing_scatter_s = 0.05;
  }
  optimizer::ActuatorGroup &high = problem.groups[0], &low = problem.groups[1];
  high.chamber.operating_pressure_pa = 2.5e5;
  high.pressure_max_pa = 3e5;
  low.chamber.operating_pressure_pa = 1.5e5;
  low.chamber.rest_volume_m3 = 1e-6;
  low.pressure_max_pa = 1.52e5;
  const bool found = ExpectAsEnumerated(problem, [](const Design&, const Enumerated&) {});
  EXPECT_FALSE(found);
  const auto record = Recorded(problem).proof.record;
  ASSERT_EQ(record->plans.size(), 1U);
  EXPECT_EQ(record->plans[0].boxes.size(), 1U);
}

// A valve that closes in less time, or a higher limit, never makes the best design worse.
TEST(ClosingSearch, QuickerIsNeverWorse) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(seed, 1);
    problem.count = 1;
    const auto best = [](const Problem& p) {
      const optimizer::Answer answer = Recorded(p);
      return answer.designs.empty() ? optimizer::kUnlimited : answer.designs.front().objective;
    };
    const double late = best(problem);
    Problem higher = problem, quicker = problem;
    for (optimizer::ActuatorGroup& group : higher.groups) group.pressure_max_pa *= 1.1;
    for (model::Valve& valve : quicker.parts.valves) valve.closing_scatter_s *= 0.3;
    for (const Problem& easier : {higher, quicker}) {
      const double objective = best(easier);
      EXPECT_LE(objective, late * (1.0 + 1e-9));
      better += objective < late;
    }
  }
  EXPECT_GT(better, 3);
}

}  // namespace closing_search_test
}  // namespace plenum::test
