// The simulator against an independent one that counts masses, on random rigs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "model/simulate/simulate.h"
#include "tests/support/mass_form.h"

namespace plenum::model {
namespace simulate_mass_form_test {

enum class Kind { kRegulated, kRegulator, kFlowMax, kReservoir, kCompressor };

// The same rig twice, as each simulator wants it.
struct Twins {
  Rig rig;
  test::MassRig mass;
};

class RandomRigs {
 public:
  explicit RandomRigs(unsigned seed) : generator_(seed) {}

  Twins Draw(Kind kind) {
    Twins twins;
    const double ambient_pa = Uniform(0.85e5, 1.05e5);
    twins.rig.ambient = {ambient_pa, Uniform(275.0, 310.0)};
    twins.rig.gas = Uniform(0.0, 1.0) < 0.25 ? Gas::kCo2 : Gas::kAir;
    twins.mass.ambient_pa = ambient_pa;
    twins.mass.temperature_k = twins.rig.ambient.temperature_k;
    twins.mass.gas_factor = twins.rig.gas == Gas::kCo2 ? 0.79 : 1.0;
    const int groups = Integer(1, 3);
    for (int i = 0; i < groups; ++i) AddGroup(twins, ambient_pa);
    AddSource(twins, kind, ambient_pa);
    return twins;
  }

 private:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  int Integer(int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(generator_);
  }

  void AddElements(double conductance, bool cracking, std::vector<FlowElement>& elements,
                   std::vector<test::MassElement>& copies) {
    const int size = Integer(1, 5);
    for (int i = 0; i < size; ++i) {
      const FlowElement element{conductance * std::sqrt(size) * Uniform(0.7, 2.0),
                                Uniform(0.0, 0.55), Uniform(0.0, 1.0) < 0.2 ? 0.55 : 0.5,
                                cracking ? Uniform(0.0, 2e3) : 0.0};
      elements.push_back(element);
      copies.push_back({element.sonic_conductance_m3_per_s_pa, element.critical_ratio,
                        element.subsonic_index, element.cracking_pressure_pa});
    }
  }

  void AddGroup(Twins& twins, double ambient_pa) {
    GroupRig group;
    test::MassGroup mass;
    const double v0 = Uniform(20e-6, 100e-6), dead = Uniform(0.0, 10e-6);
    const double expansion = Uniform(1.0, 3.0), above = Uniform(0.4e5, 1.5e5);
    group.count = mass.count = Integer(1, 4);
    group.chamber.rest_volume_m3 = v0;
    group.chamber.dead_volume_m3 = dead;
    group.chamber.expansion_ratio = expansion;
    group.chamber.operating_pressure_pa = mass.operating_pa = ambient_pa + above;
    group.chamber.ambient_pressure_pa = ambient_pa;
    group.initial_pressure_pa = mass.initial_pa = ambient_pa + Uniform(0.0, 0.3) * above;
    mass.volume_m3 = [=](double p) {
      return dead + v0 * (1.0 + (expansion - 1.0) * (p - ambient_pa) / above);
    };
    const bool cracking = Uniform(0.0, 1.0) < 0.2;
    const double conductance = v0 / 1e5 * Uniform(1.0, 3.0);
    AddElements(conductance, cracking, group.fill, mass.fill);
    AddElements(conductance, cracking, group.exhaust, mass.exhaust);
    group.close_at_operating = mass.close_at_operating = Uniform(0.0, 1.0) < 0.6;
    const double frequency_hz = Uniform(0.5, 1.5);
    group.schedule = CycleSchedule(frequency_hz, Uniform(0.3, 0.6), 3, Uniform(0.0, 0.5));
    for (const ValveCommand& command : group.schedule) {
      mass.schedule.push_back({command.time_s, command.state == ValveState::kInflate ? 1 : -1});
    }
    twins.rig.groups.push_back(group);
    twins.mass.groups.push_back(mass);
  }

