#include "optimizer/choices/corner.h"

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {
namespace {

double Log(double value) { return std::log(std::max(value, 1e-300)); }

void ToLeast(double& a, double b) { a = std::min(a, b); }
void ToMost(double& a, double b) { a = std::max(a, b); }

void ToMost(model::FlowElement& a, const model::FlowElement& b) {
  ToMost(a.sonic_conductance_m3_per_s_pa, b.sonic_conductance_m3_per_s_pa);
  ToMost(a.critical_ratio, b.critical_ratio);
}

template <typename Corner>
void WidenShare(Corner& a, const Corner& b) {
  ToLeast(a.amounts.mass_kg, b.amounts.mass_kg);
  ToLeast(a.amounts.volume_m3, b.amounts.volume_m3);
  ToLeast(a.amounts.cost_eur, b.amounts.cost_eur);
  ToLeast(a.objective, b.objective);
}

}  // namespace

void Widen(TubeCorner& a, const TubeCorner& b) {
  WidenShare(a, b);
  a.diameters |= b.diameters;
  ToLeast(a.inner_low_m, b.inner_low_m);
  ToMost(a.inner_high_m, b.inner_high_m);
  ToMost(a.pressure_max_pa, b.pressure_max_pa);
}

void Widen(FittingCorner& a, const FittingCorner& b) {
  WidenShare(a, b);
  a.diameters |= b.diameters;
  a.threads |= b.threads;
  ToMost(a.flow, b.flow);
  ToMost(a.pressure_max_pa, b.pressure_max_pa);
}

void Widen(ValveCorner& a, const ValveCorner& b) {
  WidenShare(a, b);
  a.threads |= b.threads;
  a.some_hold = a.some_hold || b.some_hold;
  a.all_hold = a.all_hold && b.all_hold;
  ToMost(a.fill, b.fill);
  ToMost(a.exhaust, b.exhaust);
  ToLeast(a.coil_power_w, b.coil_power_w);
  ToLeast(a.pressure_min_pa, b.pressure_min_pa);
  ToMost(a.pressure_max_pa, b.pressure_max_pa);
}

void Widen(RegulatorCorner& a, const RegulatorCorner& b) {
  WidenShare(a, b);
  ToMost(a.flow, b.flow);
  ToMost(a.flow_max_m3_per_s, b.flow_max_m3_per_s);
  ToLeast(a.inlet_min_pa, b.inlet_min_pa);
  ToMost(a.inlet_max_pa, b.inlet_max_pa);
  ToLeast(a.outlet_min_pa, b.outlet_min_pa);
  ToMost(a.outlet_max_pa, b.outlet_max_pa);
  ToLeast(a.electrical_power_w, b.electrical_power_w);
}

void Widen(BottleCorner& a, const BottleCorner& b) {
  WidenShare(a, b);
  ToMost(a.gas_to_low_m3, b.gas_to_low_m3);
  ToMost(a.gas_to_high_m3, b.gas_to_high_m3);
  ToLeast(a.fill_pressure_pa, b.fill_pressure_pa);
  ToMost(a.flow_sustained_m3_per_s, b.flow_sustained_m3_per_s);
}

void Widen(CompressorCorner& a, const CompressorCorner& b) {
  WidenShare(a, b);
  a.voltages |= b.voltages;
  ToMost(a.duty_max, b.duty_max);
  ToMost(a.pressure_max_pa, b.pressure_max_pa);
  for (int i = 0; i < kCoarseCells; ++i) {
    ToLeast(a.pump.energy_j_per_m3[i], b.pump.energy_j_per_m3[i]);
    ToLeast(a.pump.seconds_per_m3[i], b.pump.seconds_per_m3[i]);
    ToLeast(a.pump.current_a[i], b.pump.current_a[i]);
  }
}

void Widen(BatteryCorner& a, const BatteryCorner& b) {
  WidenShare(a, b);
  a.voltages |= b.voltages;
  ToMost(a.energy_j, b.energy_j);
  ToMost(a.current_max_a, b.current_max_a);
  ToMost(a.voltage_v, b.voltage_v);
}

void Widen(ReservoirCorner& a, const ReservoirCorner& b) {
  WidenShare(a, b);
  a.custom = a.custom || b.custom;
  ToLeast(a.low_m3, b.low_m3);
  ToMost(a.high_m3, b.high_m3);
  ToMost(a.pressure_max_pa, b.pressure_max_pa);
}

std::array<double, 3> SplitKeys(const TubeCorner& c) {
  return {Log(c.objective), 2.5 * Log(c.inner_high_m), Log(c.pressure_max_pa)};
}

std::array<double, 4> SplitKeys(const FittingCorner& c) {
  return {Log(c.objective), Log(c.flow.sonic_conductance_m3_per_s_pa), c.flow.critical_ratio,
          Log(c.pressure_max_pa)};
}

std::array<double, 7> SplitKeys(const ValveCorner& c) {
  return {Log(c.objective),
          Log(c.fill.sonic_conductance_m3_per_s_pa),
          c.fill.critical_ratio,
          0.5 * Log(c.exhaust.sonic_conductance_m3_per_s_pa),
          0.2 * Log(c.coil_power_w + 1e-3),
          Log(c.pressure_max_pa),
          Log(c.pressure_min_pa)};
}

std::array<double, 6> SplitKeys(const RegulatorCorner& c) {
  return {Log(c.objective),           Log(c.flow.sonic_conductance_m3_per_s_pa),
          0.5 * Log(c.inlet_min_pa),  0.5 * Log(c.inlet_max_pa),
          0.5 * Log(c.outlet_max_pa), 0.2 * Log(c.electrical_power_w + 1e-2)};
}

std::array<double, 4> SplitKeys(const BottleCorner& c) {
  return {Log(c.objective), Log(c.gas_to_low_m3), 0.5 * Log(c.fill_pressure_pa),
          0.5 * Log(c.flow_sustained_m3_per_s)};
}

std::array<double, 5> SplitKeys(const CompressorCorner& c) {
  return {Log(c.objective), Log(1.0 / c.pump.seconds_per_m3[kCoarseCells / 2]),
          0.5 * Log(c.pump.energy_j_per_m3[kCoarseCells / 2]), Log(c.duty_max),
          Log(c.pressure_max_pa)};
}

std::array<double, 3> SplitKeys(const BatteryCorner& c) {
  return {Log(c.objective), Log(c.energy_j), 0.3 * Log(c.current_max_a)};
}

std::array<double, 3> SplitKeys(const ReservoirCorner& c) {
  return {Log(c.objective), 8.0 * Log(c.low_m3), 0.1 * Log(c.pressure_max_pa)};
}

}  // namespace plenum::optimizer
