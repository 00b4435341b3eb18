// Leak: gas escapes from the actuator to the surroundings at all times.
//   orifice   ISO 6358 with (C, b), upstream at the gas temperature
//   laminar   Q = G·(p² − p_a²)/(2·P0), m³/s ANR
//   porous    a·ṁ + c·ṁ² = p² − p_a² (Forchheimer: viscous and inertial resistance)
// Below the ambient pressure gas leaks in by the same law. Sources: ISO 6358-1; laminar and
// Forchheimer flow of a compressible gas through a narrow path.
#ifndef PLENUM_MODEL_EFFECTS_LEAK_H_
#define PLENUM_MODEL_EFFECTS_LEAK_H_

#include <cmath>

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class LeakOrifice final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"sonic_conductance_m3_per_s_pa", 0.0, 1e-6},
                                                  {"critical_ratio", 0.0, 0.95}};
  static constexpr EffectSpec kSpec = {"leak", "orifice", EffectPlace::kChamber, kParameters};

  explicit LeakOrifice(std::span<const T> p)
      : sonic_conductance_m3_per_s_pa_(p[0]), critical_ratio_(p[1]) {}

  void AfterFlow(const GroupSetup<T>& setup, const T*, Moment<T>& m) const override {
    using std::sqrt;
    const bool outward = m.pressure_pa >= setup.ambient_pressure_pa;
    const T upstream = outward ? m.pressure_pa : setup.ambient_pressure_pa;
    const T ratio = (outward ? setup.ambient_pressure_pa : m.pressure_pa) / upstream;
    const T flow = sonic_conductance_m3_per_s_pa_ * setup.flow_factor * upstream * Psi(ratio);
    if (outward) {
      AddLeak(flow * sqrt(setup.ambient_temperature_k / m.temperature_k), m);
    } else {
      AddLeak(-flow, m);
    }
  }

  // Leakage in and out in one account; used by all laws.
  static void AddLeak(const T& flow_m3_per_s, Moment<T>& m) {
    m.leak_m3_per_s += flow_m3_per_s;
    (flow_m3_per_s > 0.0 ? m.out_m3_per_s : m.in_m3_per_s) +=
        flow_m3_per_s > 0.0 ? flow_m3_per_s : -flow_m3_per_s;
  }

  // The flow function with the simulator's straight line to zero near equal pressures.
  T Psi(const T& ratio) const {
    using std::sqrt;
    if (ratio <= critical_ratio_) return T(1.0);
    const T width = 1.0 - critical_ratio_;
    if (ratio <= kLinearRatio) {
      const T share = (1.0 - ratio) / width;
      return sqrt(share * (2.0 - share));
    }
    const T share = (1.0 - kLinearRatio) / width;
    return sqrt(share * (2.0 - share)) * (1.0 - ratio) / (1.0 - kLinearRatio);
  }

 private:
  T sonic_conductance_m3_per_s_pa_;
  T critical_ratio_;
};

template <class T>
class LeakLaminar final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"conductance_m3_per_s_pa", 0.0, 1e-6}};
  static constexpr EffectSpec kSpec = {"leak", "laminar", EffectPlace::kChamber, kParameters};

  explicit LeakLaminar(std::span<const T> p) : conductance_m3_per_s_pa_(p[0]) {}

  void AfterFlow(const GroupSetup<T>& setup, const T*, Moment<T>& m) const override {
    const T squares =
        m.pressure_pa * m.pressure_pa - setup.ambient_pressure_pa * setup.ambient_pressure_pa;
    LeakOrifice<T>::AddLeak(conductance_m3_per_s_pa_ * squares / (2.0 * kReferencePressurePa), m);
  }

 private:
  T conductance_m3_per_s_pa_;
};

template <class T>
class LeakPorous final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"viscous_pa2_s_per_kg", 1e6, 1e22},
                                                  {"inertial_pa2_s2_per_kg2", 0.0, 1e30}};
  static constexpr EffectSpec kSpec = {"leak", "porous", EffectPlace::kChamber, kParameters};

  explicit LeakPorous(std::span<const T> p)
      : viscous_pa2_s_per_kg_(p[0]), inertial_pa2_s2_per_kg2_(p[1]) {}

  void AfterFlow(const GroupSetup<T>& setup, const T*, Moment<T>& m) const override {
    using std::sqrt;
    const T squares =
        m.pressure_pa * m.pressure_pa - setup.ambient_pressure_pa * setup.ambient_pressure_pa;
    const T drive = squares >= 0.0 ? squares : T(-squares);
    const T& a = viscous_pa2_s_per_kg_;
    // The root of the quadratic without cancellation.
    const T mass = 2.0 * drive / (a + sqrt(a * a + 4.0 * inertial_pa2_s2_per_kg2_ * drive));
    const T flow = mass / setup.reference_density_kg_per_m3;
    LeakOrifice<T>::AddLeak(squares >= 0.0 ? flow : T(-flow), m);
  }

 private:
  T viscous_pa2_s_per_kg_;
  T inertial_pa2_s2_per_kg2_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LEAK_H_
