// Gaits in the search: against plain enumeration, by relations, and before the verifier.
#include <gtest/gtest.h>

#include "tests/support/drawn_gait.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace gait_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::Status;

Problem Drawn(std::uint64_t seed, Configuration configuration) {
  Draw draw;
  draw.seed = 5100 + seed;
  draw.configurations = {configuration};
  draw.groups = 1 + static_cast<int>(seed % 2);
  draw.simultaneous = seed % 3 != 0;
  draw.severity = 0.02 * static_cast<double>(seed % 15);
  const bool pumped = optimizer::IsPumped(configuration);
  const bool tank = configuration == Configuration::kTank;
  draw.size = tank     ? CatalogueSize{2, 2, 3, 2, 0, 0, 0, 2, 3}
              : pumped ? CatalogueSize{2, 2, 2, 0, 0, 0, 2, 2, 1}
                       : CatalogueSize{2, 2, 3, 2, 2, 2, 0, 2, 1};
  if (draw.groups == 2) draw.size.tubing = 1;
  Problem problem = RandomProblem(draw);
  problem.exclude.insert("custom");
  Random random(seed);
  DrawGaits(random, problem);
  if (tank) problem.actuations = std::round(LogUniform(random, 2.0, 12.0));
  for (model::Compressor& pump : problem.parts.compressors) pump.curve.voltage_v = 12.0;
  for (model::Battery& pack : problem.parts.batteries) pack.nominal_voltage_v = 11.1;
  for (model::Valve& valve : problem.parts.valves) {
    if (Chance(random, 0.6)) valve.kind = model::ValveKind::kPair;
    if (configuration == Configuration::kDirectPump) valve.pressure_min_pa = kAmbientPa;
  }
  return problem;
}

int Feasible(Configuration configuration, int draws) {
  int feasible = 0;
  for (int seed = 1; seed <= draws; ++seed) {
    SCOPED_TRACE(seed);
    feasible += ExpectAsEnumerated(Drawn(static_cast<std::uint64_t>(seed), configuration),
                                   [](const optimizer::Design&, const Enumerated&) {});
  }
  return feasible;
}

TEST(GaitSearchTest, OnTheMains) { EXPECT_GT(Feasible(Configuration::kMains, 24), 8); }
TEST(GaitSearchTest, OutOfBottles) { EXPECT_GT(Feasible(Configuration::kCylinder, 16), 4); }
TEST(GaitSearchTest, OutOfTanks) { EXPECT_GT(Feasible(Configuration::kTank, 16), 4); }
TEST(GaitSearchTest, OnPumpsWithAReservoir) {
  EXPECT_GT(Feasible(Configuration::kCompressor, 8), 1);
}
TEST(GaitSearchTest, OnPumpsAlone) { EXPECT_GT(Feasible(Configuration::kDirectPump, 30), 4); }

double Best(const Problem& problem) {
  Problem one = problem;
  one.count = 1;
  const Answer answer = optimizer::SearchTrees(one, Within(60.0));
  EXPECT_NE(answer.status, Status::kFeasible);
  return answer.designs.empty() ? optimizer::kUnlimited : answer.designs[0].objective;
}

// A period of n equal strokes is n periods of one; all phases may be shifted; a squad of its own is
// as good as a group of its own with the same parts, which is no better than any parts.
TEST(GaitSearchTest, Relations) {
  constexpr Configuration kSources[] = {Configuration::kMains, Configuration::kCylinder,
                                        Configuration::kCompressor};
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 18; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(seed, kSources[seed % 3]);
    problem.groups.resize(1);
    problem.groups[0].gait = {};
    problem.groups[0].count = 2;
    const double once = Best(problem);
    if (!std::isfinite(once)) continue;
    Problem strokes = problem;
    strokes.groups[0].gait.strokes_per_period = 3;
    strokes.frequency_hz /= 3.0;
    strokes.actuations = std::ceil(problem.actuations / 3.0);
    Problem as_often = problem;
    as_often.actuations = 3.0 * strokes.actuations;
    const double often = Best(as_often);
    if (std::isfinite(often)) {
      EXPECT_NEAR(Best(strokes), often, 1e-6 * once);
    }
    Problem late = problem;
    late.groups[0].gait.phases = {0.7};
    EXPECT_NEAR(Best(late), once, 1e-9 * once);
    // One after the other draws no more at once.
    Problem turns = problem;
    turns.groups[0].gait.phases = {0.0, 0.5};
    const double in_turns = Best(turns);
    Problem apart = turns;
    apart.groups.push_back(apart.groups[0]);
    for (int g : {0, 1}) {
      apart.groups[g].count = 1;
      apart.groups[g].joint_conductance_m3_per_s_pa /= 2.0;
      apart.groups[g].gait.phases = {0.5 * g};
    }
    // Two groups may have valves with several channels each for itself.
    for (model::Valve& valve : apart.parts.valves) valve.channels = 1;
    for (model::Valve& valve : turns.parts.valves) valve.channels = 1;
    EXPECT_LE(Best(apart), Best(turns) * (1.0 + 1e-6));
    compared += std::isfinite(in_turns);
  }
  EXPECT_GT(compared, 6);
}

}  // namespace gait_search_test
}  // namespace plenum::test
