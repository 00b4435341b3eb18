// What a compressor must at least bear to feed the strokes, by intervals of reservoir volumes.
//
// Let A be the air of a cycle and m the air pumped since a stroke began, both ANR; κ = P0·T/T0
// converts to content. The reservoir holds p_1 when the stroke begins: the stop pressure p_s, or
// less where groups take turns.
//  (1) No more than A is drawn in a cycle, so the m-th bit of air is pumped at
//      p(m) ≥ p_1 − κ·(A−m)/V.
//  (2) Where all strokes begin at once: when group g comes to its target p_g as the last of some,
//      these have taken the air A_S up to their targets, of which the pumps have delivered at most
//      Q_max·t_g, t_g the limit on its rise time; the reservoir is no lower than g:
//      p_s ≥ p_g + κ·(A_S − Q_max·t_g)/V.
//      Which comes last is not known: of all orders the one that asks least, found from the last
//      group on (Lawler's rule, Management Science 19, 1973), without those in which a group comes
//      sooner than it could alone. No stop pressure is below a target.
//  (3) p_1 is at least what a group needs that is alone on the reservoir (stroke_bound.h), and of
//      two groups that take turns each must leave what the other needs.
// Energy per air, made non-falling in pressure from below, and time per air, which does not fall
// with pressure, then bound energy and running time: bit by bit of air, each by its mean over the
// pressures of the bit. For a single choice of pumps the line's flow bounds how fast air is drawn,
// so that less of it is pumped at the lowest pressures than (1) alone allows.
// pump_need.cc: what pumps take for the air of a cycle and for the first fill.
#ifndef PLENUM_OPTIMIZER_PUMP_PUMP_BOUNDS_H_
#define PLENUM_OPTIMIZER_PUMP_PUMP_BOUNDS_H_

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "optimizer/evaluate/candidate.h"
#include "optimizer/pump/pump_facts.h"

namespace plenum::optimizer {

struct PumpNeed {
  double on_s = 0.0;      // per cycle
  double energy_j = 0.0;  // per cycle, all pumps
};

// Of filling the reservoir for the first time, J.
double LeastFirstFill(const Problem& problem, const PumpFacts& facts, double source_pa,
                      double reservoir_m3);

// Air of one stroke of a group up to its rise target, all its actuators, m³ ANR.
double AirToTarget(const Problem& problem, int group, const model::Chamber& chamber);

// What lines ask of a compressor and its reservoir, before or after either is chosen: bounds from
// below.
struct PumpLoad {
  const std::vector<const Line*>& lines;  // one per group
  // Of a burst (gait.h); where there are none of all strokes of a cycle.
  double air_m3 = 0.0;
  double coil_j = 0.0;  // per cycle
};
PumpLoad MakePumpLoad(const Problem& problem, const std::vector<const Line*>& lines);

// What the pumps at least take in a cycle, with a reservoir of low_m3 to high_m3 that holds
// start_pa[i] or more when phase i of the cycle begins: one phase, or one per group where two
// alternate. None where they cannot deliver the air of a cycle within it.
std::optional<PumpNeed> LeastPumpNeed(const Problem& problem, const PumpFacts& facts,
                                      const PumpLoad& load, const std::vector<double>& start_pa,
                                      double low_m3, double high_m3);

// What a reservoir at least takes whose volume is in [low, high].
struct ReservoirNeed {
  double low_m3 = 0.0, high_m3 = 0.0;
  double source_pa = 0.0;             // least stop pressure
  double source_max_pa = kUnlimited;  // most that duty and energy bear
  std::array<double, 2> start_pa{};   // least when each of two groups that take turns begins
  double energy_j = 0.0;              // whole mission: first fill, pumps, coils
};
struct PumpLimits {
  double duty_max = 1.0;
  double energy_max_j = kUnlimited;
  bool find_most = false;  // ReservoirNeed::source_max_pa is wanted; else a box closes all the same
};
// Tightens what is known of an interval of volumes, be it only from a larger one or from a larger
// box; none where no volume in it will do. `tolerance`: of the source pressures, relative; they
// stay on the safe side.
std::optional<ReservoirNeed> LeastReservoirNeed(const Problem& problem, const PumpFacts& facts,
                                                const PumpLoad& load, const PumpLimits& limits,
                                                const Window& window, ReservoirNeed known,
                                                double tolerance);

// ReservoirNeed::energy_j counts coils that are energised only for the strokes as if no source made
// these faster; the time that the bound on strokes gives them at the stop pressures in question
// raises it, where all strokes begin at once.
bool EnergyMayGrow(const Problem& problem, const PumpLoad& load);
// Energy of the mission at any stop pressure in between, at least, by so many divisions of the
// pressures. `need` as LeastReservoirNeed gave it for the same load. As divisions go on the bound
// rises from low_j towards high_j at most: `matters(low_j, high_j)`, if given, tells whether it is
// to be raised.
double LeastMissionEnergy(const Problem& problem, const PumpFacts& facts, const PumpLoad& load,
                          const ReservoirNeed& need, int divisions,
                          const std::function<bool(double, double)>& matters = {});

// Both for a candidate whose compressor and lines are chosen, by intervals of volumes that
// divide [low, high]; intervals that will not do are left out.
std::vector<ReservoirNeed> ReservoirNeeds(const Problem& problem, const PumpFacts& facts,
                                          const Candidate& candidate, double energy_max_j,
                                          double low_m3, double high_m3);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PUMP_PUMP_BOUNDS_H_
