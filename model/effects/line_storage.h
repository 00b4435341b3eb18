// Gas stored along the tube: a share of the rigid volume that the line adds to the actuator (its
// bore, Chamber::dead_volume_m3) lies behind the valve instead, in front of the tube's resistance,
//   V_n·dp_n/dt = P0·(T_a/T0)·(Q_valve − q),  V_n = share·V_line,
// with q the flow of the elements behind the inlet (GroupRig::inlet_after) between node and
// actuator, either way. A share of one half is the π-section of a line: half of its volume at each
// end. Without a tube it does nothing. Isothermal in the node; no inertia: valid for changes that
// are slow beside the sound through the tube (6 m: 17 ms). Source: lumped models of pneumatic
// lines.
#ifndef PLENUM_MODEL_EFFECTS_LINE_STORAGE_H_
#define PLENUM_MODEL_EFFECTS_LINE_STORAGE_H_

#include <cmath>

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class LineStorage final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"share", 0.01, 0.95}};
  static constexpr EffectSpec kSpec = {"line_storage", "", EffectPlace::kLine, kParameters};

  explicit LineStorage(std::span<const T> p) : share_(p[0]) {}

  void Prepare(GroupSetup<T>& setup) override {
    const std::size_t before = setup.fill_before_inlet;
    active_ = before > 0 && setup.line_volume_m3 > 0.0 &&
              (before < setup.fill.size() || setup.exhaust_before_inlet > 0);
    if (!active_) return;
    volume_m3_ = share_ * setup.line_volume_m3;
    setup.dead_volume_m3 -= volume_m3_;
    if (!setup.fill.empty()) {
      const auto middle = setup.fill.begin() + static_cast<std::ptrdiff_t>(before);
      inward_ = Line<T>({&*middle, setup.fill.size() - before}, setup.linear_ratio);
      setup.fill.erase(middle, setup.fill.end());
    }
    if (!setup.exhaust.empty()) {
      const std::size_t tube = setup.exhaust_before_inlet;
      outward_ = Line<T>({setup.exhaust.data(), tube}, setup.linear_ratio);
      setup.exhaust.erase(setup.exhaust.begin(),
                          setup.exhaust.begin() + static_cast<std::ptrdiff_t>(tube));
      setup.exhaust_before_inlet = 0;
    }
  }
  int states() const override { return 1; }  // pressure in the node
  void Start(const GroupSetup<T>&, const Moment<T>& m, T* x, double* size) override {
    x[0] = m.pressure_pa;
    size[0] = ValueOf(m.pressure_pa);
  }
  void BeforeVolume(const GroupSetup<T>&, const T* x, Moment<T>& m) const override {
    if (active_) m.tail_pa = x[0];
  }
  void AfterVolume(const GroupSetup<T>& setup, const T*, Moment<T>& m) const override {
    if (active_) m.tail_temperature_k = setup.ambient_temperature_k;
  }
  void AfterFlow(const GroupSetup<T>& setup, const T* x, Moment<T>& m) const override {
    using std::sqrt;
    if (!active_) return;
    const bool in = x[0] >= m.pressure_pa;
    m.in_m3_per_s = in ? Through(inward_, outward_, x[0], m.pressure_pa) : T(0.0);
    m.out_m3_per_s = in ? T(0.0) : Through(outward_, inward_, m.pressure_pa, x[0]);
    if (m.heat_capacity_ratio > 1.0) {
      m.out_m3_per_s *= sqrt(setup.ambient_temperature_k / m.temperature_k);
    }
    from_node_ = m.in_m3_per_s - m.out_m3_per_s;
  }
  void Rates(const GroupSetup<T>& setup, const Moment<T>& m, const T*, T* dxdt) const override {
    dxdt[0] = active_ ? T(setup.ContentRate() *
                          (m.line_in_m3_per_s - m.line_out_m3_per_s - from_node_) / volume_m3_)
                      : T(0.0);
  }
  T Stored(const GroupSetup<T>& setup, const T* x) const override {
    return active_ ? T(x[0] * volume_m3_ / setup.ContentRate()) : T(0.0);
  }

 private:
  // The tube of a line that goes one way only serves both.
  static T Through(const Line<T>& line, const Line<T>& other, const T& from_pa, const T& to_pa) {
    return (line.empty() ? other : line).Flow(from_pa, to_pa);
  }

  T share_, volume_m3_;
  Line<T> inward_, outward_;
  mutable T from_node_ = T(0.0);  // into the actuator, at the moment
  bool active_ = false;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LINE_STORAGE_H_
