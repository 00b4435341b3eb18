// The best of every number of a group's choices in a box. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_LINE_H_
#define PLENUM_VERIFY_CORNER_VERIFY_LINE_H_

#include "model/flow/flow_table.h"
#include "verify/corner/verify_ranges.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Of the pressure behind a regulator, Pa absolute, by the rise time and by half of the period.
struct NodeMeans {
  double rise_pa = 0.0, inflate_pa = 0.0;
};

// On the way from rest to the operating pressure: what the actuators that fill at once hold there
// above rest, Pa·m³, at least and at most.
struct StrokeKnot {
  double pressure_pa = 0.0, least_drawn = 0.0, most_drawn = 0.0;
};

// How actuators fill: the flow of a line as a table, and knots on the way to the target of the rise
// time and on to the operating pressure.
struct Filling {
  model::FlowTable flow;
  std::vector<StrokeKnot> to_target, to_operating;
};

struct BestLine {
  // False: no choices fit together; or the best of each, alone on a source without limits, miss a
  // pressure or a time. Nothing below is valid then.
  bool mates = false, works = false;
  std::vector<model::FlowElement> fill;  // in the order crossed, largest C and b of each element
  struct Ways {
    model::Series fill, exhaust;  // of these, and on the way out, with gas and temperature factor
  } series;
  Filling filling;
  model::Chamber chamber;       // with the narrowest bore
  model::Chamber widest;        // with the widest
  double source_low_pa = 0.0;   // least that is fast enough and switches a valve
  double source_high_pa = 0.0;  // most that the parts stand
  double coil_w = 0.0;          // whole group
  double coil_s = 0.0;          // it is on in a cycle, at least, whatever the strokes
  double inflate_s = 0.0;       // at the highest pressure; 0 unless all valves hold
  bool some_hold = false, all_hold = true;
  NodeMeans least_means;  // with which it is fast enough, of groups that inflate at once
};

BestLine BestOf(const Problem& problem, const ProofPlan& plan, const Ranges& ranges, int group);

int SlotOf(const ProofPlan& plan, Family family, int group);

// Pressure after a share of the way from ambient to the operating pressure.
double PressureAt(const Problem& problem, int group, double fraction);
double FallenPa(const Problem& problem, int group);  // where its fall ends

// Content of all chambers of a group above that at rest, Pa·m³, with the given dead volume.
double Drawn(const Problem& problem, int group, const model::Chamber& chamber, double pressure_pa);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_LINE_H_
