#include "tests/support/random_parts.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "optimizer/problem/problem.h"

namespace plenum::test {
namespace {

constexpr double kConductance = 1e-8;  // of 1 dm³/(s·bar)
constexpr double kLitrePerMinute = 1e-3 / 60.0;

model::PartBasics Basics(Random& random, const char* family, int index, double mass_kg) {
  model::PartBasics basics;
  basics.id = std::string(family) + "-" + static_cast<char>('a' + index);
  basics.mass_kg = mass_kg;
  basics.body_volume_m3 = mass_kg / Uniform(random, 400.0, 2500.0);
  if (!Chance(random, 0.15)) basics.cost_eur = mass_kg * LogUniform(random, 50.0, 800.0);
  return basics;
}

model::Tubing RandomTubing(Random& random, int index) {
  model::Tubing tubing;
  tubing.outer_diameter_m = kOuterDiameterM[Pick(random, 0, 2)];
  tubing.inner_diameter_m = tubing.outer_diameter_m * Uniform(random, 0.5, 0.75);
  const double outer = std::numbers::pi / 4.0 * std::pow(tubing.outer_diameter_m, 2);
  const double inner = std::numbers::pi / 4.0 * std::pow(tubing.inner_diameter_m, 2);
  tubing.per_metre = Basics(random, "tube", index, (outer - inner) * 1150.0);
  tubing.per_metre.body_volume_m3 = outer;
  tubing.pressure_max_pa = kAmbientPa + Uniform(random, 2.0, 10.0) * kBar;
  return tubing;
}

model::Fitting RandomFitting(Random& random, int index) {
  model::Fitting fitting;
  fitting.tube_outer_diameter_m = kOuterDiameterM[Pick(random, 0, 2)];
  fitting.thread = kThreads[Pick(random, 0, 1)];
  fitting.flow.sonic_conductance_m3_per_s_pa =
      std::pow(fitting.tube_outer_diameter_m / 4e-3, 2) * Uniform(random, 0.4, 1.2) * kConductance;
  fitting.flow.critical_ratio = Uniform(random, 0.2, 0.5);
  fitting.basics =
      Basics(random, "fitting", index,
             0.002 + 0.004 * fitting.flow.sonic_conductance_m3_per_s_pa / kConductance);
  fitting.pressure_max_pa = kAmbientPa + Uniform(random, 5.0, 10.0) * kBar;
  return fitting;
}

model::Valve RandomValve(Random& random, int index) {
  model::Valve valve;
  valve.kind = Chance(random, 0.3)   ? model::ValveKind::kThreeWay
               : Chance(random, 0.5) ? model::ValveKind::kPair
                                     : model::ValveKind::kProportional;
  valve.channels = Chance(random, 0.3) ? Pick(random, 2, 4) : 1;
  valve.port = kThreads[Pick(random, 0, 1)];
  const double conductance = LogUniform(random, 0.05, 1.0);
  valve.fill.sonic_conductance_m3_per_s_pa = conductance * kConductance;
  valve.fill.critical_ratio = Uniform(random, 0.15, 0.5);
  valve.exhaust.sonic_conductance_m3_per_s_pa =
      conductance * Uniform(random, 0.8, 1.2) * kConductance;
  valve.exhaust.critical_ratio = Uniform(random, 0.15, 0.5);
  valve.basics = Basics(random, "valve", index,
                        valve.channels * (0.004 + 0.03 * conductance) * Uniform(random, 0.8, 1.2));
  valve.coil_power_w = LogUniform(random, 0.2, 3.0);
  valve.pressure_max_pa = kAmbientPa + Uniform(random, 1.5, 8.0) * kBar;
  return valve;
}

model::Compressor RandomCompressor(Random& random, int index) {
  model::Compressor compressor;
  const double flow = LogUniform(random, 2.0, 20.0) * kLitrePerMinute;
  const double highest = kAmbientPa + Uniform(random, 2.0, 6.0) * kBar;
  const double bend = Uniform(random, 0.6, 1.6);
  std::vector<double> pressure, delivery, current;
  // Most pumps draw more against a higher pressure; some draw less near their end.
  const double slope = Chance(random, 0.8) ? Uniform(random, 0.0, 1.5) : Uniform(random, -0.4, 0.0);
  compressor.curve.voltage_v = Chance(random, 0.5) ? 12.0 : 6.0;
  for (int i = 0; i <= 5; ++i) {
    const double share = i / 5.0;
    pressure.push_back(kAmbientPa + share * (highest - kAmbientPa));
    delivery.push_back(flow * (1.0 - 0.9 * std::pow(share, bend)));
    const double power_w = flow / kLitrePerMinute * 2.0 * (1.0 + slope * share);
    current.push_back(power_w / compressor.curve.voltage_v);
  }
  compressor.curve.free_air_m3_per_s = model::MonotoneCurve(pressure, delivery);
  compressor.curve.current_a = model::MonotoneCurve(pressure, current);
  compressor.curve.pressure_max_pa = highest * (Chance(random, 0.3) ? 0.9 : 1.0);
  compressor.basics = Basics(random, "pump", index,
                             (0.05 + 0.03 * flow / kLitrePerMinute) * Uniform(random, 0.7, 1.3));
  compressor.duty_max = Uniform(random, 0.3, 1.0);
  return compressor;
}

model::Battery RandomBattery(Random& random, int index) {
  constexpr std::array<double, 4> kVolts{6.4, 7.4, 11.1, 12.8};
  model::Battery battery;
  battery.nominal_voltage_v = kVolts[Pick(random, 0, 3)];
  battery.capacity_ah = LogUniform(random, 0.3, 8.0);
  battery.current_max_a = battery.capacity_ah * Uniform(random, 1.0, 20.0);
  battery.basics =
      Basics(random, "battery", index,
             battery.capacity_ah * battery.nominal_voltage_v / Uniform(random, 90.0, 180.0));
  return battery;
}

model::Cylinder RandomCylinder(Random& random, int index) {
  model::Cylinder cylinder;
  cylinder.water_volume_m3 = LogUniform(random, 0.1e-3, 2e-3);
  cylinder.fill_pressure_pa = kAmbientPa + (Chance(random, 0.5) ? 200.0 : 300.0) * kBar;
  cylinder.basics = Basics(random, "cylinder", index,
                           0.1 + 0.9e3 * cylinder.water_volume_m3 * Uniform(random, 0.7, 1.3));
  return cylinder;
}

// What the wall of a bottle can evaporate, m³/s ANR: catalog/data/README.md, CO2 sustained flow.
double SustainedFlow(double body_volume_m3) {
  const double diameter_m = std::cbrt(body_volume_m3 / (0.75 * std::numbers::pi));
  const double wall_m2 = 3.5 * std::numbers::pi * diameter_m * diameter_m;
  return 10.0 * wall_m2 * 20.0 / 274e3;
}

model::Co2Bottle RandomCo2(Random& random, int index) {
  model::Co2Bottle bottle;
  bottle.co2_mass_kg = LogUniform(random, 0.016, 0.6);
  if (Chance(random, 0.7)) bottle.water_volume_m3 = bottle.co2_mass_kg / 700.0;
  bottle.basics = Basics(random, "co2", index, bottle.co2_mass_kg * Uniform(random, 0.8, 2.5));
  bottle.flow_sustained_m3_per_s =
      SustainedFlow(bottle.co2_mass_kg / 600.0) * LogUniform(random, 1.0, 10.0);
  return bottle;
}

model::Regulator RandomRegulator(Random& random, int index) {
  model::Regulator regulator;
  const double conductance = LogUniform(random, 0.2, 4.0);
  regulator.flow = {conductance * kConductance, Uniform(random, 0.1, 0.5)};
  regulator.flow_max_m3_per_s = Chance(random, 0.5)
                                    ? optimizer::kUnlimited
                                    : LogUniform(random, 30.0, 600.0) * kLitrePerMinute;
  regulator.inlet_pressure_min_pa = kAmbientPa + Uniform(random, 1.0, 6.0) * kBar;
  constexpr std::array<double, 3> kInletBar{10.0, 210.0, 310.0};
  regulator.inlet_pressure_max_pa = kAmbientPa + kInletBar[Pick(random, 0, 2)] * kBar;
  regulator.outlet_pressure_min_pa = kAmbientPa + Uniform(random, 0.0, 1.0) * kBar;
  regulator.outlet_pressure_max_pa = kAmbientPa + Uniform(random, 2.0, 8.0) * kBar;
  regulator.electrical_power_w = Chance(random, 0.3) ? Uniform(random, 0.1, 1.0) : 0.0;
  regulator.basics =
      Basics(random, "regulator", index, (0.03 + 0.06 * conductance) * Uniform(random, 0.7, 1.3));
  return regulator;
}

model::Reservoir RandomReservoir(Random& random, int index) {
  model::Reservoir reservoir;
  reservoir.volume_m3 = LogUniform(random, 0.1e-3, 2e-3);
  reservoir.pressure_max_pa = kAmbientPa + Uniform(random, 2.0, 10.0) * kBar;
  reservoir.basics = Basics(random, "reservoir", index,
                            0.03 + 300.0 * reservoir.volume_m3 * Uniform(random, 0.6, 1.4));
  return reservoir;
}

template <typename Part, typename Make>
std::vector<Part> RandomFamily(Random& random, int count, Make&& make) {
  std::vector<Part> parts;
  for (int i = 0; i < count; ++i) parts.push_back(make(random, i));
  return parts;
}

// Now and then a part is sold twice, under another name: an exact tie.
template <typename Part>
void SellTwice(Random& random, std::vector<Part>& parts) {
  if (parts.size() < 2 || !Chance(random, 0.15)) return;
  const std::string id = parts.back().basics.id;
  parts.back() = parts.front();
  parts.back().basics.id = id;
}

}  // namespace

double Uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

double LogUniform(Random& random, double low, double high) {
  return low * std::pow(high / low, Uniform(random, 0.0, 1.0));
}

int Pick(Random& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
}

bool Chance(Random& random, double share) { return Uniform(random, 0.0, 1.0) < share; }

model::Parts RandomParts(Random& random, const CatalogueSize& size) {
  model::Parts parts;
  parts.tubing = RandomFamily<model::Tubing>(random, size.tubing, RandomTubing);
  parts.fittings = RandomFamily<model::Fitting>(random, size.fittings, RandomFitting);
  parts.valves = RandomFamily<model::Valve>(random, size.valves, RandomValve);
  parts.regulators = RandomFamily<model::Regulator>(random, size.regulators, RandomRegulator);
  parts.cylinders = RandomFamily<model::Cylinder>(random, size.cylinders, RandomCylinder);
  parts.co2 = RandomFamily<model::Co2Bottle>(random, size.co2, RandomCo2);
  parts.compressors = RandomFamily<model::Compressor>(random, size.compressors, RandomCompressor);
  parts.batteries = RandomFamily<model::Battery>(random, size.batteries, RandomBattery);
  parts.reservoirs = RandomFamily<model::Reservoir>(random, size.reservoirs, RandomReservoir);
  parts.tanks = parts.reservoirs;
  SellTwice(random, parts.valves);
  SellTwice(random, parts.batteries);
  SellTwice(random, parts.cylinders);
  SellTwice(random, parts.compressors);
  // At least one fitting mates with a tube and a valve.
  if (!parts.fittings.empty() && !parts.tubing.empty() && !parts.valves.empty()) {
    parts.fittings[0].tube_outer_diameter_m = parts.tubing[0].outer_diameter_m;
    parts.fittings[0].thread = parts.valves[0].port;
  }
  return parts;
}

void MakePowerFall(Random& random, model::CompressorCurve& curve) {
  const std::vector<double> pressure(curve.current_a.x().begin(), curve.current_a.x().end());
  const double drop = Uniform(random, 0.3, 0.8), bend = Uniform(random, 0.4, 1.5);
  std::vector<double> current;
  for (double p : pressure) {
    const double share = (p - pressure.front()) / (pressure.back() - pressure.front());
    current.push_back(curve.current_a.y()[0] * (1.0 - drop * std::pow(share, bend)));
  }
  curve.current_a = model::MonotoneCurve(pressure, current);
}

}  // namespace plenum::test
