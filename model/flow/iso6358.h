// Flow of a compressible gas through one element, ISO 6358-1.
#ifndef PLENUM_MODEL_FLOW_ISO6358_H_
#define PLENUM_MODEL_FLOW_ISO6358_H_

#include "model/physics/air.h"

namespace plenum::model {

// Flow characteristics of an element (valve, fitting, tube).
// Valid: C > 0 and finite, 0 ≤ b < 1, 0 < m ≤ 1, Δp_c ≥ 0. Checked where elements enter plenum.
struct FlowElement {
  double sonic_conductance_m3_per_s_pa = 0.0;  // C; 1 dm³/(s·bar) = 1e-8 m³/(s·Pa)
  double critical_ratio = 0.0;        // b, downstream/upstream pressure at which flow chokes
  double subsonic_index = 0.5;        // m
  double cracking_pressure_pa = 0.0;  // Δp_c, lost from the upstream pressure
  bool operator==(const FlowElement&) const = default;
};

// Below this pressure ratio the ellipse holds; from it to 1 the simulator uses a straight line to
// zero flow, because the ellipse has infinite slope at equal pressures (Simscape's legacy block
// uses 0.995 to 0.999). Times to 95 % of the source pressure do not change; to 99.9 % by 0.3 %.
inline constexpr double kLinearRatio = 0.999;

// Ψ(r) = 1 for r ≤ b, else [1 − ((r−b)/(1−b))²]^m; r = p2/p1 in [0, 1]; 0 for r ≥ 1.
double FlowFunction(double ratio, double critical_ratio, double subsonic_index = 0.5);

// Downstream to upstream pressure of an element between two pressures, or between two images of
// them (model/physics/chamber.h).
inline double PressureRatio(double mirror_pa, double upstream_pa, double downstream_pa) {
  return mirror_pa > 0.0 ? (mirror_pa - upstream_pa) / (mirror_pa - downstream_pa)
                         : downstream_pa / upstream_pa;
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_ISO6358_H_
