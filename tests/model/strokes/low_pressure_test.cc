// Actuators under pressure that are pulled below ambient: against the oracle of the physics page,
// closed forms of choked strokes, and masses integrated by code that shares nothing with the model.
#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <vector>

#include "model/simulate/periodic.h"
#include "model/simulate/simulate.h"
#include "model/strokes/stroke.h"
#include "model/strokes/stroke_enclosure.h"
#include "tests/support/flow/iso_chain.h"
#include "tests/support/random.h"

namespace plenum::model {
namespace low_pressure_test {

constexpr double kAmbientPa = 1e5;

struct Numbers {
  double rest_m3 = 50e-6, ratio = 2.0, operating_pa = 1.5e5, low_pa = 0.8e5, rail_pa = 0.4e5;
  double dead_m3 = 0.0;

  double Content(double p) const {
    const double x = (p - kAmbientPa) / (operating_pa - kAmbientPa);
    return p * (dead_m3 + rest_m3 * (1.0 + (ratio - 1.0) * x));
  }
};

Chamber ChamberOf(const Numbers& numbers) {
  Chamber chamber;
  chamber.rest_volume_m3 = numbers.rest_m3;
  chamber.expansion_ratio = numbers.ratio;
  chamber.operating_pressure_pa = numbers.operating_pa;
  chamber.dead_volume_m3 = numbers.dead_m3;
  chamber.low_pressure_pa = numbers.low_pa;
  chamber.exhaust_pressure_pa = numbers.rail_pa;
  return chamber;
}

// Seconds of a stroke between a constant pressure and the chamber, mass by mass.
double Integrated(const Numbers& numbers, const std::vector<test::MassElement>& chain,
                  double outside_pa, double from_pa, double to_pa) {
  using State = std::array<double, 1>;
  const bool fills = to_pa > from_pa;
  const auto rate = [&](const State& y, State& dy, double) {
    const double p = test::Bisect(
        1.0, 2e6, [&](double pa) { return y[0] - numbers.Content(pa); }, 1e-7);
    dy[0] = fills ? 1e5 * test::ChainFlow(chain, outside_pa, p, 1.0, 1.0 - 1e-9)
                  : -1e5 * test::ChainFlow(chain, p, outside_pa, 1.0, 1.0 - 1e-9);
  };
  State y{numbers.Content(from_pa)};
  const double target = numbers.Content(to_pa), span = std::abs(target - y[0]);
  boost::numeric::odeint::runge_kutta4<State> stepper;
  double t = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    State dy{};
    rate(y, dy, t);
    const double left = std::abs(target - y[0]);
    if (left < 1e-10 * span || dy[0] == 0.0) break;
    const double step = std::min(left, 2e-3 * span) / std::abs(dy[0]);
    stepper.do_step(rate, y, t, step);
    t += step;
  }
  return t;
}

TEST(LowPressure, OracleOfThePhysicsPage) {
  const FlowElement element{1e-9, 0.3};
  const Chamber chamber = ChamberOf({});
  EXPECT_NEAR(EmptyTime(MakeSeries({&element, 1}), chamber, 1.5e5, 0.8e5), 1.093949, 1e-6);
}

// With k of W = V0·(1 − k + 2·k·p), p in parts of ambient: choked all the way.
TEST(LowPressure, ChokedStrokesAreThoseOfTheClosedForms) {
  Numbers numbers;
  numbers.rail_pa = 0.1e5;
  const Chamber chamber = ChamberOf(numbers);
  const FlowElement element{1e-9, 0.3};
  const Series line = MakeSeries({&element, 1});
  const double k = (numbers.ratio - 1.0) / (numbers.operating_pa / kAmbientPa - 1.0);
  const double c = 1e-9 * kAmbientPa / numbers.rest_m3;
  const double fall = (1.0 - k) * std::log(1.5 / 0.8) + 2.0 * k * (1.5 - 0.8);
  EXPECT_NEAR(EmptyTime(line, chamber, 1.5e5, 0.8e5), fall / c, 1e-9 * fall / c);
  const auto pv = [&](double p) { return p * (1.0 + k * (p - 1.0)); };
  const double rise = (pv(1.5) - pv(0.8)) / 6.0;
  EXPECT_NEAR(FillTime(line, chamber, 6e5, 0.8e5, 1.5e5), rise / c, 1e-9 * rise / c);
}

TEST(LowPressure, StrokesAreThoseOfMassesIntegrated) {
  test::Random random(7);
  const auto uniform = [&](double low, double high) { return random.Uniform(low, high); };
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    Numbers numbers;
    numbers.rest_m3 = uniform(5e-6, 200e-6);
    numbers.ratio = uniform(1.0, 2.0);
    numbers.operating_pa = kAmbientPa + uniform(20e3, 200e3);
    const double deepest = std::min(
        80e3, 0.8 * (numbers.operating_pa - kAmbientPa) / std::max(1e-3, numbers.ratio - 1.0));
    numbers.low_pa = kAmbientPa - uniform(0.1, 1.0) * deepest;
    numbers.rail_pa = uniform(0.05, 0.95) * numbers.low_pa;
    numbers.dead_m3 = uniform(0.0, 5e-6);
    std::vector<FlowElement> elements;
    std::vector<test::MassElement> chain;
    for (int e = 0; e < 3; ++e) {
      const double conductance = uniform(0.2e-9, 2e-9), ratio = uniform(0.1, 0.5);
      elements.push_back({conductance, ratio});
      chain.push_back({conductance, ratio});
    }
    const Chamber chamber = ChamberOf(numbers);
    ASSERT_EQ(WhyInvalid(chamber), "");
    const Series line = MakeSeries(elements);
    const double source_pa = numbers.operating_pa * uniform(1.05, 3.0);
    const double target_pa = kAmbientPa + 0.95 * (numbers.operating_pa - kAmbientPa);
    const double fallen_pa = numbers.low_pa + 0.05 * (numbers.operating_pa - numbers.low_pa);
    const double rise_s = FillTime(line, chamber, source_pa, numbers.low_pa, target_pa);
    const double fall_s = EmptyTime(line, chamber, numbers.operating_pa, fallen_pa);
    EXPECT_NEAR(rise_s, Integrated(numbers, chain, source_pa, numbers.low_pa, target_pa),
                1e-6 * rise_s);
    EXPECT_NEAR(fall_s,
                Integrated(numbers, chain, numbers.rail_pa, numbers.operating_pa, fallen_pa),
                1e-6 * fall_s);
    const CurveNodes nodes =
        MarchNodes(elements, 1.0, PressureRatio(0.0, fallen_pa, numbers.rail_pa));
    const Enclosure around =
        EncloseEmptyTime(nodes, chamber, numbers.operating_pa, fallen_pa, kReferenceTemperatureK);
    EXPECT_LE(around.low_s, fall_s);
    EXPECT_GE(around.high_s, fall_s);
    EXPECT_GE(EmptyTimeAtMost(elements, 1.0, chamber, numbers.operating_pa, fallen_pa,
                              kReferenceTemperatureK),
              fall_s);
  }
}

