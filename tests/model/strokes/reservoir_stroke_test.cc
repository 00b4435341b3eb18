// One stroke out of a pumped reservoir against the simulator, against masses, and by hand.
#include "model/strokes/reservoir_stroke.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "model/simulate/simulate.h"
#include "model/strokes/stroke.h"
#include "tests/support/mass_form.h"

namespace plenum::model {
namespace reservoir_stroke_test {

constexpr double kAmbientPa = 1e5;

// A pump, a reservoir, a line and chambers. ReservoirStrokeInput points into it.
struct Pumped {
  std::vector<FlowElement> elements;
  Chamber chamber;
  CompressorCurve curve;
  int count = 1, pumps = 1;
  double stop_pa = 0.0, reservoir_m3 = 0.0, temperature_k = kReferenceTemperatureK;
  FlowTable table;

  Series Line() const {
    return MakeSeries(elements, std::sqrt(kReferenceTemperatureK / temperature_k));
  }
  ReservoirStrokeInput Input(double falling_m3, double rising_m3) const {
    ReservoirStrokeInput input;
    input.fill = &table;
    input.chamber = &chamber;
    input.count = count;
    input.compressor = &curve;
    input.compressors = pumps;
    input.stop_pa = stop_pa;
    input.volume_falling_m3 = falling_m3;
    input.volume_rising_m3 = rising_m3;
    input.from_pa = kAmbientPa;
    input.operating_pa = chamber.operating_pressure_pa;
    input.target_pa = kAmbientPa + 0.95 * (input.operating_pa - kAmbientPa);
    input.temperature_k = temperature_k;
    return input;
  }
  ReservoirStrokeInput Input() const { return Input(reservoir_m3, reservoir_m3); }
  Rig AsRig() const {
    Rig rig;
    rig.ambient.temperature_k = temperature_k;
    ReservoirSource source;
    source.volume_m3 = reservoir_m3;
    source.initial_pressure_pa = source.stop_pressure_pa = stop_pa;
    source.compressor = curve;
    source.compressor_count = pumps;
    rig.source = source;
    GroupRig group;
    group.count = count;
    group.chamber = chamber;
    group.fill = group.exhaust = elements;
    group.close_at_operating = true;
    group.schedule = {{0.0, ValveState::kInflate}};
    rig.groups = {group};
    return rig;
  }
};

class RandomPumped {
 public:
  explicit RandomPumped(unsigned seed) : generator_(seed) {}
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  double LogUniform(double low, double high) {
    return low * std::pow(high / low, Uniform(0.0, 1.0));
  }
  int Integer(int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(generator_);
  }
  // Pumps from far too weak to so strong that they cover the draw, reservoirs from one actuator to
  // thirty times all of them; the stop pressure is in the table, at its end or at the rating.
  Pumped Draw() {
    Pumped rig;
    rig.temperature_k = Uniform(275.0, 310.0);
    rig.count = Integer(1, 4);
    rig.pumps = Integer(1, 2);
    rig.chamber.rest_volume_m3 = Uniform(20e-6, 100e-6);
    rig.chamber.dead_volume_m3 = Uniform(0.0, 10e-6);
    rig.chamber.expansion_ratio = Uniform(1.0, 3.0);
    rig.chamber.operating_pressure_pa = kAmbientPa + Uniform(0.4e5, 1.5e5);
    const double conductance = rig.chamber.rest_volume_m3 / 1e5 * LogUniform(0.3, 10.0);
    rig.elements.resize(Integer(1, 5));
    for (FlowElement& element : rig.elements)
      element = {conductance * Uniform(1.0, 4.0), Uniform(0.0, 0.55)};
    rig.table = FlowTable(rig.Line());
    const double end_pa = rig.chamber.operating_pressure_pa + Uniform(0.3e5, 3e5);
    const double span = end_pa - kAmbientPa;
    const double flow = rig.count * conductance * end_pa * LogUniform(3e-3, 3.0) / rig.pumps;
    const double second = Uniform(0.7, 1.0), third = Uniform(0.3, second);
    const std::vector<double> pressure{kAmbientPa, kAmbientPa + 0.4 * span,
                                       kAmbientPa + 0.75 * span, end_pa};
    rig.curve.free_air_m3_per_s =
        MonotoneCurve(pressure, {flow, second * flow, third * flow, Uniform(0.05, third) * flow});
    rig.curve.current_a = MonotoneCurve(pressure, {2.0, 2.5, Uniform(2.0, 4.0), Uniform(2.0, 4.0)});
    rig.curve.voltage_v = 12.0;
    const int kind = Integer(0, 2);
    rig.stop_pa = kind == 0 ? end_pa - Uniform(0.0, 0.2e5) : end_pa;
    rig.curve.pressure_max_pa = kind == 1 ? end_pa : end_pa + 1e5;
    rig.reservoir_m3 = rig.count * rig.chamber.rest_volume_m3 * LogUniform(1.0, 30.0);
    return rig;
  }

