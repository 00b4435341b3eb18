// Ejectors in the search: against plain enumeration, against looser problems, and before the
// verifier.
#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/explain/explained_search.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/in_full.h"
#include "tests/support/pumps/vacuum_problems.h"

namespace plenum::test {
namespace ejector_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;

constexpr Configuration kReservoir = Configuration::kEjector,
                        kDirect = Configuration::kDirectEjector;

Problem Drawn(std::uint64_t seed, std::set<Configuration> configurations, int groups = 1) {
  Draw draw;
  draw.seed = 31000 + seed;
  draw.configurations = std::move(configurations);
  draw.severity = 0.03 * static_cast<double>(seed % 20);
  draw.groups = groups;
  draw.simultaneous = groups == 1;
  draw.size = groups == 1 ? CatalogueSize{3, 3, 4, 0, 0, 0, 3, 3, 2}
                          : CatalogueSize{2, 2, 3, 0, 0, 0, 2, 2, 2};
  Problem problem = EjectorProblem(draw);
  problem.frequency_hz *= 0.5;
  return problem;
}

TEST(EjectorSearch, ListsWhatEnumerationLists) {
  int feasible = 0, infeasible = 0, with_ejector = 0;
  for (int seed = 1; seed <= Draws(40); ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = seed % 4 == 0 ? Drawn(seed, {kDirect})
                            : seed % 4 == 1
                                ? Drawn(seed, {kReservoir, kDirect, Configuration::kVacuumPump})
                            : seed % 4 == 2 ? Drawn(seed, {kReservoir})
                                            : Drawn(seed, {kReservoir}, 2);
    const bool found = ExpectAsEnumerated(problem, [&](const Design& design, const Enumerated&) {
      with_ejector += IsEjector(design.configuration);
    });
    ++(found ? feasible : infeasible);
  }
  EXPECT_GT(feasible, Draws(12));
  EXPECT_GT(infeasible, 0);
  EXPECT_GT(with_ejector, Draws(40));
}

// More compressed air, ejectors that blow less, and more of them.
TEST(EjectorSearch, LooserIsNeverWorse) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(100 + seed, {kReservoir, kDirect});
    problem.count = 1;
    const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    std::vector<Problem> looser(4, problem);
    looser[0].compressed_air.flow_max_m3_per_s *= 1.5;
    for (model::Compressor& ejector : looser[1].parts.ejectors)
      ejector.air_consumption_m3_per_s *= 0.8;
    looser[2].limits.compressors += 1;
    looser[3].configurations.insert(Configuration::kVacuumPump);
    ASSERT_NO_FATAL_FAILURE(ExpectNeverWorse(answer, looser));
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

// Designs use no more compressed air than there is, and no energy but that of their valves.
TEST(EjectorSearch, AirAndEnergy) {
  int limited = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(200 + seed, {kReservoir});
    for (const Design& design : optimizer::SearchTrees(problem, Within(60.0)).designs) {
      double air_m3_per_s = 0.0;
      for (const optimizer::Choice& row : design.parts)
        if (row.family == optimizer::Family::kEjector)
          for (const model::Compressor& ejector : problem.parts.ejectors)
            if (ejector.basics.id == row.id)
              air_m3_per_s += row.quantity * ejector.air_consumption_m3_per_s;
      EXPECT_GT(air_m3_per_s, 0.0);
      EXPECT_LE(air_m3_per_s, problem.compressed_air.flow_max_m3_per_s * (1.0 + 1e-9));
      limited += std::isfinite(problem.compressed_air.flow_max_m3_per_s);
    }
  }
  EXPECT_GT(limited, 5);
}

TEST(EjectorSearch, TheVerifierAcceptsAndRefusesWhatIsTamperedWith) {
  int looked_at = 0;
  for (std::uint64_t seed = 1; seed <= 30 && looked_at < 4; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(300 + seed, {seed % 2 == 0 ? kReservoir : kDirect});
    const Answer answer = Recorded(problem);
    if (answer.designs.empty()) continue;
    ASSERT_TRUE(Accepts(problem, answer));
    const auto refused = [&](const auto& change) { return RefusesFirst(problem, answer, change); };
    EXPECT_TRUE(refused([](Design& d) { d.settings.source_pressure_pa *= 1.01; }));
    EXPECT_TRUE(refused([](Design& d) { d.performance.groups[0].rise_time_s *= 0.999; }));
    EXPECT_TRUE(refused([](Design& d) { d.configuration = Configuration::kVacuumPump; }));
    Problem less_air = problem;
    less_air.compressed_air.flow_max_m3_per_s = 1e-9;
    EXPECT_FALSE(Accepts(less_air, answer));
    ++looked_at;
  }
  EXPECT_EQ(looked_at, 4);
}

}  // namespace ejector_search_test
}  // namespace plenum::test
