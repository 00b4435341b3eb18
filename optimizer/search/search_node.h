// A box that waits in a search, and the orders that boxes come out in.
#ifndef PLENUM_OPTIMIZER_SEARCH_SEARCH_NODE_H_
#define PLENUM_OPTIMIZER_SEARCH_SEARCH_NODE_H_

#include <memory>

#include "optimizer/bounds/box.h"
#include "optimizer/search/queue.h"
#include "optimizer/search/ranking.h"
#include "optimizer/sizing/custom_sizing.h"

namespace plenum::optimizer {

struct Node {
  Box box;
  Bounds* bounds = nullptr;
  long long serial = 0;  // order of creation: the same search on every run
  int depth = 0;
  int record = -1;
  std::unique_ptr<CustomSizing> sizing;  // a made-to-measure reservoir that is being sized
  TieKey earliest;                       // while ties are searched
};
using NodePtr = std::unique_ptr<Node>;

struct LowestBound {  // among equals, the nearest to a design
  LowestFirst operator()(const NodePtr& node) const {
    return {node->box.bound, node->depth, node->serial};
  }
};

struct EarliestFirst {
  struct Place {
    const Node* node;
    bool operator<(const Place& other) const {
      return node->earliest != other.node->earliest ? node->earliest < other.node->earliest
                                                    : node->serial > other.node->serial;
    }
  };
  Place operator()(const NodePtr& node) const { return {node.get()}; }
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_SEARCH_NODE_H_
