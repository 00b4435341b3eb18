// A heap whose top can be taken out: std::priority_queue cannot give up what only moves.
#ifndef PLENUM_OPTIMIZER_QUEUE_H_
#define PLENUM_OPTIMIZER_QUEUE_H_

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace plenum::optimizer {

// `Later(a, b)`: a comes out after b.
template <typename Item, typename Later>
class Queue {
 public:
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  const Item& top() const { return items_.front(); }
  const std::vector<Item>& items() const { return items_; }
  void Push(Item item) {
    items_.push_back(std::move(item));
    std::push_heap(items_.begin(), items_.end(), Later());
  }
  Item Pop() {
    std::pop_heap(items_.begin(), items_.end(), Later());
    Item item = std::move(items_.back());
    items_.pop_back();
    return item;
  }

 private:
  std::vector<Item> items_;
};

// Lowest key first; of equal ones the deepest, of these the one that was pushed first.
struct LowestKey {
  bool operator()(const auto& a, const auto& b) const {
    if (a->key != b->key) return a->key > b->key;
    if (a->depth != b->depth) return a->depth < b->depth;
    return a->serial > b->serial;
  }
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_QUEUE_H_
