// Two integrators, one system: Dormand–Prince with its own event location against CVODE's BDF with
// CVODE's root finding, on random rigs with random effects.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "model/simulate/simulate.h"
#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace integrators_test {

class RandomRigs {
 public:
  explicit RandomRigs(unsigned seed) : generator_(seed) {}

  Rig Draw() {
    Rig rig;
    rig.ambient = {Uniform(0.85e5, 1.05e5), Uniform(275.0, 310.0)};
    if (Coin(0.2)) rig.gas = Gas::kCo2;
    const int groups = 1 + static_cast<int>(Uniform(0.0, 3.0));
    for (int i = 0; i < groups; ++i) rig.groups.push_back(DrawGroup(rig.ambient));
    double highest_pa = 0.0;
    for (const GroupRig& group : rig.groups) {
      highest_pa = std::max(highest_pa, group.chamber.operating_pressure_pa);
    }
    if (Coin()) {
      RegulatedSource source = Regulated(highest_pa * Uniform(0.97, 2.5));
      if (Coin(0.4)) source.regulator = DrawElement();
      if (Coin(0.2)) source.flow_max_m3_per_s = Uniform(1e-4, 1e-3);
      rig.source = source;
    } else {
      rig.source = DrawReservoir(highest_pa);
    }
    return rig;
  }

 private:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  double LogUniform(double low, double high) {
    return std::exp(Uniform(std::log(low), std::log(high)));
  }
  bool Coin(double chance = 0.5) { return Uniform(0.0, 1.0) < chance; }

  FlowElement DrawElement() {
    return {.sonic_conductance_m3_per_s_pa = LogUniform(0.04e-8, 0.4e-8),
            .critical_ratio = Uniform(0.1, 0.5)};
  }

  ReservoirSource DrawReservoir(double highest_pa) {
    ReservoirSource source;
    source.volume_m3 = LogUniform(0.1e-3, 2e-3);
    source.initial_pressure_pa = highest_pa * Uniform(1.1, 2.5);
    if (Coin(0.3)) return source;
    const double scale = LogUniform(0.3, 3.0);
    source.compressor = {
        .free_air_m3_per_s = MonotoneCurve(
            {1e5, 2e5, 4e5, 7e5}, {2e-4 * scale, 1.6e-4 * scale, 1e-4 * scale, 0.3e-4 * scale}),
        .current_a = MonotoneCurve({1e5, 3e5, 7e5}, {1.0, 1.8, 2.2}),
        .voltage_v = 12.0,
        .pressure_max_pa = 7e5};
    source.compressor_count = Coin() ? 1 : 2;
    source.duty = Uniform(0.3, 1.0);
    if (Coin(0.7)) source.stop_pressure_pa = source.initial_pressure_pa * Uniform(0.97, 1.05);
    return source;
  }

  GroupRig DrawGroup(const Ambient& ambient) {
    GroupRig group;
    group.count = 1 + static_cast<int>(Uniform(0.0, 4.0));
    group.chamber = {.rest_volume_m3 = LogUniform(15e-6, 120e-6),
                     .expansion_ratio = Uniform(1.0, 2.5),
                     .operating_pressure_pa = ambient.pressure_pa + Uniform(0.4e5, 1.5e5),
                     .ambient_pressure_pa = ambient.pressure_pa,
                     .dead_volume_m3 = Uniform(0.5e-6, 5e-6),
                     .volume_curve = {}};
    const int elements = 1 + static_cast<int>(Uniform(0.0, 5.0));
    for (int k = 0; k < elements; ++k) group.fill.push_back(DrawElement());
    group.exhaust.assign(group.fill.rbegin(), group.fill.rend());
    group.initial_pressure_pa = ambient.pressure_pa + (Coin() ? 0.0 : Uniform(0.0, 0.3e5));
    group.close_at_operating = Coin();
    group.blocked = Coin(0.15);
    double time_s = Uniform(0.0, 0.2);
    for (int k = 0; k < 2; ++k) {
      group.schedule.push_back({time_s, ValveState::kInflate});
      time_s += Uniform(0.1, 0.4);
      if (Coin()) group.schedule.push_back({time_s, ValveState::kHold}), time_s += 0.07;
      group.schedule.push_back({time_s, ValveState::kDeflate});
      time_s += Uniform(0.1, 0.4);
    }
    AddEffects(group, ambient);
    return group;
  }

