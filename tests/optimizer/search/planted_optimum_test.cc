// Parts that are best by construction, hidden in random catalogues: no bound may prune them.
#include <gtest/gtest.h>

#include <algorithm>

#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace planted_optimum_test {

using optimizer::Configuration;
using optimizer::Problem;

template <typename Part>
model::PartBasics& BasicsOf(Part& part) {
  if constexpr (requires { part.per_metre; })
    return part.per_metre;
  else
    return part.basics;
}

// Everything else in the family gets heavier; the planted part goes somewhere among it.
template <typename Part>
void Plant(Random& random, std::vector<Part>& family, Part part, double mass_kg) {
  for (Part& other : family) BasicsOf(other).mass_kg += 2.0;
  BasicsOf(part) = {"planted", mass_kg, 1e-5, 1.0};
  family.insert(family.begin() + Pick(random, 0, static_cast<int>(family.size())), part);
}

void PlantEverywhere(Random& random, Problem& problem) {
  model::Parts& parts = problem.parts;
  constexpr double kHighPa = 2e6;
  Plant(random, parts.tubing, {{}, 5e-3, 4e-3, kHighPa}, 0.01);
  Plant(random, parts.fittings, {{}, 5e-3, "planted", {2e-8, 0.5}, kHighPa}, 0.002);
  Plant(random, parts.valves,
        {{}, model::ValveKind::kPair, 1, "planted", {2e-8, 0.5}, {2e-8, 0.5}, 0.1, kHighPa}, 0.01);
  Plant(random, parts.regulators, {{}, {5e-8, 0.5}, optimizer::kUnlimited, 2e5, 5e7, 1e5, kHighPa},
        0.05);
  Plant(random, parts.cylinders, {{}, 1e-3, 3.01e7}, 0.3);
  Plant(random, parts.co2, {{}, 0.4, 0.0, 1e-2}, 0.3);
  model::Compressor pump;
  pump.curve.free_air_m3_per_s = model::MonotoneCurve({1e5, 8e5}, {1e-3, 8e-4});
  pump.curve.current_a = model::MonotoneCurve({1e5, 8e5}, {1.0, 2.0});
  pump.curve.voltage_v = 12.0;
  pump.curve.pressure_max_pa = 8e5;
  Plant(random, parts.compressors, pump, 0.1);
  Plant(random, parts.batteries, {{}, 11.1, 30.0, 200.0}, 0.1);
  Plant(random, parts.reservoirs, {{}, 2e-3, kHighPa}, 0.01);
}

TEST(PlantedOptimumTest, IsRankedFirst) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Draw draw;
    draw.seed = 2000 + seed;
    draw.configurations = {static_cast<Configuration>(seed % 4)};
    draw.severity = 0.4;
    draw.size = {5, 5, 6, 5, 5, 5, 4, 5, 2};
    Problem problem = RandomProblem(draw);
    problem.source_pressure_max_pa = 6e5;
    problem.mains.pressure_pa = 7e5;
    problem.mains.flow_max_m3_per_s = optimizer::kUnlimited;
    problem.count = 1;
    Random random(seed);
    PlantEverywhere(random, problem);
    const optimizer::Answer answer = optimizer::SearchTrees(problem, Within(100.0));
    SCOPED_TRACE("seed " + std::to_string(seed));
    EXPECT_EQ(answer.status, optimizer::Status::kOptimal);
    ASSERT_EQ(answer.designs.size(), 1u);
    for (const optimizer::Choice& choice : answer.designs[0].parts) {
      if (choice.family == optimizer::Family::kManifold) continue;  // no choice
      EXPECT_EQ(choice.id, "planted") << optimizer::Name(choice.family);
    }
  }
}

}  // namespace planted_optimum_test
}  // namespace plenum::test
