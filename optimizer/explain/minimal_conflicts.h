// Sets of demands that cannot be met together, and the fewest that must be dropped.
//
// Over an oracle that says whether something meets all demands but the dropped ones. To drop more
// is never harder, so what one answer implies of other sets is not asked again.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_MINIMAL_CONFLICTS_H_
#define PLENUM_OPTIMIZER_EXPLAIN_MINIMAL_CONFLICTS_H_

#include <functional>
#include <set>
#include <vector>

namespace plenum::optimizer {

enum class Met { kYes, kNo, kUnknown };  // unknown: time ran out

using DemandSet = std::set<int>;  // positions of demands

class DropOracle {
 public:
  using Ask = std::function<Met(const DemandSet& dropped)>;
  explicit DropOracle(Ask ask) : ask_(std::move(ask)) {}
  Met operator()(const DemandSet& dropped);

 private:
  Ask ask_;
  std::vector<DemandSet> met_, not_met_;
};

struct MinimalConflict {
  DemandSet demands;
  DemandSet proved;  // of these: without it the others are met, as an answer said
};

// Of the demands 0 … count − 1 but `dropped`, which are not met together: a smallest set in the
// sense that nothing can be taken away, the earlier demands rather than later ones.
MinimalConflict FindMinimalConflict(int count, const DemandSet& dropped, DropOracle& oracle);

// Disjoint ones, until what is left is met (or not known to fail). Precondition: all of the demands
// together are not met.
std::vector<MinimalConflict> FindDisjointConflicts(int count, DropOracle& oracle);

// All smallest sets of demands without which the rest is met, at most `most` of them; each holds a
// demand of every conflict there is. (Implicit hitting sets: those of the conflicts known are asked
// in the order of their size, and one that fails gives a conflict more.) Empty: even without all
// demands nothing is met, or time ran out.
std::vector<DemandSet> FindSmallestDrops(int count, const std::vector<MinimalConflict>& known,
                                         std::size_t most, DropOracle& oracle);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_MINIMAL_CONFLICTS_H_
