// What a compressor must at least bear to feed the strokes, before the reservoir is known and
// after.
//
// Let A be the air of a cycle, A_t the part of it up to the rise targets, p_t the lowest target,
// and m the air pumped since the strokes began, all ANR; κ = P0·T/T0 converts to content. The
// reservoir starts at the stop pressure p_s.
//  (1) No more than A is ever drawn, so the m-th bit of air is pumped at p(m) ≥ p_s − κ·(A−m)/V.
//  (2) Within the rise times the pumps deliver at most `early`, so the reservoir gives at least
//      A_t − early and still ends at or above p_t: p_s ≥ p_t + κ·(A_t − early)/V.
//  (3) p_s is at least what an unlimited source would need.
//  (4) After the rise times the reservoir never falls below p_t: air only flows downhill.
// So the last A_t − early of the air is pumped at pressures spread evenly over an interval that
// begins at or above p_t and ends at or above p_s,min, whatever the volume; by (4) the rest that is
// not early is pumped at or above p_t. Energy per air, made non-falling in pressure from below, and
// time per air, which does not fall with pressure, then bound energy and running time.
#ifndef PLENUM_OPTIMIZER_PUMP_BOUNDS_H_
#define PLENUM_OPTIMIZER_PUMP_BOUNDS_H_

#include <vector>

#include "optimizer/candidate.h"

namespace plenum::optimizer {

// A step function of pressure that nowhere exceeds the true one and does not fall.
class Minorant {
 public:
  Minorant() = default;
  // value[i] holds on [pressure[i], pressure[i+1]); one more pressure than values.
  Minorant(std::vector<double> pressure_pa, std::vector<double> value);
  double At(double pressure_pa) const;
  double Mean(double low_pa, double high_pa) const;  // At(high) where low ≥ high

 private:
  double Integral(double pressure_pa) const;
  std::vector<double> pressure_pa_, value_, integral_;
};

// What the bounds need of one pump, computed once per problem.
struct PumpFacts {
  double early_m3 = 0.0;     // the most that it pumps during the rise times of a cycle, ANR
  double target_pa = 0.0;    // p_t
  Minorant energy_j_per_m3;  // P/Q
  Minorant seconds_per_m3;   // 1/Q
};
PumpFacts MakePumpFacts(const Problem& problem, const model::CompressorCurve& curve);

struct PumpNeed {
  double on_s = 0.0;      // per cycle
  double energy_j = 0.0;  // per cycle, all pumps
};

// Bounds from below for `pumps` in parallel, whatever the reservoir. `air_m3` and
// `air_to_target_m3` are lower bounds on A and A_t, `source_min_pa` on p_s.
PumpNeed LeastPumpNeed(const Problem& problem, const PumpFacts& facts, int pumps, double air_m3,
                       double air_to_target_m3, double source_min_pa);

// Least volume of a reservoir that stops at or below `source_max_pa`, by (2); +∞ where there is
// none.
double LeastReservoirVolume(const Problem& problem, const PumpFacts& facts, int pumps,
                            double air_to_target_m3, double source_max_pa);

// LeastPumpNeed when the reservoir is at least `reservoir_m3` large and stops at or above
// `source_pa`.
PumpNeed LeastPumpNeed(const Problem& problem, const PumpFacts& facts, int pumps, double air_m3,
                       double source_pa, double reservoir_m3, double* first_fill_j);

// Air of one stroke of a group up to its rise target, all its actuators, m³ ANR.
double AirToTarget(const Problem& problem, int group, const model::Chamber& chamber);

// Volumes of reservoirs that might serve a candidate whose compressor and lines are chosen, by
// intervals, each with what it at least takes; a single volume where low and high are equal. Left
// out is what needs more than `energy_max_j` or more running time than the pump stands.
struct ReservoirNeed {
  double low_m3 = 0.0, high_m3 = 0.0;
  double source_pa = 0.0;      // least stop pressure
  double source_max_pa = 0.0;  // most that duty and energy bear
  double energy_j = 0.0;       // whole mission: first fill, pumps, coils
};
std::vector<ReservoirNeed> ReservoirNeeds(const Problem& problem, const PumpFacts& facts,
                                          const Candidate& candidate, double energy_max_j,
                                          double low_m3, double high_m3);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PUMP_BOUNDS_H_
