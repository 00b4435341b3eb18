// Designs whose making is told to stop, wherever that falls: whole, or none.
#include <gtest/gtest.h>

#include <algorithm>

#include "optimizer/choices/make_plan.h"
#include "optimizer/search/first_designs.h"
#include "optimizer/sizing/report.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace late_stop_test {

using optimizer::Bounds;
using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Found;
using optimizer::Problem;

constexpr int kFromTheEnd = 40, kInAll = 60;  // places at which a design is told to stop

// Two groups at once, whose strokes are integrated together and look for the word to stop.
Problem Together(std::uint64_t seed, Configuration configuration) {
  Problem problem = EasyProblem(seed, {configuration});
  problem.groups.push_back(problem.groups[0]);
  problem.groups[1].chamber.rest_volume_m3 *= 0.5;
  problem.count = 1;
  return problem;
}

// A design whose making is told to stop at the look of this number, and how often it looked.
struct Stopped {
  std::optional<optimizer::Design> design;
  int looks = 0;
};

Stopped StopAt(int look, const Problem& problem, Candidate candidate, const Found& found) {
  Stopped stopped;
  const auto stop = [&] { return ++stopped.looks > look; };
  optimizer::Workbench bench{.stop = stop};
  candidate.bench = &bench;
  stopped.design = optimizer::MakeDesign(problem, candidate, found.leaf, stop);
  return stopped;
}

// How many places were tried.
int StopEverywhere(const Problem& problem, const Found& found) {
  constexpr int kNever = 1'000'000'000;
  const Candidate candidate = found.bounds->CandidateOf(found.box);
  const Stopped whole = StopAt(kNever, problem, candidate, found);
  EXPECT_TRUE(whole.design);
  if (!whole.design) return 0;
  int tried = 0;
  const int stride = std::max(1, whole.looks / kInAll);
  for (int look = 0; look < whole.looks; look += look < whole.looks - kFromTheEnd ? stride : 1) {
    const Stopped stopped = StopAt(look, problem, candidate, found);
    ++tried;
    if (!stopped.design) continue;
    EXPECT_EQ(stopped.design->performance.groups.size(), problem.groups.size());
    EXPECT_NEAR(stopped.design->totals.mass_kg, whole.design->totals.mass_kg,
                0.02 * whole.design->totals.mass_kg);
  }
  return tried;
}

TEST(LateStopTest, NoDesignIsHalfMade) {
  for (const Configuration configuration :
       {Configuration::kCylinder, Configuration::kMains, Configuration::kTank,
        Configuration::kTankAndPump, Configuration::kCompressor}) {
    SCOPED_TRACE(optimizer::Name(configuration));
    int tried = 0;
    for (std::uint64_t seed = 1; seed <= 12 && tried == 0; ++seed) {
      const Problem problem = Together(seed, configuration);
      const auto plan = optimizer::MakePlan(problem, {configuration});
      if (plan->empty()) continue;
      Bounds bounds(problem, *plan);
      optimizer::Ranking ranking(problem);
      optimizer::SearchLikely(
          problem, bounds, {bounds.Root()}, [] { return false; }, ranking);
      for (const Found& found : ranking.list()) tried += StopEverywhere(problem, found);
    }
    EXPECT_GT(tried, 0);
  }
}

}  // namespace late_stop_test
}  // namespace plenum::test