  void Add(GroupRig& group, const char* id, std::vector<double> parameters, const char* law = "") {
    if (Coin(share_of_effects_)) {
      group.effects.push_back({FindEffect(id, law), std::move(parameters)});
    }
  }

  void AddEffects(GroupRig& group, const Ambient& ambient) {
    share_of_effects_ = Coin(0.3) ? 0.0 : Uniform(0.05, 0.6);
    Add(group, "valve_delay", {Uniform(0.001, 0.06)});
    Add(group, "valve_ramp", {Uniform(0.005, 0.15)});
    Add(group, "directional_conductance", {Uniform(0.8, 1.2)});
    Add(group, "cracking_pressure", {Uniform(300.0, 6e3)});
    Add(group, "exhaust_restriction", {LogUniform(0.04e-8, 0.4e-8), Uniform(0.1, 0.5)});
    Add(group, "dead_volume", {Uniform(0.0, 10e-6)});
    // Past the operating pressure a negative curvature makes the volume shrink as the pressure
    // rises, and with inertia both run away: only for actuators that stop there.
    const double lowest_curvature = group.close_at_operating ? -0.3 : 0.0;
    Add(group, "nonlinear_compliance", {Uniform(lowest_curvature, 0.3), Uniform(-0.3, 0.3)});
    Add(group, "hysteresis", {Uniform(500.0, 8e3)});
    Add(group, "creep", {Uniform(0.02, 0.4), LogUniform(0.05, 5.0)});
    Add(group, "inertia", {LogUniform(15.0, 120.0), Uniform(0.2, 1.5)});
    Add(group, "heat_transfer", {LogUniform(0.02, 20.0)});
    Add(group, "supply_droop",
        {LogUniform(20e-6, 500e-6), LogUniform(0.05e-8, 0.5e-8), Uniform(0.1, 0.5)});
    Add(group, "line_dynamics", {Uniform(0.3, 2.0), Uniform(2e-3, 5e-3)});
    const double law = Uniform(0.0, 3.0);
    if (law < 1.0) {
      Add(group, "leak", {LogUniform(1e-12, 1e-10), 0.3}, "orifice");
    } else if (law < 2.0) {
      Add(group, "leak", {LogUniform(1e-12, 5e-11)}, "laminar");
    } else {
      Add(group, "leak", {LogUniform(1e14, 1e16), 1e21}, "porous");
    }
    Add(group, "sensor_lag", {LogUniform(2e-3, 0.1)});
    Add(group, "sensor_gain", {Uniform(0.9, 1.1)});
    Add(group, "sensor_offset", {Uniform(-1e3, 1e3)});
    if (Coin(0.3)) group.initial_temperature_k = ambient.temperature_k + Uniform(-20.0, 20.0);
  }

  std::mt19937 generator_;
  double share_of_effects_ = 0.0;
};

std::string Describe(const Rig& rig) {
  std::ostringstream text;
  text << "source kind " << rig.source.index();
  for (const GroupRig& group : rig.groups) {
    text << "; " << group.count << "x, " << group.fill.size() << " elements"
         << (group.close_at_operating ? ", closes" : "");
    for (const Effect& effect : group.effects) text << ", " << effect.spec->id;
  }
  return text.str();
}

struct Difference {
  double share = 0.0;
  std::string where;
  void See(const std::string& name, double a, double b, double size) {
    if (a == b) return;
    const double d = std::abs(a - b) / size;
    if (!(d <= share)) share = d, where = name;
  }
};

