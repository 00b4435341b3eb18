#include "calibration/noise/phases.h"

#include <gtest/gtest.h>

#include <vector>

namespace plenum::calibration {
namespace phases_test {

using model::ValveState;

Run MakeRun(std::vector<model::ValveCommand> valve, double end_s) {
  calibration::Run run;
  run.chamber.operating_pressure_pa = 2e5;
  run.valve = std::move(valve);
  run.t_s = {0.0, end_s};
  run.pressure_pa = {1e5, 1e5};
  return run;
}

TEST(Phases, FollowTheScheduleAndCountInflations) {
  const calibration::Run run = MakeRun({{0.0, ValveState::kHold},
                                        {0.3, ValveState::kInflate},
                                        {1.4, ValveState::kHold},
                                        {2.0, ValveState::kHold},  // no change
                                        {6.0, ValveState::kDeflate},
                                        {8.0, ValveState::kHold},
                                        {9.0, ValveState::kInflate},
                                        {10.0, ValveState::kDeflate}},
                                       12.0);
  const std::vector<PhaseSpan> spans = PhasesOf(run);
  const std::vector<Phase> phases = {Phase::kRest, Phase::kRise, Phase::kHold, Phase::kFall,
                                     Phase::kRest, Phase::kRise, Phase::kFall};
  const std::vector<int> cycles = {0, 0, 0, 0, 0, 1, 1};
  const std::vector<double> starts = {0.0, 0.3, 1.4, 6.0, 8.0, 9.0, 10.0};
  ASSERT_EQ(spans.size(), phases.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    EXPECT_EQ(spans[i].phase, phases[i]) << i;
    EXPECT_EQ(spans[i].cycle, cycles[i]) << i;
    EXPECT_EQ(spans[i].start_s, starts[i]) << i;
    EXPECT_EQ(spans[i].end_s, i + 1 < starts.size() ? starts[i + 1] : 12.0) << i;
  }
  EXPECT_EQ(PhaseAt(spans, 1.4), 2u);
  EXPECT_EQ(PhaseAt(spans, -1.0), 0u);
  EXPECT_EQ(PhaseAt(spans, 99.0), 6u);
}

TEST(Phases, AClosedChamberUnderPressureHolds) {
  calibration::Run run = MakeRun({{0.0, ValveState::kHold}}, 5.0);
  EXPECT_EQ(PhasesOf(run).front().phase, Phase::kRest);
  run.pressure_pa = {1.9e5, 1.8e5};
  EXPECT_EQ(PhasesOf(run).front().phase, Phase::kHold);
  run.initial_pressure_pa = 1e5;
  EXPECT_EQ(PhasesOf(run).front().phase, Phase::kRest);
}

TEST(Phases, CommandsOutsideTheSamplesMakeNoPhase) {
  const std::vector<PhaseSpan> spans =
      PhasesOf(MakeRun({{-1.0, ValveState::kInflate}, {7.0, ValveState::kDeflate}}, 5.0));
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_EQ(spans.front().phase, Phase::kRise);
  EXPECT_EQ(spans.front().start_s, 0.0);
  EXPECT_EQ(spans.front().end_s, 5.0);
  EXPECT_TRUE(PhasesOf(calibration::Run{}).empty());
}

}  // namespace phases_test
}  // namespace plenum::calibration
