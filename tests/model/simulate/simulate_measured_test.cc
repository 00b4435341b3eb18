// What a comparison with measured runs needs: a driven source, uneven samples, further channels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "model/simulate/sensitivity.h"
#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace simulate_measured_test {

using enum ValveState;

constexpr FlowElement kValve = {.sonic_conductance_m3_per_s_pa = 0.1e-8, .critical_ratio = 0.3};
constexpr FlowElement kTube = {.sonic_conductance_m3_per_s_pa = 0.06e-8, .critical_ratio = 0.15};

GroupRig ValveAndTube() {
  GroupRig group = OneActuator(2e5, 2.0, kValve);
  group.chamber.dead_volume_m3 = 2e-6;
  group.fill = {kValve, kTube};
  group.exhaust = {kTube, kValve};
  group.inlet_after = 1;
  group.schedule = {{0.1, kInflate}, {0.6, kHold}, {1.0, kDeflate}};
  return group;
}

std::vector<double> Pressures(const Rig& rig, const SimulateOptions& options) {
  const Response r = Simulate(rig, options);
  EXPECT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  return r.groups[0].pressure_pa;
}

// Choked into a rigid volume: p − p(0) = P0·C/V·∫p_s dt.
TEST(DrivenSource, FillsByTheIntegralOfItsPressureWhileTheLineIsChoked) {
  GroupRig group = OneActuator(2e5, 1.0, kValve);
  group.schedule = {{0.0, kInflate}};
  const Rig rig = RigOf(DrivenSource{{0.0, 0.5}, {5e5, 7e5}, 1.0}, {group});
  const std::vector<double> p = Pressures(rig, Until(0.05, 400.0));
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double t = static_cast<double>(k) / 400.0;
    const double integral = 5e5 * t + 0.5 * 4e5 * t * t;
    EXPECT_NEAR(p[k], 1e5 + 1e5 * 0.1e-8 / 50e-6 * integral, 1.0) << t;
    ASSERT_LT(p[k] / (5e5 + 4e5 * t), 0.3);
  }
}

TEST(DrivenSource, ConstantIsARegulatedOneAndItsFactorScalesTheGaugePressure) {
  const std::vector<double> regulated =
      Pressures(RigOf(Regulated(2.8e5), {ValveAndTube()}), Until(2.0, 50.0));
  const DrivenSource driven = {{0.0, 0.3, 0.7}, {1.9e5, 1.9e5, 1.9e5}, 2.0};
  const std::vector<double> same = Pressures(RigOf(driven, {ValveAndTube()}), Until(2.0, 50.0));
  ASSERT_EQ(same.size(), regulated.size());
  for (std::size_t k = 0; k < same.size(); ++k) EXPECT_NEAR(same[k], regulated[k], 0.02) << k;
}

// The record of a small reservoir, played back.
TEST(DrivenSource, PlaysBackAReservoir) {
  ReservoirSource reservoir = {.volume_m3 = 0.2e-3, .initial_pressure_pa = 3e5};
  const Rig rig = RigOf(reservoir, {ValveAndTube()});
  const Response recorded = Simulate(rig, Until(1.5, 1000.0));
  const Rig played =
      RigOf(DrivenSource{recorded.t_s, recorded.source_pressure_pa, 1.0}, rig.groups);
  const Response r = Simulate(played, Until(1.5, 1000.0));
  ASSERT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  for (std::size_t k = 0; k < r.t_s.size(); ++k) {
    EXPECT_NEAR(r.groups[0].pressure_pa[k], recorded.groups[0].pressure_pa[k], 3.0) << r.t_s[k];
  }
  EXPECT_NEAR(r.source_lowest_pressure_pa, recorded.source_lowest_pressure_pa, 1.0);
}

// The actuator has long been full when the source rises for 20 ms.
TEST(DrivenSource, ABriefRiseLongAfterTheValveSettledIsNotPassedOver) {
  GroupRig group = OneActuator(2e5, 1.0, kValve);
  group.schedule = {{0.0, kInflate}};
  const DrivenSource source = {
      {0.0, 50.0, 50.01, 50.02, 100.0}, {1.5e5, 1.5e5, 1.8e5, 1.5e5, 1.5e5}, 1.0};
  const std::vector<double> p = Pressures(RigOf(source, {group}), Until(100.0, 1.0));
  EXPECT_NEAR(p[49], 1.5e5, 1.0);
  // Flow of a rise by 30 kPa for about 10 ms: between a tenth and all of what choked flow brings.
  EXPECT_GT(p[60] - p[49], 0.1 * 1e5 * 0.1e-8 / 50e-6 * 1.5e5 * 0.02);
  EXPECT_LT(p[60] - p[49], 1e5 * 0.1e-8 / 50e-6 * 1.8e5 * 0.02);
  EXPECT_NEAR(p[100], p[60], 1e-3);
}

