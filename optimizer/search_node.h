// A box that waits in a search, and the orders that boxes come out in.
#ifndef PLENUM_OPTIMIZER_SEARCH_NODE_H_
#define PLENUM_OPTIMIZER_SEARCH_NODE_H_

#include <memory>

#include "optimizer/box.h"
#include "optimizer/custom_sizing.h"
#include "optimizer/ranking.h"

namespace plenum::optimizer {

struct Node {
  Box box;
  Bounds* bounds = nullptr;
  long long serial = 0;  // order of creation: the same search on every run
  int depth = 0;
  int record = -1;
  std::unique_ptr<CustomSizing> sizing;  // a made-to-measure reservoir that is being sized
  PartIds earliest;                      // while ties are searched
};
using NodePtr = std::unique_ptr<Node>;

struct LowestBound {
  bool operator()(const NodePtr& a, const NodePtr& b) const {
    if (a->box.bound != b->box.bound) return a->box.bound > b->box.bound;
    if (a->depth != b->depth) return a->depth < b->depth;  // among equals, the nearest to a design
    return a->serial > b->serial;
  }
};

struct EarliestIdsFirst {
  bool operator()(const NodePtr& a, const NodePtr& b) const {
    return a->earliest != b->earliest ? a->earliest > b->earliest : a->serial < b->serial;
  }
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_NODE_H_
