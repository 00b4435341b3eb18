// Gas and energy that cross the borders of a simulated rig are those that it gains, with any
// effect.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "tests/model/effects/effects_rigs.h"

namespace plenum::model {
namespace effects_balance_test {

using test::kUnitC;

constexpr int kCycles = 100;

struct Case {
  std::string name;
  std::vector<Effect> effects;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case> Cases() {
  std::vector<Case> cases = {
      {"none", {}},
      {"leak_orifice", {MakeEffect("leak", {0.0005 * kUnitC, 0.3}, "orifice")}},
      {"leak_laminar", {MakeEffect("leak", {0.0005 * kUnitC}, "laminar")}},
      {"leak_porous", {MakeEffect("leak", {1e16, 1e23}, "porous")}},
      {"inertia", {MakeEffect("inertia", {40.0, 0.3})}},
      {"creep", {MakeEffect("creep", {0.15, 3.0})}},
      {"hysteresis", {MakeEffect("hysteresis", {4e3})}},
      {"valve_delay", {MakeEffect("valve_delay", {0.02})}},
      {"valve_ramp", {MakeEffect("valve_ramp", {0.1})}},
      {"dead_volume", {MakeEffect("dead_volume", {10e-6})}},
      {"supply_droop", {MakeEffect("supply_droop", {500e-6, 0.01 * kUnitC, 0.3})}},
      {"exhaust_restriction", {MakeEffect("exhaust_restriction", {0.075 * kUnitC, 0.3})}},
      {"nonlinear_compliance", {MakeEffect("nonlinear_compliance", {0.2, 0.2})}},
      {"sensor_lag", {MakeEffect("sensor_lag", {0.03})}},
      {"cracking_pressure", {MakeEffect("cracking_pressure", {5e3})}},
      {"directional_conductance", {MakeEffect("directional_conductance", {1.07})}},
      {"line_dynamics", {MakeEffect("line_dynamics", {0.5, 4e-3})}},
  };
  // The same with a wall of 1 s, so that energy is counted too.
  for (std::size_t i = 0, n = cases.size(); i < n; ++i) {
    Case heated = cases[i];
    heated.name += "_with_heat";
    heated.effects.push_back(MakeEffect("heat_transfer", {1.0}));
    cases.push_back(heated);
  }
  return cases;
}

class EffectBalance : public ::testing::TestWithParam<Case> {};

TEST_P(EffectBalance, ClosesOverManyCycles) {
#ifdef PLENUM_SANITIZED
  const int cycles = kCycles / 10;
#else
  const int cycles = kCycles;
#endif
  Rig rig = BenchWith(GetParam().effects);
  GroupRig& group = rig.groups[0];
  group.count = 3;
  group.schedule = CycleSchedule(0.5, 0.4, cycles);
  SimulateOptions options = Until(2.0 * cycles);
  options.relative_tolerance = 1e-10;
  options.absolute_tolerance_pa = 1e-6;
  const Response response = Simulate(rig, options);
  ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  const GroupResponse& g = response.groups[0];
  ASSERT_GT(g.air_drawn_m3, 1e-4 * cycles);  // at least what the droop's refill lets through
  EXPECT_NEAR(g.air_drawn_m3 - g.air_out_m3 - g.air_leaked_m3, g.gas_final_m3 - g.gas_start_m3,
              1e-8 * g.air_drawn_m3);
  if (GetParam().effects.empty() || GetParam().effects.back().spec->id != "heat_transfer") return;
  ASSERT_GT(g.enthalpy_in_j, 0.0);
  ASSERT_GT(std::abs(g.wall_heat_j), 0.0);
  EXPECT_NEAR(g.enthalpy_in_j - g.enthalpy_out_j + g.wall_heat_j - g.work_j,
              g.energy_final_j - g.energy_start_j, 1e-8 * g.enthalpy_in_j);
}

INSTANTIATE_TEST_SUITE_P(Effects, EffectBalance, ::testing::ValuesIn(Cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace effects_balance_test
}  // namespace plenum::model
