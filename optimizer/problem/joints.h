// Manifolds and tees: what joins several lines to their source, and several pieces of a source to
// each other; and check valves. They follow from the request and from the other parts, so that a
// search does not choose them.
//
// n lines, or pieces, need pieces of one row whose stations suffice in a tree: ⌈(n − 1)/(k − 1)⌉ of
// k stations. Of the rows that stand the pressure and pass enough the one whose pieces together are
// least by the request's objective (Problem::joints_by, in packs of their own, energy aside); ties
// go by mass, cost and id. Rows with a price go before those without, which are none where cost
// counts. Along a front the rows stay: they are least by what orders the front's designs. Where no
// row passes enough it is of those that pass most. Where none stands the pressure there is no
// joint, and nothing counts. Where products alone are asked for (Problem::orderable_only) a class
// of products joins only what no product does: what joins is there in either case.
//
// Enough, for lines, is kJointFactor times what all actuators ask who fill at once within their
// rise times (JointConductance below). It would slow lines which are just fast enough by 2 or 3 %
// at most, which is left out.
//
// Pumps of each actuator (pump_feed.h) keep it full while they are off. Where their row says that
// they let air back each feed has a check valve between them and its line, the same for all feeds:
// of the rows that stand the highest operating pressure and pass enough for the actuator that asks
// most the least one, as above. Where no row does, such pumps are no choice. Air passes it while
// the pressure in front is its cracking pressure above that behind, so that the pumps work against
// so much more: their curves are shifted by it, to the pressures behind the check valve, which
// alone all else knows.
#ifndef PLENUM_OPTIMIZER_PROBLEM_JOINTS_H_
#define PLENUM_OPTIMIZER_PROBLEM_JOINTS_H_

#include <optional>
#include <vector>

#include "optimizer/problem/own_regulators.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

inline constexpr double kJointFactor = 4.0;

struct Joint {
  Family family = Family::kManifold;
  int part = -1;  // in Problem::parts
  int quantity = 0;
};

// How many lines there are: one for each actuator.
int LineCount(const Problem& problem);

// kJointFactor times the sonic conductance, m³/(s·Pa), that fills all actuators of a group within
// their rise time, or else their part of the period, from a source at their operating pressure; of
// evacuated ones from what is inside, in the logarithmic mean over the stroke.
double JointConductance(const Problem& problem, int group);
// Of all lines, as their groups have it (ActuatorGroup).
double JointConductance(const Problem& problem);

// None: there is one line, or nothing joins them.
std::optional<Joint> JointOfLines(const Problem& problem);
// The same of the lines of a group behind its own regulator, and of these regulators in front of
// them, at a part of a source or, kRegulator, at the mains.
std::optional<Joint> JointOfLines(const Problem& problem, int group);
std::optional<Joint> JointOfOwnRegulators(const Problem& problem, Family family, int part);
// The same of some pieces of a part of a source. Batteries and regulators have nothing to join.
std::optional<Joint> JointOfPieces(const Problem& problem, Family family, int part, int quantity);

// The check valve among these parts, by its number; −1: none serves.
int CheckValveOf(const Problem& problem, const model::Parts& parts);
// Shifts the curves of pumps among the parts that let air back to what the check valve leaves, and
// leaves these pumps out where there is none. Where the problem has no pumps of each actuator
// nothing needs a check valve, and none is left.
void FitCheckValves(const Problem& problem, model::Parts& parts);

// Of all feeds of pumps of their own (pump_feed.h), each of so many pumps. For a group: what joins
// the pumps. For an actuator, each in its turn: what joins pumps, line and the valve that vents it,
// and the check valves of pumps that let air back.
std::vector<Joint> JointsOfFeeds(const Problem& problem, Family family, int part, int quantity);

// All joints of a design with these other rows; what is the same part is told once.
std::vector<Joint> JointsOf(const Problem& problem, const std::vector<Choice>& rows);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_JOINTS_H_
