// Groups at once on a pump's reservoir: what designs in turns suggest, and what a full reservoir
// refutes.
#include "optimizer/search/in_turns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "optimizer/choices/make_plan.h"
#include "optimizer/evaluate/evaluate.h"
#include "optimizer/evaluate/strokes/full_strokes.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/search/box_search.h"
#include "optimizer/search/first_designs.h"
#include "optimizer/search/tree_search.h"
#include "optimizer/sizing/report.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace in_turns_test {

using optimizer::Bounds;
using optimizer::Box;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::Variant;

Problem AtOnce(std::uint64_t seed) {
  Draw draw;
  draw.seed = 4100 + seed;
  draw.configurations = {Configuration::kCompressor};
  draw.groups = 2;
  draw.simultaneous = true;
  draw.severity = 0.03 * static_cast<double>(seed % 16);
  draw.size = {2, 2, 4, 4, 1, 1, 3, 1, 3};
  Problem problem = RandomProblem(draw);
  problem.limits = {2, 2, 1, 1, 2};
  return problem;
}

std::vector<Variant> List(const Problem& problem, const optimizer::SearchOptions& options) {
  return optimizer::ListCombinations(problem, options).combinations;
}

TEST(InTurnsTest, IsForReservoirsThatStrokesMeetOn) {
  const Problem problem = AtOnce(1);
  EXPECT_TRUE(optimizer::IsCheaperInTurns(problem, Configuration::kCompressor));
  EXPECT_FALSE(optimizer::IsCheaperInTurns(problem, Configuration::kCylinder));
  EXPECT_FALSE(optimizer::IsCheaperInTurns(optimizer::InTurns(problem, Configuration::kCompressor),
                                           Configuration::kCompressor));
}

// The first boxes hold the designs' own parts; and where these do at once, a design is found.
TEST(InTurnsTest, PartsOfADesignInTurns) {
  int boxes_seen = 0, found = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Problem problem = AtOnce(seed);
    const auto plan = optimizer::MakePlan(problem, {Configuration::kCompressor});
    if (plan->empty()) continue;
    Bounds bounds(problem, *plan);
    const std::vector<Variant> designs =
        List(optimizer::InTurns(problem, Configuration::kCompressor), Within(5.0));
    std::vector<Box> boxes = optimizer::BoxesLike(problem, bounds, designs);
    ASSERT_EQ(boxes.size(), 3 * designs.size());
    for (std::size_t d = 0; d < designs.size(); ++d) {
      for (std::size_t s = 0; s < plan->slots.size(); ++s) {
        const optimizer::Slot& slot = plan->slots[s];
        const optimizer::BoxNode& node = (*slot.nodes)[boxes[d].nodes[s]];
        if (!node.single()) continue;
        const optimizer::Option& option = (*slot.options)[node.first];
        if (option.index < 0) continue;
        const std::string& id = optimizer::BasicsOf(problem.parts, slot.family, option.index).id;
        EXPECT_TRUE(std::any_of(
            designs[d].parts.begin(), designs[d].parts.end(), [&](const optimizer::Choice& row) {
              return row.family == slot.family && row.group == slot.group && row.id == id;
            }));
        ++boxes_seen;
      }
    }
    Problem of_one = problem;
    of_one.count = 1;
    optimizer::Ranking ranking(of_one);
    optimizer::SearchLikely(
        problem, bounds, std::move(boxes), [] { return false; }, ranking);
    found += !ranking.list().empty();
    for (const optimizer::Found& one : ranking.list())
      EXPECT_TRUE(optimizer::MakeDesign(problem, one.bounds->CandidateOf(one.box), one.leaf));
  }
  EXPECT_GT(boxes_seen, 10);
  EXPECT_GT(found, 0);
}

