// Each effect alone: what is left when it vanishes, where it acts, and its extremes.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "tests/model/effects/effects_rigs.h"

namespace plenum::model {
namespace effects_limits_test {

using test::kCloseS;
using test::kUnitC;

Response Simulated(Rig rig) {
  SimulateOptions options = Until(8.0, 20);
  options.relative_tolerance = 1e-10;
  const Response response = Simulate(rig, options);
  EXPECT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  return response;
}

double Difference(const std::vector<Effect>& effects, bool blocked = false) {
  Rig with = BenchWith(effects), without = BenchWith({});
  with.groups[0].blocked = without.groups[0].blocked = blocked;
  return test::LargestDifference(Reading(Simulated(with)), Reading(Simulated(without)));
}

struct Limit {
  std::string name;
  std::function<Effect(double)> effect;  // at a size from 1 to 0
  bool acts_when_blocked = true;
};

void PrintTo(const Limit& limit, std::ostream* out) { *out << limit.name; }

std::vector<Limit> Limits() {
  const auto make = [](std::string_view id, auto parameters, std::string_view law = {}) {
    return [=](double s) { return MakeEffect(id, parameters(s), law); };
  };
  using V = std::vector<double>;
  return {
      {"leak_orifice", make(
                           "leak",
                           [](double s) {
                             return V{s * 1e-4 * kUnitC, 0.3};
                           },
                           "orifice")},
      {"leak_laminar", make(
                           "leak", [](double s) { return V{s * 1e-4 * kUnitC}; }, "laminar")},
      {"leak_porous", make(
                          "leak",
                          [](double s) {
                            return V{1e17 / s, 1e24 / s / s};
                          },
                          "porous")},
      {"inertia",
       make("inertia",
            [](double s) {
              return V{60.0 / s, 0.7};
            }),
       false},
      {"creep",
       make("creep",
            [](double s) {
              return V{0.01 * s, 0.2};
            }),
       false},
      {"slow_creep",
       make("creep",
            [](double s) {
              return V{0.2, 500.0 / s};
            }),
       false},
      {"hysteresis", make("hysteresis", [](double s) { return V{500.0 * s}; }), false},
      {"heat_transfer", make("heat_transfer", [](double s) { return V{0.1 * s}; })},
      {"valve_delay", make("valve_delay", [](double s) { return V{5e-3 * s}; })},
      {"valve_ramp", make("valve_ramp", [](double s) { return V{5e-3 * s}; })},
      {"dead_volume", make("dead_volume", [](double s) { return V{1e-6 * s}; })},
      {"supply_droop", make("supply_droop",
                            [](double s) {
                              return V{1e-2 / s, 2 * kUnitC / s, 0.3};
                            })},
      {"exhaust_restriction", make("exhaust_restriction",
                                   [](double s) {
                                     return V{kUnitC / s, 0.3};
                                   })},
      {"nonlinear_compliance",
       make("nonlinear_compliance",
            [](double s) {
              return V{0.02 * s, 0.02 * s};
            }),
       false},
      {"sensor_lag", make("sensor_lag", [](double s) { return V{5e-3 * s}; })},
      {"sensor_gain", make("sensor_gain", [](double s) { return V{1.0 + 0.01 * s}; })},
      {"sensor_offset", make("sensor_offset", [](double s) { return V{500.0 * s}; })},
      {"cracking_pressure", make("cracking_pressure", [](double s) { return V{500.0 * s}; })},
      {"directional_conductance",
       make("directional_conductance", [](double s) { return V{1.0 + 0.01 * s}; })},
  };
}

class EffectLimit : public ::testing::TestWithParam<Limit> {};

TEST_P(EffectLimit, LeavesTheBaseInProportionOrFaster) {
  const auto& [name, effect, acts_when_blocked] = GetParam();
  const double whole = Difference({effect(1.0)});
  EXPECT_GT(whole, 20.0);  // Pa
  EXPECT_LT(Difference({effect(0.1)}), 0.2 * whole);
  EXPECT_LT(Difference({effect(0.01)}), 0.02 * whole + 0.05);
}

TEST_P(EffectLimit, ActsOnABlockedActuatorUnlessItMovesTheWall) {
  const auto& [name, effect, acts_when_blocked] = GetParam();
  const double difference = Difference({effect(1.0)}, true);
  if (acts_when_blocked) {
    EXPECT_GT(difference, 20.0);
  } else {
    EXPECT_LT(difference, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, EffectLimit, ::testing::ValuesIn(Limits()),
                         [](const auto& test) { return test.param.name; });

// Rate of pressure just after opening, with heat against without: γ(V + pV')/(V + γpV').
TEST(EffectHeat, AdiabaticFillingIsFasterByThePublishedRatio) {
  const auto rate = [](double expansion_ratio, bool adiabatic) {
    Rig rig = BenchWith({});
    if (adiabatic) rig.groups[0].effects = {MakeEffect("heat_transfer", {kAdiabaticS})};
    rig.groups[0].chamber.expansion_ratio = expansion_ratio;
    rig.groups[0].initial_pressure_pa = 2e5;
    const std::vector<double> p = Simulate(rig, Until(1e-4, 1e4)).groups[0].pressure_pa;
    return p.back() - p.front();
  };
  EXPECT_NEAR(rate(1.0, true) / rate(1.0, false), 1.40, 0.005);
  EXPECT_NEAR(rate(2.0, true) / rate(2.0, false), 1.17, 0.005);
  EXPECT_NEAR(rate(3.0, true) / rate(3.0, false), 1.14, 0.01);
}

TEST(EffectHeat, StartsAtTheGivenTemperatureAndRelaxesToAmbient) {
  Rig rig = BenchWith({MakeEffect("heat_transfer", {0.2})});
  rig.groups[0].schedule.clear();
  rig.groups[0].initial_temperature_k = 330.0;
  const GroupResponse group = Simulated(rig).groups[0];
  EXPECT_NEAR(group.temperature_k.front(), 330.0, 1e-9);
  EXPECT_NEAR(group.temperature_k.back(), 293.15, 0.01);
  EXPECT_LT(group.pressure_pa.back(), group.pressure_pa.front());
}

// The way in alone: 7 % more conductance fills 1.07 times as fast.
TEST(EffectDirection, ScalesTheTimeOfFillingAlone) {
  SimulateOptions options = Until(10.0);
  const FullStroke base = FullStrokes(BenchWith({}), options)[0];
  const FullStroke with =
      FullStrokes(BenchWith({MakeEffect("directional_conductance", {1.07})}), options)[0];
  EXPECT_NEAR(base.rise_time_s / with.rise_time_s, 1.07, 1e-6);
  EXPECT_NEAR(with.fall_time_s, base.fall_time_s, 1e-9);
}

// Lag, then gain, then offset, in whatever order they are listed: at rest the gain does not scale
// the offset, and right after a step the lag holds the reading back.
TEST(EffectSensor, LagsThenScalesThenShifts) {
  const std::vector<Effect> listed = {MakeEffect("sensor_offset", {700.0}),
                                      MakeEffect("sensor_gain", {1.05}),
                                      MakeEffect("sensor_lag", {0.03})};
  const GroupResponse with = Simulated(BenchWith(listed)).groups[0];
  const GroupResponse lagged = Simulated(BenchWith({listed[2]})).groups[0];
  ASSERT_EQ(with.reading_pa.size(), lagged.reading_pa.size());
  for (std::size_t i = 0; i < with.reading_pa.size(); ++i) {
    EXPECT_NEAR(with.reading_pa[i], 1e5 + 1.05 * (lagged.reading_pa[i] - 1e5) + 700.0, 1e-3);
    EXPECT_NEAR(with.pressure_pa[i], lagged.pressure_pa[i], 1e-3);
  }
  EXPECT_NEAR(with.reading_pa.front(), 1e5 + 700.0, 1e-9);
}

TEST(EffectLine, AShortWideTubeIsItsVolume) {
  const double length_m = 0.02, bore_m = 5e-3;
  const double volume_m3 = std::numbers::pi / 4.0 * bore_m * bore_m * length_m;
  const auto tube = Simulated(BenchWith({MakeEffect("line_dynamics", {length_m, bore_m})}));
  const auto dead = Simulated(BenchWith({MakeEffect("dead_volume", {volume_m3})}));
  EXPECT_LT(test::LargestDifference(Reading(tube), Reading(dead)), 10.0);
  EXPECT_GT(test::LargestDifference(Reading(dead), Reading(Simulated(BenchWith({})))), 100.0);
}

// Below the cracking pressure nothing leaves.
TEST(EffectCracking, TrapsThePressureThatItNeeds) {
  Rig rig = BenchWith({MakeEffect("cracking_pressure", {5e3})});
  SimulateOptions options = Until(60.0);
  EXPECT_NEAR(Simulate(rig, options).groups[0].final_pressure_pa, 1.05e5, 1.0);
}

}  // namespace effects_limits_test
}  // namespace plenum::model