Difference Compare(const Rig& rig, const Response& a, const Response& b) {
  Difference worst;
  for (std::size_t i = 0; i < a.groups.size(); ++i) {
    const GroupResponse &x = a.groups[i], &y = b.groups[i];
    const std::string name = "group " + std::to_string(i) + " ";
    const auto series = [&](const char* what, const std::vector<double>& u,
                            const std::vector<double>& v) {
      EXPECT_EQ(u.size(), v.size());
      for (std::size_t k = 0; k < u.size(); ++k) {
        worst.See(name + what + " sample " + std::to_string(k), u[k], v[k], std::abs(u[k]));
      }
    };
    series("pressure", x.pressure_pa, y.pressure_pa);
    series("reading", x.reading_pa, y.reading_pa);
    series("volume", x.volume_m3, y.volume_m3);
    series("temperature", x.temperature_k, y.temperature_k);
    const Chamber& chamber = rig.groups[i].chamber;
    const double gas_m3 = rig.groups[i].count * Content(chamber, chamber.operating_pressure_pa) /
                          kReferencePressurePa;
    const double energy_j = gas_m3 * kReferencePressurePa;
    worst.See(name + "drawn", x.air_drawn_m3, y.air_drawn_m3, gas_m3);
    worst.See(name + "in", x.air_in_m3, y.air_in_m3, gas_m3);
    worst.See(name + "out", x.air_out_m3, y.air_out_m3, gas_m3);
    worst.See(name + "leaked", x.air_leaked_m3, y.air_leaked_m3, gas_m3);
    worst.See(name + "stored", x.gas_final_m3, y.gas_final_m3, gas_m3);
    worst.See(name + "enthalpy in", x.enthalpy_in_j, y.enthalpy_in_j, energy_j);
    worst.See(name + "enthalpy out", x.enthalpy_out_j, y.enthalpy_out_j, energy_j);
    worst.See(name + "wall heat", x.wall_heat_j, y.wall_heat_j, energy_j);
    worst.See(name + "work", x.work_j, y.work_j, energy_j);
  }
  for (std::size_t k = 0; k < a.source_pressure_pa.size(); ++k) {
    worst.See("source sample " + std::to_string(k), a.source_pressure_pa[k],
              b.source_pressure_pa[k], a.source_pressure_pa[k]);
  }
  worst.See("on-time", a.compressor_on_s, b.compressor_on_s, 1.0);
  worst.See("pumped", a.compressor_air_m3, b.compressor_air_m3,
            std::max(1e-4, a.compressor_air_m3));
  worst.See("energy", a.compressor_energy_j, b.compressor_energy_j,
            std::max(1.0, a.compressor_energy_j));
  EXPECT_EQ(a.strokes.size(), b.strokes.size());
  for (std::size_t k = 0; k < std::min(a.strokes.size(), b.strokes.size()); ++k) {
    const Stroke &x = a.strokes[k], &y = b.strokes[k];
    const std::string name = "stroke " + std::to_string(k) + " ";
    worst.See(name + "target", x.to_target_s, y.to_target_s, 0.1);
    worst.See(name + "operating", x.to_operating_s, y.to_operating_s, 0.1);
    worst.See(name + "source lowest", x.source_lowest_pressure_pa, y.source_lowest_pressure_pa,
              x.source_lowest_pressure_pa);
  }
  return worst;
}

SimulateOptions With(Integrator integrator, double end_s = 1.6) {
  SimulateOptions options = Until(end_s, 37.0);
  options.integrator = integrator;
  options.relative_tolerance = integrator == Integrator::kCvode ? 1e-11 : 1e-10;
  options.absolute_tolerance_pa = 1e-6;
  return options;
}

#ifdef PLENUM_SANITIZED
constexpr int kRigsPerShard = 4;
#else
constexpr int kRigsPerShard = 64;
#endif

class Integrators : public ::testing::TestWithParam<int> {};

TEST_P(Integrators, AgreeOnRandomRigs) {
  RandomRigs rigs(1000u + static_cast<unsigned>(GetParam()));
  for (int i = 0; i < kRigsPerShard; ++i) {
    const Rig rig = rigs.Draw();
    const Response explicit_run = Simulate(rig, With(Integrator::kDormandPrince));
    const Response cvode_run = Simulate(rig, With(Integrator::kCvode));
    EXPECT_EQ(explicit_run.status, SimulateStatus::kDone)
        << i << ": " << explicit_run.detail << " " << Describe(rig);
    EXPECT_EQ(cvode_run.status, SimulateStatus::kDone)
        << i << ": " << cvode_run.detail << " " << Describe(rig);
    if (explicit_run.status != SimulateStatus::kDone || cvode_run.status != SimulateStatus::kDone) {
      continue;
    }
    const Difference worst = Compare(rig, explicit_run, cvode_run);
    EXPECT_LT(worst.share, 1e-6) << i << ": " << worst.where << " " << Describe(rig);
  }
}