 private:
  std::mt19937 generator_;
};

TEST(ReservoirStroke, AgreesWithTheSimulatorOnRandomRigs) {
  RandomPumped rigs(31);
  int reached = 0, refilled = 0, equal = 0, full = 0;
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(trial);
    const Pumped rig = rigs.Draw();
    const ReservoirStroke stroke = FillFromReservoir(rig.Input());
    SimulateOptions options;
    options.relative_tolerance = 1e-10;
    options.linear_ratio = 1.0 - 1e-7;
    const double refill_s = PumpUpTime(rig.curve, rig.pumps, rig.reservoir_m3,
                                       stroke.reservoir_end_pa, rig.stop_pa, rig.temperature_k);
    options.end_s = stroke.reached ? 1.01 * (stroke.inflate_s + refill_s) : 1e4;
    const Response whole = Simulate(rig.AsRig(), options);
    ASSERT_EQ(whole.status, SimulateStatus::kDone) << whole.detail;
    const Stroke& slow = whole.strokes[0];
    ASSERT_EQ(stroke.reached, std::isfinite(slow.to_operating_s));
    if (!stroke.reached) continue;
    options.end_s = slow.to_operating_s;
    const Response response = Simulate(rig.AsRig(), options);
    ++reached;
    full += stroke.reservoir_end_pa == rig.stop_pa;
    equal += stroke.reservoir_end_pa < rig.chamber.operating_pressure_pa * (1.0 + 1e-5);
    EXPECT_NEAR(stroke.rise_s, slow.to_target_s, 1e-5 * slow.to_target_s);
    EXPECT_NEAR(stroke.inflate_s, slow.to_operating_s, 1e-5 * slow.to_operating_s);
    EXPECT_NEAR(stroke.pump_on_s, response.compressor_on_s, 1e-5 * response.compressor_on_s);
    EXPECT_NEAR(stroke.pump_energy_j, response.compressor_energy_j,
                1e-5 * response.compressor_energy_j);
    EXPECT_NEAR(stroke.reservoir_end_pa, response.source_final_pressure_pa, 1e-5 * rig.stop_pa);
    // On to the full reservoir.
    EXPECT_EQ(whole.source_final_pressure_pa, rig.stop_pa);
    EXPECT_NEAR(stroke.pump_on_s + refill_s, whole.compressor_on_s, 1e-5 * whole.compressor_on_s);
    refilled += refill_s > 0.0;
  }
  EXPECT_GT(reached, 150);
  EXPECT_GT(refilled, 100);
  EXPECT_GT(equal, 3);
  EXPECT_GT(full, 3);
}

TEST(ReservoirStroke, AgreesWithTheMassesOnRandomRigs) {
  RandomPumped rigs(32);
  int compared = 0;
  for (int trial = 0; trial < 60 && compared < 12; ++trial) {
    SCOPED_TRACE(trial);
    const Pumped rig = rigs.Draw();
    const ReservoirStroke stroke = FillFromReservoir(rig.Input());
    // Where the pressures stay apart: fixed steps are no match for a stiff end.
    if (!stroke.reached || stroke.reservoir_end_pa < 1.02 * rig.chamber.operating_pressure_pa)
      continue;
    ++compared;
    test::MassRig mass;
    mass.temperature_k = rig.temperature_k;
    mass.linear_ratio = 0.99999;
    mass.source = test::MassRig::Source::kReservoir;
    mass.source_pa = mass.stop_pa = rig.stop_pa;
    mass.reservoir_m3 = rig.reservoir_m3;
    for (int i = 0; i <= 2000; ++i) {
      const double p = kAmbientPa + (rig.curve.free_air_m3_per_s.back() - kAmbientPa) * i / 2000.0;
      mass.delivery.emplace_back(p, rig.pumps * rig.curve.free_air_m3_per_s(p));
    }
    test::MassGroup group;
    group.count = rig.count;
    group.operating_pa = rig.chamber.operating_pressure_pa;
    const Chamber chamber = rig.chamber;
    group.volume_m3 = [chamber](double p) {
      const double x = (p - kAmbientPa) / (chamber.operating_pressure_pa - kAmbientPa);
      return chamber.rest_volume_m3 * (1.0 + (chamber.expansion_ratio - 1.0) * x) +
             chamber.dead_volume_m3;
    };
    for (const FlowElement& e : rig.elements)
      group.fill.push_back({e.sonic_conductance_m3_per_s_pa, e.critical_ratio, 0.5, 0.0});
    group.schedule = {{0.0, 1}};
    group.close_at_operating = true;
    mass.groups = {group};
    const double step_s = stroke.rise_s / 1000.0;
    const test::MassResult result =
        test::SimulateMasses(mass, stroke.rise_s, step_s, stroke.rise_s);
    EXPECT_NEAR(result.pressure_pa[0].back(), rig.Input().target_pa, 1e-5 * rig.stop_pa);
    const test::MassResult inflated =
        test::SimulateMasses(mass, stroke.inflate_s, step_s, stroke.inflate_s);
    EXPECT_NEAR(inflated.source_pa.back(), stroke.reservoir_end_pa, 1e-5 * rig.stop_pa);
  }
  EXPECT_EQ(compared, 12);
}

Pumped ByHand(double flow_m3_per_s, double reservoir_m3) {
  Pumped rig;
  rig.elements = {{2e-8, 0.3}, {1e-8, 0.2}};
  rig.table = FlowTable(rig.Line());
  rig.count = 3;
  rig.chamber.rest_volume_m3 = 50e-6;
  rig.chamber.expansion_ratio = 2.0;
  rig.chamber.operating_pressure_pa = 2e5;
  rig.curve.free_air_m3_per_s = MonotoneCurve({1e5, 4e5}, {flow_m3_per_s, flow_m3_per_s});
  rig.curve.current_a = MonotoneCurve({1e5, 4e5}, {5.0, 5.0});
  rig.curve.voltage_v = 12.0;
  rig.curve.pressure_max_pa = rig.stop_pa = 4e5;
  rig.reservoir_m3 = reservoir_m3;
  return rig;
}

// 30 mL at 4 bar into 150 mL: equal long before 2 bar, from where the pump fills all as one volume.
// Content p·V, in bar·L: needed 3·0.05·(2·2 − 1) + 0.03·2 = 0.51 with 0.03·4 = 0.12 there, so the
// pump brings 0.39 of standard air, at 10 mL/s.
TEST(ReservoirStroke, WhereTheReservoirFallsToTheChambersBothFillTogether) {
  const ReservoirStroke stroke = FillFromReservoir(ByHand(1e-5, 30e-6).Input());
  ASSERT_TRUE(stroke.reached);
  EXPECT_NEAR(stroke.inflate_s, 39.0, 39.0 * 2e-6);
  EXPECT_NEAR(stroke.reservoir_end_pa, 2e5, 0.5);
  EXPECT_NEAR(stroke.pump_on_s, stroke.inflate_s, 1e-9);
  EXPECT_NEAR(stroke.pump_energy_j, 60.0 * stroke.inflate_s, 1e-6);
  // To 1.95 bar: 3·0.05·(1.95² − 1) + 0.03·(1.95 − 4) = 0.358875.
  EXPECT_NEAR(stroke.rise_s, 35.8875, 35.9 * 2e-6);

  Pumped weak = ByHand(1e-5, 30e-6);
  weak.curve.free_air_m3_per_s = MonotoneCurve({1e5, 1.8e5, 4e5}, {1e-5, 0.0, 0.0});
  EXPECT_FALSE(FillFromReservoir(weak.Input()).reached);
}

TEST(ReservoirStroke, WithoutAVolumeNothingIsReached) {
  const Pumped rig = ByHand(1e-5, 30e-6);
  EXPECT_FALSE(FillFromReservoir(rig.Input(0.0, 0.0)).reached);
  EXPECT_FALSE(FillFromReservoir(rig.Input(0.0, 30e-6)).reached);
  EXPECT_FALSE(FillFromReservoir(rig.Input(30e-6, std::nan(""))).reached);
}

// A pump that delivers more than the choked line draws keeps the reservoir full: the stroke is that
// of a constant source, and the pump runs for the air drawn, 3·0.05·(2·2 − 1) = 0.45 L.
TEST(ReservoirStroke, AStrongPumpKeepsTheReservoirFull) {
  const Pumped rig = ByHand(2e-2, 1e-3);
  const ReservoirStroke stroke = FillFromReservoir(rig.Input());
  ASSERT_TRUE(stroke.reached);
  const auto fill_time = [&](double to_pa) {
    return FillTime(rig.Line(), rig.chamber, 4e5, kAmbientPa, to_pa);
  };
  EXPECT_NEAR(stroke.rise_s, fill_time(1.95e5), 1e-7 * stroke.rise_s);
  EXPECT_NEAR(stroke.inflate_s, fill_time(2e5), 1e-7 * stroke.inflate_s);
  EXPECT_EQ(stroke.reservoir_end_pa, 4e5);
  EXPECT_NEAR(stroke.pump_on_s, 0.45e-3 / 2e-2, 1e-7 * stroke.pump_on_s);
  EXPECT_NEAR(stroke.pump_energy_j, 60.0 * stroke.pump_on_s, 1e-9);
}

TEST(ReservoirStroke, AnIntervalOfVolumesBoundsEachVolumeInIt) {
  RandomPumped rigs(33);
  int compared = 0, strict = 0;
  for (int trial = 0; trial < 150; ++trial) {
    SCOPED_TRACE(trial);
    const Pumped rig = rigs.Draw();
    const double low_m3 = rig.reservoir_m3, high_m3 = low_m3 * rigs.LogUniform(1.01, 2.0);
    const ReservoirStroke bound = FillFromReservoir(rig.Input(high_m3, low_m3));
    for (int i = 0; i <= 6; ++i) {
      const double volume_m3 = low_m3 * std::pow(high_m3 / low_m3, i / 6.0);
      const ReservoirStroke stroke = FillFromReservoir(rig.Input(volume_m3, volume_m3));
      if (!stroke.reached) continue;
      ASSERT_TRUE(bound.reached);
      EXPECT_LE(bound.rise_s, stroke.rise_s * (1.0 + 1e-7));
      EXPECT_LE(bound.inflate_s, stroke.inflate_s * (1.0 + 1e-7));
      ++compared;
      strict += bound.inflate_s < stroke.inflate_s * (1.0 - 1e-4);
    }
  }
  EXPECT_GT(compared, 700);
  EXPECT_GT(strict, 300);
}

// A higher stop pressure and a stronger pump are never slower.
TEST(ReservoirStroke, MoreSupplyIsNeverSlower) {
  RandomPumped rigs(34);
  int compared = 0;
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    Pumped rig = rigs.Draw();
    rig.stop_pa -= 0.1e5;
    const ReservoirStroke base = FillFromReservoir(rig.Input());
    if (!base.reached) continue;
    ++compared;
    Pumped higher = rig;
    higher.stop_pa += 0.05e5;
    EXPECT_LE(FillFromReservoir(higher.Input()).inflate_s, base.inflate_s * (1.0 + 1e-7));
    Pumped stronger = rig;
    ++stronger.pumps;
    EXPECT_LE(FillFromReservoir(stronger.Input()).inflate_s, base.inflate_s * (1.0 + 1e-7));
  }
  EXPECT_GT(compared, 60);
}

