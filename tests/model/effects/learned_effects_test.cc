// Learned terms where they become something known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "model/effects/learned/learned.h"
#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace learned_effects_test {

using enum ValveState;

constexpr FlowElement kLine = {.sonic_conductance_m3_per_s_pa = 0.05e-8, .critical_ratio = 0.3};

GroupRig Cycled() {
  GroupRig group = OneActuator(2e5, 2.0, kLine);
  group.schedule = {{0.1, kInflate}, {1.1, kHold}, {1.5, kDeflate}, {3.0, kInflate}};
  return group;
}

Effect Learned(const char* id, const char* law, std::vector<double> parameters) {
  return {FindEffect(id, law), std::move(parameters)};
}

std::vector<double> Pressures(GroupRig group, double end_s = 4.5) {
  const Response r = Simulate(RigOf(Regulated(3e5), {std::move(group)}), Until(end_s, 40.0));
  EXPECT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  return r.groups[0].reading_pa.empty() ? r.groups[0].pressure_pa : r.groups[0].reading_pa;
}

void ExpectNear(const std::vector<double>& a, const std::vector<double>& b, double bound_pa) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], bound_pa) << k;
}

TEST(LearnedCurve, InterpolatesAndIntegrates) {
  const std::vector<double> values = {1.0, 3.0, 2.0};
  LearnedCurve<double> curve(values, 2.0);
  const auto at = [&](double x) {
    curve.Settle(x, 1.0);
    return curve(x);
  };
  const auto integral = [&](double x) {
    curve.Settle(x, -1.0);
    return curve.Integral(x);
  };
  EXPECT_EQ(at(-1.0), 1.0);
  EXPECT_EQ(at(0.5), 2.0);
  EXPECT_EQ(at(1.5), 2.5);
  EXPECT_EQ(at(9.0), 2.0);
  EXPECT_NEAR(integral(1.0), 2.0, 1e-15);
  EXPECT_NEAR(integral(1.5), 2.0 + 1.375, 1e-15);
  EXPECT_NEAR(integral(3.0), 2.0 + 2.5 + 2.0, 1e-15);
  EXPECT_NEAR(integral(-1.0), -1.0, 1e-15);
  for (const double x : {0.3, 1.7}) {
    EXPECT_NEAR((integral(x + 1e-6) - integral(x - 1e-6)) / 2e-6, at(x), 1e-8);
    EXPECT_NEAR((at(x + 1e-6) - at(x - 1e-6)) / 2e-6, curve.Slope(), 1e-8);
  }
  // On a knot the direction decides.
  curve.Settle(1.0, 1.0);
  EXPECT_EQ(curve.Slope(), -1.0);
  EXPECT_EQ(curve.Above(1.25), 0.75);
  curve.Settle(1.0, -1.0);
  EXPECT_EQ(curve.Slope(), 2.0);
  EXPECT_EQ(curve.Below(0.75), 0.75);
}

// A rigid chamber that leaks in proportion to its gauge pressure empties as e^(−r·t).
TEST(LearnedEffects, AnEvenLeakEmptiesExponentially) {
  GroupRig group = OneActuator(2e5, 1.0, kLine);
  group.initial_pressure_pa = 2e5;
  group.effects = {Learned("learned_leak", "pressure_5", std::vector(5, 0.7))};
  const std::vector<double> p = Pressures(group, 3.0);
  for (std::size_t k = 0; k < p.size(); ++k) {
    EXPECT_NEAR(p[k], 1e5 + 1e5 * std::exp(-0.7 * static_cast<double>(k) / 40.0), 0.1) << k;
  }
}

TEST(LearnedEffects, ALeakThatOpensHalfWayIsTightBelow) {
  GroupRig group = OneActuator(2e5, 1.0, kLine);
  group.initial_pressure_pa = 2e5;
  group.effects = {Learned("learned_leak", "pressure_3", {0.0, 0.0, 4.0})};
  const std::vector<double> p = Pressures(group, 20.0);
  EXPECT_NEAR(p.back(), 1.6e5, 200.0);  // the middle knot is at x = 0.6
  EXPECT_GT(p.back(), 1.6e5 - 1.0);
  EXPECT_LT(p[4], p[0] - 5e3);
}

TEST(LearnedEffects, AnEvenChangeOfConductanceIsAnotherElement) {
  GroupRig other = Cycled();
  other.fill[0].sonic_conductance_m3_per_s_pa *= 0.8;
  other.exhaust = other.fill;
  for (const char* law : {"pressure_9", "expansion_9"}) {
    GroupRig group = Cycled();
    group.effects = {Learned("learned_conductance", law, std::vector(9, -0.2))};
    ExpectNear(Pressures(group), Pressures(other), 0.05);
  }
}

