// What records tell of a group, its valve's opening and its volume, against closed forms and an
// integrator of the test's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/effects/registry.h"
#include "model/simulate/sensitivity.h"
#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace told_test {

using enum ValveState;

constexpr FlowElement kValve = {.sonic_conductance_m3_per_s_pa = 0.1e-8, .critical_ratio = 0.3};
constexpr FlowElement kTube = {.sonic_conductance_m3_per_s_pa = 0.06e-8, .critical_ratio = 0.15};
const TimeCourse kOpening = {{0.0, 0.3, 0.35, 0.8, 1.2, 1.5}, {0.0, 1.0, 0.2, 0.6, 0.0, 0.0}};
const TimeCourse kVolume = {{0.1, 0.6, 0.65, 1.4}, {50e-6, 20e-6, 22e-6, 70e-6}};

Response Done(const Rig& rig, double end_s) {
  Response r = Simulate(rig, Until(end_s, 200.0));
  EXPECT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  return r;
}

GroupRig ValveAndTube() {
  GroupRig group = OneActuator(2e5, 1.0, kValve);
  group.fill = {kValve, kTube};
  group.exhaust = {kTube, kValve};
  group.inlet_after = 1;
  return group;
}

GroupRig Syringe() {
  GroupRig group = OneActuator(2e5, 1.0, kValve);
  group.chamber.dead_volume_m3 = 3e-6;
  group.initial_pressure_pa = 1.2e5;
  group.blocked = true;
  group.told.volume_m3 = kVolume;
  return group;
}

// p·(V + V_d) of a closed chamber that stays at one temperature.
TEST(ToldVolume, AClosedChamberKeepsItsProductOfPressureAndVolume) {
  const Response r = Done(RigOf(NoSource{}, {Syringe()}), 1.6);
  for (std::size_t k = 0; k < r.t_s.size(); ++k) {
    const double volume_m3 = kVolume.At(r.t_s[k]);
    EXPECT_NEAR(r.groups[0].volume_m3[k], volume_m3, 1e-12 * volume_m3);
    const double product = r.groups[0].pressure_pa[k] * (volume_m3 + 3e-6);
    EXPECT_NEAR(product / (1.2e5 * 53e-6), 1.0, 1e-7) << r.t_s[k];
  }
}

// Without heat from the wall p·V^γ stays.
TEST(ToldVolume, AnInsulatedChamberFollowsTheAdiabat) {
  GroupRig group = Syringe();
  group.initial_temperature_k = 293.15;
  group.effects = {{FindEffect("heat_transfer"), {1e9}}};
  const Response r = Done(RigOf(NoSource{}, {group}), 1.6);
  for (std::size_t k = 0; k < r.t_s.size(); ++k) {
    const double share = (kVolume.At(r.t_s[k]) + 3e-6) / 53e-6;
    EXPECT_NEAR(r.groups[0].pressure_pa[k] / 1.2e5, std::pow(share, -1.4), 1e-6) << r.t_s[k];
    EXPECT_NEAR(r.groups[0].temperature_k[k], 293.15 * std::pow(share, -0.4), 3e-4) << r.t_s[k];
  }
}

TEST(ToldVolume, EffectsOnTheLawDoNothing) {
  GroupRig group = Syringe();
  const Response plain = Done(RigOf(NoSource{}, {group}), 1.6);
  group.effects = {{FindEffect("inertia"), {40.0, 0.3}}, {FindEffect("creep"), {0.2, 0.5}}};
  const Response r = Done(RigOf(NoSource{}, {group}), 1.6);
  for (std::size_t k = 0; k < r.t_s.size(); ++k)
    EXPECT_NEAR(r.groups[0].pressure_pa[k], plain.groups[0].pressure_pa[k], 0.1) << r.t_s[k];
}

// Choked into a rigid volume: p − p(0) = P0·C/V·p_s·∫o dt.
TEST(ToldOpening, FillsByItsIntegralWhileTheLineIsChoked) {
  GroupRig group = OneActuator(2e5, 1.0, kValve);
  group.schedule = {{0.0, kInflate}};
  group.told.opening = {{0.0, 0.05, 0.1}, {0.0, 0.8, 0.2}};
  const Response r = Done(RigOf(Regulated(6e5), {group}), 0.1);
  for (std::size_t k = 0; k < r.t_s.size(); ++k) {
    const double t = r.t_s[k], early = std::min(t, 0.05), late = std::max(0.0, t - 0.05);
    const double integral = 8.0 * early * early + 0.8 * late - 6.0 * late * late;
    EXPECT_NEAR(r.groups[0].pressure_pa[k], 1e5 + 1e5 * 0.1e-8 / 50e-6 * 6e5 * integral, 0.05) << t;
  }
}

