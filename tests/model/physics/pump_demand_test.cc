// Pumps that hold the stop pressure let go of it when the draw rises above their delivery.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "tests/model/effects/effects_rigs.h"

namespace plenum::model {
namespace pump_demand_test {

constexpr double kStopPa = 3.6e5;
constexpr double kDelivery = 1.5e-4;  // m³/s ANR at the stop pressure
constexpr double kCommandS = 0.1;
constexpr double kConductance = 0.1e-8;

// The draw through the open valve, choked, is 2.4 times the delivery.
Rig HoldingRig(Effect effect) {
  const ReservoirSource source = {
      .volume_m3 = 0.4e-3,
      .initial_pressure_pa = kStopPa,
      .compressor = {.free_air_m3_per_s =
                         MonotoneCurve({1e5, kStopPa, 6e5}, {3e-4, kDelivery, 0.5e-4}),
                     .current_a = MonotoneCurve({1e5, 6e5}, {1.0, 2.0}),
                     .voltage_v = 12.0,
                     .pressure_max_pa = 6e5},
      .stop_pressure_pa = kStopPa};
  GroupRig group = OneActuator(
      2.5e5, 2.0, {.sonic_conductance_m3_per_s_pa = kConductance, .critical_ratio = 0.4});
  group.chamber.rest_volume_m3 = 200e-6;
  group.schedule = {{kCommandS, ValveState::kInflate}};
  group.effects = {std::move(effect)};
  return RigOf(source, {std::move(group)});
}

// Where the source is seen below the stop pressure first, s. Before it held the stop pressure, and
// from then on it falls until `falling_to_s`.
double LetsGo(const Response& response, double falling_to_s) {
  double let_go_s = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < response.t_s.size() && response.t_s[k] <= falling_to_s; ++k) {
    const double source_pa = response.source_pressure_pa[k];
    if (source_pa < kStopPa && std::isinf(let_go_s)) let_go_s = response.t_s[k];
    if (std::isinf(let_go_s)) {
      EXPECT_EQ(source_pa, kStopPa) << response.t_s[k] << " s";
    } else {
      EXPECT_LT(source_pa, response.source_pressure_pa[k - 1]) << response.t_s[k] << " s";
    }
  }
  return let_go_s;
}

// What the pumps brought and the groups took is what the reservoir gained, m³ ANR.
void ExpectBalance(const Response& response, double volume_m3) {
  const double gained_m3 =
      (response.source_final_pressure_pa - kStopPa) * volume_m3 / kReferencePressurePa;
  EXPECT_NEAR(gained_m3, response.compressor_air_m3 - response.groups[0].air_drawn_m3,
              1e-9 * response.groups[0].air_drawn_m3);
}

// The opening grows as (t − t_command)/duration; the flow stays choked for longer than the hold.
TEST(PumpDemand, AValveThatOpensSlowlyTakesThePumpFromTheStopPressure) {
  constexpr double kRampS = 0.2;
  const Response response =
      Simulate(HoldingRig(MakeEffect("valve_ramp", {kRampS})), Until(0.3, 2000.0));
  ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  const double balanced_s = kCommandS + kRampS * kDelivery / (kConductance * kStopPa);
  const double let_go_s = LetsGo(response, 0.3);
  EXPECT_GT(let_go_s, balanced_s);
  EXPECT_LT(let_go_s, balanced_s + 2.0 / 2000.0);
  EXPECT_LT(response.source_lowest_pressure_pa, kStopPa - 1e3);
  ExpectBalance(response, 0.4e-3);
}

// The line empties a volume of its own first, and the draw grows as that falls below the source.
TEST(PumpDemand, AVolumeBeforeTheLineTakesThePumpFromTheStopPressure) {
  constexpr double kDroopVolume = 20e-6, kDroopC = 0.3e-8, kDroopB = 0.3;
  const Response response = Simulate(
      HoldingRig(MakeEffect("supply_droop", {kDroopVolume, kDroopC, kDroopB})), Until(0.3, 2000.0));
  ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  const double let_go_s = LetsGo(response, 0.2);
  EXPECT_GT(let_go_s, kCommandS);
  EXPECT_LT(let_go_s, 0.2);
  EXPECT_LT(response.source_lowest_pressure_pa, kStopPa - 1e3);
  ExpectBalance(response, 0.4e-3);
}

}  // namespace pump_demand_test
}  // namespace plenum::model
