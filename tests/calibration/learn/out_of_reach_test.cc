#include "calibration/learn/out_of_reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace out_of_reach_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Gauge pressures after 2.5 s, when the line opens to deflate: towards `end_pa`.
Dataset FallingTo(double end_pa) {
  Dataset dataset;
  dataset.runs = {test::DeclaredRun("r1", 2.6e5, false)};
  calibration::Run& run = dataset.runs.front();
  for (const double t_s : run.t_s) run.pressure_pa.push_back(1e5 + (t_s < 2.5 ? 9e4 : end_pa));
  return dataset;
}

TEST(OutOfReach, IsWhatFallsBelowTheAmbientWhereTheExhaustIsDeclaredAsIt) {
  EXPECT_THAT(OutOfReach(FallingTo(-5e4)),
              ElementsAre(AllOf(HasSubstr("r1 fall to -50 kPa gauge"), HasSubstr("is below 0 kPa"),
                                HasSubstr("exhaust_pressure_kpa_gauge"))));
}

TEST(OutOfReach, IsNotWhatTheExhaustOrAnOffsetOfTheSensorReaches) {
  EXPECT_THAT(OutOfReach(FallingTo(-2e3)), IsEmpty());
  Dataset evacuated = FallingTo(-5e4);
  evacuated.runs.front().exhaust_pressure_pa = 0.5e5;
  EXPECT_THAT(OutOfReach(evacuated), IsEmpty());
  Dataset wild = FallingTo(0.0);
  wild.runs.front().pressure_pa[200] = 0.5e5;
  EXPECT_THAT(OutOfReach(wild), IsEmpty());
}

}  // namespace out_of_reach_test
}  // namespace plenum::calibration