double IsoFlow(const FlowElement& e, double share, double upstream_pa, double downstream_pa) {
  if (downstream_pa >= upstream_pa) return 0.0;
  const double over =
      std::max(0.0, (downstream_pa / upstream_pa - e.critical_ratio) / (1.0 - e.critical_ratio));
  return share * e.sonic_conductance_m3_per_s_pa * upstream_pa * std::sqrt(1.0 - over * over);
}

// Two elements in series, by bisection over the pressure between them.
double SeriesFlow(const FlowElement& first, double first_share, const FlowElement& second,
                  double second_share, double upstream_pa, double downstream_pa) {
  double low = downstream_pa, high = upstream_pa;
  for (int i = 0; i < 70; ++i) {
    const double middle = 0.5 * (low + high);
    const bool more = IsoFlow(first, first_share, upstream_pa, middle) >
                      IsoFlow(second, second_share, middle, downstream_pa);
    (more ? low : high) = middle;
  }
  return IsoFlow(second, second_share, 0.5 * (low + high), downstream_pa);
}

// Fills to 0.8 s, holds to 0.9 s, then empties. Runge–Kutta of fourth order.
std::vector<double> OwnIntegration(const std::vector<double>& t_s) {
  std::vector<double> p = {1e5};
  const auto rate = [](double t, double pressure_pa) {
    const double opening = kOpening.At(t);
    double flow = 0.0;
    if (t < 0.8)
      flow = SeriesFlow(kValve, opening, kTube, 1.0, 3e5, pressure_pa);
    else if (t >= 0.9)
      flow = -SeriesFlow(kTube, 1.0, kValve, opening, pressure_pa, 1e5);
    return flow * 1e5 / 50e-6;
  };
  constexpr int kSteps = 20;
  for (std::size_t k = 1; k < t_s.size(); ++k) {
    double now = p.back();
    const double h = (t_s[k] - t_s[k - 1]) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      // Ends just before an instant at which the valve turns.
      const double t = t_s[k - 1] + i * h, end = t + h * (1.0 - 1e-9);
      const double k1 = rate(t, now), k2 = rate(t + 0.5 * h, now + 0.5 * h * k1);
      const double k3 = rate(t + 0.5 * h, now + 0.5 * h * k2), k4 = rate(end, now + h * k3);
      now += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    p.push_back(now);
  }
  return p;
}

TEST(ToldOpening, ThrottlesTheValveAndNotTheTubeBehindIt) {
  GroupRig group = ValveAndTube();
  group.schedule = {{0.0, kInflate}, {0.8, kHold}, {0.9, kDeflate}};
  group.told.opening = kOpening;
  const Response r = Done(RigOf(Regulated(3e5), {group}), 1.5);
  const std::vector<double> own = OwnIntegration(r.t_s);
  for (std::size_t k = 0; k < own.size(); ++k) {
    EXPECT_NEAR(r.groups[0].pressure_pa[k], own[k], 3.0) << r.t_s[k];
    const double p = r.groups[0].pressure_pa[k], inlet = r.groups[0].inlet_pressure_pa[k];
    const double flow = r.groups[0].flow_m3_per_s[k];
    EXPECT_NEAR(IsoFlow(kTube, 1.0, inlet, p), flow, 1e-5 * flow) << r.t_s[k];
  }
  EXPECT_GT(r.groups[0].pressure_pa[160], 1.5e5);
  EXPECT_LT(r.groups[0].pressure_pa.back(), 0.9 * r.groups[0].pressure_pa[160]);
}

// A valve's opening of one half is a valve of half the conductance.
TEST(ToldOpening, ConstantIsAnotherConductance) {
  GroupRig group = ValveAndTube();
  group.schedule = {{0.0, kInflate}, {0.3, kDeflate}};
  group.told.opening = {{0.0}, {0.5}};
  const Response told = Done(RigOf(Regulated(3e5), {group}), 0.7);
  group.told = {};
  group.fill[0].sonic_conductance_m3_per_s_pa *= 0.5;
  group.exhaust[1].sonic_conductance_m3_per_s_pa *= 0.5;
  const Response half = Done(RigOf(Regulated(3e5), {group}), 0.7);
  for (std::size_t k = 0; k < half.t_s.size(); ++k)
    EXPECT_NEAR(told.groups[0].pressure_pa[k], half.groups[0].pressure_pa[k], 0.1) << k;
}

