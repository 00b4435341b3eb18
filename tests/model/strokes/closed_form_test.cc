#include "model/strokes/closed_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace plenum::model {
namespace closed_form_test {

struct Row {
  double source, operating, expansion, b, rise, fall;
};

constexpr Row kRows[] = {
    {3.0, 2.0, 2.0, 0.30, 1.066905, 2.459439}, {2.2, 2.0, 2.0, 0.30, 1.809829, 2.459439},
    {1.5, 1.3, 1.2, 0.20, 0.544652, 0.964523}, {6.0, 2.0, 1.0, 0.30, 0.166679, 0.869134},
    {6.0, 5.0, 1.5, 0.30, 1.225728, 2.328377}, {2.0, 1.7, 1.5, 0.60, 0.826105, 1.297414},
};

TEST(ClosedForm, ReproducesTheTable) {
  for (const Row& row : kRows) {
    SCOPED_TRACE(row.source);
    const NormalisedStroke stroke{row.operating, row.expansion, row.b};
    EXPECT_NEAR(NormalisedRiseTime(stroke, row.source, 1.0, row.operating), row.rise, 1e-6);
    EXPECT_NEAR(NormalisedFallTime(stroke, row.operating, 1.0 + 0.05 * (row.operating - 1.0)),
                row.fall, 1e-6);
  }
}

// Composite midpoint rule over p = end + (start − end)·u², straight from the differential equation.
double Integrate(double start, double end, double k, auto flow) {
  constexpr int kPanels = 200000;
  double sum = 0.0;
  for (int i = 0; i < kPanels; ++i) {
    const double u = (i + 0.5) / kPanels;
    const double p = end + (start - end) * u * u;
    sum += (1.0 + k * (2.0 * p - 1.0)) / flow(p) * 2.0 * u;
  }
  return sum * std::abs(start - end) / kPanels;
}

double Psi(double r, double b) {
  return r <= b ? 1.0 : std::sqrt(1.0 - (r - b) / (1.0 - b) * ((r - b) / (1.0 - b)));
}

TEST(ClosedForm, AgreesWithTheDifferentialEquationAtAnyCriticalRatio) {
  for (const double b : {0.0, 0.05, 0.3, 0.449, 0.451, 0.49999, 0.5, 0.50001, 0.549, 0.551, 0.8}) {
    SCOPED_TRACE(b);
    const NormalisedStroke stroke{2.5, 2.2, b};
    const double k = 1.2 / 1.5;
    EXPECT_NEAR(NormalisedRiseTime(stroke, 3.0, 1.1, 2.5),
                Integrate(1.1, 2.5, k, [&](double p) { return 3.0 * Psi(p / 3.0, b); }), 2e-6);
    EXPECT_NEAR(NormalisedFallTime(stroke, 2.5, 1.02),
                Integrate(2.5, 1.02, k, [&](double p) { return p * Psi(1.0 / p, b); }), 2e-6);
  }
}

TEST(ClosedForm, RigidChamberFillsToTheSourceInFiniteTime) {
  const NormalisedStroke stroke{2.0, 1.0, 0.3};
  EXPECT_NEAR(NormalisedRiseTime(stroke, 6.0, 1.0, 6.0),
              0.3 - 1.0 / 6.0 + 0.7 * std::numbers::pi / 2.0, 1e-14);
  EXPECT_TRUE(std::isinf(NormalisedRiseTime(stroke, 1.9, 1.0, 2.0)));
  EXPECT_EQ(NormalisedRiseTime(stroke, 6.0, 2.0, 2.0), 0.0);
  EXPECT_TRUE(std::isfinite(NormalisedFallTime(stroke, 6.0, 1.0)));
  EXPECT_EQ(NormalisedFallTime(stroke, 2.0, 2.0), 0.0);
}

TEST(ClosedForm, StrokesAddUpAcrossTheChokingPoint) {
  const NormalisedStroke stroke{2.0, 1.7, 0.35};
  EXPECT_NEAR(NormalisedRiseTime(stroke, 4.0, 1.0, 1.6) + NormalisedRiseTime(stroke, 4.0, 1.6, 3.5),
              NormalisedRiseTime(stroke, 4.0, 1.0, 3.5), 1e-14);
  EXPECT_NEAR(NormalisedFallTime(stroke, 5.0, 2.0) + NormalisedFallTime(stroke, 2.0, 1.0),
              NormalisedFallTime(stroke, 5.0, 1.0), 1e-13);
}

}  // namespace closed_form_test
}  // namespace plenum::model
