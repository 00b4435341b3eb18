#include "bench/search/synthetic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace plenum::bench {
namespace {

constexpr double kAmbientPa = 1e5;
constexpr double kBar = 1e5;
constexpr double kConductance = 1e-8;  // of 1 dm³/(s·bar)
constexpr double kLitrePerMinute = 1e-3 / 60.0;

constexpr std::array<double, 7> kOuterMm{3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0};
constexpr std::array<const char*, 5> kThreads{"M3", "M5", "G1/8", "G1/4", "R1/8"};
constexpr std::array<double, 3> kPumpVolts{6.0, 12.0, 24.0};
constexpr std::array<double, 6> kPackVolts{3.7, 7.4, 11.1, 12.8, 14.8, 22.2};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15ULL + 1) {}
  double Uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  double LogUniform(double low, double high) {
    return low * std::pow(high / low, Uniform(0.0, 1.0));
  }
  // A number as data sheets round it.
  double Step(double low, double high, double step) {
    return step * std::round(Uniform(low, high) / step);
  }
  // Around 1: products of this kind lie within a third of their rule.
  double Scatter() { return LogUniform(0.75, 1.35); }
  int Pick(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  bool Chance(double share) { return Uniform(0.0, 1.0) < share; }

 private:
  std::mt19937_64 random_;
};

model::PartBasics Basics(Draw& draw, const char* family, int index, double mass_kg) {
  model::PartBasics basics;
  basics.id = std::string(family) + "-" + std::to_string(index);
  basics.mass_kg = mass_kg;
  basics.body_volume_m3 = mass_kg / draw.Uniform(500.0, 2500.0);
  basics.cost_eur = 5.0 + mass_kg * draw.LogUniform(50.0, 800.0);
  return basics;
}

model::Tubing MakeTubing(Draw& draw, int index) {
  model::Tubing tubing;
  const double outer_mm = kOuterMm[draw.Pick(kOuterMm.size())];
  const double inner_mm = std::round(10.0 * outer_mm * draw.Uniform(0.45, 0.8)) / 10.0;
  tubing.outer_diameter_m = outer_mm * 1e-3;
  tubing.inner_diameter_m = inner_mm * 1e-3;
  const double wall_mm2 = std::numbers::pi / 4.0 * (outer_mm * outer_mm - inner_mm * inner_mm);
  tubing.per_metre = Basics(draw, "tube", index, wall_mm2 * 1.15e-3 * draw.Scatter());
  tubing.per_metre.body_volume_m3 = std::numbers::pi / 4.0 * outer_mm * outer_mm * 1e-6;
  tubing.pressure_max_pa =
      kAmbientPa + kBar * std::round(25.0 * (outer_mm - inner_mm) / outer_mm * draw.Scatter());
  return tubing;
}

model::Fitting MakeFitting(Draw& draw, int index) {
  model::Fitting fitting;
  const double outer_mm = kOuterMm[draw.Pick(kOuterMm.size())];
  fitting.tube_outer_diameter_m = outer_mm * 1e-3;
  fitting.thread = kThreads[draw.Pick(kThreads.size())];
  const double bore_mm = outer_mm * draw.Uniform(0.4, 0.75);
  const double conductance = 0.16 * std::numbers::pi / 4.0 * bore_mm * bore_mm * draw.Scatter();
  fitting.flow = {conductance * kConductance, draw.Step(0.3, 0.5, 0.1)};
  fitting.basics = Basics(draw, "fitting", index,
                          (0.001 + 0.0012 * outer_mm + 0.002 * conductance) * draw.Scatter());
  fitting.pressure_max_pa = kAmbientPa + draw.Step(6.0, 16.0, 2.0) * kBar;
  return fitting;
}