TEST(ToldOpening, ADelayOfTheValveActsOnTheRecord) {
  GroupRig group = ValveAndTube();
  group.schedule = {{0.0, kInflate}};
  group.told.opening = kOpening;
  for (double& t_s : group.told.opening.time_s) t_s += 0.07;
  const Response moved = Done(RigOf(Regulated(3e5), {group}), 1.5);
  group.told.opening = kOpening;
  group.effects = {{FindEffect("valve_delay"), {0.07}}};
  const Response late = Done(RigOf(Regulated(3e5), {group}), 1.5);
  for (std::size_t k = 0; k < late.t_s.size(); ++k)
    EXPECT_NEAR(late.groups[0].pressure_pa[k], moved.groups[0].pressure_pa[k], 0.5) << k;
}

// Shut for long, then a short pulse: the pulse is not passed over.
TEST(ToldOpening, ABriefPulseAfterALongRestIsNotPassedOver) {
  GroupRig group = OneActuator(2e5, 1.0, kValve);
  group.schedule = {{0.0, kInflate}};
  group.told.opening = {{0.0, 50.0, 50.01, 50.02, 100.0}, {0.0, 0.0, 1.0, 0.0, 0.0}};
  const Response r = Simulate(RigOf(Regulated(6e5), {group}), Until(100.0, 1.0));
  EXPECT_NEAR(r.groups[0].pressure_pa[50], 1e5, 1e-6);
  EXPECT_NEAR(r.groups[0].pressure_pa[100], 1e5 + 1e5 * 0.1e-8 / 50e-6 * 6e5 * 0.01, 0.1);
}

TEST(Told, DerivativesAgreeWithDifferences) {
  GroupRig group = ValveAndTube();
  group.schedule = {{0.0, kInflate}, {0.8, kHold}, {0.9, kDeflate}};
  group.blocked = true;
  group.chamber.dead_volume_m3 = 5e-6;
  group.told = {kOpening, kVolume};
  group.effects = {{FindEffect("valve_delay"), {0.02}}};
  Rig rig = RigOf(Regulated(3e5), {group});
  GroupRig& g = rig.groups[0];
  const std::vector<double*> numbers = {&g.chamber.dead_volume_m3,
                                        &g.fill[0].sonic_conductance_m3_per_s_pa,
                                        &g.effects[0].parameters[0], &g.schedule[2].time_s};
  std::vector<Direction> directions;
  for (const double* number : numbers) directions.push_back({{number, 1.0}});
  SimulateOptions options = Until(1.5);
  for (int k = 0; k < 70; ++k) options.sample_times_s.push_back(0.013 + 0.02 * k);  // at no switch
  options.relative_tolerance = 1e-11;
  const SensitivityResponse s = SimulateAlongDirections(rig, options, directions);
  ASSERT_EQ(s.response.status, SimulateStatus::kDone) << s.response.detail;
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    const double at = *numbers[j], step = 1e-4 * at;
    *numbers[j] = at + step;
    const Response above = Simulate(rig, options);
    *numbers[j] = at - step;
    const Response below = Simulate(rig, options);
    *numbers[j] = at;
    for (std::size_t k = 0; k < s.response.t_s.size(); ++k) {
      const double slope =
          (above.groups[0].pressure_pa[k] - below.groups[0].pressure_pa[k]) / (2.0 * step);
      EXPECT_NEAR(s.derivatives[j].groups[0].pressure_pa[k], slope,
                  1e-3 * std::abs(slope) + 3.0 / at)
          << j << " " << s.response.t_s[k];
    }
  }
}

TEST(Told, WhatCannotBeIsRefused) {
  const auto refused = [](const GroupRig& group, const char* field) {
    const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(1.0));
    EXPECT_EQ(r.status, SimulateStatus::kInvalid);
    EXPECT_NE(r.detail.find(field), std::string::npos) << r.detail;
  };
  GroupRig group = Syringe();
  group.blocked = false;
  refused(group, "blocked");
  group = Syringe();
  group.told.volume_m3.value[1] = 0.0;
  refused(group, "told.volume_m3.value");
  group = Syringe();
  group.told.volume_m3.value.pop_back();
  refused(group, "as many points");
  group = ValveAndTube();
  group.told.opening = {{0.0, 1.0}, {0.0, 1.2}};
  refused(group, "told.opening.value");
  group.told.opening = {{1.0, 1.0}, {0.0, 0.2}};
  refused(group, "time_s");
}

}  // namespace told_test
}  // namespace plenum::model
