// Gas that comes out of the walls, against the closed form for a rigid closed chamber:
//   p(t) = p_0 + P0·(T_a/T0)/V·Q_0·τ·(1 − e^(−t/τ)).
#include "model/effects/outgassing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/simulate/simulate.h"

namespace plenum::model {
namespace outgassing_test {

TEST(Outgassing, FillsAClosedChamberAsTheClosedFormSays) {
  constexpr double kVolumeM3 = 150e-6, kFlowM3PerS = 2e-9, kTimeConstantS = 80.0, kStartPa = 40.0;
  Rig rig;
  rig.ambient = {101.3e3, 300.0};
  rig.source = NoSource{};
  GroupRig group;
  group.chamber = {.rest_volume_m3 = kVolumeM3,
                   .expansion_ratio = 1.0,
                   .operating_pressure_pa = 2e5,
                   .ambient_pressure_pa = 101.3e3,
                   .volume_curve = {}};
  group.blocked = true;
  group.initial_pressure_pa = kStartPa;
  group.effects = {{FindEffect("outgassing"), {kFlowM3PerS, kTimeConstantS}}};
  rig.groups = {group};
  SimulateOptions options;
  options.sample_times_s = {0.0, 10.0, 80.0, 400.0};
  options.end_s = 400.0;
  const Response response = Simulate(rig, options);
  ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  for (std::size_t i = 0; i < options.sample_times_s.size(); ++i) {
    const double given_m3 = kFlowM3PerS * kTimeConstantS *
                            (1.0 - std::exp(-options.sample_times_s[i] / kTimeConstantS));
    const double pressure_pa =
        kStartPa + kReferencePressurePa * 300.0 / kReferenceTemperatureK * given_m3 / kVolumeM3;
    EXPECT_NEAR(response.groups[0].pressure_pa[i], pressure_pa, 1e-3) << i;
  }
}

}  // namespace outgassing_test
}  // namespace plenum::model
