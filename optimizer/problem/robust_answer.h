// What is asked about part numbers that are not quite right, and what is answered, as values.
#ifndef PLENUM_OPTIMIZER_PROBLEM_ROBUST_ANSWER_H_
#define PLENUM_OPTIMIZER_PROBLEM_ROBUST_ANSWER_H_

#include <functional>
#include <optional>
#include <vector>

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// The parts of a design as draw number `draw` has them, with the ids of the design; a
// made-to-measure reservoir is by then a stock reservoir with the id "custom". A part has the same
// numbers in every design of a draw, and a draw is the same whenever it is asked for.
using DrawParts = std::function<model::Parts(const Design& design, int draw)>;

struct RobustOptions {
  int draws = 200;
  double time_limit_s = 10.0;             // of the draws; the search has its own
  std::optional<double> probability_min;  // list only designs that meet all with this probability
};

struct Robustness {
  int met = 0;    // draws in which the design meets every requirement
  int first = 0;  // draws in which it meets them and no listed design is better (ties: by rank)
};

// What a list that asks for a probability was chosen from.
struct Searched {
  int count = 0;  // designs asked of the search
  Answer answer;
  std::vector<int> place;  // in the list, of each of its designs; −1: not listed
};

struct RobustAnswer {
  Answer answer;
  int draws = 0;                       // done
  std::vector<Robustness> robustness;  // per design of the answer
  int below = 0;                       // designs left out for probability_min
  std::optional<Searched> searched;    // with probability_min
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_ROBUST_ANSWER_H_
