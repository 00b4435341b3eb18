#include "model/simulate/sensitivity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/model/simulate/simulate_rigs.h"
#include "tests/support/sensitivities.h"

namespace plenum::model {
namespace sensitivity_test {

constexpr FlowElement kValve = {.sonic_conductance_m3_per_s_pa = 0.1e-8, .critical_ratio = 0.3};
constexpr FlowElement kTube = {.sonic_conductance_m3_per_s_pa = 0.06e-8, .critical_ratio = 0.15};

GroupRig TwoElements() {
  GroupRig group = OneActuator(2e5, 2.0, kValve);
  group.name = "a";
  group.chamber.dead_volume_m3 = 2e-6;
  group.fill = {kValve, kTube};
  group.exhaust = {kTube, kValve};
  group.schedule = {{0.1, ValveState::kInflate}, {1.3, ValveState::kDeflate}};
  return group;
}

SimulateOptions Tight(double end_s = 2.5) {
  SimulateOptions options = Until(end_s, 17.3);
  options.relative_tolerance = 1e-11;
  options.absolute_tolerance_pa = 1e-7;
  return options;
}

// Every number of a response by name.
std::map<std::string, double> Flat(const Response& r) {
  std::map<std::string, double> all;
  const auto add = [&](const std::string& name, const std::vector<double>& series) {
    for (std::size_t k = 0; k < series.size(); ++k) all[name + std::to_string(k)] = series[k];
  };
  for (std::size_t i = 0; i < r.groups.size(); ++i) {
    const GroupResponse& g = r.groups[i];
    const std::string name = "group" + std::to_string(i) + ".";
    add(name + "pressure", g.pressure_pa);
    add(name + "reading", g.reading_pa);
    add(name + "volume", g.volume_m3);
    add(name + "temperature", g.temperature_k);
    add(name + "flow", g.flow_m3_per_s);
    add(name + "inlet", g.inlet_pressure_pa);
    all[name + "final"] = g.final_pressure_pa;
    all[name + "drawn"] = g.air_drawn_m3;
    all[name + "in"] = g.air_in_m3;
    all[name + "out"] = g.air_out_m3;
    all[name + "leaked"] = g.air_leaked_m3;
    all[name + "gas_start"] = g.gas_start_m3;
    all[name + "gas_final"] = g.gas_final_m3;
    all[name + "energy_start"] = g.energy_start_j;
    all[name + "energy_final"] = g.energy_final_j;
    all[name + "enthalpy_in"] = g.enthalpy_in_j;
    all[name + "enthalpy_out"] = g.enthalpy_out_j;
    all[name + "wall_heat"] = g.wall_heat_j;
    all[name + "work"] = g.work_j;
  }
  add("source", r.source_pressure_pa);
  all["run.source_lowest"] = r.source_lowest_pressure_pa;
  all["source_final"] = r.source_final_pressure_pa;
  all["on"] = r.compressor_on_s;
  all["pumped"] = r.compressor_air_m3;
  all["energy"] = r.compressor_energy_j;
  std::map<int, int> strokes_of;
  for (const Stroke& s : r.strokes) {
    const std::string name =
        "group" + std::to_string(s.group) + ".stroke" + std::to_string(strokes_of[s.group]++) + ".";
    all[name + "command"] = s.command_s;
    all[name + "start"] = s.start_pressure_pa;
    if (std::isfinite(s.source_start_pressure_pa)) {
      all[name + "source_start"] = s.source_start_pressure_pa;
      all[name + "source_lowest"] = s.source_lowest_pressure_pa;
    }
    if (std::isfinite(s.to_target_s)) all[name + "target"] = s.to_target_s;
    if (std::isfinite(s.to_operating_s)) all[name + "operating"] = s.to_operating_s;
  }
  return all;
}

// Series are compared on the size of the whole series, other numbers on their own.
std::string SeriesOf(const std::string& name) {
  return name.substr(0, name.find_last_not_of("0123456789") + 1);
}

struct Worst {
  double error = 0.0;  // of a derivative, per size of the derivatives of its series
  std::string where;
};

constexpr double kStepFromZero = 20.0;  // Pa, of the cracking pressures

// Differences of fourth order at a relative step h of each number. The response is smooth
// in the number where no event comes or goes, so the error falls as h⁴ down to the noise of the
// integration over h. A derivative counts as small beside 1e-7 of its quantity per h.
Worst AgainstDifferences(Rig rig, const SimulateOptions& options, double step,
                         const std::function<bool(const std::string&)>& compared) {
  Worst worst;
  for (const RigNumber& parameter : DifferentiableNumbers(rig)) {
    if (!std::isfinite(*parameter.number)) continue;
    const double* address = parameter.number;
    const SensitivityResponse exact = SimulateWithSensitivities(rig, options, {&address, 1});
    EXPECT_EQ(exact.response.status, SimulateStatus::kDone) << exact.response.detail;
    if (exact.response.status != SimulateStatus::kDone) return worst;
    double& number = const_cast<double&>(*address);
    const double value = number;
    // A number at the end of its range, 0, can only grow.
    const bool one_sided = value == 0.0;
    const double h = one_sided ? kStepFromZero : step * std::abs(value);
    const double base = one_sided ? 2.0 : 0.0;
    const auto at = [&](double shift) {
      number = value + (base + shift) * h;
      // The copy of the ambient pressure that the chamber carries.
      for (GroupRig& group : rig.groups) {
        group.chamber.ambient_pressure_pa = rig.ambient.pressure_pa;
      }
      return Flat(Simulate(rig, options));
    };
    const auto down2 = at(-2), down = at(-1), middle = at(0), up = at(1), up2 = at(2);
    (void)at(-base);
    number = value;
    const auto values = Flat(exact.response);
    const auto derivatives = Flat(exact.derivatives[0]);
    std::map<std::string, double> sizes, errors;
    for (const auto& [name, q] : values) {
      if (!up.contains(name) || !down.contains(name) || !up2.contains(name) ||
          !down2.contains(name)) {
        ADD_FAILURE() << name << " is not on both sides of " << parameter.name;
        continue;
      }
      const double difference =
          one_sided ? (-25.0 * down2.at(name) + 48.0 * down.at(name) - 36.0 * middle.at(name) +
                       16.0 * up.at(name) - 3.0 * up2.at(name)) /
                          (12.0 * h)
                    : (8.0 * (up.at(name) - down.at(name)) - (up2.at(name) - down2.at(name))) /
                          (12.0 * h);
      // What rounding and the integration leave in the difference.
      const double size = std::max(std::abs(difference), 1e-7 * std::abs(q) / h);
      double& series = sizes[SeriesOf(name)];
      series = std::max(series, size);
      double& error = errors[SeriesOf(name)];
      error = std::max(error, std::abs(derivatives.at(name) - difference));
    }
    for (const auto& [name, error] : errors) {
      if (error == 0.0 || !compared(name)) continue;
      if (error / sizes[name] > worst.error) {
        worst = {error / sizes[name], name + " by " + parameter.name};
      }
    }
  }
  return worst;
}

bool Any(const std::string&) { return true; }

CompressorCurve Pump() {
  return {.free_air_m3_per_s = MonotoneCurve({1e5, 2e5, 4e5, 6e5}, {3e-4, 2.4e-4, 1.3e-4, 0.5e-4}),
          .current_a = MonotoneCurve({1e5, 3e5, 6e5}, {1.0, 1.8, 2.2}),
          .voltage_v = 12.0,
          .pressure_max_pa = 6e5};
}

TEST(Sensitivity, OfTheBaseModelOnARegulatedSource) {
  const Rig rig = RigOf(Regulated(3e5), {TwoElements()});
  const Worst worst = AgainstDifferences(rig, Tight(), 1e-4, Any);
  EXPECT_LT(worst.error, 1e-5) << worst.where;
}

TEST(Sensitivity, OfTwoGroupsBehindOneRegulator) {
  RegulatedSource source = Regulated(3.2e5);
  source.regulator = FlowElement{.sonic_conductance_m3_per_s_pa = 0.15e-8, .critical_ratio = 0.25};
  GroupRig second = TwoElements();
  second.count = 2;
  second.chamber.rest_volume_m3 = 31e-6;
  second.schedule = {{0.25, ValveState::kInflate}, {1.47, ValveState::kDeflate}};
  const Rig rig = RigOf(source, {TwoElements(), second});
  const Worst worst = AgainstDifferences(rig, Tight(), 1e-4, Any);
  EXPECT_LT(worst.error, 1e-5) << worst.where;
}

TEST(Sensitivity, OfADrivenSourceAndTheInletPressure) {
  GroupRig group = TwoElements();
  group.inlet_after = 1;
  const DrivenSource source = {{0.0, 0.2, 0.5, 1.0, 2.0}, {3e5, 2.7e5, 2.8e5, 3.1e5, 2e5}, 0.97};
  const Worst worst = AgainstDifferences(RigOf(source, {group}), Tight(), 1e-4, Any);
  EXPECT_LT(worst.error, 1e-5) << worst.where;
}

// The pressure behind a valve that is partly open follows from the tube's flow.
TEST(Sensitivity, OfTheInletPressureWhileTheValveOpens) {
  GroupRig group = TwoElements();
  group.inlet_after = 1;
  group.effects = {{FindEffect("valve_ramp"), {0.4}}};
  const Worst worst = AgainstDifferences(RigOf(RegulatedSource{3e5}, {group}), Tight(), 1e-4, Any);
  EXPECT_LT(worst.error, 1e-5) << worst.where;
}

// One parameter that moves the volume, both ways through the valve and the source together.
TEST(Sensitivity, AlongADirectionAgreesWithDifferences) {
  Rig rig = RigOf(DrivenSource{{0.0, 0.5, 2.0}, {3e5, 2.7e5, 2.9e5}, 1.0}, {TwoElements()});
  rig.groups[0].effects = {{FindEffect("creep"), {0.2, 0.3}}};
  GroupRig& group = rig.groups[0];
  auto& source = std::get<DrivenSource>(rig.source);
  double* const moved[] = {&group.chamber.rest_volume_m3,
                           &group.fill[0].sonic_conductance_m3_per_s_pa,
                           &group.exhaust[1].sonic_conductance_m3_per_s_pa, &source.factor,
                           &group.effects[0].parameters[0]};
  Direction direction;
  std::vector<double> start;
  for (double* number : moved) {
    start.push_back(*number);
    direction.push_back({number, (start.size() % 2 == 0 ? -0.7 : 1.3) * *number});
  }
  const std::vector<Direction> directions = {{}, direction};
  const SensitivityResponse exact = SimulateAlongDirections(rig, Tight(), directions);
  ASSERT_EQ(exact.response.status, SimulateStatus::kDone) << exact.response.detail;
  const double h = 1e-4;
  const auto at = [&](double shift) {
    for (std::size_t i = 0; i < start.size(); ++i) {
      *moved[i] = start[i] + shift * h * direction[i].weight;
    }
    return Flat(Simulate(rig, Tight()));
  };
  const auto down2 = at(-2), down = at(-1), up = at(1), up2 = at(2);
  std::map<std::string, double> sizes, errors;
  const auto derivatives = Flat(exact.derivatives[1]);
  for (const auto& [name, value] : Flat(exact.response)) {
    const double derivative = derivatives.at(name);
    const double difference =
        (8.0 * (up.at(name) - down.at(name)) - (up2.at(name) - down2.at(name))) / (12.0 * h);
    const double size = std::max(std::abs(difference), 1e-7 * std::abs(value) / h);
    sizes[SeriesOf(name)] = std::max(sizes[SeriesOf(name)], size);
    errors[SeriesOf(name)] = std::max(errors[SeriesOf(name)], std::abs(derivative - difference));
  }
  for (const auto& [name, error] : errors) EXPECT_LE(error, 1e-5 * sizes[name]) << name;
  for (const auto& [name, derivative] : Flat(exact.derivatives[0])) {
    EXPECT_EQ(derivative, 0.0) << name;
  }
}

// The valve closes at the operating pressure; the pump stops, holds and runs again.
TEST(Sensitivity, OfAReservoirWhoseCompressorStops) {
  ReservoirSource source = {.volume_m3 = 0.4e-3,
                            .initial_pressure_pa = 3.5e5,
                            .compressor = Pump(),
                            .compressor_count = 2,
                            .duty = 0.9,
                            .stop_pressure_pa = 3.6e5};
  GroupRig group = TwoElements();
  group.close_at_operating = true;
  const Rig rig = RigOf(source, {group});
  const Worst worst = AgainstDifferences(rig, Tight(), 1e-4, Any);
  EXPECT_LT(worst.error, 1e-5) << worst.where;
}

// Both groups are told at once, and each closes at its own instant, which is the same. The source
// pressures of a stroke have a corner there: the one that acts last sees what the other draws.
// Second derivatives jump as well, so the differences converge in
// the first order and take a shorter step.
TEST(Sensitivity, OfEqualGroupsThatSwitchTogether) {
  ReservoirSource source = {.volume_m3 = 0.5e-3, .initial_pressure_pa = 4e5};
  GroupRig group = TwoElements();
  group.close_at_operating = true;
  const Rig rig = RigOf(source, {group, group});
  const auto smooth = [](const std::string& name) {
    return name.find(".source_") == std::string::npos;
  };
  const Worst worst = AgainstDifferences(rig, Tight(), 2e-6, smooth);
  EXPECT_LT(worst.error, 1e-5) << worst.where;
}

TEST(Sensitivity, OfACommandAtTheStart) {
  GroupRig group = TwoElements();
  group.schedule[0].time_s = 0.0;
  const Rig rig = RigOf(Regulated(3e5), {group});
  const double* start = &rig.groups[0].schedule[0].time_s;
  SimulateOptions options = Tight(1.0);
  const SensitivityResponse r = SimulateWithSensitivities(rig, options, {&start, 1});
  ASSERT_EQ(r.response.status, SimulateStatus::kDone);
  // A later start shifts the whole curve: ∂p/∂t0 = −dp/dt.
  const auto& p = r.response.groups[0].pressure_pa;
  for (std::size_t k = 2; k < 7; ++k) {
    const double rate = (8.0 * (p[k + 1] - p[k - 1]) - (p[k + 2] - p[k - 2])) / (12.0 / 17.3);
    EXPECT_NEAR(r.derivatives[0].groups[0].pressure_pa[k], -rate, 2e-3 * rate) << k;
  }
  EXPECT_NEAR(r.derivatives[0].strokes[0].to_target_s, 0.0, 1e-8);
}

struct EffectCase {
  const char* id;
  const char* law;
  std::vector<double> parameters;
  double bound = 1e-5;
};

class SensitivityOfEffect : public ::testing::TestWithParam<EffectCase> {};

TEST_P(SensitivityOfEffect, AgreesWithDifferences) {
  GroupRig group = TwoElements();
  group.close_at_operating = true;
  group.initial_pressure_pa = 1.02e5;  // laws of leaks have a bend at the ambient pressure
  group.effects = {{FindEffect(GetParam().id, GetParam().law), GetParam().parameters}};
  const Rig rig = RigOf(Regulated(3e5), {group});
  const Worst worst = AgainstDifferences(rig, Tight(), 1e-4, Any);
  EXPECT_LT(worst.error, GetParam().bound) << worst.where;
}

// The orifice of the store turns and changes its regime inside a step.
INSTANTIATE_TEST_SUITE_P(
    Each, SensitivityOfEffect,
    ::testing::Values(
        EffectCase{"valve_delay", "", {0.0213}}, EffectCase{"valve_ramp", "", {0.083}},
        EffectCase{"directional_conductance", "", {0.93}},
        EffectCase{"cracking_pressure", "", {4321.0}},
        EffectCase{"exhaust_restriction", "", {0.12e-8, 0.4}},
        EffectCase{"dead_volume", "", {7e-6}}, EffectCase{"nonlinear_compliance", "", {0.2, -0.15}},
        EffectCase{"hysteresis", "", {4567.0}}, EffectCase{"creep", "", {0.2, 0.3}},
        EffectCase{"inertia", "", {37.0, 0.4}}, EffectCase{"heat_transfer", "", {0.4}},
        EffectCase{"supply_droop", "", {2e-4, 0.08e-8, 0.3}},
        EffectCase{"line_dynamics", "", {0.7, 3e-3}},
        EffectCase{"learned_leak", "pressure_5", {0.01, 0.02, 0.1, 0.3, 0.2}},
        EffectCase{"learned_leak", "opening", {0.3, 0.5, 0.05}},
        EffectCase{"learned_volume", "bend", {0.1, 0.5, 0.05}},
        EffectCase{"learned_leak", "store", {9e-6, 0.004e-8, 0.4}, 2e-4},
        EffectCase{"learned_conductance", "pressure_5", {0.02, -0.03, -0.1, -0.2, 0.1}},
        EffectCase{"learned_conductance", "expansion_3", {0.02, -0.1, -0.2}},
        EffectCase{"learned_volume", "pressure_5", {0.1, 0.2, -0.1, 0.05, 0.02}},
        EffectCase{"learned_volume", "memory_3", {0.07, 0.13, 0.1}},
        EffectCase{"learned_sensor", "pressure_3", {0.01, 0.03, -0.01}},
        EffectCase{"learned_sensor", "drift", {300.0, 0.7, 40.0}},
        EffectCase{"learned_sensor", "swing", {400.0, 1.3, 0.4}},
        EffectCase{"learned_valve", "late", {0.0213}},
        EffectCase{"leak", "orifice", {0.004e-8, 0.3}}, EffectCase{"leak", "laminar", {0.003e-8}},
        EffectCase{"leak", "porous", {1e15, 1e21}}, EffectCase{"sensor_lag", "", {0.02}},
        EffectCase{"sensor_gain", "", {1.03}}, EffectCase{"sensor_offset", "", {512.0}}),
    [](const auto& test) { return std::string(test.param.id) + test.param.law; });

// The lowest pressure of the source is that at the ends of steps, which moves with them.
TEST(Sensitivity, OfASwingingSupply) {
  GroupRig group = TwoElements();
  group.effects = {{FindEffect("learned_supply", "swing"), {0.05, 1.3, 0.4}}};
  const auto smooth = [](const std::string& name) {
    return name.find("source_lowest") == std::string::npos;
  };
  const Worst worst = AgainstDifferences(RigOf(Regulated(3e5), {group}), Tight(), 1e-4, smooth);
  EXPECT_LT(worst.error, 1e-5) << worst.where;
}

// t ∝ V0, t ∝ 1/C and t ∝ T^−½ (Pa·m³ per m³ ANR times the flow's √(T0/T)).
TEST(Sensitivity, OfAFullStrokeFollowsTheScalingOfTime) {
  for (const ValveState state : {ValveState::kInflate, ValveState::kDeflate}) {
    GroupRig group = OneActuator(2e5, 1.7, kValve);
    const bool rises = state == ValveState::kInflate;
    group.initial_pressure_pa = rises ? group.chamber.ambient_pressure_pa : 2e5;
    group.schedule = {{0.0, state}};
    const Rig rig = RigOf(Regulated(3e5), {group});
    const GroupRig& g = rig.groups[0];
    const auto conductance = [](const std::vector<FlowElement>& line) {
      return &line[0].sonic_conductance_m3_per_s_pa;
    };
    const double* parameters[] = {&g.chamber.rest_volume_m3, conductance(g.fill),
                                  conductance(g.exhaust), &rig.ambient.temperature_k};
    const SensitivityResponse r = SimulateWithSensitivities(rig, Tight(), parameters);
    ASSERT_EQ(r.response.status, SimulateStatus::kDone) << r.response.detail;
    const double time_s = r.response.strokes[0].to_target_s;
    const FullStroke plain = FullStrokes(rig, Tight())[0];
    EXPECT_NEAR(time_s, rises ? plain.rise_time_s : plain.fall_time_s, 1e-10 * time_s);
    const double powers[] = {1.0, rises ? -1.0 : 0.0, rises ? 0.0 : -1.0, -0.5};
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_NEAR(r.derivatives[j].strokes[0].to_target_s * *parameters[j], powers[j] * time_s,
                  1e-8 * time_s);
  }
}

TEST(Sensitivity, ValuesAreThoseOfSimulateInAnyNumberOfChunks) {
  const Rig rig = RigOf(Regulated(3e5), {TwoElements()});
  std::vector<const double*> all;
  for (const RigNumber& n : DifferentiableNumbers(rig)) all.push_back(n.number);
  ASSERT_GT(all.size(), 16u);
  const SensitivityResponse together = SimulateWithSensitivities(rig, Tight(), all);
  ASSERT_EQ(together.derivatives.size(), all.size());
  const auto plain = Flat(Simulate(rig, Tight()));
  for (const auto& [name, value] : Flat(together.response)) {
    EXPECT_NEAR(value, plain.at(name), 1e-9 * std::abs(plain.at(name))) << name;
  }
  for (std::size_t j : {0u, 9u, 17u}) {
    const SensitivityResponse alone = SimulateWithSensitivities(rig, Tight(), {&all[j], 1});
    const auto derivatives = Flat(together.derivatives[j]);
    for (const auto& [name, value] : Flat(alone.derivatives[0])) {
      EXPECT_NEAR(value, derivatives.at(name), 1e-8 * std::abs(value)) << name;
    }
  }
  const SensitivityResponse none = SimulateWithSensitivities(rig, Tight(), {});
  EXPECT_EQ(Flat(none.response), Flat(together.response));
  EXPECT_TRUE(none.derivatives.empty());
}

// However many run at once, and in numbers of whatever width.
TEST(Sensitivity, ManyAtOnceAreThoseOfEachAlone) {
  Rig rig = RigOf(Regulated(3e5), {TwoElements()});
  rig.groups[0].effects = {{FindEffect("heat_transfer"), {0.5}}};
  std::vector<const double*> all;
  for (const RigNumber& n : DifferentiableNumbers(rig)) all.push_back(n.number);
  SimulateOptions options = Until(2.5, 17.3);
  for (const Integrator integrator : {Integrator::kDamped, Integrator::kImplicit}) {
    options.integrator = integrator;
    std::vector<std::map<std::string, double>> alone;
    for (const double*& number : all)
      alone.push_back(Flat(SimulateWithSensitivities(rig, options, {&number, 1}).derivatives[0]));
    for (const std::size_t count : {10u, 11u, 12u, 13u, 18u}) {
      ASSERT_LE(count, all.size());
      const SensitivityResponse together =
          SimulateWithSensitivities(rig, options, {all.data(), count});
      ASSERT_EQ(together.response.status, SimulateStatus::kDone);
      ASSERT_EQ(together.derivatives.size(), count);
      for (std::size_t j = 0; j < count; ++j) {
        double largest = 0.0;
        for (const auto& [name, value] : alone[j])
          if (name.starts_with("group0.pressure")) largest = std::max(largest, std::abs(value));
        for (const auto& [name, value] : Flat(together.derivatives[j])) {
          if (!name.starts_with("group0.pressure")) continue;
          EXPECT_NEAR(value, alone[j].at(name), 1e-4 * largest) << count << " " << j << name;
        }
      }
    }
  }
}

TEST(Sensitivity, RefusesWhatIsNoNumberOfTheRig) {
  const Rig rig = RigOf(Regulated(3e5), {TwoElements()});
  const double stranger = 1.0;
  const double* parameters[] = {&rig.groups[0].chamber.rest_volume_m3, &stranger};
  const SensitivityResponse r = SimulateWithSensitivities(rig, Tight(), parameters);
  EXPECT_EQ(r.response.status, SimulateStatus::kInvalid);
  EXPECT_THAT(r.response.detail, ::testing::HasSubstr("parameters[1]"));
  const std::vector<Direction> infinite = {{{parameters[0], kInf}}};
  EXPECT_EQ(SimulateAlongDirections(rig, Tight(), infinite).response.status,
            SimulateStatus::kInvalid);
  const double* copy = &rig.groups[0].chamber.ambient_pressure_pa;
  const Response refused = SimulateWithSensitivities(rig, Tight(), {&copy, 1}).response;
  EXPECT_EQ(refused.status, SimulateStatus::kInvalid);
  EXPECT_THAT(refused.detail, ::testing::HasSubstr("ambient.pressure_pa itself"));
}

TEST(Sensitivity, OfATargetNeverReachedIsZeroBesideAnInfiniteTime) {
  const Rig rig = RigOf(Regulated(1.9e5), {TwoElements()});
  const double* source = &std::get<RegulatedSource>(rig.source).pressure_pa;
  const SensitivityResponse r = SimulateWithSensitivities(rig, Tight(), {&source, 1});
  ASSERT_EQ(r.response.status, SimulateStatus::kDone) << r.response.detail;
  EXPECT_EQ(r.response.strokes[0].to_target_s, kInf);
  EXPECT_EQ(r.derivatives[0].strokes[0].to_target_s, 0.0);
}

// Where all values rest no step is too long for them, but the derivatives still move.
TEST(Sensitivity, OfALaggingReadingAtRestDecaysWithThePressure) {
  for (const double lag_s : {0.002, 0.02, 0.2}) {
    GroupRig group = TwoElements();
    group.effects = {{FindEffect("leak", "porous"), {7e15, 0.0}},
                     {FindEffect("sensor_lag"), {lag_s}}};
    group.initial_pressure_pa = group.chamber.ambient_pressure_pa;
    group.schedule = {};
    Rig rig = RigOf(Regulated(3e5), {group});
    const SimulateOptions options = Until(300.0, 0.1);
    const double* by = &rig.groups[0].initial_pressure_pa;
    const SensitivityResponse r = SimulateWithSensitivities(rig, options, {&by, 1});
    ASSERT_EQ(r.response.status, SimulateStatus::kDone) << r.response.detail;
    constexpr double kShiftPa = 10.0;
    rig.groups[0].initial_pressure_pa += kShiftPa;
    const Response shifted = Simulate(rig, options);
    for (std::size_t i = 0; i < r.response.t_s.size(); ++i) {
      const double rest_pa = r.response.groups[0].reading_pa[i];
      const double difference = (shifted.groups[0].reading_pa[i] - rest_pa) / kShiftPa;
      EXPECT_NEAR(r.derivatives[0].groups[0].reading_pa[i], difference, 1e-3)
          << "lag " << lag_s << " s, t " << r.response.t_s[i] << " s";
    }
  }
}

// While the chamber vents to its end, loose tolerances ask for steps that are too long for what a
// line does within them. No derivative may grow there.
TEST(Sensitivity, OfALineAtALooseToleranceStaysAtThoseOfATightOne) {
  for (int draw = 0; draw < 20; ++draw) {
    GroupRig group = TwoElements();
    group.effects = {{FindEffect("line_dynamics"), {0.3 + 0.04 * draw, 2.3e-3}}};
    group.schedule = {{0.5, ValveState::kInflate},
                      {1.0, ValveState::kHold},
                      {2.0, ValveState::kDeflate},
                      {6.5, ValveState::kHold}};
    const Rig rig = RigOf(Regulated(3.8e5), {group});
    SimulateOptions options = Until(7.0, 50.0);
    options.integrator = Integrator::kDormandPrince;
    const double* by = &rig.groups[0].initial_pressure_pa;
    options.relative_tolerance = 1e-8;
    const SensitivityResponse tight = SimulateWithSensitivities(rig, options, {&by, 1});
    options.relative_tolerance = 3e-5;
    options.absolute_tolerance_pa = 0.3;
    const SensitivityResponse loose = SimulateWithSensitivities(rig, options, {&by, 1});
    ASSERT_EQ(loose.response.status, SimulateStatus::kDone) << loose.response.detail;
    for (std::size_t i = 0; i < loose.response.t_s.size(); ++i)
      ASSERT_NEAR(loose.derivatives[0].groups[0].pressure_pa[i],
                  tight.derivatives[0].groups[0].pressure_pa[i], 0.03)
          << "draw " << draw << ", t " << loose.response.t_s[i] << " s";
  }
}

// A closed chamber keeps its pressures at any size: their derivatives by it are rounding, which no
// step, however short, makes smaller.
TEST(Sensitivity, OfWhatIsNothingButRoundingAsksForNoShorterSteps) {
  for (int draw = 0; draw < 200; ++draw) {
    GroupRig group = OneActuator(2e5, 1.55, kValve);
    group.chamber.rest_volume_m3 = 1e-6 * (20.0 + 7.3 * (draw % 25));
    group.effects = {{FindEffect("creep"), {0.0744, 1.54 + 0.013 * (draw % 11)}}};
    group.schedule = {};
    group.initial_pressure_pa = group.chamber.ambient_pressure_pa + 11.1 * (draw - 100) + 1.1;
    const Rig rig = RigOf(Regulated(3e5), {group});
    SimulateOptions options = Until(2.0, 100.0);
    options.relative_tolerance = 5e-7;
    options.absolute_tolerance_pa = 5e-3;
    const double* volume = &rig.groups[0].chamber.rest_volume_m3;
    const std::vector<Direction> size = {{{volume, 0.97 * *volume}}};
    const SensitivityResponse r = SimulateAlongDirections(rig, options, size);
    ASSERT_EQ(r.response.status, SimulateStatus::kDone) << r.response.detail;
    EXPECT_LT(r.response.steps, 100u) << draw;
    const std::vector<double>& pressure_pa = r.response.groups[0].pressure_pa;
    EXPECT_NE(pressure_pa.back(), pressure_pa.front());
    for (const double derivative_pa : r.derivatives[0].groups[0].pressure_pa)
      EXPECT_NEAR(derivative_pa, 0.0, 1e-9 * pressure_pa.front());
  }
}

}  // namespace sensitivity_test
}  // namespace plenum::model
