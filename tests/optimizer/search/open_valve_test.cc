// Designs whose valves cannot hold: actuators stay on the source for half of the period, and what
// they are filled to by then is the air of a stroke, be that the source's pressure or less.
#include <gtest/gtest.h>

#include <algorithm>

#include "model/simulate/simulate.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"
#include "verify/verify.h"

namespace plenum::test {
namespace open_valve_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Problem;

// Lone 3/2 valves alone, actuators that stand what a source gives, and periods so short that many
// are not filled up.
Problem Drawn(std::uint64_t seed, Configuration configuration) {
  Draw draw;
  draw.seed = seed;
  draw.configurations = {configuration};
  draw.severity = 0.3;
  draw.size = {2, 2, 3, 2, 2, 2, 2, 2, 2};
  Problem problem = RandomProblem(draw);
  for (model::Valve& valve : problem.parts.valves) valve.kind = model::ValveKind::kThreeWay;
  for (optimizer::ActuatorGroup& group : problem.groups) group.pressure_max_pa = 8e5;
  problem.frequency_hz *= 4.0;
  problem.exclude.insert("custom");
  problem.count = 3;
  return problem;
}

void ExpectTheRightList(const Problem& problem, int& listed) {
  const BruteForce truth = Enumerate(problem);
  optimizer::SearchOptions options = Within(60.0);
  options.record = true;
  const Answer answer = optimizer::SearchTrees(problem, options);
  ASSERT_EQ(answer.designs.size(), std::min<std::size_t>(3, truth.designs.size()));
  for (std::size_t i = 0; i < answer.designs.size(); ++i)
    EXPECT_EQ(KeyOf(answer.designs[i]), truth.designs[i].key) << "rank " << i + 1;
  listed += static_cast<int>(answer.designs.size());
  for (const verify::Check& check : verify::Verify(problem, answer).checks)
    EXPECT_TRUE(check.ok) << check.name << ": " << check.detail;
}

TEST(OpenValve, TheListIsThatOfAllCombinations) {
  int listed = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    for (const Configuration configuration :
         {Configuration::kCompressor, Configuration::kCylinder, Configuration::kCo2}) {
      SCOPED_TRACE(std::to_string(seed) + optimizer::Name(configuration));
      ExpectTheRightList(Drawn(seed, configuration), listed);
    }
  EXPECT_GT(listed, 15);
}

// Duty and air are those of the simulated periodic state, also where half of the period is too
// short to fill the actuators up.
TEST(OpenValve, DutyAndAirAreThoseOfThePeriodicState) {
  int compared = 0, short_of_full = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Problem problem = Drawn(seed, Configuration::kCompressor);
    ForEachCombination(problem, [&](const optimizer::Candidate& candidate) {
      const optimizer::Leaf leaf = SizeAlone(problem, candidate);
      if (leaf.status != optimizer::LeafStatus::kFeasible) return;
      const double inflate_s =
          optimizer::Evaluate(problem, candidate, leaf.point).groups[0].inflate_time_s;
      for (const double times : {1.02, 1.2}) {
        Problem faster = problem;
        faster.frequency_hz = 0.5 / (times * inflate_s);
        const optimizer::Evaluation evaluation = optimizer::Evaluate(faster, candidate, leaf.point);
        if (!(evaluation.compressor_duty < 1.0)) continue;  // not full again in time
        const optimizer::Strokes simulated =
            optimizer::SimulateStrokes(faster, candidate, leaf.point);
        ASSERT_TRUE(evaluation.works && simulated.works);
        EXPECT_NEAR(evaluation.compressor_duty, simulated.pump_on_s * faster.frequency_hz,
                    1e-4 * evaluation.compressor_duty);
        // What is pumped in a cycle is what the actuators take.
        EXPECT_NEAR(evaluation.air_per_cycle_m3, simulated.pump_air_m3,
                    1e-4 * simulated.pump_air_m3);
        ++compared;
        short_of_full += simulated.filled_pa[0] < 0.99 * leaf.point.source_pa;
      }
    });
  }
  EXPECT_GT(compared, 40);
  EXPECT_GT(short_of_full, 20);
}

}  // namespace open_valve_test
}  // namespace plenum::test
