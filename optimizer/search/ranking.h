// The designs found so far, in the order of the list: by objective; ties, counted from the first of
// each run of them, by mass, cost and part ids. A list of kinds (kind.h) has of each kind its best
// design, and of the kinds of a source as many as there may be.
#ifndef PLENUM_OPTIMIZER_SEARCH_RANKING_H_
#define PLENUM_OPTIMIZER_SEARCH_RANKING_H_

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/bounds/box.h"
#include "optimizer/choices/tie_key.h"
#include "optimizer/problem/amount.h"
#include "optimizer/problem/kind.h"
#include "optimizer/problem/proof.h"
#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {

// A feasible combination.
struct Found {
  Box box;
  const Bounds* bounds = nullptr;  // of its plan
  Leaf leaf;
  TieKey key;
  int record = -1;                 // its box in the record; −1: the search has not come there yet
  std::shared_ptr<Design> design;  // once the simulator has confirmed it
  Kind kind = {};                  // where kinds are listed
};

// Of each slot the least mass, the least cost, and the choice with the earliest id: no combination
// in the box that ties comes before these; of a single one they are its own.
TieKey EarliestKey(const Problem& problem, const Plan& plan, const Box& box);

// The kind of all combinations in the box; none where they are of several.
std::optional<Kind> KindAt(const Plan& plan, const Box& box);

class Ranking {
 public:
  explicit Ranking(const Problem& problem)
      : problem_(problem), wanted_(problem.count), tie_(TieOf(problem)) {}

  void Add(Found found);
  void Remove(std::size_t position);
  // The designs from a place on are not listed: their least bound.
  double LeaveOutFrom(std::size_t position);  // of one that did not hold
  Found* Find(const TieKey& key);             // null: not found yet
  void Place(Found& found, int record);       // the search has come to its box

  // In order; what ties with the last place comes behind it.
  std::vector<Found>& list() { return list_; }
  bool HasAsGoodAs(double objective) const {
    return !list_.empty() && list_.front().leaf.objective <= objective;
  }
  bool full() const { return static_cast<int>(list_.size()) >= wanted_; }
  const Found& last() const { return list_[wanted_ - 1]; }  // of a full list
  // Of a full list and a box with this earliest key: whether it may hold a design that comes
  // before the last, or the last itself, found before its box was.
  bool MayTakeLast(const TieKey& earliest) const { return MayTake(last(), earliest); }
  // Objectives of the run of ties that the last place of a full list is in; +∞ until it is full.
  double run_begin() const { return run_begin_; }
  double run_end() const { return run_end_; }
  // How a box with this bound that holds nothing better than the last is closed in the record.
  BoxKind EndBehind(double bound) const {
    return full() && bound <= run_end_ ? BoxKind::kOrder : BoxKind::kBound;
  }
  // Where kinds are listed: whether nothing in the box can change the list, unless a design is
  // taken out, because all of it is of a kind whose best design is found, or of a source with as
  // many better kinds as there may be.
  bool IsSettled(const Plan& plan, const Box& box) const;
  // How such a box is closed in the record: by its kind or source where that is listed.
  BoxKind EndOfSettled(const Plan& plan, const Box& box) const;
  // Least objective that the settings of a combination behind the list might have, unless it is of
  // a kind or source that IsSettled().
  double BoundBehind() const;

 private:
  struct Run {  // of the best of a kind and what ties with it
    double begin = 0.0, end = 0.0;
    TieKey key;
    bool seen = false;  // by the search, not only by a dive
  };

  static bool MayTake(const Found& found, const TieKey& earliest) {
    return earliest < found.key || (earliest == found.key && found.record < 0);
  }
  bool ListsKinds() const { return problem_.list == ListOf::kKinds; }
  void Sort();
  std::vector<Found> TakeBestOfKinds();
  void SortKinds();

  const Problem& problem_;
  int wanted_;
  double tie_;
  std::vector<Found> list_, spare_;  // spare: beyond the ties of a full list
  double run_begin_ = kUnlimited, run_end_ = kUnlimited;
  std::map<Kind, Run> kinds_;
  std::map<Kind::Sources, double> source_end_;  // of its last kind that is listed
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_RANKING_H_
