// Rigs whose gas is too dense to be ideal, against quadratures, the isentrope and balances.
#include <gtest/gtest.h>

#include <cmath>

#include "model/effects/effect.h"
#include "model/flow/dense_gas.h"
#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace simulate_dense_test {

constexpr double kVolumeM3 = 1e-3, kConductance = 2e-9, kTemperatureK = 293.15;
constexpr double kPerContent = kReferenceTemperatureK / kReferencePressurePa;

Effect HeatOf(double time_constant_s) { return {FindEffect("heat_transfer"), {time_constant_s}}; }

// A rigid vessel at 20 MPa that is emptied.
Rig Vessel(Gas gas, double initial_pa) {
  GroupRig group = OneActuator(20e6, 1.0, {kConductance, 0.4});
  group.chamber.rest_volume_m3 = kVolumeM3;
  group.initial_pressure_pa = initial_pa;
  group.schedule = {{0.0, ValveState::kDeflate}};
  Rig rig = RigOf(NoSource{}, {group});
  rig.gas = gas;
  rig.dense = true;
  return rig;
}

double ContentAt(Gas gas, double pressure_pa, double temperature_k) {
  return kVolumeM3 / DenseGas(gas).Volume(pressure_pa, temperature_k) * kPerContent;
}

// Choked: t = ∫ dn/Q with Q = C·p·√(T0/T)/√Z and the gas's factor, by Simpson's rule.
double EmptyingTime(Gas gas, double from_pa, double to_pa) {
  constexpr int kPanels = 400;
  const auto slowness = [&](double pressure_pa) {
    const double step_pa = 1e-4 * pressure_pa;
    const double by_pressure = (ContentAt(gas, pressure_pa + step_pa, kTemperatureK) -
                                ContentAt(gas, pressure_pa - step_pa, kTemperatureK)) /
                               (2.0 * step_pa);
    const double z = pressure_pa * DenseGas(gas).Volume(pressure_pa, kTemperatureK) / kTemperatureK;
    return by_pressure * std::sqrt(z) / (kConductance * FlowFactor(gas) * pressure_pa);
  };
  double sum = 0.0;
  const double width_pa = (from_pa - to_pa) / kPanels;
  for (int i = 0; i <= kPanels; ++i)
    sum += (i == 0 || i == kPanels ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * slowness(to_pa + i * width_pa);
  return sum * width_pa / 3.0;
}

TEST(SimulateDense, AVesselEmptiesAsItsQuadratureSays) {
  for (const Gas gas : {Gas::kAir, Gas::kNitrogen, Gas::kHydrogen}) {
    const double time_s = EmptyingTime(gas, 20e6, 2e6);
    const Response response = Simulate(Vessel(gas, 20e6), Until(time_s));
    ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
    EXPECT_NEAR(response.groups[0].final_pressure_pa, 2e6, 2e6 * 1e-5);
    EXPECT_NEAR(response.groups[0].gas_start_m3 - response.groups[0].gas_final_m3,
                response.groups[0].air_out_m3, 1e-8 * response.groups[0].gas_start_m3);
  }
}

// Without heat from the wall the gas that stays expands along an isentrope, dT/dw = −T·p_T/c_v,
// followed here by Heun's method in ln w.
TEST(SimulateDense, WithoutHeatTheGasFollowsItsIsentrope) {
  for (const Gas gas : {Gas::kNitrogen, Gas::kHelium}) {
    Rig rig = Vessel(gas, 30e6);
    rig.groups[0].effects = {HeatOf(1e9)};
    SimulateOptions options = Until(EmptyingTime(gas, 30e6, 12e6), 10.0);
    const Response response = Simulate(rig, options);
    ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
    const GroupResponse& group = response.groups[0];
    const double end_k = group.temperature_k.back(), end_pa = group.pressure_pa.back();
    EXPECT_LT(end_k, 0.85 * kTemperatureK);

    const DenseGas dense(gas);
    const double start = std::log(dense.Volume(30e6, kTemperatureK));
    const double end = std::log(dense.Volume(end_pa, end_k));
    const auto cooling = [&](double log_w, double temperature_k) {
      const double w = std::exp(log_w);
      const GasState<double> at = dense.At(w, temperature_k);
      const double capacity = 1.0 / (HeatCapacityRatio(gas) - 1.0) + at.added_capacity;
      return -temperature_k * at.per_kelvin_pa / capacity * w;
    };
    constexpr int kSteps = 2000;
    double temperature_k = kTemperatureK;
    const double step = (end - start) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const double first = cooling(start + i * step, temperature_k);
      const double second = cooling(start + (i + 1) * step, temperature_k + step * first);
      temperature_k += 0.5 * step * (first + second);
    }
    EXPECT_NEAR(end_k, temperature_k, 1e-4 * temperature_k);
  }
}

// Filled from a dense source and emptied, with heat from the wall.
TEST(SimulateDense, GasAndEnergyAreBalanced) {
  GroupRig group = OneActuator(20e6, 1.0, {kConductance, 0.4});
  group.chamber.rest_volume_m3 = kVolumeM3;
  group.initial_pressure_pa = 1e5;
  group.schedule = {{0.0, ValveState::kInflate}, {20.0, ValveState::kDeflate}};
  group.effects = {HeatOf(3.0)};
  Rig rig = RigOf(Regulated(25e6), {group});
  rig.gas = Gas::kNitrogen;
  rig.dense = true;
  const Response response = Simulate(rig, Until(50.0));
  ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  const GroupResponse& of = response.groups[0];
  EXPECT_NEAR(of.gas_final_m3 - of.gas_start_m3, of.air_in_m3 - of.air_out_m3, 1e-8 * of.air_in_m3);
  EXPECT_NEAR(of.energy_final_j - of.energy_start_j,
              of.enthalpy_in_j - of.enthalpy_out_j + of.wall_heat_j, 1e-7 * of.enthalpy_in_j);
}

// Thin gas is the same by both equations.
TEST(SimulateDense, GasOfLittlePressureIsIdeal) {
  Rig rig = Vessel(Gas::kHelium, 2e5);
  rig.groups[0].effects = {HeatOf(0.5)};
  const Response dense = Simulate(rig, Until(1.0));
  rig.dense = false;
  const Response ideal = Simulate(rig, Until(1.0));
  EXPECT_NEAR(dense.groups[0].final_pressure_pa, ideal.groups[0].final_pressure_pa, 200.0);
}

}  // namespace simulate_dense_test
}  // namespace plenum::model
