// The designs found so far, in the order of the list: by objective; ties, counted from the first of
// each run of them, by part ids.
#ifndef PLENUM_OPTIMIZER_SEARCH_RANKING_H_
#define PLENUM_OPTIMIZER_SEARCH_RANKING_H_

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/bounds/box.h"
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
};

// Of each slot the choice with the earliest id: no combination in the box is listed before these.
PartIds EarliestIds(const Problem& problem, const Plan& plan, const Box& box);

class Ranking {
 public:
  explicit Ranking(int wanted) : wanted_(wanted) {}

  void Add(Found found);
  void Remove(std::size_t position);  // of one that did not hold
  Found* Find(const PartIds& ids);    // null: not found yet

  // In order; what ties with the last place comes behind it.
  std::vector<Found>& list() { return list_; }
  bool full() const { return static_cast<int>(list_.size()) >= wanted_; }
  const Found& last() const { return list_[wanted_ - 1]; }  // of a full list
  // Of a full list and a box with these earliest ids: whether it may hold a design that comes
  // before the last, or the last itself, found before its box was.
  bool MayTakeLast(const PartIds& earliest) const {
    return earliest < last().ids || (earliest == last().ids && last().record < 0);
  }
  // Objectives of the run of ties that the last place of a full list is in; +∞ until it is full.
  double run_begin() const { return run_begin_; }
  double run_end() const { return run_end_; }
  // Least objective that the settings of a combination behind the list might have.
  double BoundBehind() const;

 private:
  void Sort();

  int wanted_;
  std::vector<Found> list_, spare_;  // spare: beyond the ties of a full list
  double run_begin_ = kUnlimited, run_end_ = kUnlimited;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_RANKING_H_
