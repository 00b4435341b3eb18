// Valves that close late.
//
// A valve that holds is told to close early by its response time, so that it closes when the
// operating pressure is reached. By how much it may close later (Valve::closing_scatter_s) more air
// comes in, and the pressure that its actuator then has, the peak, counts against the group's
// limit. The source is taken at its setting, the highest that it has: neither droop nor a regulator
// nor neighbours make a peak higher. Pumps without a reservoir stop when they are told to, so that
// nothing comes after that; a valve that cannot hold does not close at all.
#ifndef PLENUM_OPTIMIZER_EVALUATE_CLOSING_H_
#define PLENUM_OPTIMIZER_EVALUATE_CLOSING_H_

#include <span>
#include <vector>

#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/root.h"

namespace plenum::optimizer {

struct Closing {
  std::span<const model::FlowElement> fill;  // from the source to one actuator, passing most
  const model::Chamber& chamber;             // that fills first
  double late_s;
};

// Absolute pressure after `late_s` more of the source beyond the operating pressure, at most that
// of the source; the operating pressure where nothing is late.
double PeakPa(const Problem& problem, int group, double flow_factor, const Closing& closing,
              double source_pa);

// Where the highest source pressure lies, at most `most_pa`, at which the peak keeps the group's
// limit: it does at the lower end. `tolerance`: of its width, relative.
Bracket HighestSourcePa(const Problem& problem, int group, double flow_factor,
                        const Closing& closing, double most_pa, double tolerance);

// The peak of a group of a candidate whose lines are of single parts; of actuators that stay on the
// source its pressure. T: double, or a dual number, differentiated by differences.
template <class T>
T PeakOf(const Problem& problem, const Candidate& candidate, int group, const T& source_pa);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_CLOSING_H_
