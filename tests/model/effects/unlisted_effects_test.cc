// What the independent simulator does with sources that move and effects that no list has.
#include "tests/support/effects/unlisted_effects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "tests/model/effects/effect_rigs.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::test {
namespace unlisted_effects_test {

constexpr double kStep = 5e-4;

// Gas in chambers, tube and droop volume changes by what crosses the borders.
void ExpectMassKept(const EffectRig& rig) {
  const EffectResult r = SimulateEffects(rig, {7.0}, kStep);
  const double in = r.source_kg, out = r.exhaust_kg + r.leak_kg;
  EXPECT_GT(in, 0.0);
  EXPECT_NEAR(r.gas_kg - r.gas_start_kg, in - out, 1e-9 * in);
}

TEST(UnlistedEffects, KeepMass) {
  ExpectMassKept(Bench([](EffectRig& r) { r.unlisted.softening = {0.3}; }));
  ExpectMassKept(Bench([](EffectRig& r) { r.unlisted.kinking_line = {0.5}; }));
  ExpectMassKept(Bench([](EffectRig& r) { r.unlisted.second_chamber = {10e-6, 2e-12, 0.3}; }));
  ExpectMassKept(Bench([](EffectRig& r) { r.unlisted.gaping_seam = {1.5e5, 2e3, 1e-11, 0.3}; }));
  ExpectMassKept(Bench([](EffectRig& r) { r.unlisted.snap_through = {0.2, 0.5, 0.02}; }));
}

// The compressor's tale and the reservoir's: p·V rises by what was delivered less what was drawn.
TEST(UnlistedEffects, CompressorFillsTheReservoir) {
  EffectRig rig = Bench([](EffectRig& r) {
    r.source = EffectRig::Source::kReservoir;
    r.reservoir_m3 = 1e-3;
    r.delivery = {{1e5, 1e-4}, {3e5, 5e-5}, {5e5, 0.0}};
  });
  const EffectResult r = SimulateEffects(rig, {1.0, 7.0}, kStep);
  const double gained_kg =
      rig.reservoir_m3 * (r.supply_pa.back() - rig.source_pa) / (kGasConstant * rig.ambient_k);
  EXPECT_GT(r.delivered_kg, 0.0);
  EXPECT_NEAR(gained_kg, r.delivered_kg - r.source_kg, 1e-9 * r.delivered_kg);
  // Alone the reservoir follows dp/dt = P0/V·q(p), here a straight line to 0 at 5 bar above 3 bar.
  rig.schedule.clear();
  const double rate = 1e5 / rig.reservoir_m3 * 5e-5 / 2e5;
  const double alone_pa = SimulateEffects(rig, {7.0}, kStep).supply_pa.back();
  EXPECT_NEAR(alone_pa, 5e5 - 2e5 * std::exp(-7.0 * rate), 2e-5 * alone_pa);  // R·T0·ρ0 ≈ P0
}

TEST(UnlistedEffects, RegulatedSourceFollowsItsCourse) {
  const auto times = Every(0.01, 7.0);
  const EffectResult constant = SimulateEffects(Bench(), times, kStep);
  const EffectResult course = SimulateEffects(
      Bench([](EffectRig& r) { r.source_course = [](double) { return 3e5; }; }), times, kStep);
  EXPECT_EQ(constant.pressure_pa, course.pressure_pa);
  const EffectResult weaker = SimulateEffects(
      Bench([](EffectRig& r) { r.source_course = [](double t_s) { return 3e5 - 1e4 * t_s; }; }),
      times, kStep);
  EXPECT_LT(weaker.pressure_pa[100], constant.pressure_pa[100]);
}

// The first stroke is the base model's; the second, from below the highest pressure, is slower: the
// softened chamber is larger there.
TEST(UnlistedEffects, SofteningShowsFromTheSecondCycle) {
  const auto cycles = [](EffectRig& r) {
    r.schedule = {{0.0, 1}, {1.0, 0}, {1.2, -1}, {4.2, 1}, {5.2, 0}};
  };
  const auto times = Every(0.01, 5.5);
  const EffectResult base = SimulateEffects(Bench(cycles), times, kStep);
  const EffectResult soft = SimulateEffects(Bench([&](EffectRig& r) {
                                              cycles(r);
                                              r.unlisted.softening = {0.3};
                                            }),
                                            times, kStep);
  for (std::size_t i = 0; i <= 100; ++i) {
    EXPECT_NEAR(soft.pressure_pa[i], base.pressure_pa[i], 5.0) << times[i];
  }
  EXPECT_LT(soft.pressure_pa[470], base.pressure_pa[470] - 1e3);
  const double x = (soft.pressure_pa[470] - 1e5) / 1e5;
  const double highest = (soft.pressure_pa[100] - 1e5) / 1e5;
  EXPECT_NEAR(soft.volume_m3[470], 50e-6 * (1.0 + x * (1.0 + 0.3 * (1.0 - x / highest))), 1e-10);
}

TEST(UnlistedEffects, SecondChamberTakesItsShareInTheHold) {
  const EffectRig rig = Bench([](EffectRig& r) {
    r.unlisted.second_chamber = {20e-6, 1e-10, 0.3};
  });
  const EffectResult r = SimulateEffects(rig, {kCloseS, kCloseS + 4.9}, kStep);
  EXPECT_LT(r.pressure_pa[1], r.pressure_pa[0] - 3e3);
  // At the end both are at one pressure, and no gas was lost since the valve closed.
  const double all_kg = r.pressure_pa[1] * (r.volume_m3[1] + 20e-6) / (kGasConstant * 293.15);
  EXPECT_NEAR(all_kg, r.gas_kg, 1e-3 * r.gas_kg);
}

TEST(UnlistedEffects, SeamLeaksOnlyAboveItsPressure) {
  const EffectResult r = SimulateEffects(Bench([](EffectRig& rig) {
                                           rig.unlisted.gaping_seam = {1.7e5, 2e3, 3e-10, 0.3};
                                         }),
                                         {0.3, kCloseS, kCloseS + 2.0, kCloseS + 4.9}, kStep);
  const EffectResult tight =
      SimulateEffects(Bench(), {0.3, kCloseS, kCloseS + 2.0, kCloseS + 4.9}, kStep);
  ASSERT_LT(tight.pressure_pa[0], 1.7e5);
  EXPECT_NEAR(r.pressure_pa[0], tight.pressure_pa[0], 1e-3);
  EXPECT_LT(r.pressure_pa[2], r.pressure_pa[1] - 5e3);
  EXPECT_NEAR(r.pressure_pa[3], 1.7e5, 500.0);
}

TEST(UnlistedEffects, LawsAtTheirEnds) {
  EXPECT_DOUBLE_EQ(SnappedShare({0.3, 0.5, 0.02}, 0.0), 0.0);
  EXPECT_NEAR(SnappedShare({0.3, 0.5, 0.02}, 1.0), 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(KinkFactor({0.4}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(KinkFactor({0.4}, 1.0), 0.6);
  EXPECT_THROW(SimulateEffects(Bench([](EffectRig& r) {
                                 r.unlisted.softening = {0.1};
                                 r.heat_time_constant_s = 0.3;
                               }),
                               {1.0}, kStep),
               std::invalid_argument);
}

}  // namespace unlisted_effects_test
}  // namespace plenum::test