// Behind a restriction that the change does not touch, and in the account of the source.
TEST(LearnedEffects, AChangedLineKeepsItsRestrictionAndItsAccounts) {
  GroupRig other = Cycled();
  other.fill[0].sonic_conductance_m3_per_s_pa *= 0.8;
  other.exhaust = other.fill;
  other.effects = {{FindEffect("exhaust_restriction"), {0.07e-8, 0.2}}};
  GroupRig group = Cycled();
  group.effects = {{FindEffect("exhaust_restriction"), {0.07e-8, 0.2}},
                   Learned("learned_conductance", "pressure_3", std::vector(3, -0.2))};
  ReservoirSource source = {.volume_m3 = 0.3e-3, .initial_pressure_pa = 3e5};
  const Response a = Simulate(RigOf(source, {group}), Until(4.5, 40.0));
  const Response b = Simulate(RigOf(source, {other}), Until(4.5, 40.0));
  ExpectNear(a.groups[0].pressure_pa, b.groups[0].pressure_pa, 0.05);
  ExpectNear(a.source_pressure_pa, b.source_pressure_pa, 0.05);
  EXPECT_NEAR(a.groups[0].air_drawn_m3, b.groups[0].air_drawn_m3, 1e-12);
}

TEST(LearnedEffects, AnEvenGrowthIsAnotherExpansionRatio) {
  GroupRig other = Cycled();
  other.chamber.expansion_ratio = 2.3;
  GroupRig group = Cycled();
  group.effects = {Learned("learned_volume", "pressure_9", std::vector(9, 0.3))};
  ExpectNear(Pressures(group), Pressures(other), 0.05);
}

// A narrow bend is a step of the volume at its place.
TEST(LearnedEffects, ABendAddsItsVolumeAboveItsPlace) {
  GroupRig group = Cycled();
  group.effects = {Learned("learned_volume", "bend", {0.2, 0.5, 0.01})};
  const Response with = Simulate(RigOf(Regulated(3e5), {group}), Until(4.5, 40.0));
  ASSERT_EQ(with.status, SimulateStatus::kDone) << with.detail;
  for (std::size_t k = 0; k < with.t_s.size(); ++k) {
    const double x = (with.groups[0].pressure_pa[k] - 1e5) / 1e5;
    if (std::abs(x - 0.5) < 0.1) continue;
    EXPECT_NEAR(with.groups[0].volume_m3[k], 50e-6 * (1.0 + x + (x > 0.5 ? 0.2 : 0.0)), 1e-8);
  }
  EXPECT_NEAR(with.groups[0].gas_final_m3 - with.groups[0].gas_start_m3,
              with.groups[0].air_in_m3 - with.groups[0].air_out_m3, 1e-10);
}

TEST(LearnedEffects, AnOpeningIsTightBelowItsPlace) {
  GroupRig group = OneActuator(2e5, 1.0, kLine);
  group.initial_pressure_pa = 2e5;
  group.effects = {Learned("learned_leak", "opening", {2.0, 0.6, 0.005})};
  const std::vector<double> p = Pressures(group, 20.0);
  EXPECT_NEAR(p.back(), 1.6e5, 5e3);
  EXPECT_NEAR(p[4], 1e5 + 1e5 * std::exp(-2.0 * 0.1), 1.0);  // wide open far above
}

TEST(LearnedEffects, AMemoryActsOnlyBelowTheHighestPressure) {
  GroupRig group = Cycled();
  const std::vector<double> without = Pressures(group);
  group.effects = {Learned("learned_volume", "memory_3", {0.1, 0.15, 0.1})};
  const std::vector<double> with = Pressures(group);
  const auto at = [](double t_s) { return static_cast<std::size_t>(t_s * 40.0); };
  for (std::size_t k = 0; k <= at(1.5); ++k) EXPECT_NEAR(with[k], without[k], 0.05) << k;
  EXPECT_GT(std::abs(with[at(2.2)] - without[at(2.2)]), 300.0);
  EXPECT_LT(with[at(3.4)], without[at(3.4)] - 300.0);  // softer: the second rise is slower
  const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(4.5, 40.0));
  EXPECT_NEAR(r.groups[0].gas_final_m3 - r.groups[0].gas_start_m3,
              r.groups[0].air_in_m3 - r.groups[0].air_out_m3, 1e-9);
}

