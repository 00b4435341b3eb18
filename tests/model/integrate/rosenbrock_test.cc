#include "model/integrate/rosenbrock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/model/simulate/simulate_rigs.h"
#include "tests/support/sensitivities.h"

namespace plenum::model {
namespace rosenbrock_test {

const auto kAcceptAll = [](auto, auto, auto) { return 1e-9; };

// A pendulum that grows: nonlinear, and driven so that the time counts.
const auto kDriven = [](const auto& t, auto y, auto dydt) {
  using std::cos, std::sin;
  dydt[0] = y[1];
  dydt[1] = cos(t) - y[0] * y[0] * y[0];
};

template <class T>
std::vector<T> AtTwo(int steps, const T& start) {
  RosenbrockOf<T> stepper(2);
  const T h = T(2.0 / steps);
  stepper.Start(kDriven, T(0.0), std::vector<T>{start, T(0.2)}, ValueOf(h));
  for (int i = 0; i < steps; ++i) stepper.Step(kDriven, h, kAcceptAll);
  return {stepper.state().begin(), stepper.state().end()};
}

TEST(Rosenbrock, ErrorFallsWithTheThirdPowerOfTheStep) {
  const double fine = AtTwo(4000, 1.0)[0];
  const auto error = [&](int steps) { return std::abs(AtTwo(steps, 1.0)[0] - fine); };
  EXPECT_NEAR(std::log2(error(40) / error(80)), 3.0, 0.2);
  EXPECT_NEAR(std::log2(error(80) / error(160)), 3.0, 0.2);
}

// The derivatives are carried by a matrix that knows nothing of them.
TEST(Rosenbrock, DerivativesConvergeToDifferencesOfFineSteps) {
  const double h = 1e-4;
  const double difference = (AtTwo(4000, 1.0 + h)[0] - AtTwo(4000, 1.0 - h)[0]) / (2.0 * h);
  const auto error = [&](int steps) {
    return std::abs(AtTwo(steps, Dual(1.0, 0))[0].v[0] - difference);
  };
  EXPECT_LT(error(160), 1e-4 * std::abs(difference));
  EXPECT_NEAR(std::log2(error(40) / error(80)), 3.0, 0.3);
}

// What moves with a parameter may be far larger than the state itself, or far smaller: the values
// do not feel it.
TEST(Rosenbrock, ValuesDoNotDependOnTheSizeOfDerivatives) {
  const double plain = AtTwo(40, 1.0)[0];
  for (const double size : {1e-18, 1.0, 1e18}) {
    Dual start(1.0, 3);
    start.v *= size;
    EXPECT_NEAR(AtTwo(40, start)[0].a, plain, 1e-7) << size;
    EXPECT_NEAR(AtTwo(40, start)[0].v[3] / size, AtTwo(40, Dual(1.0, 0))[0].v[0], 1e-7) << size;
  }
}

// y' = −λ·(y − cos t) with λ = 1e6: steps a hundred thousand times the time constant.
TEST(Rosenbrock, StiffMotionDoesNotHoldTheStep) {
  const auto rhs = [](double t, std::span<const double> y, std::span<double> dydt) {
    dydt[0] = -1e6 * (y[0] - std::cos(t));
  };
  RosenbrockOf<double> stepper(1);
  stepper.Start(rhs, 0.0, std::vector<double>{0.0}, 0.1);
  for (int i = 0; i < 20; ++i) stepper.Step(rhs, 0.1, kAcceptAll);
  EXPECT_NEAR(stepper.state()[0], std::cos(2.0), 0.02);
  for (double theta = 0.1; theta < 1.0; theta += 0.2)
    EXPECT_NEAR(stepper.At(theta, 0), std::cos(1.9 + 0.1 * theta), 0.05);
}

// y' = −λ·(y − s·t): once the start has died out y lags s·t by s/λ, a straight line, on which no
// step is too long.
template <class T>
void ExpectFewStepsAlongARamp(const T& rate) {
  constexpr double kLambda = 1e7;
  const auto rhs = [&](const T& t, std::span<const T> y, std::span<T> dydt) {
    dydt[0] = -kLambda * (y[0] - rate * t);
  };
  const auto norm = [](auto, auto, std::span<const T> error) {
    return std::abs(ValueOf(error[0]));  // of 1 Pa
  };
  RosenbrockOf<T> stepper(1);
  stepper.Start(rhs, T(0.0), std::vector<T>{T(0.0)}, 1e-9);
  int steps = 0;
  while (ValueOf(stepper.time()) < 1.0 && steps < 1000) {
    stepper.Step(rhs, T(1.0 - ValueOf(stepper.time())), norm);
    ++steps;
  }
  EXPECT_LT(steps, 30);
  EXPECT_NEAR(ValueOf(stepper.state()[0]), ValueOf(rate) * (1.0 - 1.0 / kLambda), 1e-3);
  if constexpr (kIsDual<T>) {
    EXPECT_NEAR(stepper.state()[0].v[2], 1.0 - 1.0 / kLambda, 1e-7);
  }
}

TEST(Rosenbrock, FastModesFollowARampInLongSteps) {
  ExpectFewStepsAlongARamp(1e5);
  ExpectFewStepsAlongARamp(Dual(1e5, 2));
}

// At rest nothing tells how long a first step should be: all of what is left is tried.
TEST(Rosenbrock, StartsFromRestWithoutAFirstStep) {
  const auto rhs = [](const Dual& t, std::span<const Dual> y, std::span<Dual> dydt) {
    dydt[0] = t * t - y[0] + y[1] * y[1];
    dydt[1] = -y[1];
  };
  RosenbrockOf<Dual> stepper(2);
  stepper.Start(rhs, Dual(0.0), std::vector<Dual>{Dual(0.0), Dual(0.0, 1)},
                std::numeric_limits<double>::infinity());
  ASSERT_EQ(stepper.Step(rhs, Dual(0.01), kAcceptAll), RosenbrockOf<Dual>::Outcome::kAccepted);
  EXPECT_NEAR(stepper.state()[0].a, 3.3e-7, 1e-7);
  EXPECT_NEAR(stepper.state()[1].v[1], std::exp(-0.01), 1e-6);
}

TEST(Rosenbrock, DenseOutputHasTheSlopesOfBothEnds) {
  RosenbrockOf<double> stepper(2);
  stepper.Start(kDriven, 0.3, std::vector<double>{0.7, -0.4}, 0.1);
  stepper.Step(kDriven, 0.1, kAcceptAll);
  EXPECT_NEAR(stepper.At(0.0, 0), 0.7, 1e-15);
  EXPECT_NEAR(stepper.At(1.0, 0), stepper.state()[0], 1e-15);
  EXPECT_NEAR(stepper.SlopeAt(0.0, 0), 0.1 * -0.4, 1e-15);
  EXPECT_NEAR(stepper.SlopeAt(1.0, 0), 0.1 * stepper.derivative()[0], 1e-15);
  for (const double theta : {0.2, 0.7})
    EXPECT_NEAR((stepper.At(theta + 1e-6, 1) - stepper.At(theta - 1e-6, 1)) / 2e-6,
                stepper.SlopeAt(theta, 1), 1e-8);
}

// It rings a thousand times a second.
Rig ShortLine() {
  GroupRig group =
      OneActuator(2e5, 1.8, {.sonic_conductance_m3_per_s_pa = 0.05e-8, .critical_ratio = 0.3});
  group.schedule = {{0.2, ValveState::kInflate},
                    {0.8, ValveState::kHold},
                    {1.2, ValveState::kDeflate},
                    {2.0, ValveState::kHold}};
  group.effects = {{FindEffect("line_dynamics"), {0.1, 2e-3}}};
  return RigOf(Regulated(3e5), {group});
}

// The pressures of a short tube, and what they do as the conductance changes, are those of a run
// that follows every turn.
TEST(Rosenbrock, DampsAShortLineThatRings) {
  const Rig rig = ShortLine();
  SimulateOptions exact = Until(2.5, 100.0), damped = exact;
  exact.integrator = Integrator::kCvode;
  exact.relative_tolerance = 1e-9;
  damped.integrator = Integrator::kDamped;
  damped.relative_tolerance = 1e-6;
  damped.absolute_tolerance_pa = 0.01;
  damped.steps_max = 3000;
  const double* conductance = &rig.groups[0].fill[0].sonic_conductance_m3_per_s_pa;
  const SensitivityResponse dual = SimulateWithSensitivities(rig, damped, {&conductance, 1});
  const Response plain = Simulate(rig, damped);
  ASSERT_EQ(dual.response.status, SimulateStatus::kDone) << dual.response.detail;
  ASSERT_EQ(plain.status, SimulateStatus::kDone) << plain.detail;
  EXPECT_TRUE(plain.stiff && dual.response.stiff);
  EXPECT_LT(plain.steps, 1000u);
  SimulateOptions at_once = damped;  // the same run, without the trial of the explicit method
  at_once.integrator = Integrator::kImplicit;
  EXPECT_EQ(Simulate(rig, at_once).groups[0].pressure_pa, plain.groups[0].pressure_pa);
  EXPECT_EQ(SimulateWithSensitivities(rig, at_once, {&conductance, 1})
                .derivatives[0]
                .groups[0]
                .pressure_pa,
            dual.derivatives[0].groups[0].pressure_pa);
  const Response reference = Simulate(rig, exact);
  Rig more = rig, less = rig;
  const double h = 1e-3 * *conductance;
  more.groups[0].fill[0].sonic_conductance_m3_per_s_pa += h;
  less.groups[0].fill[0].sonic_conductance_m3_per_s_pa -= h;
  const auto up = Simulate(more, exact).groups[0].pressure_pa;
  const auto down = Simulate(less, exact).groups[0].pressure_pa;
  for (std::size_t k = 0; k < up.size(); ++k) {
    EXPECT_NEAR(plain.groups[0].pressure_pa[k], reference.groups[0].pressure_pa[k], 20.0) << k;
    EXPECT_NEAR(dual.response.groups[0].pressure_pa[k], plain.groups[0].pressure_pa[k], 1e-3) << k;
    const double difference = (up[k] - down[k]) / 2e-3;
    EXPECT_NEAR(*conductance * dual.derivatives[0].groups[0].pressure_pa[k], difference, 150.0)
        << k;
  }
}

// Where a sensor is at the inlet it shows the ringing, which is followed then.
TEST(Rosenbrock, FollowsTheRingsThatAnInletSensorSees) {
  Rig rig = ShortLine();
  rig.groups[0].inlet_after = 1;
  SimulateOptions exact = Until(2.5, 400.0), damped = exact;
  exact.integrator = Integrator::kCvode;
  exact.relative_tolerance = 1e-9;
  damped.integrator = Integrator::kImplicit;
  damped.relative_tolerance = 1e-6;
  damped.absolute_tolerance_pa = 0.01;
  const Response r = Simulate(rig, damped), reference = Simulate(rig, exact);
  ASSERT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  double squares = 0.0;
  for (std::size_t k = 0; k < r.t_s.size(); ++k)
    squares +=
        std::pow(r.groups[0].inlet_pressure_pa[k] - reference.groups[0].inlet_pressure_pa[k], 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(r.t_s.size())), 150.0);
}

// A sensor's lag of a third of a millisecond is nothing that a rough run follows, however many
// steps it may take.
TEST(Rosenbrock, ARoughRunIsNotHeldDownByAFastMode) {
  GroupRig group =
      OneActuator(2e5, 1.8, {.sonic_conductance_m3_per_s_pa = 0.05e-8, .critical_ratio = 0.3});
  group.schedule = {{0.2, ValveState::kInflate}, {0.8, ValveState::kHold}};
  group.effects = {{FindEffect("sensor_lag"), {3e-4}}};
  const Rig rig = RigOf(Regulated(3e5), {group});
  SimulateOptions exact = Until(3.0, 100.0), rough = exact;
  exact.integrator = Integrator::kCvode;
  exact.relative_tolerance = 1e-9;
  rough.integrator = Integrator::kDamped;
  rough.relative_tolerance = 3e-5;
  rough.steps_max = 200'000;
  const Response r = Simulate(rig, rough), reference = Simulate(rig, exact);
  ASSERT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  EXPECT_LT(r.steps, 300u);
  for (std::size_t k = 0; k < r.t_s.size(); ++k)
    EXPECT_NEAR(r.groups[0].pressure_pa[k], reference.groups[0].pressure_pa[k], 30.0) << k;
}

// A small volume behind a wide check valve lags less behind a source that rises than a difference
// for the slope moves it; were that taken beyond the source, where nothing flows back, the feed
// would look shut and hold the steps to its time constant of microseconds.
TEST(Rosenbrock, WhatAFeedShutsAgainstDoesNotHoldTheStep) {
  GroupRig group =
      OneActuator(1.5e5, 1.8, {.sonic_conductance_m3_per_s_pa = 0.05e-8, .critical_ratio = 0.3});
  group.schedule = {{0.2, ValveState::kInflate}, {0.5, ValveState::kHold}};
  group.effects = {{FindEffect("supply_droop"), {1e-6, 1e-7, 0.24}}};
  const DrivenSource source = {{0.0, 1.0, 2.0, 3.0}, {1.55e5, 1.551e5, 1.55e5, 1.57e5}, 1.0};
  SimulateOptions options = Until(3.0);
  options.integrator = Integrator::kImplicit;
  options.relative_tolerance = 1e-7;
  const Response r = Simulate(RigOf(source, {group}), options);
  ASSERT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  EXPECT_LT(r.steps, 1000u);
}

}  // namespace rosenbrock_test
}  // namespace plenum::model
