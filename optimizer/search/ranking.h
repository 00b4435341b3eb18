// The designs found so far, in the order of the list: by objective; ties, counted from the first of
// each run of them, by part ids. A list of kinds (kind.h) has of each kind its best design, and of
// the kinds of a source as many as there may be.
#ifndef PLENUM_OPTIMIZER_SEARCH_RANKING_H_
#define PLENUM_OPTIMIZER_SEARCH_RANKING_H_

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/bounds/box.h"
#include "optimizer/problem/kind.h"
#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {

// Ids with numbers in parallel, in the order of a design's parts list.
using PartIds = std::vector<std::pair<std::string, int>>;

// A feasible combination.
struct Found {
  Box box;
  const Bounds* bounds = nullptr;  // of its plan
  Leaf leaf;
  PartIds ids;
  int record = -1;                 // its box in the record; −1: the search has not come there yet
  std::shared_ptr<Design> design;  // once the simulator has confirmed it
  Kind kind = {};                  // where kinds are listed
};

// Of each slot the choice with the earliest id: no combination in the box is listed before these.
PartIds EarliestIds(const Problem& problem, const Plan& plan, const Box& box);

// The kind of all combinations in the box; none where they are of several.
std::optional<Kind> KindAt(const Plan& plan, const Box& box);

class Ranking {
 public:
  explicit Ranking(const Problem& problem) : problem_(problem), wanted_(problem.count) {}

  void Add(Found found);
  void Remove(std::size_t position);     // of one that did not hold
  Found* Find(const PartIds& ids);       // null: not found yet
  void Place(Found& found, int record);  // the search has come to its box

  // In order; what ties with the last place comes behind it.
  std::vector<Found>& list() { return list_; }
  bool full() const { return static_cast<int>(list_.size()) >= wanted_; }
  const Found& last() const { return list_[wanted_ - 1]; }  // of a full list
  // Of a full list and a box with these earliest ids: whether it may hold a design that comes
  // before the last, or the last itself, found before its box was.
  bool MayTakeLast(const PartIds& earliest) const { return MayTake(last(), earliest); }
  // Objectives of the run of ties that the last place of a full list is in; +∞ until it is full.
  double run_begin() const { return run_begin_; }
  double run_end() const { return run_end_; }
  // Where kinds are listed: whether nothing in the box can change the list, unless a design is
  // taken out, because all of it is of a kind whose best design is found, or of a source with as
  // many better kinds as there may be.
  bool IsSettled(const Plan& plan, const Box& box) const;
  // Least objective that the settings of a combination behind the list might have, unless it is of
  // a kind or source that IsSettled().
  double BoundBehind() const;

 private:
  struct Run {  // of the best of a kind and what ties with it
    double begin = 0.0, end = 0.0;
    PartIds ids;
    bool seen = false;  // by the search, not only by a dive
  };

  static bool MayTake(const Found& found, const PartIds& earliest) {
    return earliest < found.ids || (earliest == found.ids && found.record < 0);
  }
  bool ListsKinds() const { return problem_.list == ListOf::kKinds; }
  void Sort();
  std::vector<Found> TakeBestOfKinds();
  void SortKinds();

  const Problem& problem_;
  int wanted_;
  std::vector<Found> list_, spare_;  // spare: beyond the ties of a full list
  double run_begin_ = kUnlimited, run_end_ = kUnlimited;
  std::map<Kind, Run> kinds_;
  std::map<std::pair<Configuration, int>, double> source_end_;  // of its last kind that is listed
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_RANKING_H_
