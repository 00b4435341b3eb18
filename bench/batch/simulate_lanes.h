// The vector loop of bench/batch/simulate_batch.h: Dormand–Prince 5(4) on many strokes at once.
//
// One actuator behind one ISO 6358 element (m = ½) has a single state, its pressure p:
//   dp/dt = g·q/W(p),   W = V(0) + 2·V'·p,   z = (p2 − b·p1)/(1 − b)
//   q = p1 where choked, √(p1² − z²) where subsonic, p1 − p2 on the straight line
// with p1, p2 the pressures before and behind the element. What a closed reservoir has given is in
// the actuator, so its pressure is p_s − (n/V_R)·[content(p) − content(from)]. A stroke is cut
// where the formula of q changes, at pressures known beforehand, into legs of smooth flow.
//
// A leg is integrated in time with the simulator's error control, each lane at its own step. Its
// last step is aimed at the leg's end by the trapezoidal rule for ∫ dp/(dp/dt), and what is then
// missing, of either sign, is added by the same rule, if its error is a small share of the
// tolerance; otherwise the lane goes on from there, or takes the step again if it went too far.
#ifndef PLENUM_BENCH_BATCH_SIMULATE_LANES_H_
#define PLENUM_BENCH_BATCH_SIMULATE_LANES_H_

#include <cstddef>
#include <span>

#include "bench/batch/closed_form_batch.h"

namespace plenum::bench {

enum class LegStroke { kRise, kRiseFromReservoir, kFall };
enum class LegFlow { kChoked, kSubsonic, kLinear };

struct Leg {
  double conductance_pa_m3_per_s_pa;  // g > 0: P0·(T/T0)·C, on the straight line times its slope
  double critical_ratio;              // b in [0, 1)
  double volume_at_zero_m3;           // Volume(chamber, 0), may be negative
  double volume_slope_m3_per_pa;      // V' ≥ 0
  double outer_pa;                    // source, or the reservoir at `start_pa`; ambient (fall)
  double per_reservoir_m3;            // n/V_R
  double start_pa;                    // where the stroke began
  double from_pa, to_pa;              // different, the flow positive at both
};

struct LegTolerance {
  double relative;
  double absolute_pa;
  std::size_t steps_max;
};

// Seconds, NaN where steps_max did not suffice. The same bits in every variant and at every place
// in the list.
void LegTimes(LegStroke stroke, LegFlow flow, std::span<const Leg> legs,
              const LegTolerance& tolerance, std::span<double> time_s,
              Instructions instructions = WidestSupported());

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_BATCH_SIMULATE_LANES_H_
