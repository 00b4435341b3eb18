// A heap whose top can be taken out, which std::priority_queue cannot give up where it only moves,
// and whose keys lie next to each other: a large one is mostly waits for memory.
#ifndef PLENUM_OPTIMIZER_QUEUE_H_
#define PLENUM_OPTIMIZER_QUEUE_H_

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace plenum::optimizer {

// `Key`: made of what an item points to; a < b: a comes out after b.
template <typename Item, typename Key>
class Queue {
 public:
  bool empty() const { return entries_.empty(); }
  std::size_t size() const { return entries_.size(); }
  const Item& top() const { return entries_.front().item; }
  template <typename Visit>
  void ForEach(const Visit& visit) const {
    for (const Entry& entry : entries_) visit(entry.item);
  }
  void Push(Item item) {
    const Key key(*item);
    entries_.push_back({key, std::move(item)});
    std::push_heap(entries_.begin(), entries_.end());
  }
  Item Pop() {
    std::pop_heap(entries_.begin(), entries_.end());
    Item item = std::move(entries_.back().item);
    entries_.pop_back();
    return item;
  }

 private:
  struct Entry {
    Key key;
    Item item;
    bool operator<(const Entry& other) const { return key < other.key; }
  };
  std::vector<Entry> entries_;
};

// The lowest first; of equal ones the deepest, the nearest to a design, of these the one that was
// pushed first.
struct LowestFirst {
  double lowest;
  int depth;
  long long serial;
  bool operator<(const LowestFirst& other) const {
    if (lowest != other.lowest) return lowest > other.lowest;
    if (depth != other.depth) return depth < other.depth;
    return serial > other.serial;
  }
};

struct LowestKey : LowestFirst {
  template <typename Node>
  explicit LowestKey(const Node& node) : LowestFirst{node.key, node.depth, node.serial} {}
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_QUEUE_H_