INSTANTIATE_TEST_SUITE_P(Shards, Integrators, ::testing::Range(0, 8));

Rig StiffRig() {
  GroupRig group = OneActuator(2e5, 2.0, {0.1e-8, 0.3});
  group.schedule = {{0.0, ValveState::kInflate}, {2.0, ValveState::kDeflate}};
  group.effects = {{FindEffect("sensor_lag"), {1e-5}}, {FindEffect("heat_transfer"), {1e-4}}};
  return RigOf(Regulated(3e5), {group});
}

TEST(IntegratorChoice, AStiffRigGoesOverToCvode) {
  SimulateOptions options = Until(4.0, 50.0);
  const Response automatic = Simulate(StiffRig(), options);
  ASSERT_EQ(automatic.status, SimulateStatus::kDone) << automatic.detail;
  EXPECT_TRUE(automatic.stiff);
  EXPECT_LT(automatic.steps, 20'000u);
  // So fast a wall is isothermal, and so fast a sensor shows the pressure.
  Rig isothermal = StiffRig();
  isothermal.groups[0].effects.clear();
  const Response base = Simulate(isothermal, options);
  EXPECT_FALSE(base.stiff);
  const GroupResponse &a = automatic.groups[0], &b = base.groups[0];
  for (std::size_t k = 0; k < base.t_s.size(); ++k) {
    EXPECT_NEAR(a.pressure_pa[k], b.pressure_pa[k], 1e-3 * b.pressure_pa[k]) << k;
    EXPECT_NEAR(a.reading_pa[k], a.pressure_pa[k], 1e-4 * a.pressure_pa[k]) << k;
  }
  options.integrator = Integrator::kDormandPrince;
  const Response held = Simulate(StiffRig(), options);
  ASSERT_EQ(held.status, SimulateStatus::kDone) << held.detail;
  EXPECT_FALSE(held.stiff);
  EXPECT_GT(held.steps, 10 * automatic.steps);
  for (std::size_t k = 0; k < base.t_s.size(); ++k) {
    EXPECT_NEAR(a.pressure_pa[k], held.groups[0].pressure_pa[k], 1e-6 * a.pressure_pa[k]) << k;
  }
}

TEST(IntegratorStatus, SaysWhereAndWhy) {
  for (const Integrator integrator : {Integrator::kDormandPrince, Integrator::kCvode}) {
    SimulateOptions options = With(integrator);
    Rig rig = StiffRig();
    rig.groups[0].effects.clear();
    options.steps_max = 20;
    const Response few = Simulate(rig, options);
    EXPECT_EQ(few.status, SimulateStatus::kTooManySteps);
    EXPECT_THAT(few.detail, ::testing::StartsWith("more than 20 steps at t = "));
    EXPECT_EQ(few.steps, 20u);

    options = With(integrator);
    options.cancelled = [] { return true; };
    const Response cancelled = Simulate(rig, options);
    EXPECT_EQ(cancelled.status, SimulateStatus::kCancelled);
    EXPECT_THAT(cancelled.detail, ::testing::StartsWith("cancelled at t = "));

    // The slope of the volume law is so negative past the operating pressure that more pressure
    // holds less gas.
    options = With(integrator);
    rig.groups[0].effects = {{FindEffect("nonlinear_compliance"), {-1.0, 0.0}}};
    const Response bent = Simulate(rig, options);
    EXPECT_EQ(bent.status, SimulateStatus::kNotFinite) << bent.detail;
    EXPECT_THAT(bent.detail, ::testing::HasSubstr("leave their range"));
    EXPECT_THAT(bent.detail, ::testing::HasSubstr(" at t = "));
  }
}

}  // namespace integrators_test
}  // namespace plenum::model
