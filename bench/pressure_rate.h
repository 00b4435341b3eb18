// The right-hand side dp/dt that all rival integrators share, inlined into their steps.
#ifndef PLENUM_BENCH_PRESSURE_RATE_H_
#define PLENUM_BENCH_PRESSURE_RATE_H_

#include <cmath>

#include "bench/rigs.h"

namespace plenum::bench {

// dp/dt = P0·C·p_s·Ψ(p/p_s)/W(p), W = V0·[1 + k·(2p − p_a)]; p_s·Ψ as its ellipse, 0 beyond p_s.
struct PressureRate {
  double critical_pa;   // b·p_s
  double inverse_span;  // 1/((1 − b)·p_s)
  double choked;        // P0·C·p_s, Pa·m³/s
  double w0;            // W = w0 + w1·p
  double w1;

  explicit PressureRate(const RiseRig& rig)
      : critical_pa(rig.critical_ratio * rig.source_pa),
        inverse_span(1.0 / (rig.source_pa - critical_pa)),
        choked(1e5 * rig.conductance_m3_per_s_pa * rig.source_pa) {
    const double growth = (rig.expansion_ratio - 1.0) / (rig.operating_pa - rig.ambient_pa);
    w0 = rig.rest_volume_m3 * (1.0 - growth * rig.ambient_pa);
    w1 = 2.0 * rig.rest_volume_m3 * growth;
  }

  double Choked(double p) const { return choked / (w0 + w1 * p); }

  double Subsonic(double p) const {
    const double z = (p - critical_pa) * inverse_span;
    return z < 1.0 ? std::sqrt(1.0 - z * z) * Choked(p) : 0.0;
  }

  double operator()(double p) const { return p <= critical_pa ? Choked(p) : Subsonic(p); }

  // d(dp/dt)/dp of the above.
  double ChokedSlope(double p) const { return -Choked(p) * w1 / (w0 + w1 * p); }

  double SubsonicSlope(double p) const {
    const double z = (p - critical_pa) * inverse_span;
    if (!(z < 1.0)) return 0.0;
    const double psi = std::sqrt(1.0 - z * z);
    return -(z * inverse_span / psi + psi * w1 / (w0 + w1 * p)) * Choked(p);
  }

  double Slope(double p) const { return p <= critical_pa ? ChokedSlope(p) : SubsonicSlope(p); }
};

// A time by which p has certainly passed `to_pa`: the flow never falls below its value there.
inline double RiseTimeAtMost(const PressureRate& rate, double from_pa, double to_pa) {
  const double content = (to_pa - from_pa) * (rate.w0 + 0.5 * rate.w1 * (to_pa + from_pa));
  return content / (rate(to_pa) * (rate.w0 + rate.w1 * to_pa));
}

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_PRESSURE_RATE_H_
