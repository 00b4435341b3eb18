// A heap whose top can be taken out, which std::priority_queue cannot give up where it only moves,
// and whose keys lie next to each other: a large one is mostly waits for memory.
#ifndef PLENUM_OPTIMIZER_SEARCH_QUEUE_H_
#define PLENUM_OPTIMIZER_SEARCH_QUEUE_H_

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace plenum::optimizer {

// `PlaceOf()(item)`: an ordered value that does not change while the item waits; the least comes
// out first. Kept beside the items, so that the heap need not look into them.
template <typename Item, typename PlaceOf>
class Queue {
 public:
  bool empty() const { return waiting_.empty(); }
  std::size_t size() const { return waiting_.size(); }
  const Item& top() const { return waiting_.front().item; }
  void Push(Item item) {
    const auto place = PlaceOf()(item);
    waiting_.push_back({place, std::move(item)});
    std::push_heap(waiting_.begin(), waiting_.end());
  }
  Item Pop() {
    std::pop_heap(waiting_.begin(), waiting_.end());
    Item item = std::move(waiting_.back().item);
    waiting_.pop_back();
    return item;
  }
  void ForEach(const auto& visit) const {
    for (const Waiting& waiting : waiting_) visit(waiting.item);
  }

 private:
  struct Waiting {
    decltype(PlaceOf()(std::declval<Item>())) place;
    Item item;
    bool operator<(const Waiting& other) const { return other.place < place; }
  };
  std::vector<Waiting> waiting_;
};

// The lowest first; of equal ones the deepest, of these the one that was pushed first.
struct LowestFirst {
  double value;
  int depth;
  long long serial;
  bool operator<(const LowestFirst& other) const {
    if (value != other.value) return value < other.value;
    if (depth != other.depth) return depth > other.depth;
    return serial < other.serial;
  }
};
struct LowestKey {
  LowestFirst operator()(const auto& item) const { return {item->key, item->depth, item->serial}; }
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_QUEUE_H_
