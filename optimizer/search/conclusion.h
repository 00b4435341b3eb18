// What a search that has ended claims.
#ifndef PLENUM_OPTIMIZER_SEARCH_CONCLUSION_H_
#define PLENUM_OPTIMIZER_SEARCH_CONCLUSION_H_

#include "optimizer/problem/problem.h"
#include "optimizer/search/ranking.h"
#include "optimizer/search/recorder.h"

namespace plenum::optimizer {

struct Ending {
  bool stopped = false, cancelled = false;
  bool any_design = false;  // was enough
  double seconds = 0.0;
};

// Where the objective is one of the limited amounts alone, its limit bounds the objective.
double ObjectiveLimit(const Problem& problem);

// The share by which the last design of a list may be too large: 1 − lower bound / last, at least
// 0.
double GapOf(double lower_bound, double last);

// `proof`: complete but for gap and record, its lower bound that of all that is not in the list and
// was not left out by dominance. Takes the designs out of the list.
Answer Conclude(const Problem& problem, const Ending& ending, Proof proof, Ranking& ranking,
                Recorder& recorder);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_CONCLUSION_H_