model::Valve MakeValve(Draw& draw, int index) {
  model::Valve valve;
  valve.kind = draw.Chance(0.4)   ? model::ValveKind::kThreeWay
               : draw.Chance(0.6) ? model::ValveKind::kPair
                                  : model::ValveKind::kProportional;
  valve.channels = draw.Chance(0.2) ? 2 + draw.Pick(3) : 1;
  valve.port = kThreads[draw.Pick(kThreads.size())];
  const double conductance = draw.LogUniform(0.03, 3.0);
  valve.fill = {conductance * kConductance, draw.Step(0.2, 0.5, 0.1)};
  valve.exhaust = {conductance * draw.Step(0.8, 1.2, 0.1) * kConductance,
                   valve.fill.critical_ratio};
  valve.coil_power_w =
      std::max(0.3, 0.1 * std::round(10.0 * (0.3 + 1.2 * std::sqrt(conductance) * draw.Scatter())));
  valve.basics =
      Basics(draw, "valve", index,
             valve.channels * (0.006 + 0.05 * std::pow(conductance, 0.7) / valve.coil_power_w) *
                 draw.Scatter());
  valve.pressure_max_pa = kAmbientPa + draw.Step(2.0, 10.0, 1.0) * kBar;
  valve.pressure_min_pa = draw.Chance(0.2) ? kAmbientPa + draw.Step(0.5, 2.0, 0.5) * kBar : 0.0;
  return valve;
}

model::Regulator MakeRegulator(Draw& draw, int index) {
  model::Regulator regulator;
  const double conductance = draw.LogUniform(0.2, 8.0);
  constexpr std::array<double, 3> kInletBar{15.0, 210.0, 310.0};
  const double inlet_bar = kInletBar[draw.Pick(kInletBar.size())];
  regulator.flow = {conductance * kConductance, draw.Step(0.2, 0.5, 0.1)};
  regulator.flow_max_m3_per_s = 250.0 * conductance * kLitrePerMinute;
  regulator.inlet_pressure_min_pa = kAmbientPa + draw.Step(1.0, 8.0, 1.0) * kBar;
  regulator.inlet_pressure_max_pa = kAmbientPa + inlet_bar * kBar;
  regulator.outlet_pressure_min_pa = kAmbientPa + draw.Step(0.0, 0.6, 0.2) * kBar;
  regulator.outlet_pressure_max_pa = kAmbientPa + draw.Step(2.0, 10.0, 1.0) * kBar;
  regulator.electrical_power_w = draw.Chance(0.3) ? draw.Step(0.2, 1.4, 0.4) : 0.0;
  regulator.basics = Basics(draw, "regulator", index,
                            (0.03 + 0.05 * conductance + 0.0004 * inlet_bar) * draw.Scatter());
  return regulator;
}

model::Cylinder MakeCylinder(Draw& draw, int index) {
  model::Cylinder cylinder;
  cylinder.water_volume_m3 = draw.LogUniform(0.05e-3, 5e-3);
  cylinder.fill_pressure_pa = kAmbientPa + (draw.Chance(0.5) ? 200.0 : 300.0) * kBar;
  cylinder.basics =
      Basics(draw, "cylinder", index,
             0.05 + cylinder.water_volume_m3 * cylinder.fill_pressure_pa * 2.6e-5 * draw.Scatter());
  return cylinder;
}

model::Compressor MakeCompressor(Draw& draw, int index) {
  model::Compressor compressor;
  const double flow_lpm = draw.LogUniform(1.0, 60.0);
  const double highest_bar = draw.Uniform(1.5, 8.0);
  const double bend = draw.Uniform(0.6, 1.4);
  model::CompressorCurve& curve = compressor.curve;
  curve.voltage_v = kPumpVolts[draw.Pick(kPumpVolts.size())];
  std::vector<double> pressure, delivery, current;
  const double power_w = flow_lpm * draw.Uniform(1.2, 2.4);
  const double slope = draw.Uniform(0.2, 1.5);
  for (int i = 0; i <= 6; ++i) {
    const double share = i / 6.0;
    pressure.push_back(kAmbientPa + share * highest_bar * kBar);
    delivery.push_back(flow_lpm * kLitrePerMinute * (1.0 - 0.92 * std::pow(share, bend)));
    current.push_back(power_w * (0.7 + slope * share) / curve.voltage_v);
  }
  curve.free_air_m3_per_s = model::MonotoneCurve(pressure, delivery);
  curve.current_a = model::MonotoneCurve(pressure, current);
  curve.pressure_max_pa = pressure.back();
  compressor.duty_max = draw.Uniform(0.3, 1.0);
  compressor.basics = Basics(draw, "pump", index,
                             (0.04 + 0.02 * flow_lpm * (0.5 + 0.15 * highest_bar)) *
                                 (0.6 + 0.5 * compressor.duty_max) * draw.Scatter());
  return compressor;
}

