// What groups that inflate at the same time leave each other of the pressure at the node that they
// share.
//
// Let p(t) be the pressure at the node behind a regulator, groups and chambers at rest when all
// valves open at t = 0. Chambers fill, so that p rises and stays above the pressure of each of
// them.
// * The flow through a line, F(p, p_g), is concave in both pressures where p ≥ p_g (see
//   model/strokes/stroke_enclosure.h) and homogeneous, F = p·q(p_g/p). So of the time that a
//   chamber is between two pressures, from P on, the mean of p decides: for any μ ≤ p_ambient
//     ∫₀ᵀ (p − μ) dt ≥ ∫ dV · h(P),  h(P) = min over r of (1 − μ·r/P)/q(r),
//   V the air taken, ANR. h is concave and rises with P: its chord over a panel of pressures bounds
//   the integral from below. That gives the least mean of p over [0, T] with which the line has its
//   chamber filled at T, whatever the course of p.
// * The flow through the regulator is concave in p and falls: its mean over [0, T], at least the
//   air that all groups have taken by then over T, is passed at the mean of p. That gives the
//   highest mean of p.
// Each line is held against the highest mean by itself: groups need not be looked at together.
#ifndef PLENUM_OPTIMIZER_BOUNDS_NODE_NEED_H_
#define PLENUM_OPTIMIZER_BOUNDS_NODE_NEED_H_

#include <tuple>
#include <vector>

#include "optimizer/choices/corner.h"
#include "optimizer/evaluate/line.h"

namespace plenum::optimizer {

// Mean pressures, Pa absolute, from the command until the limit on the rise time and until half of
// the period.
struct NodeMeans {
  double rise_pa = 0.0, inflate_pa = 0.0;
  bool operator<(const NodeMeans& other) const {
    return std::tie(rise_pa, inflate_pa) < std::tie(other.rise_pa, other.inflate_pa);
  }
  bool Within(const NodeMeans& most) const {
    return rise_pa <= most.rise_pa && inflate_pa <= most.inflate_pa;
  }
};

// The least means with which a line fills its chamber in time; `line`: single or the corner of a
// box. 0 where nothing is known. Of evacuated groups, which no bound looks at: the images of the
// vacua at the node that do it while they stay, +∞ where none does.
NodeMeans LeastNodeMeans(const Problem& problem, int group, model::Gas gas, const Line& line);

// Where groups draw from.
struct NodeSource {
  model::FlowElement regulator;
  double source_pa = 0.0;                 // the highest there may be
  double flow_max_m3_per_s = kUnlimited;  // ANR, of all groups together
};

// The highest means that the source leaves each group, of those that take turns each by itself,
// with these lines, or lines that take no less air through no larger conductances. Rounded up, by
// 1e-4 and what a simulation may be off.
std::vector<NodeMeans> HighestNodeMeans(const Problem& problem, model::Gas gas,
                                        const NodeSource& source,
                                        const std::vector<const Line*>& lines);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_NODE_NEED_H_
