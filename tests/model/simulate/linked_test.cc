// Actuators that are linked: against masses integrated by other code, balances, derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/simulate/sensitivity.h"
#include "model/simulate/simulate.h"
#include "tests/support/chambers/chamber_net.h"

namespace plenum::model {
namespace linked_test {

// 50 mL, 30 mL and 12 mL in a row, the last one rigid; the middle one leaks.
Rig Row() {
  Rig rig;
  rig.source = RegulatedSource{.pressure_pa = 3e5};
  const std::vector<FlowElement> valve = {{0.05e-8, 0.3}};
  for (const double rest_m3 : {50e-6, 30e-6, 12e-6}) {
    GroupRig& group = rig.groups.emplace_back();
    group.chamber = {.rest_volume_m3 = rest_m3,
                     .expansion_ratio = rest_m3 > 20e-6 ? 1.8 : 1.0,
                     .operating_pressure_pa = 2e5,
                     .volume_curve = {}};
  }
  rig.groups[0].fill = rig.groups[0].exhaust = valve;
  rig.groups[0].schedule = {{0.1, ValveState::kInflate},
                            {0.9, ValveState::kHold},
                            {2.0, ValveState::kDeflate},
                            {4.0, ValveState::kHold}};
  rig.groups[1].effects = {{FindEffect("leak", "orifice"), {2e-12, 0.3}}};
  rig.links = {{0, 1, {{0.03e-8, 0.2}, {0.06e-8, 0.4}}, {{0.06e-8, 0.4}, {0.03e-8, 0.2}}},
               {1, 2, {{0.004e-8, 0.35}}, {{0.006e-8, 0.35}}}};
  return rig;
}

test::ChamberNet NetOf(const Rig& rig) {
  const auto elements = [](const std::vector<FlowElement>& line) {
    std::vector<test::MassElement> chain;
    for (const FlowElement& one : line)
      chain.push_back({one.sonic_conductance_m3_per_s_pa, one.critical_ratio});
    return chain;
  };
  test::ChamberNet net;
  net.fill = elements(rig.groups[0].fill), net.exhaust = elements(rig.groups[0].exhaust);
  net.schedule = {{0.1, 1}, {0.9, 0}, {2.0, -1}, {4.0, 0}};
  for (const GroupRig& group : rig.groups)
    net.chambers.push_back(
        {.rest_m3 = group.chamber.rest_volume_m3, .ratio = group.chamber.expansion_ratio});
  for (const Link& link : rig.links) {
    net.chambers[link.to].from = link.from;
    net.chambers[link.to].way = elements(link.fill);
    net.chambers[link.to].back = elements(link.back);
  }
  net.chambers[1].leak = {2e-12, 0.3};
  return net;
}

SimulateOptions Sampled() {
  SimulateOptions options;
  options.end_s = 5.0;
  options.sample_hz = 20.0;
  options.relative_tolerance = 1e-9;
  return options;
}

TEST(Linked, ActuatorsInARowFollowTheirMasses) {
  const Rig rig = Row();
  const Response response = Simulate(rig, Sampled());
  ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  const test::NetResult net = test::SimulateNet(NetOf(rig), response.t_s, 2e-4);
  for (std::size_t i = 0; i < rig.groups.size(); ++i)
    for (std::size_t k = 0; k < response.t_s.size(); ++k)
      EXPECT_NEAR(response.groups[i].pressure_pa[k], net.pressure_pa[i][k], 1.0)
          << i << " at " << response.t_s[k] << " s";
  const double start = net.gas_kg.front(), end = net.gas_kg.back();
  EXPECT_NEAR(end - start, net.through_valve_kg - net.leaked_kg, 1e-9 * start);
}

double Sum(const Response& response, double GroupResponse::*amount) {
  double sum = 0.0;
  for (const GroupResponse& group : response.groups) sum += group.*amount;
  return sum;
}

TEST(Linked, GasAndEnergyAreKept) {
  for (const bool heated : {false, true}) {
    Rig rig = Row();
    if (heated)
      for (GroupRig& group : rig.groups)
        group.effects.push_back({FindEffect("heat_transfer"), {0.4}});
    const Response response = Simulate(rig, Sampled());
    ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
    using G = GroupResponse;
    const double gained = Sum(response, &G::gas_final_m3) - Sum(response, &G::gas_start_m3);
    const double through = Sum(response, &G::air_in_m3) - Sum(response, &G::air_out_m3) -
                           Sum(response, &G::air_leaked_m3);
    EXPECT_NEAR(gained, through, 1e-8 * Sum(response, &G::gas_start_m3)) << heated;
    EXPECT_GT(response.groups[1].gas_final_m3, 0.9 * response.groups[1].gas_start_m3);
    if (!heated) continue;
    for (const G& group : response.groups)
      EXPECT_NEAR(group.energy_final_j - group.energy_start_j,
                  group.enthalpy_in_j - group.enthalpy_out_j + group.wall_heat_j - group.work_j,
                  1e-6 * group.energy_start_j)
          << group.name;
  }
}

TEST(Linked, DerivativesAreThoseOfDifferences) {
  const Rig rig = Row();
  const auto at = [](Rig& of, int number) -> double& {
    return number == 0   ? of.links[0].fill[0].sonic_conductance_m3_per_s_pa
           : number == 1 ? of.links[1].back[0].sonic_conductance_m3_per_s_pa
                         : of.groups[2].chamber.rest_volume_m3;
  };
  for (const int number : {0, 1, 2}) {
    Rig here = rig;
    const Direction direction = {{&at(here, number), 1.0}};
    const auto along = SimulateAlongDirections(here, Sampled(), {&direction, 1});
    ASSERT_EQ(along.response.status, SimulateStatus::kDone) << along.response.detail;
    Rig above = rig, below = rig;
    const double step = 1e-3 * at(here, number);
    at(above, number) += step, at(below, number) -= step;
    const Response up = Simulate(above, Sampled()), down = Simulate(below, Sampled());
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < up.t_s.size(); ++k) {
        const double difference =
            (up.groups[i].pressure_pa[k] - down.groups[i].pressure_pa[k]) / 2e-3;
        EXPECT_NEAR(along.derivatives[0].groups[i].pressure_pa[k] * at(here, number), difference,
                    20.0 + 2e-3 * std::abs(difference))
            << number << ", " << i << " at " << up.t_s[k] << " s";
      }
  }
}

TEST(Linked, WhatCannotBeLinkedIsSaid) {
  const auto why = [](auto change) {
    Rig rig = Row();
    change(rig);
    return Simulate(rig, Sampled()).detail;
  };
  EXPECT_NE(why([](Rig& rig) { rig.links[0].to = 3; }).find("links[0]"), std::string::npos);
  EXPECT_NE(why([](Rig& rig) { rig.groups[1].count = 2; }).find("single"), std::string::npos);
  EXPECT_NE(why([](Rig& rig) { rig.links[1].back.clear(); }).find("element"), std::string::npos);
}

// At pressures as they are, below ambient: what an actuator holds that shrinks.
TEST(Linked, AnActuatorThatShrinksFollowsItsMass) {
  Rig rig;
  rig.exhaust_pressure_pa = 3e4;
  rig.source = RegulatedSource{.pressure_pa = 1e5};
  GroupRig& group = rig.groups.emplace_back();
  group.chamber = {.rest_volume_m3 = 80e-6,
                   .expansion_ratio = 0.4,
                   .operating_pressure_pa = 4e4,
                   .volume_curve = {}};
  group.fill = group.exhaust = {{0.05e-8, 0.3}};
  group.schedule = {{0.1, ValveState::kDeflate}, {1.5, ValveState::kInflate}};
  const Response response = Simulate(rig, Sampled());
  ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  test::ChamberNet net;
  net.source_pa = 3e4;
  net.fill = net.exhaust = {{0.05e-8, 0.3}};
  net.schedule = {{0.1, 1}, {1.5, -1}};
  net.chambers = {{.rest_m3 = 80e-6, .ratio = 0.4, .operating_pa = 4e4}};
  const test::NetResult masses = test::SimulateNet(net, response.t_s, 2e-4);
  for (std::size_t k = 0; k < response.t_s.size(); ++k)
    EXPECT_NEAR(response.groups[0].pressure_pa[k], masses.pressure_pa[0][k], 1.0)
        << response.t_s[k] << " s";
}

}  // namespace linked_test
}  // namespace plenum::model