Rig TwoRails(const Numbers& numbers) {
  Rig rig;
  GroupRig group;
  group.chamber = ChamberOf(numbers);
  group.fill = {{1e-9, 0.3}, {2e-9, 0.2}};
  group.exhaust = {{2e-9, 0.2}, {1.5e-9, 0.35}};
  group.close_at_operating = group.close_at_low = true;
  group.initial_pressure_pa = numbers.low_pa;
  group.schedule = {{0.0, ValveState::kInflate}, {2.0, ValveState::kDeflate}};
  rig.groups = {group};
  rig.source = RegulatedSource{3e5, std::nullopt, std::numeric_limits<double>::infinity()};
  return rig;
}

TEST(LowPressure, TheSimulatorClosesAtTheLowPressure) {
  const Numbers numbers;
  const Rig rig = TwoRails(numbers);
  SimulateOptions options;
  options.end_s = 5.0;
  const Response response = Simulate(rig, options);
  ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  const GroupResponse& group = response.groups[0];
  EXPECT_NEAR(group.final_pressure_pa, numbers.low_pa, 1e-9 * numbers.low_pa);
  EXPECT_NEAR(group.air_in_m3, group.air_out_m3, 1e-8 * group.air_in_m3);
  const double taken_m3 =
      (numbers.Content(numbers.operating_pa) - numbers.Content(numbers.low_pa)) / 1e5;
  EXPECT_NEAR(group.air_in_m3, taken_m3, 1e-8 * taken_m3);
  ASSERT_EQ(response.strokes.size(), 2u);
  const Chamber chamber = ChamberOf(numbers);
  const double rise_s = FillTime(MakeSeries(rig.groups[0].fill), chamber, 3e5, numbers.low_pa,
                                 kAmbientPa + 0.95 * 0.5e5);
  const double fall_s = EmptyTime(MakeSeries(rig.groups[0].exhaust), chamber, numbers.operating_pa,
                                  numbers.low_pa + 0.05 * 0.7e5);
  EXPECT_NEAR(response.strokes[0].to_target_s, rise_s, 1e-6 * rise_s);
  EXPECT_NEAR(response.strokes[1].to_target_s, fall_s, 1e-6 * fall_s);
  const std::vector<FullStroke> full = FullStrokes(rig, options);
  EXPECT_NEAR(full[0].rise_time_s, rise_s, 1e-6 * rise_s);
  EXPECT_NEAR(full[0].fall_time_s, fall_s, 1e-6 * fall_s);
}

