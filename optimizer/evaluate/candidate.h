// One combination of parts, its operating point, and what its parts weigh, take and stand.
#ifndef PLENUM_OPTIMIZER_EVALUATE_CANDIDATE_H_
#define PLENUM_OPTIMIZER_EVALUATE_CANDIDATE_H_

#include <vector>

#include "model/strokes/pump_stroke.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/problem/problem.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {

// Objectives within this relative distance are ties (tie_key.h).
inline constexpr double kTie = 1e-6;

inline constexpr int kNone = -1;
inline constexpr int kCustom = -2;  // made-to-measure reservoir

// A part of a source family, some pieces in parallel.
struct Option {
  int index = kNone;
  int quantity = 0;
  Amounts amounts;         // all pieces, gas charge included; zero for kCustom
  double objective = 0.0;  // their share of the objective
};

// How candidates are evaluated. A solver that gives up, or is told to stop, leaves an evaluation
// failed: nothing is known then.
struct Workbench {
  std::function<bool()> stop;  // may be empty
  PeriodicSolver periodic = model::FindPeriodicState;
  bool stopped() const { return stop && stop(); }
};

// Of the vacuum beside the source (pumped_rail.h), and the weakest pressure that does; 0: not found
// yet.
struct RailChoice {
  Option pump, reservoir;
  double weakest_pa = 0.0;
};

struct Candidate {
  Configuration configuration = Configuration::kMains;
  std::vector<const Line*> lines;  // one per group
  Option regulator, bottle, compressor, battery, reservoir;
  std::vector<Option> own_regulators = {};  // one a group, in place of `regulator`; or empty
  RailChoice rail = {};
  // Source pressures outside are known to be too slow, or more than the source bears.
  double source_floor_pa = 0.0;
  double source_cap_pa = kUnlimited;
  double pack_surplus_eur = 0.0;  // of a finished one (packs.h); else not known, and 0
  // Of a problem with a guarantee: valves that cannot hold as they are with these parts, which is
  // the best that may be said of them; else at their worst.
  bool at_best = false;
  const Workbench* bench = nullptr;  // null: the simulator of the model, never stopped
  bool stopped() const { return bench != nullptr && bench->stopped(); }
};

// Where a candidate is run. For the regulated configurations the source pressure is the regulator's
// outlet, the highest of them where each group has its own; for a compressor it is the pressure at
// which it stops, for a tank without a regulator its fill, and for pumps without a reservoir, where
// it is no setting, the highest between them and the valves.
template <class T>
struct OperatingPointOf {
  T source_pa = T(0.0);
  T reservoir_m3 = T(0.0);
  // Volume while the reservoir rises; equal to reservoir_m3 but for bounds over an interval of
  // volumes (model/strokes/reservoir_stroke.h).
  T reservoir_rising_m3 = T(0.0);
  double tank_fill_pa = 0.0;          // 0: the least that does (see below)
  std::vector<double> group_pa = {};  // behind each group's own regulator; or empty
  double pump_stop_pa = 0.0;          // of pumps that fill a tank; 0: the lowest that does
  double rail_pa = 0.0;               // 0: the weakest that does (pumped_rail.h)
};
using OperatingPoint = OperatingPointOf<double>;

// The pumps of a candidate that has them, one piece.
inline const model::Compressor& ChosenPump(const Problem& problem, const Candidate& candidate) {
  return PumpsOf(problem, candidate.configuration)[candidate.compressor.index];
}

enum class LeafStatus { kFeasible, kInfeasible, kUndecided };

// Whether all valves can hold.
bool AllHold(const Candidate& candidate);

// The regulator, pressure at it, and its inlet of candidates with a regulator for all or with one
// for each group.
inline bool HasOwnRegulators(const Candidate& candidate) {
  return !candidate.own_regulators.empty();
}
inline const Option& RegulatorOf(const Candidate& candidate, int group) {
  return candidate.own_regulators.empty() ? candidate.regulator : candidate.own_regulators[group];
}
template <class T>
T PressureOf(const OperatingPointOf<T>& point, int group) {
  return point.group_pa.empty() ? point.source_pa : T(point.group_pa[group]);
}
std::vector<const model::Regulator*> RegulatorsOf(const Problem& problem,
                                                  const Candidate& candidate);
// What the inlets of all regulators need and stand; 0 and kUnlimited without any.
double InletMinPa(const Problem& problem, const Candidate& candidate);
double InletMaxPa(const Problem& problem, const Candidate& candidate);

// Range of source pressures that the parts stand and that can drive the strokes at all; empty
// (low > high) if there is none.
struct Window {
  double low_pa, high_pa;
  bool empty() const { return !(low_pa <= high_pa); }
};
Window SourceWindow(const Problem& problem, const Candidate& candidate);
// The same of the pressure behind a group's own regulator. SourceWindow() is then of the highest of
// these pressures.
Window GroupWindow(const Problem& problem, const Candidate& candidate, int group);

