#include "model/flow/iso6358.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace plenum::model {
namespace iso6358_test {

constexpr double kLitrePerMinute = 1e-3 / 60.0;

// Standard volume flow in L/min: C·p1·Ψ(p2/p1).
double LitresPerMinute(double conductance, double critical_ratio, double p1_pa, double p2_pa) {
  return conductance * p1_pa * FlowFunction(p2_pa / p1_pa, critical_ratio) / kLitrePerMinute;
}

TEST(Iso6358, WorkedExampleOfTheDataSheet) {
  // C = 2 dm³/(s·bar), b = 0.3, 0.4 to 0.3 MPa gauge on 0.1 MPa: 420 L/min, the ellipse 419.9.
  const double flow = LitresPerMinute(2e-8, 0.3, 5e5, 4e5);
  EXPECT_NEAR(flow, 420.0, 0.42);
  EXPECT_NEAR(flow, 419.9, 0.05);
}

TEST(Iso6358, NominalFlowFromSixToFiveBarGauge) {
  // Qn of C = 1 dm³/(s·bar): 240, 254.5, 272, 294 L/min for b = 0.2 to 0.5.
  const double expected[] = {240.0, 254.5, 272.0, 294.0};
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(LitresPerMinute(1e-8, 0.2 + 0.1 * i, 7.013e5, 6.013e5), expected[i], 0.5);
}

TEST(Iso6358, FlowFunctionMeetsOneAndZeroAtItsEnds) {
  for (const double b : {0.0, 0.3, 0.528, 0.9}) {
    for (const double m : {0.4, 0.5, 0.7, 1.0}) {
      EXPECT_EQ(FlowFunction(b, b, m), 1.0);
      EXPECT_EQ(FlowFunction(1.0, b, m), 0.0);
      EXPECT_NEAR(FlowFunction(b + 1e-7, b, m), 1.0, 1e-11);
    }
  }
  // Half way along the ellipse's axis: √(1 − ¼), and its power for another index.
  EXPECT_NEAR(FlowFunction(0.65, 0.3), std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(FlowFunction(0.65, 0.3, 1.0), 0.75, 1e-15);
}

}  // namespace iso6358_test
}  // namespace plenum::model