TEST(LowPressure, AnOpenValveGoesOnToTheRail) {
  Numbers numbers;
  numbers.rail_pa = 0.6e5;  // where the law leaves some volume
  Rig rig = TwoRails(numbers);
  rig.groups[0].close_at_low = false;
  SimulateOptions options;
  options.end_s = 30.0;
  const Response response = Simulate(rig, options);
  ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  EXPECT_NEAR(response.groups[0].final_pressure_pa, numbers.rail_pa, 1e-6 * numbers.rail_pa);
}

// From ambient, in the first period, it is soon at rest at the low pressure.
TEST(LowPressure, ThePeriodicStateBeginsAtTheLowPressure) {
  const Numbers numbers;
  Rig rig = TwoRails(numbers);
  rig.groups[0].initial_pressure_pa = kAmbientPa;
  const PeriodicState state = FindPeriodicState(rig, 5.0, {}, {.tolerance = 1e-9});
  ASSERT_EQ(state.status, PeriodicStatus::kConverged);
  EXPECT_NEAR(state.response.groups[0].final_pressure_pa, numbers.low_pa, 1e-8 * numbers.low_pa);
  EXPECT_NEAR(state.response.strokes[0].start_pressure_pa, numbers.low_pa, 1e-8 * numbers.low_pa);
}

TEST(LowPressure, WhatIsOutOfRangeIsNamed) {
  Chamber chamber = ChamberOf({});
  EXPECT_EQ(WhyInvalid(chamber), "");
  chamber.low_pressure_pa = 1.2e5;
  EXPECT_NE(WhyInvalid(chamber).find("low_pressure_pa"), std::string::npos);
  chamber = ChamberOf({});
  chamber.low_pressure_pa = 0.4e5;  // the law: 50 mL·(1 − 1.2)
  EXPECT_NE(WhyInvalid(chamber).find("law of the volume"), std::string::npos);
  chamber = ChamberOf({});
  chamber.evacuated = true;
  chamber.expansion_ratio = 0.5;
  EXPECT_NE(WhyInvalid(chamber).find("not evacuated"), std::string::npos);
}

}  // namespace low_pressure_test
}  // namespace plenum::model
