#include "optimizer/bounds/line_list.h"

#include <algorithm>

namespace plenum::optimizer {

const ListedLine* LineList::At(std::size_t place, int looks, const Look& look) {
  if (!begun_) {
    open_.push({0.0, {0, 0, 0}});
    begun_ = true;
  }
  for (; place >= found_.size() && !open_.empty() && looks > 0; --looks) {
    const Open lowest = open_.top();
    open_.pop();
    Box box;
    if (!look(lowest.nodes, box)) continue;
    const double objective = std::max(lowest.objective, box.objective);
    // Of a box that was not looked at before only that of the larger one was known.
    if (!open_.empty() && objective > open_.top().objective && objective > lowest.objective) {
      open_.push({objective, lowest.nodes});
      continue;
    }
    if (box.single) {
      found_.push_back(box.line);
      found_.back().objective = objective;
      continue;
    }
    for (const Nodes& half : box.halves) open_.push({objective, half});
  }
  return place < found_.size() ? &found_[place] : nullptr;
}

std::size_t LineList::PlaceOf(double objective) const {
  return static_cast<std::size_t>(std::lower_bound(found_.begin(), found_.end(), objective,
                                                   [](const ListedLine& line, double least) {
                                                     return line.objective < least;
                                                   }) -
                                  found_.begin());
}

double LineList::Beyond() const {
  if (!begun_) return 0.0;
  return open_.empty() ? std::numeric_limits<double>::infinity() : open_.top().objective;
}

}  // namespace plenum::optimizer
