// A family's choices as a tree of boxes: a binary kd-tree whose every node stands for all choices
// below it by their corner, the componentwise best of what they can do. Whatever the corner cannot
// do, none of the choices can; what it costs, each of them costs at least.
#ifndef PLENUM_OPTIMIZER_CHOICES_BOX_TREE_H_
#define PLENUM_OPTIMIZER_CHOICES_BOX_TREE_H_

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include "optimizer/choices/tie_key.h"
#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {

// A choice and what it can do.
template <typename Corner>
struct Item {
  Option option;
  Corner corner;
  int outdone = 0;  // by how many choices of the family it is dominated
  int series = 0;   // where kinds are listed (kind.h): by number, of its part
  TieShare tie = {};
};

struct BoxNode {
  int left = -1, right = -1;  // −1: a single choice
  int first = 0, last = 0;    // the choices [first, last) of the tree's order
  double objective_low = 0.0, objective_high = 0.0;
  int earliest = 0;   // the choice of the lowest rank
  int outdone = 0;    // each choice is dominated by so many others at least
  int series = 0;     // of all its choices; −1: of several
  TieShare tie = {};  // the least of each
  bool single() const { return left < 0; }
  int size() const { return last - first; }
};

// The node of a single choice.
inline int LeafOf(const std::vector<BoxNode>& nodes, int choice) {
  int at = 0;
  while (!nodes[at].single())
    at = choice < nodes[nodes[at].right].first ? nodes[at].left : nodes[at].right;
  return at;
}

// Node 0 is the root; no nodes where the family has no choices.
template <typename Corner>
struct BoxTree {
  std::vector<BoxNode> nodes;
  std::vector<Corner> corners;  // per node
  std::vector<Option> options;  // in the tree's order
};

namespace box_tree_internal {

template <typename Corner>
class Builder {
 public:
  explicit Builder(const std::vector<const Item<Corner>*>& items)
      : items_(items), order_(items.size()), by_key_(items.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    keys_.reserve(items.size());
    classes_.reserve(items.size());
    for (const Item<Corner>* item : items) {
      keys_.push_back(SplitKeys(item->corner));
      classes_.push_back(MatingClass(item->corner));
    }
  }

  BoxTree<Corner> Build() {
    if (items_.empty()) return {};
    tree_.nodes.reserve(2 * items_.size());
    tree_.corners.reserve(2 * items_.size());
    tree_.options.reserve(items_.size());
    MeetSeries();
    Grow(0, static_cast<int>(order_.size()), true);
    for (int i : order_) tree_.options.push_back(items_[i]->option);
    return std::move(tree_);
  }

 private:
  using Keys = decltype(SplitKeys(std::declval<Corner>()));

  int Rank(int position) const { return order_[position]; }

  Keys Spread(const std::vector<Keys>& keys, int first, int last) const {
    Keys low = keys[order_[first]], high = low;
    for (int i = first; i < last; ++i)
      for (std::size_t k = 0; k < low.size(); ++k) {
        low[k] = std::min(low[k], keys[order_[i]][k]);
        high[k] = std::max(high[k], keys[order_[i]][k]);
      }
    for (std::size_t k = 0; k < low.size(); ++k) high[k] -= low[k];
    return high;
  }

  bool AreSeveralSeries(int first, int last) const {
    for (int i = first + 1; i < last; ++i)
      if (items_[order_[i]]->series != items_[order_[first]]->series) return true;
    return false;
  }

  // Of each series the least of each attribute.
  void MeetSeries() {
    several_series_ = AreSeveralSeries(0, static_cast<int>(order_.size()));
    if (!several_series_) return;
    std::unordered_map<int, Keys> least;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      Keys& keys = least.try_emplace(items_[i]->series, keys_[i]).first->second;
      for (std::size_t k = 0; k < keys.size(); ++k) keys[k] = std::min(keys[k], keys_[i][k]);
    }
    of_series_.reserve(items_.size());
    for (const Item<Corner>* item : items_) of_series_.push_back(least.at(item->series));
  }

  // As Divide() by attributes, but keeps each series together.
  int DivideSeries(int first, int last) {
    const std::size_t widest = Widest(Spread(of_series_, first, last));
    const auto begin = order_.begin() + first, end = order_.begin() + last;
    std::sort(begin, end, [&](int a, int b) {
      const double key_a = of_series_[a][widest], key_b = of_series_[b][widest];
      if (key_a != key_b) return key_a < key_b;
      return items_[a]->series != items_[b]->series ? items_[a]->series < items_[b]->series : a < b;
    });
    return NearestBorder(first, last, [&](int i) { return items_[order_[i]]->series; });
  }

  // Of the places in an ordered range where `of` changes the one that is nearest to the middle.
  int NearestBorder(int first, int last, const auto& of) const {
    int best = first;
    for (int i = first + 1; i < last; ++i)
      if (of(i - 1) != of(i) &&
          (best == first || std::abs(2 * i - first - last) < std::abs(2 * best - first - last)))
        best = i;
    return best;
  }

