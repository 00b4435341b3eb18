// The gas in the tube has volume and mass: a node of volume V_l = π·d²·L/4 at the line's end, and a
// column between node and actuator,
//   V_l·dp_n/dt = P0·(T_a/T0)·(Q_line − q),
//   dq/dt = A/(ρ0·L)·(p_n − p) − 32·μ/(d²·ρ)·q,  A = π·d²/4, ρ the mean density at T_a,
// q in m³/s ANR, either way. Delay and ripple follow from both. The resistance of the tube as an
// element of the line is not in it, and V_l comes on top of the dead volume. Isothermal. Valid for
// wavelengths above the tube's length. Source: lumped inertance, volume and laminar friction.
#ifndef PLENUM_MODEL_EFFECTS_LINE_DYNAMICS_H_
#define PLENUM_MODEL_EFFECTS_LINE_DYNAMICS_H_

#include <cmath>
#include <numbers>

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class LineDynamics final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"length_m", 1e-3, 100.0},
                                                  {"inner_diameter_m", 1e-4, 0.05}};
  static constexpr EffectSpec kSpec = {"line_dynamics", "", EffectPlace::kLine, kParameters};

  explicit LineDynamics(std::span<const T> p) : length_m_(p[0]), inner_diameter_m_(p[1]) {}

  int states() const override { return 2; }  // node pressure, flow to the actuator
  bool hidden_states() const override { return true; }
  void Start(const GroupSetup<T>& setup, const Moment<T>& m, T* x, double* size) override {
    x[0] = m.pressure_pa;
    x[1] = T(0.0);
    size[0] = ValueOf(m.pressure_pa);
    const double impedance = ValueOf(setup.ContentRate() * setup.reference_density_kg_per_m3 *
                                     length_m_ / (Area() * Volume()));
    size[1] = size[0] / std::sqrt(impedance);
  }
  void BeforeVolume(const GroupSetup<T>&, const T* x, Moment<T>& m) const override {
    m.tail_pa = x[0];
  }
  void AfterVolume(const GroupSetup<T>& setup, const T*, Moment<T>& m) const override {
    m.tail_temperature_k = setup.ambient_temperature_k;
  }
  void AfterFlow(const GroupSetup<T>&, const T* x, Moment<T>& m) const override {
    m.in_m3_per_s = x[1] > 0.0 ? x[1] : T(0.0);
    m.out_m3_per_s = x[1] > 0.0 ? T(0.0) : T(-x[1]);
  }
  void Rates(const GroupSetup<T>& setup, const Moment<T>& m, const T* x, T* dxdt) const override {
    dxdt[0] = setup.ContentRate() * (m.line_in_m3_per_s - m.line_out_m3_per_s - x[1]) / Volume();
    const T density = (x[0] + m.pressure_pa) / (2.0 * kReferencePressurePa) *
                      setup.reference_density_kg_per_m3 * kReferenceTemperatureK /
                      setup.ambient_temperature_k;
    dxdt[1] =
        Area() / (setup.reference_density_kg_per_m3 * length_m_) * (x[0] - m.pressure_pa) -
        32.0 * setup.viscosity_pa_s / (inner_diameter_m_ * inner_diameter_m_ * density) * x[1];
  }
  T Stored(const GroupSetup<T>& setup, const T* x) const override {
    return x[0] * Volume() / setup.ContentRate();
  }

 private:
  T Area() const { return std::numbers::pi / 4.0 * inner_diameter_m_ * inner_diameter_m_; }
  T Volume() const { return Area() * length_m_; }
  T length_m_;
  T inner_diameter_m_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LINE_DYNAMICS_H_