// A record that follows its sensor's noise, with a dip at each stroke.
TEST(DrivenSource, BendsOfNoiseDoNotHoldTheStepsOfARoughRun) {
  GroupRig group = ValveAndTube();
  group.schedule = {{0.5, kInflate}, {3.0, kDeflate}, {5.0, kInflate}};
  DrivenSource source;
  std::mt19937 random(7);
  std::normal_distribution<double> noise_pa(0.0, 40.0);
  for (int k = 0; k < 400; ++k) {
    const double t_s = 0.02 * k, since_s = std::fmod(t_s + 4.0, 4.5);
    source.time_s.push_back(t_s);
    source.pressure_pa.push_back(3e5 - 1e4 * std::exp(-since_s / 0.4) + noise_pa(random));
  }
  const Rig rig = RigOf(source, {group});
  SimulateOptions options = Until(7.9, 100.0);
  const Response exact = Simulate(rig, options);
  options.relative_tolerance = 1e-4;
  options.absolute_tolerance_pa = 1.0;
  const Response rough = Simulate(rig, options);
  ASSERT_EQ(rough.status, SimulateStatus::kDone) << rough.detail;
  EXPECT_GT(exact.steps, 300u);
  EXPECT_LT(rough.steps, 150u);
  for (std::size_t k = 0; k < exact.t_s.size(); ++k)
    EXPECT_NEAR(rough.groups[0].pressure_pa[k], exact.groups[0].pressure_pa[k], 40.0) << k;
}

TEST(SimulateSamples, MayBeUnevenAndShareAnInstant) {
  const Rig rig = RigOf(Regulated(3e5), {ValveAndTube()});
  SimulateOptions options = Until(1.5);
  options.sample_times_s = {0.0, 0.013, 0.4, 0.4, 0.6, 1.234, 1.5};
  const Response r = Simulate(rig, options);
  ASSERT_EQ(r.t_s, options.sample_times_s);
  for (std::size_t k = 1; k < r.t_s.size(); ++k) {
    const Response alone = Simulate(rig, Until(r.t_s[k]));
    EXPECT_NEAR(r.groups[0].pressure_pa[k], alone.groups[0].final_pressure_pa, 0.01) << r.t_s[k];
  }
}

TEST(SimulateSamples, OutOfOrderOrPastTheEndAreRefused) {
  const Rig rig = RigOf(Regulated(3e5), {ValveAndTube()});
  SimulateOptions options = Until(1.0);
  for (const std::vector<double>& times : {std::vector{0.2, 0.1}, std::vector{-0.1},
                                           std::vector{0.5, 1.1}, std::vector{std::nan("")}}) {
    options.sample_times_s = times;
    const Response r = Simulate(rig, options);
    EXPECT_EQ(r.status, SimulateStatus::kInvalid);
    EXPECT_NE(r.detail.find("sample_times_s"), std::string::npos) << r.detail;
  }
}

double IsoFlow(const FlowElement& e, double upstream_pa, double downstream_pa) {
  const double over =
      std::max(0.0, (downstream_pa / upstream_pa - e.critical_ratio) / (1.0 - e.critical_ratio));
  return e.sonic_conductance_m3_per_s_pa * upstream_pa * std::sqrt(1.0 - over * over);
}