// A simulation that takes its time, and cannot be stopped for a first design, would outlast the
// share of the time limit that designs in turns have.
TEST(InTurnsTest, NoDesignInTurnsIsSimulated) {
  int boxes_seen = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Problem problem = AtOnce(seed);
    const auto plan = optimizer::MakePlan(problem, {Configuration::kCompressor});
    if (plan->empty()) continue;
    const Bounds bounds(problem, *plan);
    optimizer::SearchOptions options = Within(5.0);
    int simulated = 0;
    options.periodic = [&simulated](auto&&... rest) {
      ++simulated;
      return model::FindPeriodicState(rest...);
    };
    boxes_seen += static_cast<int>(optimizer::LikeInTurns(problem, bounds, options, List).size());
    EXPECT_EQ(simulated, 0) << "seed " << seed;
  }
  EXPECT_GT(boxes_seen, 0);
}

// Four legs, two at a time, each twice in a period.
Problem Gait(std::uint64_t seed) {
  Draw draw;
  draw.seed = 4200 + seed;
  draw.configurations = {Configuration::kCompressor};
  draw.severity = 0.03 * static_cast<double>(seed % 16);
  draw.size = {2, 2, 4, 4, 1, 1, 3, 1, 3};
  Problem problem = RandomProblem(draw);
  problem.limits = {2, 2, 1, 1, 2};
  optimizer::ActuatorGroup& legs = problem.groups.front();
  legs.count = 4;
  legs.gait = {.phases = {0.0, 0.25, 0.5, 0.75}, .inflate_fraction = 0.3, .strokes_per_period = 2};
  problem.frequency_hz *= 0.25;
  return problem;
}

TEST(InTurnsTest, AGaitOfOneGroupIsBurstsOfTheSameAir) {
  const Problem problem = Gait(1);
  ASSERT_TRUE(optimizer::IsCheaperInTurns(problem, Configuration::kCompressor));
  const Problem bursts = optimizer::InTurns(problem, Configuration::kCompressor);
  EXPECT_FALSE(optimizer::IsCheaperInTurns(bursts, Configuration::kCompressor));
  EXPECT_EQ(bursts.groups.front().count, 2);
  EXPECT_DOUBLE_EQ(bursts.frequency_hz, 4.0 * problem.frequency_hz);
  EXPECT_DOUBLE_EQ(bursts.actuations, 4.0 * problem.actuations);
}

// What is too slow out of a full reservoir is too slow in the periodic state.
TEST(InTurnsTest, NothingIsFasterThanAFullReservoir) {
  int too_slow = 0, in_time = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Problem problem = AtOnce(seed);
    const auto plan = optimizer::MakePlan(problem, {Configuration::kCompressor});
    if (plan->empty()) continue;
    Bounds bounds(problem, *plan);
    std::mt19937_64 random(seed);
    for (int draw = 0; draw < 40; ++draw) {
      Box box = bounds.Root();
      for (std::size_t s = 0; s < plan->slots.size(); ++s)
        box.nodes[s] = optimizer::LeafOf(
            *plan->slots[s].nodes, static_cast<int>(random() % plan->slots[s].options->size()));
      if (bounds.Assess(box, -1) != optimizer::Constraint::kNone) continue;
      const optimizer::Candidate candidate = bounds.CandidateOf(box);
      const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
      if (window.empty()) continue;
      const double volume_m3 = candidate.reservoir.index == optimizer::kCustom
                                   ? 2e-4
                                   : optimizer::ReservoirVolume(problem, candidate);
      for (double share : {0.02, 0.3, 1.0}) {
        const auto point =
            optimizer::PointAt(problem, candidate,
                               window.low_pa + share * (window.high_pa - window.low_pa), volume_m3);
        const auto evaluation = optimizer::Evaluate(problem, candidate, point);
        if (evaluation.failed) continue;
        const bool slow = optimizer::TooSlowWhenFull(problem, candidate, point);
        too_slow += slow;
        in_time += !slow;
        if (slow) {
          EXPECT_GT(optimizer::StrokeExcess(problem, evaluation), 0.0) << seed;
        }
      }
    }
  }
  EXPECT_GT(too_slow, 5);
  EXPECT_GT(in_time, 5);
}

}  // namespace in_turns_test
}  // namespace plenum::test
