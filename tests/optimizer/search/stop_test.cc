// Searches whose solver fails, and searches that are stopped inside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace stop_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::SearchOptions;
using optimizer::Status;

// Two groups at once: listed designs are simulated, and strokes that no integration tells.
Problem TogetherProblem(std::uint64_t seed, Configuration configuration) {
  Problem problem = EasyProblem(seed, {configuration});
  problem.groups.push_back(problem.groups[0]);
  problem.groups[1].chamber.rest_volume_m3 *= 0.5;
  problem.parts.valves.resize(2);
  problem.parts.tubing.resize(2);
  problem.parts.fittings.resize(1);
  problem.parts.compressors.resize(1);
  problem.parts.batteries.resize(2);
  problem.exclude.insert("custom");
  problem.limits = {1, 1, 1, 1, 1};
  problem.count = 2;
  return problem;
}

// The second group begins while the first still fills: every stroke is the simulator's.
Problem OverlappingProblem(std::uint64_t seed, Configuration configuration) {
  Problem problem = TogetherProblem(seed, configuration);
  problem.groups[1].gait.phases.assign(static_cast<std::size_t>(problem.groups[1].count), 0.02);
  return problem;
}

model::PeriodicState Failed(model::PeriodicStatus status) {
  model::PeriodicState state;
  state.status = status;
  return state;
}

TEST(StopTest, SolverThatAlwaysFailsLeavesAllLeavesOpen) {
  for (Configuration configuration : {Configuration::kCylinder, Configuration::kCompressor}) {
    Problem problem = TogetherProblem(5, configuration);
    problem.parts.regulators.resize(1);
    problem.parts.cylinders.resize(1);
    ASSERT_EQ(optimizer::SearchTrees(problem, Within(60.0)).status, Status::kOptimal);
    SearchOptions options = Within(60.0);
    int calls = 0;
    options.periodic = [&](const auto&...) {
      ++calls;
      return Failed(model::PeriodicStatus::kNotConverged);
    };
    const Answer answer = optimizer::SearchTrees(problem, options);
    EXPECT_GT(calls, 0);
    EXPECT_EQ(answer.status, Status::kFeasible) << optimizer::Name(configuration);
    EXPECT_TRUE(answer.designs.empty());
    EXPECT_FALSE(answer.proof.complete);
    EXPECT_GT(answer.proof.undecided, 0);
    EXPECT_EQ(answer.proof.gap, 1.0);
    const optimizer::Pruned& pruned = answer.proof.pruned;
    EXPECT_EQ(pruned.incompatible + pruned.infeasible + pruned.bound + pruned.dominated +
                  pruned.unpriced + answer.proof.evaluated,
              answer.proof.combinations);
  }
}

// A made-to-measure reservoir whose simulations fail, from one of them on, stays open and is
// counted.
void ExpectLeftOpen(const Problem& problem, int calls_max) {
  const Answer truth = optimizer::SearchTrees(problem, Within(60.0));
  ASSERT_EQ(truth.status, Status::kOptimal);
  ASSERT_FALSE(truth.designs.empty());
  int calls = 0;
  SearchOptions options = Within(60.0);
  options.periodic = [&](auto&&... rest) {
    return ++calls > calls_max ? Failed(model::PeriodicStatus::kNotConverged)
                               : model::FindPeriodicState(rest...);
  };
  const Answer answer = optimizer::SearchTrees(problem, options);
  EXPECT_GT(calls, calls_max);
  EXPECT_EQ(answer.status, Status::kFeasible);
  EXPECT_TRUE(answer.designs.empty());
  EXPECT_GT(answer.proof.undecided, 0);
  EXPECT_LE(answer.proof.lower_bound, truth.designs.front().objective);
}

TEST(StopTest, SolverThatFailsLeavesMadeReservoirsOpen) {
  for (const bool overlap : {false, true}) {
    SCOPED_TRACE(overlap);
    Problem problem = overlap ? OverlappingProblem(5, Configuration::kCompressor)
                              : TogetherProblem(5, Configuration::kCompressor);
    problem.exclude.erase("custom");
    problem.require[optimizer::Family::kReservoir] = {"custom"};
    problem.parts.reservoirs.clear();
    problem.parts.batteries.resize(1);
    problem.parts.valves.resize(1);
    problem.count = 1;
    problem.parts.tubing.resize(1);
    ExpectLeftOpen(problem, overlap ? 12 : 0);
  }
}

// What fails for some designs is not taken for infeasible: each design of the true list is listed,
// or the bound leaves room for it. Nor is it where boxes had been forgotten for the sake of such a
// design.
TEST(StopTest, SolverThatFailsNowAndThenLosesNoDesign) {
  int undecided = 0, lost = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Problem problem = TogetherProblem(1 + seed % 4, Configuration::kCylinder);
    const Answer truth = optimizer::SearchTrees(problem, Within(60.0));
    SearchOptions options = Within(60.0);
    if (seed > 4) options.crowd = 2;
    options.periodic = [](const model::Rig& rig, auto&&... rest) {
      const double dead_m3 = rig.groups[0].chamber.dead_volume_m3;
      return rig.groups[1].chamber.dead_volume_m3 <= dead_m3
                 ? Failed(model::PeriodicStatus::kFailed)
                 : model::FindPeriodicState(rig, rest...);
    };
    const Answer answer = optimizer::SearchTrees(problem, options);
    undecided += static_cast<int>(answer.proof.undecided);
    EXPECT_NE(answer.status, Status::kInfeasible);
    for (const optimizer::Design& design : truth.designs) {
      const auto same = [&](const optimizer::Design& d) { return KeyOf(d) == KeyOf(design); };
      if (std::any_of(answer.designs.begin(), answer.designs.end(), same)) continue;
      ++lost;
      EXPECT_EQ(answer.status, Status::kFeasible) << "seed " << seed;
      EXPECT_LE(answer.proof.lower_bound, design.objective * (1.0 + 1e-6)) << "seed " << seed;
    }
  }
  EXPECT_GT(undecided, 0);
  EXPECT_GT(lost, 0);
}

