#include "calibration/experiment/proposals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace proposals_test {

using model::ValveState;

calibration::Run MakeRun(Supply supply, double source_pa) {
  calibration::Run run;
  run.id = "r";
  run.chamber = {.rest_volume_m3 = 50e-6,
                 .expansion_ratio = 2.0,
                 .operating_pressure_pa = 2e5,
                 .volume_curve = {}};
  run.line = {{{5e-10, 0.3}, {5e-10, 0.3}, {}}};
  run.supply = supply;
  run.source_pressure_pa = source_pa;
  run.initial_pressure_pa = supply == Supply::kNone ? 1.8e5 : 1e5;
  run.valve = {{0.1, ValveState::kInflate}, {1.0, ValveState::kHold}, {4.0, ValveState::kDeflate}};
  run.t_s = test::EvenTimes(500, 0.01);
  run.pressure_pa.assign(500, 1e5);
  return run;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const StrokeTime kHalfASecond = [](const calibration::Run&, double) { return 0.5; };

TEST(ProposeRuns, StayWithinWhatTheBenchHasShown) {
  Dataset dataset;
  dataset.runs = {MakeRun(Supply::kRegulated, 2.6e5), MakeRun(Supply::kRegulated, 3.2e5),
                  MakeRun(Supply::kRegulated, 4e5)};
  const std::vector<Proposal> proposals =
      ProposeRuns(dataset, {0, 1}, 1.0, kInfinity, kHalfASecond);
  ASSERT_FALSE(proposals.empty());
  bool free = false, blocked = false;
  for (const auto& [run, what] : proposals) {
    EXPECT_GE(run.source_pressure_pa, 2.6e5) << what;
    EXPECT_LE(run.source_pressure_pa, 3.2e5) << what;  // the third run is held out
    EXPECT_TRUE(std::is_sorted(run.t_s.begin(), run.t_s.end())) << what;
    EXPECT_LE(run.t_s.size(), static_cast<std::size_t>(kProposalSamples)) << what;
    EXPECT_TRUE(std::is_sorted(run.valve.begin(), run.valve.end(),
                               [](const auto& a, const auto& b) { return a.time_s < b.time_s; }))
        << what;
    EXPECT_LT(run.valve.back().time_s, run.t_s.back()) << what;
    EXPECT_EQ(run.valve.front().state, ValveState::kHold) << what;
    EXPECT_TRUE(run.pressure_pa.empty()) << what;
    (run.blocked ? blocked : free) = true;
  }
  EXPECT_TRUE(free);
  EXPECT_TRUE(blocked);
  const auto longest_hold =
      std::max_element(proposals.begin(), proposals.end(),
                       [](auto& a, auto& b) { return a.run.t_s.back() < b.run.t_s.back(); });
  EXPECT_GE(longest_hold->run.t_s.back(), 12.0);  // four times the hold of the data
}

TEST(ProposeRuns, OneSourceAloneIsLoweredToo) {
  Dataset dataset;
  dataset.runs = {MakeRun(Supply::kRegulated, 3e5), MakeRun(Supply::kRegulated, 3e5)};
  std::set<double> sources_pa;
  for (const Proposal& proposal : ProposeRuns(dataset, {0, 1}, 1.0, kInfinity, kHalfASecond))
    sources_pa.insert(proposal.run.source_pressure_pa);
  EXPECT_EQ(sources_pa, (std::set<double>{1e5 + kLowerSource * 2e5, 3e5}));
}

TEST(ProposeRuns, FasterSamplingIsFaster) {
  Dataset dataset;
  dataset.runs = {MakeRun(Supply::kRegulated, 3e5)};
  const auto spacing = [&](double rate) {
    const std::vector<double> t_s =
        ProposeRuns(dataset, {0}, rate, kInfinity, kHalfASecond).back().run.t_s;
    return t_s[1] - t_s[0];
  };
  EXPECT_NEAR(spacing(1.0), 0.01, 1e-4);
  EXPECT_NEAR(spacing(4.0), 0.0025, 1e-4);
}

TEST(ProposeRuns, ARigidChamberNeedsNoBlockingAndOneWithoutSourceIsClosedOrEmptied) {
  Dataset dataset;
  dataset.runs = {MakeRun(Supply::kNone, 0.0)};
  dataset.runs[0].chamber.expansion_ratio = 1.0;
  const std::vector<Proposal> proposals = ProposeRuns(dataset, {0}, 1.0, kInfinity, kHalfASecond);
  EXPECT_EQ(proposals.size(), 10u);
  std::set<std::size_t> strokes;
  for (const auto& [run, what] : proposals) {
    strokes.insert(static_cast<std::size_t>(
        std::count_if(run.valve.begin(), run.valve.end(),
                      [](const auto& command) { return command.state == ValveState::kDeflate; })));
    EXPECT_FALSE(run.blocked) << what;
    EXPECT_LE(*run.initial_pressure_pa, 1.8e5) << what;
    for (const model::ValveCommand& command : run.valve)
      EXPECT_NE(command.state, ValveState::kInflate) << what;
  }
  EXPECT_EQ(strokes, (std::set<std::size_t>{0, 1, 5}));  // closed, emptying, in steps
}

TEST(ProposeRuns, NoPressureIsBeyondWhatTheSensorReads) {
  for (const Supply supply : {Supply::kRegulated, Supply::kNone}) {
    Dataset dataset;
    dataset.runs = {MakeRun(supply, 2.6e5)};
    double highest_pa = 0.0;
    const StrokeTime noting = [&](const calibration::Run& stroke, double level_pa) {
      highest_pa = std::max({highest_pa, *stroke.initial_pressure_pa, level_pa});
      return 0.5;
    };
    for (const Proposal& proposal : ProposeRuns(dataset, {0}, 1.0, 1.5e5, noting))
      highest_pa = std::max(highest_pa, *proposal.run.initial_pressure_pa);
    EXPECT_LT(highest_pa, 1.5e5);
    EXPECT_GT(highest_pa, 1.4e5);
  }
}

TEST(ProposeRuns, StrokesThatNeverEndAreNotProposed) {
  Dataset dataset;
  dataset.runs = {MakeRun(Supply::kRegulated, 3e5)};
  const StrokeTime never = [](const calibration::Run&, double) { return kInfinity; };
  EXPECT_TRUE(ProposeRuns(dataset, {0}, 1.0, kInfinity, never).empty());
  EXPECT_TRUE(ProposeRuns(dataset, {}, 1.0, kInfinity, kHalfASecond).empty());
  EXPECT_TRUE(ProposeRuns(Dataset{}, {}, 1.0, kInfinity, kHalfASecond).empty());
}

}  // namespace proposals_test
}  // namespace plenum::calibration
