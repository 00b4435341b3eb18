// A listed design: the candidate with its settings, checked and traced by the simulator.
#ifndef PLENUM_OPTIMIZER_SIZING_REPORT_H_
#define PLENUM_OPTIMIZER_SIZING_REPORT_H_

#include <functional>
#include <optional>
#include <vector>

#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {

// None where the simulator, run on the whole rig in its periodic state, does not confirm that every
// requirement is met: the design is then not listed but counted as undecided.
// The settings that the objective leaves free are chosen (sizing.h) until `late`, if given, says
// so; after that the leaf's are kept.
std::optional<Design> MakeDesign(const Problem& problem, const Candidate& candidate,
                                 const Leaf& given, const std::function<bool()>& late = {});

// The rows of its parts list at a point.
std::vector<Choice> ListParts(const Problem& problem, const Candidate& candidate,
                              const OperatingPoint& point);

// Whether two rows are the same part in the same number for the same group; and two lists.
bool SameRow(const Choice& a, const Choice& b);
bool SameParts(const std::vector<Choice>& a, const std::vector<Choice>& b);

// The candidate at a point as it was evaluated there, whatever it meets, without a trace.
Design Describe(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                const Evaluation& evaluation);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SIZING_REPORT_H_
