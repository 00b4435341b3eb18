// The simulator with random subsets of effects against the independent one of effect_form.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>

#include "tests/model/effects/effects_rigs.h"

namespace plenum::model {
namespace effects_compare_test {

using test::EffectResult;
using test::EffectRig;

#ifdef PLENUM_SANITIZED
constexpr int kDraws = 4;
#else
constexpr int kDraws = 30;
#endif
constexpr double kEndS = 1.2;

std::string Describe(const EffectRig& rig) {
  std::string text = rig.blocked ? "blocked" : "free";
  text += rig.source == EffectRig::Source::kNone        ? ", no source"
          : rig.source == EffectRig::Source::kReservoir ? ", reservoir"
                                                        : ", regulated";
  for (const Effect& effect : EffectsOf(rig)) {
    text += ", " + std::string(effect.spec->id) + " " + std::string(effect.spec->law);
    for (double parameter : effect.parameters) text += " " + std::to_string(parameter);
  }
  return text;
}

// All samples within `relative` of the ambient pressure, rest volume and ambient temperature.
void ExpectSame(const EffectRig& rig, Integrator integrator, double relative) {
  SCOPED_TRACE(Describe(rig));
  SimulateOptions options = Until(kEndS, 100);
  options.relative_tolerance = 1e-10;
  options.integrator = integrator;
  const Response mine = Simulate(ModelRig(rig), options);
  ASSERT_EQ(mine.status, SimulateStatus::kDone) << mine.detail;
  const EffectResult other = test::SimulateEffects(rig, mine.t_s, rig.line ? 1e-4 : 2e-4);
  const GroupResponse& group = mine.groups[0];
  ASSERT_EQ(!rig.heat_time_constant_s, group.temperature_k.empty());
  for (std::size_t i = 0; i < mine.t_s.size(); ++i) {
    SCOPED_TRACE(mine.t_s[i]);
    ASSERT_NEAR(group.pressure_pa[i], other.pressure_pa[i], relative * rig.ambient_pa);
    ASSERT_NEAR(Reading(mine)[i], other.measured_pa[i], relative * rig.ambient_pa);
    ASSERT_NEAR(group.volume_m3[i] + rig.dead_volume_m3, other.volume_m3[i],
                relative * rig.rest_volume_m3);
    if (!group.temperature_k.empty()) {
      ASSERT_NEAR(group.temperature_k[i], other.temperature_k[i], relative * rig.ambient_k);
    }
    if (!mine.source_pressure_pa.empty()) {
      ASSERT_NEAR(mine.source_pressure_pa[i], other.supply_pa[i], relative * rig.ambient_pa);
    }
  }
  const double per_kg = 1.0 / test::kReferenceDensity;
  const double content_m3 = group.gas_start_m3;
  EXPECT_NEAR(group.air_drawn_m3, other.source_kg * per_kg, relative * content_m3);
  EXPECT_NEAR(group.air_out_m3, other.exhaust_kg * per_kg, relative * content_m3);
  EXPECT_NEAR(group.air_leaked_m3, other.leak_kg * per_kg, relative * content_m3);
}

// Other schedules, sources and starts: commands shorter than the valve's delay and ramp, pressures
// below ambient and above operating, no source.
void Vary(std::mt19937& generator, EffectRig& rig) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  if (uniform(0.0, 1.0) < 0.2) {
    rig.source = EffectRig::Source::kNone;
    rig.supply_droop.reset();
  }
  const int highest = rig.source == EffectRig::Source::kNone ? 0 : 1;
  rig.schedule.clear();
  for (double t_s = 0.0; t_s < kEndS; t_s += uniform(0.01, 0.3)) {
    const int direction = std::uniform_int_distribution<int>(-1, highest)(generator);
    rig.schedule.push_back({t_s, direction});
  }
  const double start = uniform(0.0, 1.0);
  if (start < 0.2) rig.initial_pa = rig.ambient_pa - uniform(0.0, 0.3e5);
  if (start > 0.8) rig.initial_pa = rig.operating_pa * uniform(0.9, 1.2);
  if (uniform(0.0, 1.0) < 0.3) rig.valve_delay_s = uniform(0.05, 0.4);
}

TEST(EffectsCompare, AnySubsetAgreesWithTheIndependentSimulator) {
  test::RandomEffectRigs rigs(8);
  for (int draw = 0; draw < kDraws; ++draw) {
    SCOPED_TRACE(draw);
    ExpectSame(rigs.Draw(), Integrator::kDormandPrince, 1e-6);
  }
}

TEST(EffectsCompare, AnyScheduleAgreesWithTheIndependentSimulator) {
  test::RandomEffectRigs rigs(12);
  std::mt19937 generator(1012);
  for (int draw = 0; draw < kDraws; ++draw) {
    SCOPED_TRACE(draw);
    EffectRig rig = rigs.Draw();
    Vary(generator, rig);
    ExpectSame(rig, draw % 3 == 0 ? Integrator::kCvode : Integrator::kDormandPrince, 1e-6);
  }
}

// At rest on the edge of the play when a ramp begins: the pressure's rate there is zero.
TEST(EffectsCompare, APlayAtItsEdgeIsPushedOnByARamp) {
  EffectRig rig = test::Bench();
  rig.schedule = {{0.0, 1}, {0.3, 0}, {0.5, 1}, {0.7, 0}, {0.8, -1}, {1.0, 0}, {1.05, -1}};
  rig.hysteresis_half_width_pa = 3e3;
  rig.valve_ramp_s = 0.05;
  ExpectSame(rig, Integrator::kDormandPrince, 1e-6);
  ExpectSame(rig, Integrator::kCvode, 1e-6);
}

}  // namespace effects_compare_test
}  // namespace plenum::model