// Running time and energy of a stroke and the refilling after it, the latter in small steps.
struct Cycle {
  double on_s = 0.0, energy_j = 0.0;
};
Cycle CycleOf(const Pumped& rig, double falling_m3, double rising_m3) {
  const ReservoirStroke stroke = FillFromReservoir(rig.Input(falling_m3, rising_m3));
  Cycle cycle{stroke.pump_on_s, stroke.pump_energy_j};
  constexpr int kSteps = 400;
  const double step_pa = (rig.stop_pa - stroke.reservoir_end_pa) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double p = stroke.reservoir_end_pa + (i + 0.5) * step_pa;
    const double seconds = rising_m3 * step_pa / 1e5 * (293.15 / rig.temperature_k) /
                           (rig.pumps * FreeAirDelivery(rig.curve, p));
    cycle.on_s += seconds;
    cycle.energy_j += seconds * rig.pumps * ElectricalPower(rig.curve, p);
  }
  return cycle;
}

// In the periodic state all that is pumped is drawn, so energy is ∫ (P/Q)(p_s) d(air drawn). The
// reservoir at each amount drawn is higher from a higher start: where P/Q rises so does the energy,
// and the running time always. An interval of volumes runs no longer than a volume in it. Its
// energy is no strict bound: it runs for a shorter time at higher pressures, and with a pump that
// fills the reservoir again within the stroke that may cost a little more.
TEST(ReservoirStroke, RunningTimeAndEnergyGrowWithTheStopPressure) {
  RandomPumped rigs(36);
  int compared = 0, power_falls = 0;
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(trial);
    Pumped rig = rigs.Draw();
    rig.stop_pa -= 0.1e5;
    if (!FillFromReservoir(rig.Input()).reached) continue;
    double per_air = 0.0, power_w = 0.0;
    bool rises = true, power_rises = true;
    for (int i = 0; i <= 200; ++i) {
      const double p = kAmbientPa + (rig.stop_pa + 0.05e5 - kAmbientPa) * i / 200.0;
      const double power_here_w = ElectricalPower(rig.curve, p);
      const double here = power_here_w / FreeAirDelivery(rig.curve, p);
      rises = rises && here >= per_air;
      power_rises = power_rises && power_here_w >= power_w;
      per_air = here;
      power_w = power_here_w;
    }
    const double volume_m3 = rig.reservoir_m3;
    const Cycle base = CycleOf(rig, volume_m3, volume_m3);
    Pumped higher = rig;
    higher.stop_pa += 0.05e5;
    const Cycle above = CycleOf(higher, volume_m3, volume_m3);
    EXPECT_GE(above.on_s, base.on_s * (1.0 - 1e-6));
    const Cycle bound = CycleOf(rig, 1.2 * volume_m3, volume_m3 / 1.1);
    EXPECT_LE(bound.on_s, base.on_s * (1.0 + 1e-6));
    if (!rises) continue;
    ++compared;
    power_falls += !power_rises;
    EXPECT_GE(above.energy_j, base.energy_j * (1.0 - 1e-6));
    EXPECT_LE(bound.energy_j, base.energy_j * (1.0 + 5e-4));
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(power_falls, 30);
}

