// A box that waits in a search, and the orders that boxes come out in.
#ifndef PLENUM_OPTIMIZER_SEARCH_NODE_H_
#define PLENUM_OPTIMIZER_SEARCH_NODE_H_

#include <memory>

#include "optimizer/box.h"
#include "optimizer/custom_sizing.h"
#include "optimizer/queue.h"
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

struct LowestBound : LowestFirst {
  explicit LowestBound(const Node& node) : LowestFirst{node.box.bound, node.depth, node.serial} {}
};

struct EarliestIdsFirst {
  const Node* node;
  explicit EarliestIdsFirst(const Node& waits) : node(&waits) {}
  bool operator<(const EarliestIdsFirst& other) const {
    return node->earliest != other.node->earliest ? node->earliest > other.node->earliest
                                                  : node->serial < other.node->serial;
  }
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_NODE_H_
