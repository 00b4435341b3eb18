// Draws of part numbers against plain enumeration of every drawn catalogue.
#include "optimizer/explain/robust.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "optimizer/explain/explained_search.h"
#include "optimizer/sizing/resize.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace robust_test {

using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;
using optimizer::RobustAnswer;
using optimizer::Status;

#ifdef PLENUM_SANITIZED
constexpr int kDraws = 4;
#else
constexpr int kDraws = 20;
#endif

Problem Drawn(std::uint64_t seed, std::set<Configuration> configurations) {
  Draw draw;
  draw.seed = seed;
  draw.configurations = std::move(configurations);
  draw.severity = 0.6;
  draw.size = {2, 1, 3, 2, 2, 2, 1, 2, 1};
  Problem problem = RandomProblem(draw);
  problem.exclude.insert("custom");
  problem.limits = {1, 2, 2, 2, 1};
  problem.count = 12;
  return problem;
}

// The whole catalogue with every mass, conductance and charge off by up to a quarter.
model::Parts Shaken(model::Parts parts, int draw) {
  Random random(static_cast<std::uint64_t>(1000 + draw));
  const auto shake = [&](double& number) { number *= Uniform(random, 0.75, 1.25); };
  for (model::Tubing& tube : parts.tubing) shake(tube.per_metre.mass_kg);
  for (model::Fitting& fitting : parts.fittings) shake(fitting.flow.sonic_conductance_m3_per_s_pa);
  for (model::Valve& valve : parts.valves) {
    shake(valve.basics.mass_kg);
    shake(valve.fill.sonic_conductance_m3_per_s_pa);
    shake(valve.exhaust.sonic_conductance_m3_per_s_pa);
    shake(valve.coil_power_w);
  }
  for (model::Battery& battery : parts.batteries) {
    shake(battery.basics.mass_kg);
    shake(battery.capacity_ah);
  }
  for (model::Cylinder& cylinder : parts.cylinders) shake(cylinder.water_volume_m3);
  for (model::Co2Bottle& bottle : parts.co2) shake(bottle.co2_mass_kg);
  for (model::Compressor& compressor : parts.compressors) {
    shake(compressor.basics.mass_kg);
    shake(compressor.duty_max);
  }
  return parts;
}

optimizer::DrawParts Shaking(const Problem& problem) {
  return [parts = problem.parts](const Design&, int draw) { return Shaken(parts, draw); };
}

using ByKey = std::map<PartsKey, double>;

// Objectives of all feasible combinations, draw by draw.
std::vector<ByKey> EnumerateDraws(Problem problem) {
  const model::Parts parts = problem.parts;
  std::vector<ByKey> draws;
  for (int draw = 0; draw < kDraws; ++draw) {
    problem.parts = Shaken(parts, draw);
    draws.emplace_back();
    for (const Enumerated& enumerated : Enumerate(problem).designs)
      draws.back()[enumerated.key] = enumerated.leaf.objective;
  }
  return draws;
}

int Met(const std::vector<ByKey>& draws, const PartsKey& key) {
  return static_cast<int>(std::count_if(draws.begin(), draws.end(),
                                        [&](const ByKey& draw) { return draw.contains(key); }));
}

void ExpectShares(const RobustAnswer& result, const std::vector<ByKey>& draws) {
  ASSERT_EQ(result.robustness.size(), result.answer.designs.size());
  EXPECT_EQ(result.draws, kDraws);
  std::vector<int> first(result.answer.designs.size(), 0);
  for (const ByKey& draw : draws) {
    double least = optimizer::kUnlimited;
    for (const Design& design : result.answer.designs)
      if (const auto found = draw.find(KeyOf(design)); found != draw.end())
        least = std::min(least, found->second);
    for (std::size_t i = 0; i < first.size(); ++i) {
      const auto found = draw.find(KeyOf(result.answer.designs[i]));
      if (found == draw.end() || found->second > least * (1.0 + 1e-9)) continue;
      ++first[i];
      break;
    }
  }
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(result.robustness[i].met, Met(draws, KeyOf(result.answer.designs[i]))) << i;
    EXPECT_EQ(result.robustness[i].first, first[i]) << i;
  }
}

const std::set<Configuration> kAll{Configuration::kCylinder, Configuration::kCo2,
                                   Configuration::kMains, Configuration::kCompressor};