// Both parts of the line pass the flow that is reported, and the actuator takes it up.
TEST(SimulateChannels, InletPressureAndFlowFitTheElementsAndTheBalance) {
  const Rig rig = RigOf(Regulated(3e5), {ValveAndTube()});
  const Response r = Simulate(rig, Until(1.6, 1000.0));
  const GroupResponse& g = r.groups[0];
  double drawn = 0.0;
  for (std::size_t k = 0; k < r.t_s.size(); ++k) {
    const double t = r.t_s[k], inlet = g.inlet_pressure_pa[k], p = g.pressure_pa[k];
    if (k > 0) drawn += 0.5e-3 * (g.flow_m3_per_s[k - 1] + g.flow_m3_per_s[k]);
    if (t > 0.101 && t < 0.599) {
      EXPECT_NEAR(IsoFlow(kValve, 3e5, inlet), g.flow_m3_per_s[k], 1e-5 * g.flow_m3_per_s[k]) << t;
      EXPECT_NEAR(IsoFlow(kTube, inlet, p), g.flow_m3_per_s[k], 1e-5 * g.flow_m3_per_s[k]) << t;
    } else if (t > 1.001) {
      EXPECT_EQ(g.flow_m3_per_s[k], 0.0);
      EXPECT_NEAR(IsoFlow(kTube, p, inlet), IsoFlow(kValve, inlet, 1e5), 1e-5 * 1e-4) << t;
    } else if (t > 0.601 && t < 0.999) {
      EXPECT_EQ(inlet, p);
      EXPECT_EQ(g.flow_m3_per_s[k], 0.0);
    }
  }
  EXPECT_NEAR(drawn, g.air_drawn_m3, 2e-3 * g.air_drawn_m3);
}

TEST(SimulateChannels, AnInletBehindTheWholeLineIsTheActuator) {
  GroupRig group = ValveAndTube();
  group.inlet_after = 2;
  const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(1.6, 100.0));
  EXPECT_EQ(r.groups[0].inlet_pressure_pa, r.groups[0].pressure_pa);
  group.inlet_after = 3;
  const Response refused = Simulate(RigOf(Regulated(3e5), {group}), Until(1.6, 100.0));
  EXPECT_EQ(refused.status, SimulateStatus::kInvalid);
  EXPECT_NE(refused.detail.find("inlet_after"), std::string::npos) << refused.detail;
}

// Where the flow through an element is this one, by bisection over the pressure behind it.
double Behind(double share, const FlowElement& element, double upstream_pa, double flow) {
  double low = 0.0, high = upstream_pa;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (share * IsoFlow(element, upstream_pa, middle) > flow ? low : high) = middle;
  }
  return high;
}

// A valve that opens throttles, not the tube behind it: that passes the flow as ever.
TEST(SimulateChannels, InletOfAHalfOpenFilling) {
  GroupRig group = ValveAndTube();
  group.schedule = {{0.0, kInflate}};
  group.effects = {{FindEffect("valve_ramp"), {0.5}}};
  const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(0.7, 20.0));
  for (std::size_t k = 1; k < r.t_s.size(); ++k) {
    const double p = r.groups[0].pressure_pa[k], inlet = r.groups[0].inlet_pressure_pa[k];
    const double flow = r.groups[0].flow_m3_per_s[k];
    EXPECT_GT(flow, 0.0) << r.t_s[k];
    EXPECT_NEAR(IsoFlow(kTube, inlet, p), flow, 1e-5 * flow) << r.t_s[k];
  }
}

// A throttled exhaust behind a fixed restriction: the line conducts in proportion to the opening,
// and the inlet is where the tube alone passes that flow.
TEST(SimulateChannels, InletOfAHalfOpenExhaust) {
  GroupRig group = ValveAndTube();
  group.schedule = {{0.0, kDeflate}};
  group.initial_pressure_pa = 2e5;
  const FlowElement restriction = {.sonic_conductance_m3_per_s_pa = 0.08e-8, .critical_ratio = 0.4};
  group.effects = {{FindEffect("valve_ramp"), {1.0}},
                   {FindEffect("exhaust_restriction"), {0.08e-8, 0.4}}};
  const Response r = Simulate(RigOf(NoSource{}, {group}), Until(0.9, 10.0));
  for (std::size_t k = 3; k < r.t_s.size(); ++k) {
    const double p = r.groups[0].pressure_pa[k], inlet = r.groups[0].inlet_pressure_pa[k];
    const double flow = IsoFlow(kTube, p, inlet);
    const double tube_end_pa = Behind(r.t_s[k], kTube, p, flow);
    const double valve_end_pa = Behind(r.t_s[k], kValve, tube_end_pa, flow);
    EXPECT_NEAR(flow, IsoFlow(restriction, valve_end_pa, 1e5), 1e-4 * flow) << r.t_s[k];
  }
}

}  // namespace simulate_measured_test
}  // namespace plenum::model
