// When strokes begin, by hand and by relations.
#include "optimizer/problem/gait.h"

#include <gtest/gtest.h>

#include "tests/support/drawn_gait.h"
#include "tests/support/small_catalogue.h"
#include "verify/design/cycle/verify_gait.h"

namespace plenum::test {
namespace gait_test {

using optimizer::Meeting;
using optimizer::MeetingOf;
using optimizer::Problem;
using optimizer::Squad;

Problem Groups(int groups, bool simultaneous) {
  Draw draw;
  draw.seed = 1;
  draw.groups = groups;
  draw.simultaneous = simultaneous;
  Problem problem = RandomProblem(draw);
  for (optimizer::ActuatorGroup& group : problem.groups) group.count = 4;
  problem.frequency_hz = 0.5;
  return problem;
}

TEST(GaitTest, WithoutPhasesGroupsBeginTogetherOrInTurns) {
  EXPECT_EQ(MeetingOf(Groups(1, true)), Meeting::kAlone);
  EXPECT_EQ(MeetingOf(Groups(1, false)), Meeting::kAlone);
  EXPECT_EQ(MeetingOf(Groups(3, true)), Meeting::kTogether);
  const Problem turns = Groups(4, false);
  EXPECT_EQ(MeetingOf(turns), Meeting::kApart);
  for (const double turn_s : optimizer::TurnSeconds(turns, optimizer::SquadsOf(turns)))
    EXPECT_DOUBLE_EQ(turn_s, 0.5);
  EXPECT_TRUE(optimizer::WindowsOverlap(turns));
  EXPECT_FALSE(optimizer::WindowsOverlap(Groups(2, false)));
  EXPECT_TRUE(optimizer::Alternates(Groups(2, false)));
}

TEST(GaitTest, ATrotIsTwoSquadsOfOneGroup) {
  Problem problem = Groups(1, true);
  problem.groups[0].gait.phases = {0.0, 0.5, 0.5, 0.0};
  const std::vector<Squad> squads = optimizer::SquadsOf(problem);
  ASSERT_EQ(squads.size(), 2U);
  EXPECT_EQ(squads[0].count, 2);
  EXPECT_EQ(squads[1].count, 2);
  EXPECT_EQ(MeetingOf(problem), Meeting::kApart);
  EXPECT_EQ(optimizer::FilledAtOnce(problem, 0), 2);
  EXPECT_FALSE(optimizer::IsBurst(problem));
  EXPECT_FALSE(optimizer::WindowsOverlap(problem));
  problem.groups[0].gait.inflate_fraction = 0.6;
  EXPECT_TRUE(optimizer::WindowsOverlap(problem));
  EXPECT_DOUBLE_EQ(optimizer::InflateWindow(problem, 0), 1.2);
  EXPECT_DOUBLE_EQ(optimizer::DeflateWindow(problem, 0), 0.8);
}

// Strokes k of n begin at (phase + k/n) mod 1: of two groups with two strokes each, half a period
// apart, the second stroke of one is the first of the other.
TEST(GaitTest, StrokesOfOneMayMeetThoseOfAnother) {
  Problem problem = Groups(2, true);
  problem.groups[0].gait.phases = {0.0};
  problem.groups[1].gait.phases = {0.5};
  EXPECT_TRUE(optimizer::Alternates(problem));
  problem.groups[0].gait.strokes_per_period = 2;
  EXPECT_EQ(MeetingOf(problem), Meeting::kMixed);
  problem.groups[1].gait.strokes_per_period = 2;
  EXPECT_EQ(MeetingOf(problem), Meeting::kMixed);
  problem.groups[1].gait.phases = {0.25};
  EXPECT_EQ(MeetingOf(problem), Meeting::kApart);
  EXPECT_DOUBLE_EQ(optimizer::TurnSeconds(problem, optimizer::SquadsOf(problem))[0], 0.5);
}

// The verifier works it out by itself.
TEST(GaitTest, AsTheVerifierHasIt) {
  int apart = 0, mixed = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Problem problem = Groups(Pick(random, 1, 3), Chance(random, 0.5));
    for (optimizer::ActuatorGroup& group : problem.groups) group.count = Pick(random, 1, 4);
    DrawGaits(random, problem);
    const std::vector<Squad> squads = optimizer::SquadsOf(problem);
    const std::vector<double> turns_s = optimizer::TurnSeconds(problem, squads);
    const std::vector<verify::Unit> units = verify::UnitsOf(problem);
    ASSERT_EQ(squads.size(), units.size());
    for (std::size_t s = 0; s < squads.size(); ++s) {
      EXPECT_EQ(squads[s].group, units[s].group);
      EXPECT_EQ(squads[s].count, units[s].count);
      EXPECT_NEAR(turns_s[s], verify::UntilNext(problem, units, units[s]), 1e-8);
    }
    const Meeting meeting = MeetingOf(problem);
    apart += meeting == Meeting::kApart;
    mixed += meeting == Meeting::kMixed;
    EXPECT_EQ(verify::SomeAtOnce(problem),
              meeting == Meeting::kTogether || meeting == Meeting::kMixed);
    EXPECT_EQ(verify::AllAtOnce(problem), meeting == Meeting::kTogether);
    EXPECT_EQ(verify::Bursts(problem) > 0, optimizer::IsBurst(problem));
    EXPECT_EQ(verify::Alternate(problem), optimizer::Alternates(problem));
    EXPECT_EQ(verify::MayOverlap(problem), optimizer::WindowsOverlap(problem));
    for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
      EXPECT_EQ(verify::MostAtOnce(problem, g), optimizer::FilledAtOnce(problem, g));
      EXPECT_NEAR(verify::FillWindow(problem, g), optimizer::InflateWindow(problem, g), 1e-12);
      EXPECT_NEAR(verify::VentWindow(problem, g), optimizer::DeflateWindow(problem, g), 1e-12);
    }
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(mixed, 30);
}

TEST(GaitTest, ShiftingAllPhasesChangesNothing) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Problem problem = Groups(2, true);
    DrawGaits(random, problem);
    for (optimizer::ActuatorGroup& group : problem.groups)
      if (group.gait.phases.empty()) group.gait.phases = {0.0};
    Problem shifted = problem;
    for (optimizer::ActuatorGroup& group : shifted.groups)
      for (double& phase : group.gait.phases) phase = std::fmod(phase + 0.3, 1.0);
    EXPECT_EQ(MeetingOf(problem), MeetingOf(shifted));
    EXPECT_EQ(optimizer::WindowsOverlap(problem), optimizer::WindowsOverlap(shifted));
  }
}

}  // namespace gait_test
}  // namespace plenum::test
