// Dense gas against published densities, and its derivatives and energies against each other.
#include "model/flow/dense_gas.h"

#include <gtest/gtest.h>

namespace plenum::model {
namespace dense_gas_test {

double Compressibility(Gas gas, double pressure_pa, double temperature_k) {
  return pressure_pa * DenseGas(gas).Volume(pressure_pa, temperature_k) / temperature_k;
}

TEST(DenseGas, HasThePublishedDensities) {
  // Air at 300 K: Perry's Chemical Engineers' Handbook.
  EXPECT_NEAR(Compressibility(Gas::kAir, 10e6, 300.0), 0.993, 0.001);
  EXPECT_NEAR(Compressibility(Gas::kAir, 15e6, 300.0), 1.007, 0.002);
  EXPECT_NEAR(Compressibility(Gas::kAir, 20e6, 300.0), 1.033, 0.001);
  EXPECT_NEAR(Compressibility(Gas::kAir, 30e6, 300.0), 1.109, 0.003);
  // Hydrogen at 15 °C: 24.0 kg/m³ at 35 MPa, 40.2 kg/m³ at 70 MPa (SAE J2601).
  const auto density = [](double pressure_pa) {
    return pressure_pa / (4124.5 * 288.15 * Compressibility(Gas::kHydrogen, pressure_pa, 288.15));
  };
  EXPECT_NEAR(density(35e6), 24.0, 0.003 * 24.0);
  EXPECT_NEAR(density(70e6), 40.2, 0.032 * 40.2);
  // CO2: saturated vapour at 20 °C and 5.729 MPa has 194.2 kg/m³ (Span and Wagner 1996).
  EXPECT_NEAR(5.729e6 / (188.9 * 293.15 * Compressibility(Gas::kCo2, 5.729e6, 293.15)), 194.2, 6.0);
}

TEST(DenseGas, IsIdealWhereItIsThin) {
  for (int gas = 0; gas < static_cast<int>(kGasNames.size()); ++gas)
    EXPECT_NEAR(Compressibility(static_cast<Gas>(gas), 1e3, 293.15), 1.0, 1e-4) << kGasNames[gas];
}

// Each derivative against central differences, and what thermodynamics says of energies:
// ∂u/∂w = T·p_T − p at constant temperature, ∂u/∂T = c_v at constant volume.
TEST(DenseGas, IsConsistent) {
  for (const Gas gas : {Gas::kAir, Gas::kHelium, Gas::kHydrogen, Gas::kCo2}) {
    const DenseGas dense(gas);
    for (const double pressure_pa : {3e5, 2e6, 5e6}) {
      for (const double temperature_k : {290.0, 350.0}) {
        const double w = dense.Volume(pressure_pa, temperature_k);
        const GasState<double> at = dense.At(w, temperature_k);
        EXPECT_NEAR(at.pressure_pa, pressure_pa, 1e-9 * pressure_pa);
        EXPECT_NEAR(dense.Temperature(pressure_pa, w), temperature_k, 1e-9 * temperature_k);
        constexpr double kStep = 1e-5;
        const auto by_volume = [&](double GasState<double>::*number) {
          return (dense.At(w * (1 + kStep), temperature_k).*number -
                  dense.At(w * (1 - kStep), temperature_k).*number) /
                 (2 * kStep * w);
        };
        const auto by_kelvin = [&](double GasState<double>::*number) {
          return (dense.At(w, temperature_k * (1 + kStep)).*number -
                  dense.At(w, temperature_k * (1 - kStep)).*number) /
                 (2 * kStep * temperature_k);
        };
        EXPECT_NEAR(at.per_volume_pa / by_volume(&GasState<double>::pressure_pa), 1.0, 1e-7);
        EXPECT_NEAR(at.per_kelvin_pa / by_kelvin(&GasState<double>::pressure_pa), 1.0, 1e-7);
        EXPECT_NEAR(by_volume(&GasState<double>::departure_k),
                    temperature_k * at.per_kelvin_pa - at.pressure_pa, 1e-6 * pressure_pa);
        EXPECT_NEAR(by_kelvin(&GasState<double>::departure_k), at.added_capacity, 1e-6);
      }
    }
  }
}

TEST(DenseGas, CarriesDerivatives) {
  const DenseGas dense(Gas::kNitrogen);
  const Dual pressure_pa(15e6, 0), temperature_k(280.0, 1);
  const Dual w = dense.Volume(pressure_pa, temperature_k);
  const Dual back_k = dense.Temperature(pressure_pa, w);
  const double by_pressure = (dense.Volume(15.01e6, 280.0) - dense.Volume(14.99e6, 280.0)) / 0.02e6;
  const double by_kelvin = (dense.Volume(15e6, 280.1) - dense.Volume(15e6, 279.9)) / 0.2;
  EXPECT_NEAR(w.v[0] / by_pressure, 1.0, 1e-5);
  EXPECT_NEAR(w.v[1] / by_kelvin, 1.0, 1e-5);
  EXPECT_NEAR(back_k.a, 280.0, 1e-8);
  EXPECT_NEAR(back_k.v[0], 0.0, 1e-12);
  EXPECT_NEAR(back_k.v[1], 1.0, 1e-9);
}

TEST(DenseGas, WithoutPressureIsNoNumber) {
  const DenseGas dense(Gas::kAir);
  EXPECT_TRUE(std::isnan(dense.Volume(-1.0, 300.0)));
  EXPECT_TRUE(std::isnan(dense.Temperature(-1e5, 1e-3)));
}

}  // namespace dense_gas_test
}  // namespace plenum::model