// Volume of a stock reservoir or a tank; 0 where there is none, or where it is made to measure.
double ReservoirVolume(const Problem& problem, const Candidate& candidate);
// The candidate run with such a volume, each group behind its own regulator as near to the source
// pressure as its parts stand; which a stock reservoir with tolerances has while it falls.
OperatingPoint PointAt(const Problem& problem, const Candidate& candidate, double source_pa,
                       double reservoir_m3);

// Parts of the candidate; a made-to-measure reservoir is built for its volume and stop pressure,
// and a tank holds the fill of the point, where that is known, else the least air that it may.
template <class T>
AmountsOf<T> TotalAmounts(const Problem& problem, const Candidate& candidate,
                          const OperatingPointOf<T>& point);
Amounts CustomReservoir(const Problem& problem, double volume_m3, double source_pa);
// Absolute: the highest pressure that a made-to-measure one may be built for, and one that no
// source drives the strokes without.
double CustomRatingPa(const Problem& problem);
double LeastSourcePa(const Problem& problem);
inline OperatingPoint LeastPoint(const Problem& problem, double reservoir_m3) {
  return {LeastSourcePa(problem), reservoir_m3, reservoir_m3};
}

// Pumps without a reservoir ("direct").
//
// The pumps of a feed (pump_feed.h) together fill one squad after another, each from its command
// until its valve closes at the operating pressure, and are off else (model/strokes/pump_stroke.h),
// unless they hold on (pump_feed.h).
// A squad must be full before the next one's turn: squads of one feed that would fill at once have
// no such design. Between two strokes only the valve keeps an actuator full, so that it must hold;
// and since a stroke begins at ambient pressure in front of it, it must switch without any at its
// inlet.

// The stroke of so many actuators of the group on one feed.
model::PumpStroke DirectStroke(const Problem& problem, const Candidate& candidate, int group,
                               int count);
// What the pumps of one feed take in a period to hold what they have filled of a squad for so long
// in it, J.
double HoldingEnergy(const Problem& problem, const Candidate& candidate, const FedSquad& fed,
                     double filling_s);
// The pressure at which all parts of the lines must stand it; +∞ where some group is never full.
OperatingPoint DirectPoint(const Problem& problem, const Candidate& candidate);

// Tanks.
//
// A tank is some reservoirs that are filled before the mission and emptied by it, with or without a
// regulator behind them. Isothermal and ideal, as the strokes are: what a stroke takes, m³ ANR,
// lowers the tank's pressure by P0·(T/T0)/V of it.
//
// With a regulator the tank must hold, above the regulator's inlet pressure, the air of all
// strokes. Without one ("open") the tank is the source, and its fill the source pressure: all of
// the line must stand it. Every stroke finds less pressure than the one before, so that the last
// one is the slowest; the tank must keep the highest operating pressure and what its valves ask at
// their inlets. Such a tank feeds only valves that hold: one that cannot would fill its actuator to
// whatever the tank has.
//
// The fill is a setting. Where it is not given it is the least that does, which weighs least.

// Whether the candidate, whose regulator is chosen, has a tank and no regulator.
bool IsOpenTank(const Candidate& candidate);

// Of the pieces of the tank together; 0 where it is not chosen.
double TankVolume(const Problem& problem, const Candidate& candidate);

// Absolute pressure that a part may be filled to: its rating, or less if the request says so.
double TankRatingPa(const Problem& problem, int part);
double HighestTankPa(const Problem& problem);  // of all parts
// The same of the candidate's tank before its regulator, whose inlet must stand it too.
double TankFillMaxPa(const Problem& problem, const Candidate& candidate);

// Fall of the tank's pressure by so much air, m³ ANR.
double TankFallPa(const Problem& problem, const Candidate& candidate, double air_m3);
// Air that it gives while it falls from one pressure to another, m³ ANR; 0 where it does not fall.
double TankAir(const Problem& problem, const Candidate& candidate, double from_pa, double to_pa);

// Of one stroke of every actuator, m³ ANR, where all valves hold.
double AirPerCycle(const Problem& problem, const Candidate& candidate);
// Open: the pressure that the tank must keep, and the least fill that keeps it to the end.
double KeptPa(const Problem& problem, const Candidate& candidate);
double LeastOpenFillPa(const Problem& problem, const Candidate& candidate);
// Open: the pressure when the last period of the mission begins.
double LastPeriodPa(const Problem& problem, const Candidate& candidate, double fill_pa);

// The pressure down to which a tank gives its air to a source of this pressure.
double TankInletPa(const Problem& problem, const Candidate& candidate, double source_pa);
// The fill that holds so much air above an inlet pressure, or as much of it as may be.
double FillForPa(const Problem& problem, const Candidate& candidate, double inlet_pa,
                 double air_m3);

// Air that any design with this tank carries, kg: what stays in it at the highest operating
// pressure. And what more of it a fill is.
double LeastTankCharge(const Problem& problem, int part);
double ChargeBeyondLeast(const Problem& problem, const Candidate& candidate, double fill_pa);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_CANDIDATE_H_
