// Bounds of boxes of several groups on pumps, against what single combinations come to and against
// each other.
#include "verify/corner/verify_corner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"
#include "verify/design/verify_size.h"
#include "verify/tree/verify_box.h"

namespace plenum::test {
namespace verify_corner_test {

using optimizer::Problem;
using optimizer::ProofPlan;
using verify::Ranges;

constexpr int kLineSlots = 3;  // of each group

// Two groups on pumps with a reservoir, at once or in turns.
Problem Drawn(std::uint64_t seed) {
  Draw draw;
  draw.seed = 61000 + seed;
  draw.groups = 2;
  draw.simultaneous = seed % 2 == 0;
  draw.severity = 0.04 * static_cast<double>(seed % 8);
  draw.configurations = {optimizer::Configuration::kCompressor};
  draw.size = {2, 2, 3, 1, 1, 2, 2, 2, 2};
  Problem problem = RandomProblem(draw);
  problem.parts.reservoirs.front().volume_m3 *= 0.02;  // too small for most strokes
  problem.exclude.insert("custom");
  problem.limits = {1, 1, 2, 2, 1};
  problem.count = 100'000;  // nothing is left out of the plan
  return problem;
}

// Calls `see(problem, plan)` for so many draws that have a plan.
void ForPlans(int seeds, const std::function<void(const Problem&, const ProofPlan&)>& see) {
  for (int seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(static_cast<std::uint64_t>(seed));
    optimizer::SearchOptions options = Within(60.0);
    options.record = true;
    options.steps_max = 1;  // the plan is all that is wanted
    const optimizer::Answer answer = optimizer::SearchTrees(problem, options);
    for (const ProofPlan& plan : answer.proof.record->plans) see(problem, plan);
  }
}

int SizeOf(const ProofPlan& plan, std::size_t slot) {
  return static_cast<int>(plan.slots[slot].choices.size());
}

Ranges AnyPlace(const ProofPlan& plan, Random& random) {
  Ranges place;
  for (std::size_t s = 0; s < plan.slots.size(); ++s) {
    const int chosen = Pick(random, 0, SizeOf(plan, s) - 1);
    place.emplace_back(chosen, chosen + 1);
  }
  return place;
}

TEST(VerifyCornerTest, BoundsLieBelowWhatCombinationsComeTo) {
  int compared = 0;
  ForPlans(24, [&](const Problem& problem, const ProofPlan& plan) {
    verify::KnownStrokes strokes(problem, plan);
    verify::Corners corners(problem, plan, strokes);
    verify::Sizer sizer(problem);
    Random random(plan.slots.size() + problem.parts.valves.size());
    for (int draw = 0; draw < 40; ++draw) {
      const Ranges place = AnyPlace(plan, random);
      if (corners.CannotMate(place)) continue;
      const verify::Sizing sizing =
          sizer.Size(verify::AssemblyAt(problem, plan, place), 1e-6, optimizer::kUnlimited);
      if (sizing.status != verify::Sized::kFeasible) continue;
      for (int box = 0; box < 4; ++box) {
        Ranges ranges = place;
        for (std::size_t s = 0; box > 0 && s < ranges.size(); ++s) {
          ranges[s].first = Pick(random, 0, ranges[s].first);
          ranges[s].second = Pick(random, ranges[s].second, SizeOf(plan, s));
        }
        for (const double enough : {0.9, 1.0, 1.1, optimizer::kUnlimited})
          EXPECT_LE(corners.LeastObjective(ranges, enough * sizing.objective),
                    sizing.objective * (1.0 + 1e-6));
        ++compared;
      }
    }
  });
  EXPECT_GT(compared, 200);
}

// Lines that work at no pressure of any source do not make a box cheap.
TEST(VerifyCornerTest, LinesOfABoxComeToNoLessThanTheLeastThatWorks) {
  int dearer = 0;
  ForPlans(24, [&](const Problem& problem, const ProofPlan& plan) {
    verify::KnownStrokes strokes(problem, plan);
    verify::Corners corners(problem, plan, strokes);
    Ranges all;
    for (std::size_t s = 0; s < plan.slots.size(); ++s) all.emplace_back(0, SizeOf(plan, s));
    double least = 0.0, corner = 0.0;
    for (int g = 0; g < 2; ++g) {
      double of_group = optimizer::kUnlimited;
      const int first = kLineSlots * g;
      Ranges one = all;
      for (int a = 0; a < SizeOf(plan, first); ++a)
        for (int b = 0; b < SizeOf(plan, first + 1); ++b)
          for (int c = 0; c < SizeOf(plan, first + 2); ++c) {
            one[first] = {a, a + 1}, one[first + 1] = {b, b + 1}, one[first + 2] = {c, c + 1};
            const verify::BestLine& line = strokes.Line(one, g);
            if (!line.mates || !line.works) continue;
            double sum = 0.0;
            for (int s = first; s < first + kLineSlots; ++s)
              sum += corners.Least(one, s).least.objective;
            of_group = std::min(of_group, sum);
          }
      least += of_group;
      for (int s = first; s < first + kLineSlots; ++s)
        corner += corners.Least(all, s).least.objective;
    }
    double others = 0.0;
    for (int s = 2 * kLineSlots; s < static_cast<int>(plan.slots.size()); ++s)
      others += corners.Least(all, s).least.objective;
    dearer += least > corner * (1.0 + 1e-9);
    EXPECT_GE(corners.LeastObjective(all, optimizer::kUnlimited), (least + others) * (1.0 - 1e-9));
  });
  EXPECT_GT(dearer, 3);
}

// Within limits on amounts a box is as good as its best reservoir, one that is over them is none.
TEST(VerifyCornerTest, ReservoirsOverALimitBoundNothing) {
  int ruled_out = 0;
  ForPlans(24, [&](const Problem& drawn, const ProofPlan& plan) {
    const int slot = verify::SlotOf(plan, optimizer::Family::kReservoir, -1);
    Random random(drawn.parts.valves.size());
    for (int draw = 0; draw < 6; ++draw) {
      Ranges box = AnyPlace(plan, random);
      box[slot] = {0, SizeOf(plan, static_cast<std::size_t>(slot))};
      Problem problem = drawn;
      double without_l = 0.0, least_l = optimizer::kUnlimited, most_l = 0.0;
      const verify::SlotAmounts amounts = verify::AmountsOfAll(problem, plan);
      for (int s = 0; s < static_cast<int>(box.size()); ++s)
        if (s != slot) without_l += amounts[s][box[s].first].volume_m3 * 1e3;
      for (const verify::ItemAmounts& one : amounts[slot]) {
        least_l = std::min(least_l, one.volume_m3 * 1e3);
        most_l = std::max(most_l, one.volume_m3 * 1e3);
      }
      problem.volume_max_l = without_l + Uniform(random, least_l, most_l);
      verify::KnownStrokes strokes(problem, plan);
      verify::Corners corners(problem, plan, strokes);
      double best = optimizer::kUnlimited;
      for (int i = box[slot].first; i < box[slot].second; ++i) {
        Ranges one = box;
        one[slot] = {i, i + 1};
        best = std::min(best, corners.LeastObjective(one, optimizer::kUnlimited));
      }
      const double bound = corners.LeastObjective(box, optimizer::kUnlimited);
      EXPECT_EQ(std::isinf(bound), std::isinf(best));
      if (std::isfinite(best)) {
        EXPECT_NEAR(bound, best, 1e-9 * best);
      }
      verify::KnownStrokes free_strokes(drawn, plan);
      verify::Corners free(drawn, plan, free_strokes);
      ruled_out += bound > free.LeastObjective(box, optimizer::kUnlimited) * (1.0 + 1e-9);
    }
  });
  EXPECT_GT(ruled_out, 3);
}

}  // namespace verify_corner_test
}  // namespace plenum::test
