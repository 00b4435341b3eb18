// Rigs shared by the tests of the independent simulator of effects.
#ifndef PLENUM_TESTS_MODEL_EFFECTS_EFFECT_RIGS_H_
#define PLENUM_TESTS_MODEL_EFFECTS_EFFECT_RIGS_H_

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/effects/effect_form.h"

namespace plenum::test {

inline constexpr double kCloseS = 1.066905;  // closed-form time from 1 to 2 bar out of 3 bar
inline constexpr double kUnitC = 1e-8;       // m³/(s·Pa) in 1 dm³/(s·bar)

using Change = std::function<void(EffectRig&)>;

// 50 mL, ε 2, 0.05 dm³/(s·bar), 3 bar: up to the operating pressure, 5 s of hold, down.
inline EffectRig Bench(const Change& change = [](EffectRig&) {}) {
  EffectRig rig;
  rig.fill = rig.exhaust = {{0.05 * kUnitC, 0.3}};
  rig.schedule = {{0.0, 1}, {kCloseS, 0}, {kCloseS + 5.0, -1}};
  change(rig);
  return rig;
}

inline std::vector<double> Every(double interval_s, double end_s) {
  std::vector<double> times;
  const int count = static_cast<int>(std::lround(end_s / interval_s));
  for (int i = 0; i <= count; ++i) times.push_back(i * interval_s);
  return times;
}

inline double LargestDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

inline double BoreVolume(const LineDynamics& line) {
  return std::numbers::pi * line.inner_diameter_m * line.inner_diameter_m / 4.0 * line.length_m;
}

// Any subset of effects at once.
class RandomEffectRigs {
 public:
  explicit RandomEffectRigs(unsigned seed) : generator_(seed) {}

  EffectRig Draw() {
    EffectRig rig;
    rig.rest_volume_m3 = Uniform(30e-6, 100e-6);
    rig.expansion_ratio = Uniform(1.2, 2.5);
    rig.ambient_pa = Uniform(0.85e5, 1.05e5);
    rig.ambient_k = Uniform(275.0, 310.0);
    rig.operating_pa = rig.ambient_pa + Uniform(0.5e5, 1.5e5);
    rig.initial_pa = rig.ambient_pa + Uniform(0.0, 0.3e5);
    rig.source_pa = rig.operating_pa + Uniform(0.3e5, 2e5);
    rig.blocked = Coin(0.2);
    if (Coin()) {
      rig.source = EffectRig::Source::kReservoir;
      rig.reservoir_m3 = Uniform(0.2e-3, 1e-3);
    }
    rig.fill = rig.exhaust = {{Uniform(0.05, 0.2) * kUnitC, Uniform(0.1, 0.5)},
                              {Uniform(0.05, 0.2) * kUnitC, Uniform(0.1, 0.5)}};
    std::reverse(rig.exhaust.begin(), rig.exhaust.end());
    rig.schedule = {{0.05, 1}, {0.35, 0}, {0.6, 1}, {0.7, -1}, {0.9, 0}, {1.0, -1}};
    AddGasEffects(rig);
    AddWallEffects(rig);
    return rig;
  }

 private:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  bool Coin(double chance = 0.5) { return Uniform(0.0, 1.0) < chance; }

  void AddGasEffects(EffectRig& rig) {
    if (Coin()) {
      const double law = Uniform(0.0, 3.0);
      if (law < 1.0) {
        rig.leak = OrificeLeak{0.01 * kUnitC, 0.3};
      } else if (law < 2.0) {
        rig.leak = LaminarLeak{0.005 * kUnitC};
      } else {
        rig.leak = PorousLeak{1e15, 1e21};
      }
    }
    if (Coin()) {
      rig.heat_time_constant_s = Uniform(0.1, 3.0);
      rig.initial_k = rig.ambient_k + Uniform(-20.0, 20.0);
    }
    if (Coin()) rig.valve_delay_s = Uniform(0.001, 0.05);
    if (Coin()) rig.valve_ramp_s = Uniform(0.01, 0.15);
    if (Coin()) rig.dead_volume_m3 = Uniform(1e-6, 10e-6);
    if (Coin()) rig.supply_droop = {Uniform(50e-6, 500e-6), 0.05 * kUnitC, 0.3};
    if (Coin()) rig.exhaust_restriction = {0.1 * kUnitC, 0.4};
    if (Coin()) rig.cracking_pa = Uniform(500.0, 5e3);
    if (Coin()) rig.fill_factor = Uniform(0.9, 1.1);
    if (Coin()) rig.line = {Uniform(2e-3, 4e-3), Uniform(0.3, 1.0)};
  }

  void AddWallEffects(EffectRig& rig) {
    if (Coin()) rig.inertia = {Uniform(15.0, 100.0), Uniform(0.1, 0.7)};
    if (Coin()) rig.creep = {Uniform(0.02, 0.3), Uniform(0.1, 3.0)};
    if (Coin()) rig.hysteresis_half_width_pa = Uniform(500.0, 6e3);
    if (Coin()) rig.compliance = {Uniform(-0.3, 0.3), Uniform(-0.3, 0.3)};
    if (Coin()) rig.sensor_lag_s = Uniform(0.005, 0.05);
    if (Coin()) rig.sensor_gain = Uniform(0.95, 1.05);
    if (Coin()) rig.sensor_offset_pa = Uniform(-1e3, 1e3);
  }

  std::mt19937 generator_;
};

}  // namespace plenum::test

#endif  // PLENUM_TESTS_MODEL_EFFECTS_EFFECT_RIGS_H_
