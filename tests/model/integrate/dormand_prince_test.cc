#include "model/integrate/dormand_prince.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace plenum::model {
namespace dormand_prince_test {

const auto kPendulumOfUnitRate = [](double, std::span<const double> y, std::span<double> dydt) {
  dydt[0] = y[1];
  dydt[1] = -y[0];
};
const auto kAcceptAll = [](auto, auto, auto) { return 1e-9; };

// Error of cos t at t = 3 with `steps` equal steps.
double ErrorAtThree(int steps) {
  DormandPrince stepper(2);
  const double h = 3.0 / steps;
  stepper.Start(kPendulumOfUnitRate, 0.0, std::vector<double>{1.0, 0.0}, h);
  for (int i = 0; i < steps; ++i) stepper.Step(kPendulumOfUnitRate, h, kAcceptAll);
  return std::abs(stepper.state()[0] - std::cos(3.0));
}

// Largest error of the dense output inside one step of size h from t = 0.4 on.
double DenseError(double h) {
  DormandPrince stepper(2);
  stepper.Start(kPendulumOfUnitRate, 0.4, std::vector<double>{std::cos(0.4), -std::sin(0.4)}, h);
  stepper.Step(kPendulumOfUnitRate, h, kAcceptAll);
  double largest = 0.0;
  for (double theta = 0.05; theta < 1.0; theta += 0.05) {
    const double t = 0.4 + theta * h;
    largest = std::max({largest, std::abs(stepper.At(theta, 0) - std::cos(t)),
                        std::abs(stepper.At(theta, 1) + std::sin(t))});
  }
  return largest;
}

TEST(DormandPrince, ErrorFallsWithTheFifthPowerOfTheStep) {
  EXPECT_NEAR(std::log2(ErrorAtThree(20) / ErrorAtThree(40)), 5.0, 0.2);
  EXPECT_NEAR(std::log2(ErrorAtThree(40) / ErrorAtThree(80)), 5.0, 0.2);
}

TEST(DormandPrince, DenseOutputIsOfFourthOrder) {
  // The local error of an interpolant of order 4 falls with the fifth power.
  EXPECT_NEAR(std::log2(DenseError(0.2) / DenseError(0.1)), 5.0, 0.15);
}

TEST(DormandPrince, IntegratesAPolynomialOfFifthDegreeExactly) {
  const auto rhs = [](double t, std::span<const double>, std::span<double> dydt) {
    dydt[0] = 5.0 * std::pow(t, 4);
  };
  DormandPrince stepper(1);
  stepper.Start(rhs, 0.0, std::vector<double>{0.0}, 2.0);
  stepper.Step(rhs, 2.0, kAcceptAll);
  EXPECT_NEAR(stepper.state()[0], 32.0, 1e-12);
}

TEST(DormandPrince, SlopeOfTheDenseOutputIsItsDerivative) {
  DormandPrince stepper(2);
  stepper.Start(kPendulumOfUnitRate, 0.0, std::vector<double>{0.3, 0.8}, 0.7);
  const double start = stepper.derivative()[1];
  stepper.Step(kPendulumOfUnitRate, 0.7, kAcceptAll);
  for (const double theta : {0.1, 0.5, 0.9}) {
    const double difference = (stepper.At(theta + 1e-5, 1) - stepper.At(theta - 1e-5, 1)) / 2e-5;
    EXPECT_NEAR(stepper.SlopeAt(theta, 1), difference, 1e-9);
  }
  EXPECT_NEAR(stepper.SlopeAt(0.0, 1), 0.7 * start, 1e-14);
  EXPECT_NEAR(stepper.SlopeAt(1.0, 1), 0.7 * stepper.derivative()[1], 1e-14);
}

TEST(DormandPrince, StepControlKeepsTheErrorNearTheTolerance) {
  for (const double tolerance : {1e-6, 1e-9}) {
    DormandPrince stepper(2);
    stepper.Start(kPendulumOfUnitRate, 0.0, std::vector<double>{1.0, 0.0}, 1e-3);
    const auto norm = [&](auto, auto, std::span<const double> error) {
      return std::max(std::abs(error[0]), std::abs(error[1])) / tolerance;
    };
    const double end = 2.0 * std::numbers::pi;
    int steps = 0;
    for (; stepper.time() < end; ++steps) {
      stepper.Step(kPendulumOfUnitRate, end - stepper.time(), norm);
    }
    EXPECT_NEAR(stepper.state()[0], 1.0, 20.0 * tolerance);
    EXPECT_NEAR(stepper.state()[1], 0.0, 20.0 * tolerance);
    EXPECT_LT(steps, tolerance == 1e-6 ? 40 : 150);
  }
}

TEST(DormandPrince, ReportsAResultThatIsNotFinite) {
  const auto rhs = [](double, std::span<const double> y, std::span<double> dydt) {
    dydt[0] = std::sqrt(y[0]);
  };
  DormandPrince stepper(1);
  stepper.Start(rhs, 0.0, std::vector<double>{-1.0}, 0.1);
  const auto norm = [](auto, auto, std::span<const double> error) { return std::abs(error[0]); };
  EXPECT_EQ(stepper.Step(rhs, 1.0, norm), DormandPrince::Outcome::kNotFinite);
}

}  // namespace dormand_prince_test
}  // namespace plenum::model