TEST(PumpUpTime, IsTheSumOfManySmallSteps) {
  RandomPumped rigs(35);
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    Pumped rig = rigs.Draw();
    const double low_pa = rigs.Uniform(0.8e5, 1.3e5);
    constexpr int kSteps = 100'000;
    const double step_pa = (rig.stop_pa - low_pa) / kSteps;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
      sum += step_pa / FreeAirDelivery(rig.curve, low_pa + (i + 0.5) * step_pa);
    const double expected_s =
        rig.reservoir_m3 / 1e5 * (293.15 / rig.temperature_k) / rig.pumps * sum;
    EXPECT_NEAR(
        PumpUpTime(rig.curve, rig.pumps, rig.reservoir_m3, low_pa, rig.stop_pa, rig.temperature_k),
        expected_s, 1e-7 * expected_s);
  }
}

TEST(PumpUpTime, EndsAtTheHighestPressure) {
  // 1 L from 1 to 4 bar at 0.1 L/s: 30 s, up to the rating itself and no further.
  const Pumped rig = ByHand(1e-4, 1e-3);
  EXPECT_NEAR(PumpUpTime(rig.curve, 1, 1e-3, 1e5, 4e5, 293.15), 30.0, 1e-9);
  EXPECT_NEAR(PumpUpTime(rig.curve, 3, 1e-3, 1e5, 4e5, 293.15), 10.0, 1e-9);
  EXPECT_TRUE(std::isinf(PumpUpTime(rig.curve, 1, 1e-3, 1e5, 4.0001e5, 293.15)));
  EXPECT_EQ(PumpUpTime(rig.curve, 1, 1e-3, 4e5, 4e5, 293.15), 0.0);
  CompressorCurve ends_at_zero = rig.curve;
  ends_at_zero.free_air_m3_per_s = MonotoneCurve({1e5, 4e5}, {1e-4, 0.0});
  EXPECT_TRUE(std::isinf(PumpUpTime(ends_at_zero, 1, 1e-3, 1e5, 4e5, 293.15)));
}

}  // namespace reservoir_stroke_test
}  // namespace plenum::model
