// Effects that cannot be simulated: refused by name, or ended with a status that says where and
// why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/model/effects/effects_rigs.h"

namespace plenum::model {
namespace effects_refusal_test {

using testing::HasSubstr;

double Middle(const ParameterSpec& spec) {
  return spec.low > 0.0 ? std::sqrt(spec.low * spec.high) : 0.5 * (spec.low + spec.high);
}

Effect Typical(const EffectSpec& spec) {
  Effect effect{&spec, {}};
  for (const ParameterSpec& parameter : spec.parameters) {
    effect.parameters.push_back(Middle(parameter));
  }
  return effect;
}

TEST(EffectRefusal, NamesTheParameterAndItsRange) {
  for (const EffectSpec* spec : Effects()) {
    ASSERT_EQ(WhyInvalid(std::vector{Typical(*spec)}), "");
    for (std::size_t j = 0; j < spec->parameters.size(); ++j) {
      const ParameterSpec& parameter = spec->parameters[j];
      SCOPED_TRACE(std::string(spec->id) + "." + std::string(parameter.name));
      const double width = parameter.high - parameter.low;
      for (double bad : {parameter.low - 1e-3 * width, parameter.high + 1e-3 * width, std::nan(""),
                         std::numeric_limits<double>::infinity()}) {
        Effect effect = Typical(*spec);
        effect.parameters[j] = bad;
        const Response response = Simulate(BenchWith({effect}), Until(1.0));
        EXPECT_EQ(response.status, SimulateStatus::kInvalid);
        EXPECT_THAT(response.detail, HasSubstr("groups[0]"));
        EXPECT_THAT(response.detail, HasSubstr(std::string(spec->id)));
        EXPECT_THAT(response.detail, HasSubstr(std::string(parameter.name)));
        EXPECT_THAT(response.detail, HasSubstr("must be in ["));
      }
    }
  }
}

TEST(EffectRefusal, OfTwiceTheSameOrTheWrongNumberOfParameters) {
  const auto detail = [](std::vector<Effect> effects) {
    return Simulate(BenchWith(std::move(effects)), Until(1.0)).detail;
  };
  EXPECT_THAT(detail({MakeEffect("leak", {1e-12, 0.3}), MakeEffect("leak", {1e-12}, "laminar")}),
              HasSubstr("twice"));
  EXPECT_THAT(detail({MakeEffect("creep", {0.1})}), HasSubstr("takes 2 parameters, not 1"));
  EXPECT_THAT(detail({Effect{}}), HasSubstr("no spec"));
}

// A line holds at most eight elements, the restriction included.
TEST(EffectRefusal, OfARestrictionBehindAFullLine) {
  Rig rig = BenchWith({MakeEffect("exhaust_restriction", {test::kUnitC, 0.3})});
  GroupRig& group = rig.groups[0];
  group.exhaust.resize(8, group.exhaust.front());
  EXPECT_EQ(Simulate(rig, Until(1.0)).status, SimulateStatus::kInvalid);
  EXPECT_THAT(Simulate(rig, Until(1.0)).detail, HasSubstr("at most 7 with exhaust_restriction"));
  group.exhaust.pop_back();
  EXPECT_EQ(Simulate(rig, Until(1.0)).status, SimulateStatus::kDone);
}

void ExpectFinite(const Response& response) {
  for (const GroupResponse& group : response.groups) {
    for (const std::vector<double>* numbers :
         {&group.pressure_pa, &group.reading_pa, &group.volume_m3, &group.temperature_k}) {
      for (double number : *numbers) ASSERT_TRUE(std::isfinite(number));
    }
    for (double number :
         {group.final_pressure_pa, group.air_drawn_m3, group.air_in_m3, group.air_out_m3,
          group.air_leaked_m3, group.gas_start_m3, group.gas_final_m3, group.energy_start_j,
          group.energy_final_j, group.enthalpy_in_j, group.enthalpy_out_j, group.wall_heat_j,
          group.work_j}) {
      EXPECT_TRUE(std::isfinite(number));
    }
  }
}

void ExpectEndsWithReason(const Rig& rig) {
  for (Integrator integrator : {Integrator::kAutomatic, Integrator::kCvode}) {
    SimulateOptions options = Until(8.0, 200);
    options.integrator = integrator;
    options.steps_max = 200'000;
    const Response response = Simulate(rig, options);
    EXPECT_EQ(response.status, SimulateStatus::kNotFinite) << response.detail;
    EXPECT_THAT(response.detail, HasSubstr("at t = "));
    EXPECT_THAT(response.detail, HasSubstr("volume"));
    EXPECT_LT(response.t_s.size(), 1601u);
    ExpectFinite(response);
  }
}

// V + p·V' of V0·[1 + 5·(x + …)] turns negative on the way to x = 1, or is so at the start.
TEST(EffectRefusal, OfAVolumeLawThatFallsTooSteeply) {
  for (double curvature : {-1.0, 1.0}) {
    SCOPED_TRACE(curvature);
    Rig rig = BenchWith({MakeEffect("nonlinear_compliance", {curvature, -1.0})});
    rig.groups[0].chamber.expansion_ratio = 6.0;
    rig.groups[0].schedule = {{0.0, ValveState::kInflate}};
    ExpectEndsWithReason(rig);
  }
}

// A wall without damping, soft and pushed hard by the vented gas, swings through zero volume.
TEST(EffectRefusal, OfAWallThatSwingsThroughZero) {
  Rig rig = BenchWith({MakeEffect("inertia", {3.0, 0.0})});
  GroupRig& group = rig.groups[0];
  group.chamber.expansion_ratio = 8.0;
  group.initial_pressure_pa = 2.5e5;
  group.fill = group.exhaust = {
      {.sonic_conductance_m3_per_s_pa = 2.0 * test::kUnitC, .critical_ratio = 0.3}};
  group.schedule = {{0.0, ValveState::kDeflate}};
  ExpectEndsWithReason(rig);
}

}  // namespace effects_refusal_test
}  // namespace plenum::model
