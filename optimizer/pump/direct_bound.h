// What pumps without a reservoir must at least bear to fill the groups one after another.
//
// While the chambers are at p the pressure between pumps and valves is p_n ≥ p, and what flows is
// at most what the pumps deliver at any pressure x below p_n, and at most what the lines take at
// any x above it (model/strokes/pump_stroke.h). So with D̄ ≥ the delivery and F ≥ what the lines
// take,
//   Q(p) ≤ F(x, p) for each x with D̄(x) ≤ F(x, p),
// the least of these x by bisection. Q does not rise with p: over a panel of pressures its value at
// the lower end bounds the time that the air of the panel takes. Where the pumps are a single
// choice the highest x with D̲(x) ≥ F(x, p) bounds p_n from below, at which energy per air counts;
// else p.
#ifndef PLENUM_OPTIMIZER_PUMP_DIRECT_BOUND_H_
#define PLENUM_OPTIMIZER_PUMP_DIRECT_BOUND_H_

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "optimizer/evaluate/candidate.h"
#include "optimizer/problem/pump_feed.h"
#include "optimizer/pump/pump_facts.h"

namespace plenum::optimizer {

struct DirectNeed {
  double on_s = 0.0;      // per cycle, of the pumps that run longest
  double energy_j = 0.0;  // per cycle: pumps, and coils while they fill
  double node_pa = 0.0;   // highest pressure between pumps and valves, at least
};

struct DirectStrokeBound {
  double rise_s = 0.0, inflate_s = 0.0, pump_j = 0.0, node_pa = 0.0;
  // What filling takes beyond what holding takes for as long: the rest of what pumps take that hold
  // on is the same for all lines.
  double beyond_holding_j = 0.0;
};

// Keeps the strokes that it found: most boxes differ from others in one group's line.
class DirectBounds {
 public:
  explicit DirectBounds(const Problem& problem)
      : problem_(problem),
        squads_(FedSquadsOf(problem)),
        feeds_meet_(FeedsMeet(problem)),
        feeds_at_once_(FeedsAtOnce(problem)) {}

  // As pump_feed.h has them, looked at once.
  bool feeds_meet() const { return feeds_meet_; }
  int feeds_at_once() const { return feeds_at_once_; }

  // Of the pumps of `facts`, which stay where they are, with `lines`, one per group, with curves
  // and strokes that are counted; none where a group is too slow. No part stands more than
  // `highest_pa`. `chosen`: of which all but the battery is chosen; its strokes are computed and
  // not bounded.
  std::optional<DirectNeed> Least(const PumpFacts& facts, const std::vector<const Line*>& lines,
                                  double highest_pa, const Candidate* chosen);

 private:
  // Pumps, strokes of the line, actuators, highest_pa or 0 of what is chosen.
  using Key = std::tuple<const PumpFacts*, int, int, double>;
  const DirectStrokeBound& StrokeOf(const PumpFacts& facts, const Line& line, const FedSquad& fed,
                                    double highest_pa, const Candidate* chosen);

  const Problem& problem_;
  std::vector<FedSquad> squads_;
  bool feeds_meet_;
  int feeds_at_once_;
  std::map<Key, DirectStrokeBound> known_;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PUMP_DIRECT_BOUND_H_
