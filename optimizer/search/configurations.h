// The configurations of a search. Planting one takes as long as a small search, and of most nothing
// but their outline is ever asked: so each waits until a search has come to its bound.
#ifndef PLENUM_OPTIMIZER_SEARCH_CONFIGURATIONS_H_
#define PLENUM_OPTIMIZER_SEARCH_CONFIGURATIONS_H_

#include <functional>
#include <memory>
#include <vector>

#include "optimizer/bounds/box.h"
#include "optimizer/choices/outline.h"

namespace plenum::optimizer {

class Configurations {
 public:
  // `bench` as in Bounds, also says when to stop; `record`: plans that name what they leave out.
  Configurations(const Problem& problem, const Workbench& bench, bool record);

  // Least objective of a design in one that waits; +∞ where none does.
  double LeastWaiting() const;
  // Plants the one with the least bound. Null where it was told to stop: then it goes on waiting.
  Bounds* PlantNext();

  const std::vector<Outline>& waiting() const { return waiting_; }
  const std::vector<std::unique_ptr<Bounds>>& planted() const { return planted_; }
  BigCount combinations() const { return combinations_; }  // of all

 private:
  const Problem& problem_;
  const Workbench& bench_;
  bool record_;
  std::vector<Outline> waiting_;  // the least bound last
  std::vector<std::unique_ptr<Plan>> plans_;
  std::vector<std::unique_ptr<Bounds>> planted_;
  BigCount combinations_ = 0;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_CONFIGURATIONS_H_