// Both volumes together hold what one held, at one pressure.
TEST(LearnedEffects, AStoreComesToThePressureThatTheGasGives) {
  GroupRig group = OneActuator(2e5, 1.0, kLine);
  group.schedule = {{0.0, kInflate}, {0.2, kHold}};
  group.effects = {Learned("learned_leak", "store", {20e-6, 0.005e-8, 0.4})};
  const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(60.0, 10.0));
  const double admitted_pa = 1e5 * r.groups[0].air_in_m3 / 50e-6;
  EXPECT_NEAR(r.groups[0].final_pressure_pa, 1e5 + admitted_pa * 50.0 / 70.0, 1.0);
  EXPECT_GT(r.groups[0].pressure_pa[2], r.groups[0].final_pressure_pa + 1e3);
  EXPECT_NEAR(r.groups[0].gas_final_m3 - r.groups[0].gas_start_m3, r.groups[0].air_in_m3, 1e-11);
}

TEST(LearnedEffects, SensorTermsAddToTheReading) {
  const std::vector<double> plain = Pressures(Cycled());
  GroupRig shifted = Cycled();
  shifted.effects = {Learned("learned_sensor", "pressure_3", {0.01, 0.03, 0.01})};
  const std::vector<double> reading = Pressures(shifted);
  GroupRig drifting = Cycled();
  drifting.effects = {Learned("learned_sensor", "drift", {500.0, 0.8, -30.0})};
  const std::vector<double> drifted = Pressures(drifting);
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const double x = std::min((plain[k] - 1e5) / 1e5, kLearnedEnd),
                 t_s = static_cast<double>(k) / 40.0;
    const double shift = x < 0.6 ? 0.01 + 0.02 * x / 0.6 : 0.03 - 0.02 * (x - 0.6) / 0.6;
    EXPECT_NEAR(reading[k] - plain[k], 1e5 * shift, 0.05) << k;
    EXPECT_NEAR(drifted[k] - plain[k], 500.0 * (1.0 - std::exp(-t_s / 0.8)) - 30.0 * t_s, 0.05);
  }
}

TEST(LearnedEffects, ASwingingSensorAddsASine) {
  const std::vector<double> plain = Pressures(Cycled());
  GroupRig swinging = Cycled();
  swinging.effects = {Learned("learned_sensor", "swing", {500.0, 0.7, 0.3})};
  const std::vector<double> reading = Pressures(swinging);
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const double t_s = static_cast<double>(k) / 40.0;
    EXPECT_NEAR(reading[k] - plain[k], 500.0 * std::sin(2.0 * std::numbers::pi * 0.7 * t_s + 0.3),
                0.05);
  }
}

// The same as a source whose recorded course is that sine, behind a regulator's place or not.
TEST(LearnedEffects, ASwingingSupplyIsASourceOfThatCourse) {
  const double amplitude = 0.06, frequency_hz = 1.7, phase_rad = 0.4;
  DrivenSource course;
  for (int k = 0; k <= 9000; ++k) {
    const double t_s = 5e-4 * k;
    course.time_s.push_back(t_s);
    course.pressure_pa.push_back(
        3e5 *
        (1.0 + amplitude * std::sin(2.0 * std::numbers::pi * frequency_hz * t_s + phase_rad)));
  }
  const Response recorded = Simulate(RigOf(course, {Cycled()}), Until(4.5, 40.0));
  ASSERT_EQ(recorded.status, SimulateStatus::kDone) << recorded.detail;
  GroupRig group = Cycled();
  group.effects = {Learned("learned_supply", "swing", {amplitude, frequency_hz, phase_rad})};
  ExpectNear(Pressures(group), recorded.groups[0].pressure_pa, 2.0);
}

TEST(LearnedEffects, ASwingingReservoirSwingsAboutItsPressure) {
  ReservoirSource reservoir;
  reservoir.volume_m3 = 1e3;  // so large that it stays where it is
  reservoir.initial_pressure_pa = 3e5;
  GroupRig group = Cycled();
  group.effects = {Learned("learned_supply", "swing", {0.05, 1.1, 0.2})};
  const Response r = Simulate(RigOf(reservoir, {group}), Until(4.5, 40.0));
  ASSERT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  ExpectNear(r.groups[0].pressure_pa, Pressures(group), 2.0);
}

TEST(LearnedEffects, StrokesOfUnknownTimeComeLateByTheMean) {
  GroupRig late = Cycled(), delayed = Cycled();
  late.effects = {Learned("learned_valve", "late", {0.05})};
  delayed.effects = {Learned("valve_delay", "", {0.05})};
  ExpectNear(Pressures(late), Pressures(delayed), 1e-9);
}

}  // namespace learned_effects_test
}  // namespace plenum::model
