#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/simulate/simulate.h"
#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace simulate_validate_test {

using enum ValveState;

// Invalid rigs are refused with the field's name.
TEST(SimulateValidate, RefusesWhatItCannotRun) {
  const auto detail = [](const auto& change) {
    GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
    group.schedule = {{0.0, kInflate}, {1.0, kDeflate}};
    Rig rig = RigOf(Regulated(3e5), {group});
    SimulateOptions options = Until(2.0);
    change(rig, options);
    const Response r = Simulate(rig, options);
    EXPECT_EQ(r.status, SimulateStatus::kInvalid);
    return r.detail;
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(detail([](Rig& r, auto&) { r.groups.clear(); }), HasSubstr("groups"));
  EXPECT_THAT(detail([](Rig& r, auto&) { r.groups[0].count = 0; }), HasSubstr("count"));
  EXPECT_THAT(detail([](Rig& r, auto&) { r.groups[0].chamber.expansion_ratio = 0.5; }),
              HasSubstr("expansion_ratio"));
  EXPECT_THAT(detail([](Rig& r, auto&) { r.groups[0].fill[0].critical_ratio = 1.0; }),
              HasSubstr("groups[0].fill[0].critical_ratio"));
  EXPECT_THAT(detail([](Rig& r, auto&) { r.groups[0].fill.clear(); }), HasSubstr("fill"));
  EXPECT_THAT(detail([](Rig& r, auto&) {
                r.groups[0].exhaust.resize(9, {1e-9, 0.3});
              }),
              HasSubstr("exhaust"));
  EXPECT_THAT(detail([](Rig& r, auto&) { r.groups[0].schedule[1].time_s = -1.0; }),
              HasSubstr("schedule[1].time_s"));
  EXPECT_THAT(detail([](Rig& r, auto&) { r.groups[0].initial_pressure_pa = std::nan(""); }),
              HasSubstr("initial_pressure_pa"));
  EXPECT_THAT(detail([](Rig& r, auto&) { r.source = Regulated(kInf); }), HasSubstr("pressure_pa"));
  EXPECT_THAT(detail([](Rig& r, auto&) { r.source = ReservoirSource{}; }), HasSubstr("volume_m3"));
  EXPECT_THAT(detail([](Rig& r, auto&) { r.ambient.temperature_k = 0.0; }),
              HasSubstr("ambient.temperature_k"));
  EXPECT_THAT(detail([](auto&, SimulateOptions& o) { o.end_s = kInf; }), HasSubstr("end_s"));
  EXPECT_THAT(detail([](auto&, SimulateOptions& o) { o.linear_ratio = 1.0; }),
              HasSubstr("linear_ratio"));
}

}  // namespace simulate_validate_test
}  // namespace plenum::model
