#include "model/integrate/step_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plenum::model {
namespace step_control_test {

constexpr StepControl::Law kOrderThree = {.exponent = 1.0 / 3.0, .memory = 0.0, .growth_max = 6.0};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// An error of third order that is 1 at h = 0.2: steps from far below and far above come close to
// it, and none is accepted that is above.
TEST(StepControl, StepsComeToTheOneThatIsJustAllowed) {
  for (const double first : {1e-6, 50.0}) {
    StepControl control(kOrderThree);
    control.Start(first);
    double taken = 0.0;
    const auto error_of = [&](double h) { return taken = h, std::pow(h / 0.2, 3); };
    for (int i = 0; i < 12; ++i) {
      EXPECT_EQ(control.Take(0.0, kInfinity, error_of), StepResult::kAccepted);
      EXPECT_LE(taken, 0.2);
    }
    EXPECT_NEAR(taken, 0.9 * 0.2, 1e-3);
  }
}

TEST(StepControl, GrowsByNoMoreThanTheLawSays) {
  StepControl control(kOrderThree);
  control.Start(1.0);
  EXPECT_EQ(control.Take(0.0, kInfinity, [](double) { return 0.0; }), StepResult::kAccepted);
  EXPECT_DOUBLE_EQ(control.next_step(), 6.0);
}

TEST(StepControl, AStepCutShortByItsBoundDoesNotMakeTheNextOneShorter) {
  StepControl control(kOrderThree);
  control.Start(1.0);
  EXPECT_EQ(control.Take(0.0, 1e-3, [](double) { return 1.0; }), StepResult::kAccepted);
  EXPECT_DOUBLE_EQ(control.next_step(), 1e-3);
  control.Start(1.0);
  EXPECT_EQ(control.Take(0.0, 1.0, [](double) { return 0.999; }), StepResult::kAccepted);
  EXPECT_DOUBLE_EQ(control.next_step(), 1.0);
}

TEST(StepControl, AnErrorThatNoStepRemovesIsToldOrRefused) {
  StepControl control(kOrderThree);
  control.Start(1.0);
  double taken = 0.0;
  EXPECT_EQ(control.Take(1.0, 1.0, [&](double h) { return taken = h, 2.0; }),
            StepResult::kTooSmall);
  EXPECT_GT(1.0 + taken, 1.0);
  EXPECT_LT(taken, 1e-14);
  control.Start(1.0);
  EXPECT_EQ(control.Take(1.0, 1.0, [](double) { return kInfinity; }), StepResult::kNotFinite);
}

}  // namespace step_control_test
}  // namespace plenum::model
