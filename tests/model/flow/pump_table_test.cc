// Derivatives to the values of a pump's table.
#include "model/flow/pump_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>
#include <vector>

#include "tests/model/simulate/simulate_rigs.h"
#include "tests/support/sensitivities.h"

namespace plenum::model {
namespace pump_table_test {

constexpr FlowElement kValve = {.sonic_conductance_m3_per_s_pa = 0.1e-8, .critical_ratio = 0.3};

GroupRig Actuator() {
  GroupRig group = OneActuator(2e5, 2.0, kValve);
  group.schedule = {{0.1, ValveState::kInflate}, {1.3, ValveState::kDeflate}};
  return group;
}

SimulateOptions TightOptions() {
  SimulateOptions options = Until(2.5, 17.3);
  options.relative_tolerance = 1e-11;
  options.absolute_tolerance_pa = 1e-7;
  return options;
}

CompressorCurve Pump() {
  return {.free_air_m3_per_s = MonotoneCurve({1e5, 2e5, 4e5, 6e5}, {3e-4, 2.4e-4, 1.3e-4, 0.5e-4}),
          .current_a = MonotoneCurve({1e5, 3e5, 6e5}, {1.0, 1.8, 2.2}),
          .voltage_v = 12.0,
          .pressure_max_pa = 6e5};
}

// The slopes of the table follow its values: each difference is of a rig with another table.
TEST(PumpTable, DerivativesAreThoseOfRigsWithAnotherTable) {
  const auto rig_of = [](std::size_t point, double more) {
    CompressorCurve pump = Pump();
    std::vector<double> values(pump.free_air_m3_per_s.y().begin(),
                               pump.free_air_m3_per_s.y().end());
    values[point] += more;
    const std::span<const double> at = pump.free_air_m3_per_s.x();
    pump.free_air_m3_per_s = MonotoneCurve({at.begin(), at.end()}, values);
    return RigOf(ReservoirSource{.volume_m3 = 0.4e-3,
                                 .initial_pressure_pa = 1.2e5,
                                 .compressor = pump,
                                 .compressor_count = 2,
                                 .duty = 0.9},
                 {Actuator()});
  };
  constexpr double kStep = 1e-8;
  for (std::size_t point = 0; point < 4; ++point) {
    const Rig rig = rig_of(point, 0.0);
    const auto& table = std::get<ReservoirSource>(rig.source).compressor.free_air_m3_per_s;
    const double* address = &table.y()[point];
    const SensitivityResponse exact = SimulateWithSensitivities(rig, TightOptions(), {&address, 1});
    ASSERT_EQ(exact.response.status, SimulateStatus::kDone) << exact.response.detail;
    const Response up = Simulate(rig_of(point, kStep), TightOptions());
    const Response down = Simulate(rig_of(point, -kStep), TightOptions());
    double largest = 0.0, off = 0.0;
    for (std::size_t k = 0; k < up.source_pressure_pa.size(); ++k) {
      const double slope = (up.source_pressure_pa[k] - down.source_pressure_pa[k]) / (2.0 * kStep);
      largest = std::max(largest, std::abs(slope));
      off = std::max(off, std::abs(slope - exact.derivatives[0].source_pressure_pa[k]));
    }
    EXPECT_LE(off, 1e-3 * largest) << point;
    if (point < 2) {
      EXPECT_GT(largest, 0.0) << point;
    }
  }
}

}  // namespace pump_table_test
}  // namespace plenum::model
