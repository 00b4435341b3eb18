// The simulator: groups of actuators on one source, through a schedule of valve commands.
//
// States: the pressure of one actuator per group (its `count` copies move alike), the states of its
// effects, the pressure of the reservoir if there is one, and the gas and energy that crossed each
// border, so that balances can be checked. Base model: isothermal at the ambient temperature T_a,
//   dp_i/dt = P0·(T_a/T0)·(Q_in,i − Q_out,i) / W_i(p_i),   W = V + p·dV/dp
//   dp_s/dt = P0·(T_a/T0)·(D·n_c·Q_c(p_s) − Σ n_i·Q_in,i) / V_r
// with Q from the exact series march of each line (source pressure to actuator when inflating,
// actuator to ambient when deflating). A regulator is one element shared by all lines: the node
// behind it is where its flow equals what the lines take. Flow only ever goes source → actuator →
// ambient: a check in the line holds against a source that has fallen below the actuator. Effects
// (model/effects) change these equations; model/effects/unit.h has the general form.
//
// Integration: Dormand–Prince 5(4) with error control and dense output; no step crosses a switch.
// Valve commands and ends of ramps are exact step ends. Reaching the operating pressure (with
// close_at_operating), the compressor's stop and restart, target crossings, the change between
// choked and subsonic flow and the ends of a hysteresis are located on the dense output; the step
// is then taken again up to there. Where the step is held down by stability and not by accuracy for
// long, the run starts over with CVODE (BDF, its own root finding).
#ifndef PLENUM_MODEL_SIMULATE_SIMULATE_H_
#define PLENUM_MODEL_SIMULATE_SIMULATE_H_

#include <vector>

#include "model/simulate/simulate_rig.h"

namespace plenum::model {

// Never throws for a physical reason: the status says what happened, and on any but kDone the
// numbers up to that point stand.
Response Simulate(const Rig& rig, const SimulateOptions& options);

// Full strokes by the contract's definition, whatever the schedule: rise from ambient to
// rise_fraction of the operating gauge pressure from the source's initial state with all groups
// inflating together, fall from the operating pressure to fall_fraction of it. +∞ where not
// reached, and everywhere for a rig that Simulate refuses. end_s and sample_hz are not used.
inline constexpr double kFullStrokeHorizonS = 1e6;  // what takes longer is not reached
struct FullStroke {
  double rise_time_s;
  double fall_time_s;
  double frequency_max_hz;  // 1/(rise + fall); 0 where either is never reached
  // Of the run that ended first by anything but kDone: then +∞ may also mean that it is not known.
  SimulateStatus status = SimulateStatus::kDone;
};
std::vector<FullStroke> FullStrokes(const Rig& rig, const SimulateOptions& options);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_SIMULATE_H_
