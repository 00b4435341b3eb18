// Strokes that pumps fill themselves: against the oracle of the physics page, against masses by the
// laws alone, against the simulator, and by how they move with their parts.
#include "model/strokes/pump_stroke.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/simulate/simulate.h"
#include "model/strokes/reservoir_stroke.h"
#include "tests/support/pumps/pump_filling.h"
#include "tests/support/random.h"

namespace plenum::model {
namespace pump_stroke_test {

constexpr double kAmbientPa = 1e5;

// A pump, lines and chambers. PumpStrokeInput points into it.
struct Direct {
  std::vector<FlowElement> elements;
  Chamber chamber;
  CompressorCurve curve;
  int count = 1, pumps = 1;
  double temperature_k = kReferenceTemperatureK;
  Series series;

  void Finish() {
    series = MakeSeries(elements, std::sqrt(kReferenceTemperatureK / temperature_k));
  }
  PumpStrokeInput Input(double target_share = 0.95) const {
    PumpStrokeInput input;
    input.fill = &series;
    input.chamber = &chamber;
    input.count = count;
    input.compressor = &curve;
    input.compressors = pumps;
    input.from_pa = kAmbientPa;
    input.operating_pa = chamber.operating_pressure_pa;
    input.target_pa = kAmbientPa + target_share * (input.operating_pa - kAmbientPa);
    input.temperature_k = temperature_k;
    return input;
  }
  test::PumpFilling ByLaws(double close_pa) const {
    test::PumpFilling filling;
    filling.delivery_m3_per_s = [this](double p) { return pumps * FreeAirDelivery(curve, p); };
    filling.power_w = [this](double p) { return pumps * ElectricalPower(curve, p); };
    filling.highest_pa = HighestPressure(curve) * (1.0 - 1e-12);
    filling.temperature_k = temperature_k;
    test::PumpFilling::Group group;
    group.count = count;
    group.volume_m3 = [this](double p) {
      const double x = (p - kAmbientPa) / (chamber.operating_pressure_pa - kAmbientPa);
      return chamber.rest_volume_m3 * (1.0 + (chamber.expansion_ratio - 1.0) * x) +
             chamber.dead_volume_m3;
    };
    for (const FlowElement& element : elements)
      group.fill.push_back({element.sonic_conductance_m3_per_s_pa, element.critical_ratio});
    group.close_pa = close_pa;
    filling.groups = {group};
    return filling;
  }
};

// physics, 2.15.
Direct OfThePhysicsPage() {
  Direct direct;
  direct.elements = {{5e-10, 0.3}};
  direct.chamber.rest_volume_m3 = 50e-6;
  direct.chamber.expansion_ratio = 2.0;
  direct.chamber.operating_pressure_pa = kAmbientPa + 60e3;
  direct.curve.free_air_m3_per_s = MonotoneCurve({1e5, 2e5}, {1e-4, 0.0});
  direct.curve.current_a = MonotoneCurve({1e5, 2e5}, {1.0, 1.5});
  direct.curve.voltage_v = 12.0;
  direct.curve.pressure_max_pa = 2e5;
  direct.Finish();
  return direct;
}

Direct Drawn(std::uint64_t seed) {
  test::Random random(seed);
  Direct direct;
  for (int i = random.Integer(1, 4); i > 0; --i)
    direct.elements.push_back({random.LogUniform(2e-10, 4e-9), random.Uniform(0.1, 0.5)});
  direct.chamber.rest_volume_m3 = random.LogUniform(8e-6, 80e-6);
  direct.chamber.expansion_ratio = random.Uniform(1.0, 2.5);
  direct.chamber.dead_volume_m3 = random.Uniform(0.0, 5e-6);
  direct.chamber.operating_pressure_pa = kAmbientPa + random.Uniform(20e3, 90e3);
  direct.count = random.Integer(1, 4);
  direct.pumps = random.Integer(1, 3);
  direct.temperature_k = random.Uniform(280.0, 303.0);
  const double most = random.LogUniform(2e-5, 4e-4), highest = random.Uniform(1.0e5, 3e5);
  direct.curve.free_air_m3_per_s =
      MonotoneCurve({1e5, 1e5 + 0.3 * highest, 1e5 + highest},
                    {most, most * random.Uniform(0.4, 0.9), most * random.Uniform(0.0, 0.3)});
  direct.curve.current_a = MonotoneCurve({1e5, 1e5 + highest}, {1.0, random.Uniform(0.8, 2.0)});
  direct.curve.voltage_v = 12.0;
  direct.curve.pressure_max_pa = 1e5 + highest;
  direct.Finish();
  return direct;
}

TEST(PumpStroke, TheOracleOfThePhysicsPage) {
  const Direct direct = OfThePhysicsPage();
  const PumpStroke stroke = FillFromPumps(direct.Input());
  ASSERT_TRUE(stroke.reached);
  EXPECT_NEAR(stroke.rise_s, 2.296567, 1e-6);
}

// With the lines' volume as that of a reservoir the two models are neighbours.
TEST(PumpStroke, AReservoirThatShrinksToNothing) {
  const Direct direct = OfThePhysicsPage();
  const double direct_s = FillFromPumps(direct.Input()).rise_s;
  ReservoirSource source;
  source.initial_pressure_pa = kAmbientPa;
  source.compressor = direct.curve;
  GroupRig group;
  group.chamber = direct.chamber;
  group.fill = group.exhaust = direct.elements;
  const auto seconds = [&](double volume_m3) {
    source.volume_m3 = volume_m3;
    Rig rig;
    rig.source = source;
    rig.groups = {group};
    SimulateOptions options;
    options.linear_ratio = 1.0 - 1e-9;
    return FullStrokes(rig, options)[0].rise_time_s;
  };
  EXPECT_NEAR(seconds(5e-6), 2.328824, 2e-6);
  EXPECT_NEAR(seconds(1e-6), 2.302994, 2e-6);
  EXPECT_NEAR(seconds(1e-8), direct_s, 1e-4);
  EXPECT_LT(direct_s, seconds(1e-7));
}

TEST(PumpStroke, DrawnStrokesAgainstTheLaws) {
  int reached = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE(seed);
    const Direct direct = Drawn(seed);
    const PumpStrokeInput input = direct.Input();
    const PumpStroke stroke = FillFromPumps(input);
    if (!(FreeAirDelivery(direct.curve, input.operating_pa) > 0.0)) {
      EXPECT_FALSE(stroke.reached);
      continue;
    }
    ASSERT_TRUE(stroke.reached);
    const test::PumpFilled full = test::FillByMasses(direct.ByLaws(input.operating_pa), 60);
    EXPECT_NEAR(stroke.inflate_s, full.seconds[0], 1e-5 * full.seconds[0]);
    EXPECT_NEAR(stroke.pump_energy_j, full.energy_j, 1e-5 * full.energy_j);
    EXPECT_NEAR(stroke.node_end_pa, full.node_end_pa, 1e-6 * full.node_end_pa);
    const double rise_s = test::FillByMasses(direct.ByLaws(input.target_pa), 60).seconds[0];
    EXPECT_NEAR(stroke.rise_s, rise_s, 1e-5 * rise_s);
    ++reached;
  }
  EXPECT_GT(reached, 15);
}

// More of line or pump is faster; more of a line lowers what is in front of it, more of a pump
// raises it.
TEST(PumpStroke, MovesWithItsParts) {
  int compared = 0;
  for (std::uint64_t seed = 101; seed <= 140; ++seed) {
    SCOPED_TRACE(seed);
    const Direct direct = Drawn(seed);
    const PumpStroke stroke = FillFromPumps(direct.Input());
    if (!stroke.reached) continue;
    EXPECT_LE(stroke.rise_s, stroke.inflate_s);
    EXPECT_GE(stroke.node_end_pa, direct.chamber.operating_pressure_pa);
    Direct wider = direct;
    for (FlowElement& element : wider.elements) element.sonic_conductance_m3_per_s_pa *= 1.3;
    wider.Finish();
    const PumpStroke through_wider = FillFromPumps(wider.Input());
    EXPECT_LT(through_wider.rise_s, stroke.rise_s * (1.0 + 1e-7));
    EXPECT_LE(through_wider.node_end_pa, stroke.node_end_pa * (1.0 + 1e-9));
    Direct stronger = direct;
    ++stronger.pumps;
    const PumpStroke by_stronger = FillFromPumps(stronger.Input());
    EXPECT_LT(by_stronger.inflate_s, stroke.inflate_s * (1.0 + 1e-9));
    EXPECT_GE(by_stronger.node_end_pa, stroke.node_end_pa * (1.0 - 1e-9));
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST(PumpStroke, IsNotReachedWhereThePumpEnds) {
  Direct direct = OfThePhysicsPage();
  direct.chamber.operating_pressure_pa = 2.01e5;
  EXPECT_FALSE(FillFromPumps(direct.Input()).reached);
  direct.chamber.operating_pressure_pa = 2e5;  // delivers nothing there
  EXPECT_FALSE(FillFromPumps(direct.Input()).reached);
  direct.curve = {};
  EXPECT_FALSE(FillFromPumps(direct.Input()).reached);
}

}  // namespace pump_stroke_test
}  // namespace plenum::model