TEST(Resize, GivesEachListedDesignItsOwnObjective) {
  int designs = 0;
  for (std::uint64_t seed = 3001; seed <= 3006; ++seed) {
    Problem problem = Drawn(seed, kAll);
    if (seed % 3 == 0) {  // a made-to-measure reservoir is sized anew
      problem.configurations = {Configuration::kCompressor};
      problem.exclude.clear();
      problem.count = 3;
    }
    for (const Design& design : optimizer::Search(problem, Within(60.0)).designs) {
      const Problem own = WithPartsOf(problem, design);
      EXPECT_LE(own.parts.valves.size(), 1u);
      const optimizer::Leaf leaf = Resize(own, design);
      ASSERT_EQ(leaf.status, optimizer::LeafStatus::kFeasible);
      EXPECT_NEAR(leaf.objective, design.objective, 1e-6 * design.objective);
      ++designs;
    }
  }
  EXPECT_GT(designs, 20);
}

TEST(Resize, MissingPartsAreInfeasible) {
  const Problem problem = Drawn(3001, {Configuration::kMains});
  const optimizer::Answer answer = optimizer::Search(problem, Within(60.0));
  ASSERT_FALSE(answer.designs.empty());
  Problem without = WithPartsOf(problem, answer.designs[0]);
  without.parts.regulators.clear();
  EXPECT_EQ(Resize(without, answer.designs[0]).status, optimizer::LeafStatus::kInfeasible);
}

TEST(RobustTest, SharesAreThoseOfEnumeration) {
  int designs = 0, partly = 0;
  for (std::uint64_t seed = 3101; seed <= 3106; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Problem problem = Drawn(seed, kAll);
    const RobustAnswer result =
        SearchRobust(problem, Within(60.0), {kDraws, 60.0, {}}, Shaking(problem));
    ExpectShares(result, EnumerateDraws(problem));
    for (const optimizer::Robustness& robustness : result.robustness) {
      ++designs;
      partly += robustness.met > 0 && robustness.met < kDraws;
    }
  }
  std::printf("%d designs, %d met in some draws only\n", designs, partly);
  EXPECT_GT(partly, 5);
}

TEST(RobustTest, ALeastProbabilityLeavesTheBestThatReachIt) {
  int left_out = 0;
  for (std::uint64_t seed = 3101; seed <= 3104; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed, kAll);
    problem.count = 3;
    const RobustAnswer result =
        SearchRobust(problem, Within(60.0), {kDraws, 60.0, 0.9}, Shaking(problem));
    const std::vector<ByKey> draws = EnumerateDraws(problem);
    ExpectShares(result, draws);
    std::vector<Enumerated> reach;
    for (const Enumerated& enumerated : Enumerate(problem).designs)
      if (Met(draws, enumerated.key) >= 0.9 * kDraws) reach.push_back(enumerated);
    const std::vector<Design>& designs = result.answer.designs;
    ASSERT_EQ(designs.size(), std::min<std::size_t>(3, reach.size()));
    EXPECT_EQ(result.answer.status, designs.empty() ? Status::kFeasible : Status::kOptimal);
    for (std::size_t i = 0; i < designs.size(); ++i)
      EXPECT_NEAR(designs[i].objective, reach[i].leaf.objective, 1e-6 * designs[i].objective);
    if (reach.size() > designs.size()) {
      EXPECT_LE(result.answer.proof.lower_bound,
                reach[designs.size()].leaf.objective * (1.0 + 1e-9));
    }
    left_out += result.below;
  }
  EXPECT_GT(left_out, 0);
}

TEST(RobustTest, StopsInTimeWithTheDrawsItHas) {
  const Problem problem = Drawn(3101, kAll);
  const RobustAnswer result =
      SearchRobust(problem, Within(60.0), {1'000'000, 0.05, {}}, Shaking(problem));
  EXPECT_LT(result.draws, 1'000'000);
  for (const optimizer::Robustness& robustness : result.robustness)
    EXPECT_LE(robustness.met, result.draws);
}

TEST(RobustTest, SaysThatItWasCancelledBeforeTheListWasWhole) {
  Problem problem = Drawn(3101, kAll);
  problem.count = 3;
  const optimizer::DrawParts parts = Shaking(problem);
  bool cancelled = false;
  const optimizer::DrawParts cancelling = [&](const Design& design, int draw) {
    cancelled = draw > 1;
    return parts(design, draw);
  };
  optimizer::SearchOptions options = Within(60.0);
  options.cancelled = [&] { return cancelled; };
  const RobustAnswer result = SearchRobust(problem, options, {kDraws, 60.0, 1.0}, cancelling);
  EXPECT_EQ(result.answer.status, Status::kCancelled);
  EXPECT_LT(result.draws, kDraws);
  EXPECT_FALSE(result.answer.proof.complete);
}

}  // namespace robust_test
}  // namespace plenum::test