// A simulation that goes on until it is told to stop.
optimizer::PeriodicSolver Endless(std::atomic<bool>& begun) {
  return [&begun](const model::Rig&, double, const model::SimulateOptions& options,
                  const model::PeriodicOptions&) {
    begun = true;
    while (!options.cancelled()) std::this_thread::yield();
    return Failed(model::PeriodicStatus::kCancelled);
  };
}

TEST(StopTest, CancelFromAnotherThreadReachesALeaf) {
  const Problem problem = OverlappingProblem(5, Configuration::kCompressor);
  std::atomic<bool> begun = false, cancel = false;
  SearchOptions options = Within(1e6);
  options.periodic = Endless(begun);
  options.cancelled = [&] { return cancel.load(); };
  std::thread other([&] {
    while (!begun) std::this_thread::yield();
    cancel = true;
  });
  const Answer answer = optimizer::SearchTrees(problem, options);
  other.join();
  EXPECT_EQ(answer.status, Status::kCancelled);
  EXPECT_TRUE(answer.designs.empty());
  EXPECT_EQ(answer.proof.undecided, 0);  // what was stopped is open
}

// A search whose time is over in its first simulation, which would not end.
Answer StoppedInASimulation(const Problem& problem) {
  std::atomic<bool> begun = false;
  SearchOptions options = Within(0.05);
  options.periodic = Endless(begun);
  Answer answer = optimizer::SearchTrees(problem, options);
  EXPECT_TRUE(begun);
  EXPECT_EQ(answer.status, Status::kFeasible);
  EXPECT_EQ(answer.proof.gap, 1.0);
  return answer;
}

TEST(StopTest, TimeLimitReachesALeaf) {
  const Problem problem = OverlappingProblem(5, Configuration::kCompressor);
  const Answer answer = StoppedInASimulation(problem);
  const Answer truth = optimizer::SearchTrees(problem, Within(60.0));
  ASSERT_FALSE(truth.designs.empty());
  EXPECT_LE(answer.proof.lower_bound, truth.designs[0].objective);
}

// One group alone, whose designs nothing but their confirmation simulates.
Problem ConfirmedProblem() {
  Problem problem = EasyProblem(5, {Configuration::kCylinder});
  problem.parts.valves.resize(2);
  problem.parts.tubing.resize(2);
  problem.count = 2;
  return problem;
}

TEST(StopTest, TimeLimitReachesTheFirstDesignsConfirmation) {
  const Problem problem = ConfirmedProblem();
  const Answer truth = optimizer::SearchTrees(problem, Within(60.0));
  ASSERT_FALSE(truth.designs.empty());
  const Answer answer = StoppedInASimulation(problem);
  EXPECT_TRUE(answer.designs.empty());
  EXPECT_LE(answer.proof.lower_bound, truth.designs[0].objective);
  EXPECT_GT(answer.seconds, 1.0);  // its grace
}

TEST(StopTest, CancelReachesTheFirstDesignsConfirmationBeforeAndAfterTheLimit) {
  for (const double limit_s : {1e6, 0.05}) {
    SCOPED_TRACE(limit_s);
    std::atomic<bool> cancel = false;
    SearchOptions options = Within(limit_s);
    options.cancelled = [&] { return cancel.load(); };
    options.periodic = [&](const model::Rig&, double, const model::SimulateOptions& simulate,
                           const model::PeriodicOptions&) {
      for (int i = 0; i < 30 && !simulate.cancelled(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      cancel = true;
      while (!simulate.cancelled()) std::this_thread::yield();
      return Failed(model::PeriodicStatus::kCancelled);
    };
    const Answer answer = optimizer::SearchTrees(ConfirmedProblem(), options);
    EXPECT_EQ(answer.status, Status::kCancelled);
    EXPECT_TRUE(answer.designs.empty());
  }
}

// What a stopped search says of leaves that it did not decide is in its record.
TEST(StopTest, RecordOfAStoppedSearchIsAccepted) {
  int stopped = 0, with_design = 0;
  for (int steps : {100, 400, 1600}) {
    for (std::uint64_t seed : {3u, 5u}) {
      SCOPED_TRACE(std::to_string(seed) + ", " + std::to_string(steps) + " steps");
      Problem problem = EasyProblem(seed, {Configuration::kCompressor});
      problem.objective = {.mass_kg = 1.0, .energy_wh = 0.2};
      problem.parts.valves.resize(3);
      problem.parts.tubing.resize(2);
      problem.parts.fittings.resize(2);
      problem.parts.compressors.resize(2);
      problem.parts.batteries.resize(2);
      problem.count = 3;
      SearchOptions options = Within(60.0);
      options.record = true;
      options.steps_max = steps;
      const Answer answer = optimizer::SearchTrees(problem, options);
      EXPECT_TRUE(Accepts(problem, answer));
      stopped += answer.status == Status::kFeasible;
      with_design += answer.status == Status::kFeasible && !answer.designs.empty();
    }
  }
  EXPECT_GT(stopped, 1);
  EXPECT_GE(stopped, with_design);
}

}  // namespace stop_test
}  // namespace plenum::test