  void AddSource(Twins& twins, Kind kind, double ambient_pa) {
    test::MassRig& mass = twins.mass;
    mass.source_pa = ambient_pa + Uniform(1.6e5, 4e5);
    double conductance = 0.0;  // of all lines together, roughly
    for (const GroupRig& group : twins.rig.groups) {
      conductance += group.count * group.fill[0].sonic_conductance_m3_per_s_pa;
    }
    if (kind == Kind::kReservoir || kind == Kind::kCompressor) {
      mass.source = test::MassRig::Source::kReservoir;
      mass.reservoir_m3 = Uniform(0.3e-3, 3e-3);
      ReservoirSource source{.volume_m3 = mass.reservoir_m3, .initial_pressure_pa = mass.source_pa};
      if (kind == Kind::kCompressor) {
        // Straight, so that the interpolations agree.
        const double flow = conductance * mass.source_pa * Uniform(0.1, 0.8);
        const double end_pa = mass.source_pa + 1e5;
        mass.delivery = {{0.8e5, flow}, {end_pa, 0.4 * flow}};
        mass.stop_pa = mass.source_pa + Uniform(-0.2e5, 0.2e5);
        source.stop_pressure_pa = mass.stop_pa;
        source.duty = 0.8;
        source.compressor_count = 2;
        source.compressor.free_air_m3_per_s =
            MonotoneCurve({0.8e5, end_pa}, {flow / 1.6, 0.4 * flow / 1.6});
        source.compressor.pressure_max_pa = end_pa;
      }
      twins.rig.source = source;
      return;
    }
    mass.source = test::MassRig::Source::kRegulated;
    RegulatedSource source{.pressure_pa = mass.source_pa};
    if (kind != Kind::kRegulated) {
      source.regulator = FlowElement{conductance * Uniform(0.5, 2.0), Uniform(0.1, 0.5)};
      mass.regulator = {{source.regulator->sonic_conductance_m3_per_s_pa,
                         source.regulator->critical_ratio, 0.5, 0.0}};
    }
    if (kind == Kind::kFlowMax) {
      source.flow_max_m3_per_s = conductance * mass.source_pa * Uniform(0.1, 0.4);
      mass.flow_max_m3_per_s = source.flow_max_m3_per_s;
    }
    twins.rig.source = source;
  }

  std::mt19937 generator_;
};

class AgainstMassForm : public ::testing::TestWithParam<Kind> {};

TEST_P(AgainstMassForm, PressuresAgreeOnRandomRigs) {
  RandomRigs rigs(20240 + static_cast<unsigned>(GetParam()));
  for (int trial = 0; trial < 9; ++trial) {
    SCOPED_TRACE(trial);
    const Twins twins = rigs.Draw(GetParam());
    SimulateOptions options;
    options.end_s = 1.5;
    options.sample_hz = 20.0;
    const Response r = Simulate(twins.rig, options);
    ASSERT_EQ(r.status, SimulateStatus::kDone) << r.detail;
    const test::MassResult m = test::SimulateMasses(twins.mass, 1.5, 2e-3, 0.05);
    ASSERT_EQ(r.t_s.size(), m.t_s.size());
    double largest = 0.0, swing = 0.0;
    for (std::size_t i = 0; i < r.t_s.size(); ++i) {
      ASSERT_NEAR(r.t_s[i], m.t_s[i], 1e-12);
      for (std::size_t g = 0; g < r.groups.size(); ++g) {
        const double p = r.groups[g].pressure_pa[i];
        largest = std::max(largest, std::abs(p / m.pressure_pa[g][i] - 1.0));
        swing = std::max(swing, p - twins.rig.ambient.pressure_pa);
      }
      largest = std::max(largest, std::abs(r.source_pressure_pa[i] / m.source_pa[i] - 1.0));
    }
    EXPECT_LT(largest, 1e-4);
    EXPECT_GT(swing, 0.2e5);
    EXPECT_NEAR(m.gas_kg - m.gas_start_kg, m.delivered_kg - m.vented_kg, 1e-10 * m.gas_kg);
    RecordProperty("largest", std::to_string(largest));
    if (GetParam() != Kind::kCompressor) continue;
    const double delivered_m3 = m.delivered_kg * 287.05 * 293.15 / 1e5;
    EXPECT_NEAR(r.compressor_air_m3, delivered_m3, 1e-4 * delivered_m3);
  }
}

// The reference itself against a closed-form time: 1 to 2 bar out of 3 bar, V0 50 mL, ε 2, b 0.3.
TEST(MassForm, ReachesTheOperatingPressureAtTheClosedFormTime) {
  test::MassRig rig;
  rig.source = test::MassRig::Source::kRegulated;
  rig.source_pa = 3e5;
  test::MassGroup group;
  group.volume_m3 = [](double p) { return 50e-6 * p / 1e5; };
  group.operating_pa = 2e5;
  group.fill = {{50e-6 / 1e5, 0.3}};
  group.schedule = {{0.0, 1}};
  rig.groups = {group};
  const test::MassResult result = test::SimulateMasses(rig, 1.066905, 1e-3, 1.066905);
  EXPECT_NEAR(result.pressure_pa[0].back(), 2e5, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Sources, AgainstMassForm,
                         ::testing::Values(Kind::kRegulated, Kind::kRegulator, Kind::kFlowMax,
                                           Kind::kReservoir, Kind::kCompressor));

}  // namespace simulate_mass_form_test
}  // namespace plenum::model
