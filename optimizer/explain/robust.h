// How a ranked list stands up to part numbers that are not quite what the catalogue says.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_ROBUST_H_
#define PLENUM_OPTIMIZER_EXPLAIN_ROBUST_H_

#include "optimizer/problem/problem.h"
#include "optimizer/problem/robust_answer.h"

namespace plenum::optimizer {

// Monte Carlo with common random numbers. The parts of each design are bought: they stay, and so
// does the volume of a made-to-measure reservoir. The settings can be tuned on the bench: source
// pressure and duties are sized anew in each draw, with the evaluation that ranks. A draw is met
// where sizing proves it feasible. Compared are the listed designs; the search is not repeated.
//
// With `probability_min` p a design is listed if at least p of its draws are met. The search goes
// deeper until nothing that it did not list can be among the Problem::count best of these, 500 were
// looked at, or time is up. Designs beyond, found where every requirement is tightened, fill the
// list; they may have a larger made-to-measure reservoir than the search would give them. Every
// other design, sized by the search, has an objective of at least the proof's lower bound or was
// looked at and left out. `optimal`: all draws were made and no other belongs on the list. Else
// `feasible`, with the gap of the last design, 1 where there is none.
RobustAnswer SearchRobust(const Problem& problem, const SearchOptions& search_options,
                          const RobustOptions& options, const DrawParts& draw_parts);

// The draws for a given list, such as a Pareto front; without probability_min.
RobustAnswer AssessRobustness(const Problem& problem, Answer answer,
                              const SearchOptions& search_options, const RobustOptions& options,
                              const DrawParts& draw_parts);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_ROBUST_H_