  static std::size_t Widest(const Keys& spread) {
    return static_cast<std::size_t>(std::max_element(spread.begin(), spread.end()) -
                                    spread.begin());
  }

  // Where [first, last) is divided: between two classes of parts that mate differently as long as
  // there are several, then between series, else at the median of the attribute that is spread
  // most. `several` is set to whether there are several classes.
  int Divide(int first, int last, bool& several) {
    const auto begin = order_.begin() + first, end = order_.begin() + last;
    several = several && std::any_of(begin + 1, end,
                                     [&](int i) { return classes_[i] != classes_[order_[first]]; });
    if (several) {
      std::sort(begin, end, [&](int a, int b) {
        return classes_[a] != classes_[b] ? classes_[a] < classes_[b] : a < b;
      });
      return NearestBorder(first, last, [&](int i) { return classes_[order_[i]]; });
    }
    if (several_series_ && AreSeveralSeries(first, last)) return DivideSeries(first, last);
    const std::size_t widest = Widest(Spread(keys_, first, last));
    const int middle = first + (last - first) / 2;
    const auto begin_key = by_key_.begin() + first, end_key = by_key_.begin() + last;
    for (int i = first; i < last; ++i) by_key_[i] = {keys_[order_[i]][widest], order_[i]};
    std::nth_element(begin_key, by_key_.begin() + middle, end_key);
    std::transform(begin_key, end_key, begin, [](const auto& pair) { return pair.second; });
    return middle;
  }

  // `several`: classes there may be.
  int Grow(int first, int last, bool several) {
    const int index = static_cast<int>(tree_.nodes.size());
    tree_.nodes.push_back({-1, -1, first, last});
    tree_.corners.emplace_back();
    double low, high;
    int earliest = first, outdone, series;
    TieShare tie = {};
    if (last - first == 1) {
      tree_.corners[index] = items_[order_[first]]->corner;
      low = high = tree_.corners[index].objective;
      outdone = items_[order_[first]]->outdone;
      series = items_[order_[first]]->series;
      tie = items_[order_[first]]->tie;
    } else {
      const int middle = Divide(first, last, several);
      const int left = Grow(first, middle, several);
      const int right = Grow(middle, last, several);
      tree_.nodes[index].left = left;
      tree_.nodes[index].right = right;
      tree_.corners[index] = tree_.corners[left];
      Widen(tree_.corners[index], tree_.corners[right]);
      low = std::min(tree_.nodes[left].objective_low, tree_.nodes[right].objective_low);
      high = std::max(tree_.nodes[left].objective_high, tree_.nodes[right].objective_high);
      outdone = std::min(tree_.nodes[left].outdone, tree_.nodes[right].outdone);
      series = tree_.nodes[left].series;
      if (tree_.nodes[right].series != series) series = -1;
      tie = Least(tree_.nodes[left].tie, tree_.nodes[right].tie);
      earliest = tree_.nodes[left].earliest;
      if (Rank(tree_.nodes[right].earliest) < Rank(earliest))
        earliest = tree_.nodes[right].earliest;
    }
    tree_.nodes[index].objective_low = low;
    tree_.nodes[index].objective_high = high;
    tree_.nodes[index].earliest = earliest;
    tree_.nodes[index].outdone = outdone;
    tree_.nodes[index].series = series;
    tree_.nodes[index].tie = tie;
    return index;
  }

  const std::vector<const Item<Corner>*>& items_;
  std::vector<int> order_;
  std::vector<Keys> keys_;
  bool several_series_ = false;
  std::vector<Keys> of_series_;                 // per item
  std::vector<std::pair<double, int>> by_key_;  // of what is being divided, in the same order
  std::vector<decltype(MatingClass(std::declval<Corner>()))> classes_;
  BoxTree<Corner> tree_;
};

}  // namespace box_tree_internal

// `items`: in the order of ids, then quantities.
template <typename Corner>
BoxTree<Corner> MakeBoxTree(const std::vector<const Item<Corner>*>& items) {
  return box_tree_internal::Builder<Corner>(items).Build();
}

// The choice below `node` with the least objective of those that `could` accepts, as a node; it
// must accept the corner of every box that holds an accepted choice. `best` (none at first) where
// none below it has less.
template <typename Corner, typename Could>
int LeastChoice(const BoxTree<Corner>& tree, int node, const Could& could, int best = -1) {
  const Corner& corner = tree.corners[node];
  if ((best >= 0 && corner.objective >= tree.corners[best].objective) || !could(corner))
    return best;
  const BoxNode& box = tree.nodes[node];
  if (box.single()) return node;
  int near = box.left, far = box.right;
  if (tree.corners[far].objective < tree.corners[near].objective) std::swap(near, far);
  best = LeastChoice(tree, near, could, best);
  return LeastChoice(tree, far, could, best);
}

// Its objective; +∞ without one.
template <typename Corner, typename Could>
double LeastObjective(const BoxTree<Corner>& tree, int node, const Could& could) {
  const int least = LeastChoice(tree, node, could);
  return least < 0 ? kUnlimited : tree.corners[least].objective;
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_BOX_TREE_H_
