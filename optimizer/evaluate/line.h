// A line: the tube, fitting and valve that serve one group of actuators, and what can be said of it
// before the source is known.
#ifndef PLENUM_OPTIMIZER_EVALUATE_LINE_H_
#define PLENUM_OPTIMIZER_EVALUATE_LINE_H_

#include <array>
#include <memory>
#include <vector>

#include "model/flow/flow_table.h"
#include "model/flow/series.h"
#include "model/physics/chamber.h"
#include "optimizer/evaluate/stroke_panels.h"
#include "optimizer/problem/amount.h"
#include "optimizer/problem/gait.h"
#include "optimizer/problem/joints.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Sums of a set of parts. Cost is meaningful only where every part has a price; a part without one
// drops out before it is summed when cost matters.
template <class T>
struct AmountsOf {
  T mass_kg = T(0.0), volume_m3 = T(0.0), cost_eur = T(0.0);
  T mass_slack_kg = T(0.0), volume_slack_m3 = T(0.0);  // of tolerances: limits hold with them
  template <class U>
  AmountsOf& operator+=(const AmountsOf<U>& other) {
    mass_kg += other.mass_kg;
    volume_m3 += other.volume_m3;
    cost_eur += other.cost_eur;
    mass_slack_kg += other.mass_slack_kg;
    volume_slack_m3 += other.volume_slack_m3;
    return *this;
  }
};
using Amounts = AmountsOf<double>;
// `*`: each piece at its share of a pack. Bought(): in whole packs.
Amounts operator*(double quantity, const model::PartBasics& basics);
Amounts Bought(double quantity, const model::PartBasics& basics);

// Of a joint (joints.h), and of a group's lines that share of the joint of all lines that their
// number has, or behind its own regulator or pumps the joint that they have alone.
Amounts JointAmounts(const Problem& problem, const std::optional<Joint>& joint);
Amounts LineJointShare(const Problem& problem, int group, bool own_regulators);
// Of what joins pieces of a source and, where groups have their own, the regulators to it; of pumps
// of all feeds. At the mains, where the source is no part, these count with the regulator of the
// first group.
std::vector<Joint> SourceJoints(const Problem& problem, Family family, int part, int quantity,
                                bool own_regulators);
Amounts SourceJoint(const Problem& problem, Family family, int part, int quantity,
                    bool own_regulators);
Amounts OwnRegulatorJointAtMains(const Problem& problem, Configuration configuration, int group);

// Weighted objective of parts alone (energy comes on top).
template <class T>
T ObjectiveOf(const Objective& objective, const AmountsOf<T>& amounts) {
  return objective.mass_kg * amounts.mass_kg + objective.volume_l * amounts.volume_m3 * 1e3 +
         objective.cost_eur * amounts.cost_eur;
}

// Of a box of lines those with no more coil power, at least. Coils ask for more of the battery, so
// that the lightest lines need not make the lightest design. `places`: of a single line its tube,
// fitting and valve in the orders of their trees; else −1.
struct LineChoice {
  double objective = 0.0, coil_power_w = 0.0;
  std::array<int, 3> places{-1, -1, -1};
  bool operator==(const LineChoice&) const = default;
};

// How a line fills from a reservoir.
struct FillCurve {
  model::FlowTable flow;  // of its elements as crossed, with gas and temperature factor
  StrokePanels panels;    // of its chamber
};

struct Line {
  int tubing = -1, fitting = -1,
      valve = -1;                        // indices into Problem::parts; fitting −1: none needed
  Amounts amounts;                       // whole group: tubes, fittings, valves
  double objective = 0.0;                // their share, with what they take of energy at any speed
  std::vector<model::FlowElement> fill;  // elements as crossed from source to actuator
  std::vector<model::FlowElement> exhaust;  // and from actuator to ambient
  model::Chamber chamber;                   // with the tube's bore as dead volume
  std::shared_ptr<const FillCurve> curve;   // of a finished line, where reservoirs feed it
  double fall_time_s = 0.0;
  // Pressure of an unlimited source at which the rise time is just met (no source does it with
  // less: droop, regulator and neighbours only slow the rise) and at which the valve switches, and
  // the highest that the line
  // stands.
  double source_min_pa = 0.0;
  double source_max_pa = 0.0;
  double inflate_time_least_s = 0.0;  // to p_op, unlimited source at source_max_pa
  bool holds = true;                  // in a box of lines: some hold
  // For a box: whether all hold, and how much more dead volume than the chamber's the widest has.
  bool all_hold = false;
  double dead_volume_spread_m3 = 0.0;
  double coil_power_w = 0.0;  // whole group, while energised
  int strokes = 0;            // the same for lines that a source fills alike, as Bounds counts them
  // For a finished box: each with less coil power and more objective than the one before; any line
  // of the box has no less of both than one of them.
  std::vector<LineChoice> choices;
  int weights = 0;  // that their objectives have, as Bounds counts them
};

// Tubes and fittings mate when their diameters agree to 0.05 mm, fittings and valves when thread
// and port are the same. Nothing has to mate where no fitting is needed.
bool DiametersMate(double tube_outer_m, double fitting_outer_m);
bool PartsMate(const Problem& problem, int tubing, int fitting, int valve);  // as in Line

// Factor on every conductance from the gas and its temperature.
double FlowFactor(const Problem& problem, model::Gas gas);

// Air that one actuation of the whole group takes that fills it to this pressure, m³ ANR. A valve
// that holds closes at p_op; one that cannot leaves the actuator on the source for the whole
// window (gait.h), which fills it to p_op at least and at most up to the source pressure.
template <class T>
T AirPerStroke(const Problem& problem, int group, const Line& line, const T& filled_pa);
double LeastAirPerStroke(const Problem& problem, int group, const Line& line);

// How long coils are energised in a period, s, whatever the strokes: a 3/2 while its window lasts,
// a pair or a proportional valve while it vents, and while pumps that hold on fill and hold.
double CoilSeconds(const Problem& problem, int group, bool holds);
double CoilSeconds(const Problem& problem, int group, const Line& line);  // of a box: the least
double LeastCoilSeconds(const Problem& problem);                          // of any group

// Coil energy of one cycle of the whole group, J: of a pair or a proportional valve also while it
// inflates, unless it only vents or that is counted above.
template <class T>
T CoilEnergyPerCycle(const Problem& problem, int group, const Line& line, const T& inflate_time_s) {
  const double strokes = problem.groups[group].gait.strokes_per_period;
  const bool fills = line.holds && !problem.groups[group].fed_past_valve && !PumpsHoldOn(problem);
  const T on_s = CoilSeconds(problem, group, line) + (fills ? strokes * inflate_time_s : T(0.0));
  return line.coil_power_w * on_s;
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_LINE_H_
