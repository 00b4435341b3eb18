// What designs come to in draws of their parts. Internal to robust*.cc.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_ROBUST_DRAWS_H_
#define PLENUM_OPTIMIZER_EXPLAIN_ROBUST_DRAWS_H_

#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/choices/tie_key.h"
#include "optimizer/problem/robust_answer.h"

namespace plenum::optimizer {

// Which combination a design is: ids with numbers in parallel.
using Combination = std::pair<PartIds, Configuration>;
Combination CombinationOf(const Design& design);

// Objective of one design per draw; +∞ where the draw is not met.
using Objectives = std::vector<double>;

// Remembers what was drawn. The time limit is that of all draws together.
class Draws {
 public:
  Draws(const Problem& problem, const SearchOptions& search_options, const RobustOptions& options,
        const DrawParts& draw_parts);

  // Draw by draw, so that all of these designs have the same draws when time ends it: so many are
  // given. A design that can no longer reach the probability that is asked for gets no more.
  int Run(const std::vector<Design>& designs);

  bool stopped() const;
  const Objectives& of(const Design& design) const { return objectives_.at(KeyOf(design)); }
  int Drawn(const Design& design) const { return static_cast<int>(of(design).size()); }
  int Met(const Design& design, int draws) const;
  bool Reaches(const Design& design, int draws) const;

 private:
  // A made-to-measure reservoir is another part with another volume.
  using Key = std::pair<Combination, double>;
  static Key KeyOf(const Design& design) {
    return {CombinationOf(design), design.settings.reservoir_volume_m3.value_or(0.0)};
  }
  bool Hopeless(const Objectives& drawn) const;
  double ObjectiveIn(const Design& design, int draw);

  Problem problem_;  // with the parts of a draw
  const SearchOptions& search_options_;
  const RobustOptions& options_;
  const DrawParts& draw_parts_;
  std::map<Key, Objectives> objectives_;
  double used_s_ = 0.0;  // before the run that goes on
  std::chrono::steady_clock::time_point start_;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_ROBUST_DRAWS_H_
