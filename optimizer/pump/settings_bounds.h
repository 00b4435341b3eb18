// What a compressor at least takes over a rectangle of settings: stop pressures [p1, p2] times
// volumes [V1, V2] of its reservoir.
//
// Strokes. p2 with V2 while the reservoir falls and V1 while it rises is faster than every pair of
// settings (model/strokes/reservoir_stroke.h).
//
// Pumps. Chambers and reservoir obey dc_i/dt = κ·q_i(s, c_i), V·ds/dt = κ·Q(s) − Σ dc_i/dt: each
// right-hand side grows with the other pressures, so that smaller right-hand sides and a lower stop
// pressure give lower pressures at every time, in the periodic state too. With p1, V1 while the
// reservoir falls and V2 while it rises, s_low(t) ≤ s(t) for all settings of the rectangle. Q falls
// with pressure, so that they pump no more than Q(s_low)·dt in any dt, each bit at no lower a
// pressure than s_low(t). Where energy per air e = P/Q does not fall with pressure, the air A of a
// cycle therefore costs at least what the A cheapest bits of the low run cost. That run pumps
// M ≥ A, since it loses (V2 − V1)·Δs on each way down and up, and none of its air is dearer than
// e_max = e(p1):
//   E ≥ E_low − (M − A)·e_max,    and in the same way the running time with 1/Q for e.
// A group alone on a reservoir that is full when its stroke begins keeps the same order with the
// pumped air m in place of time (pump_slope.h), be the period long enough for the low run or not.
//
// Where e falls somewhere, by L per pressure at the steepest, e(s) ≥ e(s_low) − L·(s − s_low). With
// the air pumped as clock, each stroke from a full reservoir, the run with p2, V2 falling and V1
// rising stays at or above s; V1 times its distance u from the low run grows by at most
// (1 − V1/V2) times what the one loses and the other gains, A_high and M as content:
//   u ≤ p2 − p1 + (1/V1 − 1/V2)·κ·(A_high + M),    E ≥ E_low − (M − A)·e_max − L·M·u.
// With time as clock the same holds, since the higher run pumps less, if the low run is full at
// some time of the cycle and no group draws while another does.
//
// A. Chambers whose valve holds take the same in every run. Others are filled further the higher
// their pressure is when half of the period is over, so that A is at least what the low run takes,
// or what brings them to the operating pressure, and A_high at most what brings them to p2.
#ifndef PLENUM_OPTIMIZER_PUMP_SETTINGS_BOUNDS_H_
#define PLENUM_OPTIMIZER_PUMP_SETTINGS_BOUNDS_H_

#include "optimizer/evaluate/evaluate.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/pump/pump_slope.h"

namespace plenum::optimizer {

struct SettingsBox {
  double low_m3 = 0.0, high_m3 = 0.0;
  double low_pa = 0.0, high_pa = 0.0;
};

// How the pumps of a candidate change over its source pressures.
struct PumpTrend {
  bool rises = true;  // energy per air
  SteepestFall fall;
};
PumpTrend MakePumpTrend(const Problem& problem, const Candidate& candidate);

// Strokes that are faster than those of all settings of the box.
Strokes FastestStrokes(const Problem& problem, const Candidate& candidate, const SettingsBox& box);

struct LeastEvaluation {
  // Each number at its best: to be judged at p1 and V1. Energy counts no pumps where no bound on
  // them is known.
  Evaluation least;
  // About how much less energy of the mission is counted than a pair of settings takes, J: because
  // the pressures of the box lie apart, which coils and pumps that take less at higher pressure
  // ask about, and because its volumes do.
  double pressures_gap_j = 0.0, volumes_gap_j = 0.0;
};
// `fastest`: FastestStrokes, that work, of the box or of one that holds it. Without effects.
LeastEvaluation LeastOver(const Problem& problem, const Candidate& candidate,
                          const PumpTrend& trend, const SettingsBox& box, const Strokes& fastest);

// Raises box.low_pa towards the least stop pressure that drives the strokes of any volume in the
// box; kInfeasible where even box.high_pa is too slow. `tolerance`: relative.
LeafStatus RaisePressure(const Problem& problem, const Candidate& candidate, SettingsBox& box,
                         double tolerance);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PUMP_SETTINGS_BOUNDS_H_