model::Battery MakeBattery(Draw& draw, int index) {
  model::Battery battery;
  battery.nominal_voltage_v = kPackVolts[draw.Pick(kPackVolts.size())];
  const double energy_wh = draw.LogUniform(1.0, 200.0);
  constexpr std::array<double, 7> kDischarge{1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 40.0};
  const double discharge_per_h = kDischarge[draw.Pick(kDischarge.size())];
  battery.capacity_ah = energy_wh / battery.nominal_voltage_v;
  battery.current_max_a = battery.capacity_ah * discharge_per_h;
  battery.basics =
      Basics(draw, "battery", index,
             0.01 + energy_wh / (210.0 - 20.0 * std::log(discharge_per_h)) * draw.Scatter());
  return battery;
}

model::Reservoir MakeReservoir(Draw& draw, int index) {
  model::Reservoir reservoir;
  // Two digits, as on the label.
  const double litres = draw.LogUniform(0.05, 10.0);
  const double digit = std::pow(10.0, std::floor(std::log10(litres)) - 1.0);
  reservoir.volume_m3 = digit * std::round(litres / digit) * 1e-3;
  const double gauge_bar = draw.Step(2.0, 12.0, 2.0);
  reservoir.pressure_max_pa = kAmbientPa + gauge_bar * kBar;
  reservoir.basics =
      Basics(draw, "reservoir", index,
             0.02 + reservoir.volume_m3 * (120.0 + 10.0 * gauge_bar) * draw.Scatter());
  return reservoir;
}

template <typename Part>
std::vector<Part> Family(Draw& draw, int size, Part (*make)(Draw&, int)) {
  std::vector<Part> parts;
  for (int i = 0; i < size; ++i) parts.push_back(make(draw, i));
  return parts;
}

}  // namespace

model::Parts SyntheticParts(std::uint64_t seed, int size) {
  Draw draw(seed);
  model::Parts parts;
  parts.tubing = Family(draw, size, MakeTubing);
  parts.fittings = Family(draw, size, MakeFitting);
  parts.valves = Family(draw, size, MakeValve);
  parts.regulators = Family(draw, size, MakeRegulator);
  parts.cylinders = Family(draw, size, MakeCylinder);
  parts.compressors = Family(draw, size, MakeCompressor);
  parts.batteries = Family(draw, size, MakeBattery);
  parts.reservoirs = Family(draw, size, MakeReservoir);
  return parts;
}

optimizer::Problem SyntheticRequirements(std::uint64_t seed) {
  Draw draw(seed + 1000003);
  optimizer::Problem problem;
  problem.configurations = {optimizer::Configuration::kCylinder,
                            optimizer::Configuration::kCompressor};
  optimizer::ActuatorGroup group;
  group.name = "group";
  group.count = 1 + draw.Pick(8);
  group.chamber.rest_volume_m3 = draw.LogUniform(8e-6, 120e-6);
  group.chamber.expansion_ratio = draw.Uniform(1.0, 2.5);
  group.chamber.operating_pressure_pa = kAmbientPa + draw.Uniform(0.3, 1.5) * kBar;
  group.tube_length_m = draw.Uniform(0.2, 1.5);
  group.fittings_per_line = 2;
  group.rise_time_max_s = draw.LogUniform(0.08, 1.5);
  group.fall_time_max_s = group.rise_time_max_s * draw.Uniform(1.0, 2.5);
  group.pressure_max_pa = kAmbientPa + 1.05 * (group.chamber.operating_pressure_pa - kAmbientPa);
  problem.frequency_hz =
      draw.LogUniform(0.05, 0.4) / (group.rise_time_max_s + group.fall_time_max_s);
  problem.actuations = std::round(draw.LogUniform(100.0, 3000.0));
  problem.groups = {group};
  problem.source_pressure_max_pa = kAmbientPa + draw.Uniform(3.0, 7.0) * kBar;
  problem.objective.mass_kg = 1.0;
  problem.count = 10;
  return problem;
}

}  // namespace plenum::bench
