// The independent simulator of effects: what is left when an effect vanishes.
#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/model/effects/effect_rigs.h"
#include "tests/support/effects/effect_form.h"
#include "tests/support/mass_form.h"

namespace plenum::test {
namespace effect_form_limits_test {

struct Limit {
  std::string effect;
  std::function<void(EffectRig&, double)> set;  // at a size from 1 to 0
  bool when_blocked = true;
};

void PrintTo(const Limit& limit, std::ostream* out) { *out << limit.effect; }

const std::vector<Limit> kLimits{
    {"leak",
     [](EffectRig& r, double s) {
       r.leak = OrificeLeak{s * 1e-4 * kUnitC, 0.3};
     }},
    {"laminar leak", [](EffectRig& r, double s) { r.leak = LaminarLeak{s * 1e-4 * kUnitC}; }},
    {"porous leak",
     [](EffectRig& r, double s) {
       r.leak = PorousLeak{1e17 / s, 1e24 / (s * s)};
     }},
    {"inertia",
     [](EffectRig& r, double s) {
       r.inertia = {60.0 / s, 0.7};
     },
     false},
    {"creep",
     [](EffectRig& r, double s) {
       r.creep = {0.01 * s, 0.2};
     },
     false},
    {"slow creep",
     [](EffectRig& r, double s) {
       r.creep = {0.2, 500.0 / s};
     },
     false},
    {"hysteresis", [](EffectRig& r, double s) { r.hysteresis_half_width_pa = s * 500.0; }, false},
    {"heat", [](EffectRig& r, double s) { r.heat_time_constant_s = s * 0.1; }},
    {"delay", [](EffectRig& r, double s) { r.valve_delay_s = s * 5e-3; }},
    {"ramp", [](EffectRig& r, double s) { r.valve_ramp_s = s * 5e-3; }},
    {"dead volume", [](EffectRig& r, double s) { r.dead_volume_m3 = s * 1e-6; }},
    {"droop",
     [](EffectRig& r, double s) {
       r.supply_droop = {1e-2 / s, 2.0 * kUnitC / s, 0.3};
     }},
    {"restriction",
     [](EffectRig& r, double s) {
       r.exhaust_restriction = {kUnitC / s, 0.3};
     }},
    {"compliance",
     [](EffectRig& r, double s) {
       r.compliance = {s * 0.02, s * 0.02};
     },
     false},
    {"sensor lag", [](EffectRig& r, double s) { r.sensor_lag_s = s * 5e-3; }},
    {"sensor gain", [](EffectRig& r, double s) { r.sensor_gain = 1.0 + s * 0.01; }},
    {"sensor offset", [](EffectRig& r, double s) { r.sensor_offset_pa = s * 500.0; }},
    {"cracking", [](EffectRig& r, double s) { r.cracking_pa = s * 500.0; }},
    {"direction", [](EffectRig& r, double s) { r.fill_factor = 1.0 + s * 0.01; }},
};

class VanishingEffect : public ::testing::TestWithParam<Limit> {};

// What an effect does goes to nothing with its size, about in proportion or faster.
TEST_P(VanishingEffect, LeavesTheBase) {
  const std::vector<double> times = Every(0.05, 8.0);
  for (const bool blocked : {false, true}) {
    SCOPED_TRACE(blocked);
    EffectRig rig = Bench();
    rig.blocked = blocked;
    const std::vector<double> base = SimulateEffects(rig, times, 2e-4).measured_pa;
    const auto deviation_pa = [&](double size) {
      EffectRig with = rig;
      GetParam().set(with, size);
      return LargestDifference(SimulateEffects(with, times, 2e-4).measured_pa, base);
    };
    if (blocked && !GetParam().when_blocked) {
      EXPECT_EQ(deviation_pa(1.0), 0.0);
      continue;
    }
    const double whole_pa = deviation_pa(1.0);
    EXPECT_GT(whole_pa, 30.0);
    EXPECT_LT(deviation_pa(1.0 / 64.0), whole_pa / 45.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, VanishingEffect, ::testing::ValuesIn(kLimits));

// A short tube is nothing but its volume.
TEST(EffectForm, ShortTubeIsDeadVolume) {
  const std::vector<double> times = Every(0.05, 8.0);
  const LineDynamics tube{4e-3, 0.02};
  const EffectResult dead = SimulateEffects(
      Bench([&](EffectRig& r) { r.dead_volume_m3 = BoreVolume(tube); }), times, 5e-5);
  const EffectResult line =
      SimulateEffects(Bench([&](EffectRig& r) { r.line = tube; }), times, 5e-5);
  const EffectResult base = SimulateEffects(Bench(), times, 5e-5);
  EXPECT_LT(LargestDifference(line.pressure_pa, dead.pressure_pa), 5.0);
  EXPECT_GT(LargestDifference(base.pressure_pa, dead.pressure_pa), 100.0);
}

// Without effects: the simulator of whole rigs, out of a reservoir through two elements.
TEST(EffectForm, WithoutEffectsAgreesWithTheMassForm) {
  EffectRig rig = Bench();
  rig.ambient_k = 300.0;
  rig.fill = {{0.08 * kUnitC, 0.35}, {0.1 * kUnitC, 0.2}};
  rig.exhaust = {{0.1 * kUnitC, 0.2}, {0.08 * kUnitC, 0.35}};
  rig.source = EffectRig::Source::kReservoir;
  rig.reservoir_m3 = 300e-6;
  MassRig mass;
  mass.temperature_k = 300.0;
  mass.source = MassRig::Source::kReservoir;
  mass.source_pa = 3e5;
  mass.reservoir_m3 = 300e-6;
  MassGroup group;
  group.volume_m3 = [](double p) { return 50e-6 * p / 1e5; };
  group.operating_pa = 2e5;
  group.fill = rig.fill;
  group.exhaust = rig.exhaust;
  group.schedule = rig.schedule;
  mass.groups = {group};
  const EffectResult r = SimulateEffects(rig, Every(0.05, 8.0), 5e-4);
  const MassResult m = SimulateMasses(mass, 8.0, 5e-4, 0.05);
  EXPECT_LT(LargestDifference(r.pressure_pa, m.pressure_pa[0]), 0.01);
  EXPECT_LT(LargestDifference(r.supply_pa, m.source_pa), 0.01);
}

}  // namespace effect_form_limits_test
}  // namespace plenum::test
