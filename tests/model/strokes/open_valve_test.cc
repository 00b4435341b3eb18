// A valve that cannot hold: the stroke out of a reservoir goes on after the operating pressure,
// until its time is up. Against the simulator.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/simulate/simulate.h"
#include "model/strokes/reservoir_stroke.h"

namespace plenum::model {
namespace open_valve_test {

constexpr double kAmbientPa = 1e5;

struct Supply {
  Series line;
  FlowTable table;
  Chamber chamber;
  CompressorCurve curve;
  Rig rig;
  ReservoirStrokeInput input;
};

// A rig that is drawn, from pumps and reservoirs that never catch up to those that keep full.
void Draw(std::mt19937& random, Supply& supply) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto spread = [&](double low, double high) {
    return low * std::pow(high / low, uniform(0.0, 1.0));
  };
  Chamber& chamber = supply.chamber;
  chamber.rest_volume_m3 = uniform(20e-6, 100e-6);
  chamber.expansion_ratio = uniform(1.0, 3.0);
  chamber.operating_pressure_pa = kAmbientPa + uniform(0.4e5, 1.2e5);
  const double conductance = chamber.rest_volume_m3 / 1e5 * spread(0.5, 10.0);
  const std::vector<FlowElement> elements{{2.0 * conductance, 0.3}, {conductance, 0.2}};
  supply.line = MakeSeries(elements, 1.0);
  supply.table = FlowTable(supply.line);
  const double end_pa = chamber.operating_pressure_pa + uniform(0.2e5, 2e5);
  const double flow = conductance * end_pa * spread(0.03, 3.0);
  supply.curve.free_air_m3_per_s = MonotoneCurve({kAmbientPa, end_pa}, {flow, 0.2 * flow});
  supply.curve.current_a = MonotoneCurve({kAmbientPa, end_pa}, {1.0, 3.0});
  supply.curve.voltage_v = 12.0;
  supply.curve.pressure_max_pa = end_pa;

  ReservoirSource source;
  source.volume_m3 = chamber.rest_volume_m3 * spread(1.0, 30.0);
  source.initial_pressure_pa = source.stop_pressure_pa = end_pa - uniform(0.01e5, 0.15e5);
  source.compressor = supply.curve;
  GroupRig group;
  group.count = 2;
  group.chamber = chamber;
  group.fill = group.exhaust = elements;
  group.schedule = {{0.0, ValveState::kInflate}};
  supply.rig = {};
  supply.rig.source = source;
  supply.rig.groups = {group};

  supply.input = {};
  supply.input.fill = &supply.table;
  supply.input.chamber = &supply.chamber;
  supply.input.count = group.count;
  supply.input.compressor = &supply.curve;
  supply.input.stop_pa = source.stop_pressure_pa;
  supply.input.volume_falling_m3 = supply.input.volume_rising_m3 = source.volume_m3;
  supply.input.from_pa = kAmbientPa;
  supply.input.operating_pa = chamber.operating_pressure_pa;
  supply.input.target_pa = kAmbientPa + 0.95 * (supply.input.operating_pa - kAmbientPa);
}

TEST(OpenValve, FillsAsTheSimulatorDoesUntilItsTimeIsUp) {
  std::mt19937 random(77);
  int filling = 0, full = 0, closed = 0;
  for (int trial = 0; trial < 150; ++trial) {
    SCOPED_TRACE(trial);
    Supply supply;
    Draw(random, supply);
    const ReservoirStroke held = FillFromReservoir(supply.input);
    if (!held.reached) continue;
    for (const double times : {0.5, 1.02, 1.3, 2.0, 20.0}) {
      SCOPED_TRACE(times);
      supply.input.open_s = times * held.inflate_s;
      const ReservoirStroke open = FillFromReservoir(supply.input);
      ASSERT_TRUE(open.reached);
      EXPECT_DOUBLE_EQ(open.inflate_s, held.inflate_s);
      if (times < 1.0) {
        ++closed;
        EXPECT_EQ(open.chamber_end_pa, supply.chamber.operating_pressure_pa);
        EXPECT_EQ(open.pump_on_s, held.pump_on_s);
        continue;
      }
      SimulateOptions options;
      options.relative_tolerance = 1e-10;
      options.linear_ratio = 1.0 - 1e-7;
      options.end_s = supply.input.open_s;
      const Response response = Simulate(supply.rig, options);
      ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
      EXPECT_NEAR(open.chamber_end_pa, response.groups[0].final_pressure_pa,
                  1e-5 * supply.input.stop_pa);
      EXPECT_NEAR(open.reservoir_end_pa, response.source_final_pressure_pa,
                  1e-5 * supply.input.stop_pa);
      EXPECT_NEAR(open.pump_on_s, response.compressor_on_s, 2e-5 * response.compressor_on_s);
      EXPECT_NEAR(open.pump_energy_j, response.compressor_energy_j,
                  2e-5 * response.compressor_energy_j);
      EXPECT_LE(open.chamber_end_pa, supply.input.stop_pa);
      (open.chamber_end_pa < 0.999 * supply.input.stop_pa ? filling : full) += 1;
    }
  }
  EXPECT_GT(filling, 100);
  EXPECT_GT(full, 50);
  EXPECT_GT(closed, 100);
}

}  // namespace open_valve_test
}  // namespace plenum::model
