#include "optimizer/dominance.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string_view>
#include <unordered_map>

namespace plenum::optimizer {
namespace {

bool ListedFirst(const Contender& a, const Contender& b) {
  return a.id != b.id ? a.id < b.id : a.item.quantity < b.item.quantity;
}

// The contenders of one class by their losses, as a kd-tree whose nodes know the least losses of
// those below them that have been added: a node that has more of some loss than a contender holds
// none of its dominators.
class LossTree {
 public:
  LossTree(const std::vector<Contender>& contenders, const std::vector<int>& members)
      : contenders_(contenders),
        members_(members),
        losses_(contenders[members.front()].losses.size()),
        order_(members.size()),
        leaf_of_(members.size()),
        added_(members.size(), false) {
    std::iota(order_.begin(), order_.end(), 0);
    Grow(0, static_cast<int>(members.size()), -1);
    least_.assign(nodes_.size() * losses_, std::numeric_limits<double>::infinity());
  }

  void Add(int member) {
    added_[member] = true;
    const std::vector<double>& losses = LossesOf(member);
    for (int at = leaf_of_[member]; at >= 0; at = nodes_[at].parent)
      for (std::size_t k = 0; k < losses_; ++k)
        least_[at * losses_ + k] = std::min(least_[at * losses_ + k], losses[k]);
  }

  // Hands those members to `found` that were added and lose no more anywhere, until it returns
  // false.
  template <typename Found>
  bool NoWorse(const std::vector<double>& losses, const Found& found, int at = 0) const {
    for (std::size_t k = 0; k < losses_; ++k)
      if (least_[at * losses_ + k] > losses[k]) return true;
    const Node& node = nodes_[at];
    if (node.left < 0) {
      for (int i = node.first; i < node.last; ++i)
        if (added_[order_[i]] && Below(LossesOf(order_[i]), losses) && !found(order_[i]))
          return false;
      return true;
    }
    return NoWorse(losses, found, node.left) && NoWorse(losses, found, node.right);
  }

 private:
  struct Node {
    int first, last, parent, left = -1, right = -1;
  };

  static bool Below(const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
      if (a[k] > b[k]) return false;
    return true;
  }

  const std::vector<double>& LossesOf(int member) const {
    return contenders_[members_[member]].losses;
  }

  // Where [first, last) is divided: as near to the middle as one loss of all allows, beginning with
  // the k-th; `first` where they are all alike.
  int Divide(int first, int last, std::size_t k) {
    const auto begin = order_.begin();
    for (std::size_t turn = 0; turn < losses_; ++turn, k = (k + 1) % losses_) {
      const auto loss = [&](int member) { return LossesOf(member)[k]; };
      const int half = first + (last - first) / 2;
      std::nth_element(begin + first, begin + half, begin + last,
                       [&](int a, int b) { return loss(a) < loss(b); });
      const double median = loss(order_[half]);
      auto border = std::partition(begin + first, begin + last,
                                   [&](int member) { return loss(member) < median; });
      if (border == begin + first)
        border = std::partition(begin + first, begin + last,
                                [&](int member) { return loss(member) <= median; });
      if (border != begin + last) return static_cast<int>(border - begin);
    }
    return first;
  }

  int Grow(int first, int last, int parent, std::size_t depth = 0) {
    constexpr int kLeaf = 8;
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back({first, last, parent});
    const int middle =
        last - first > kLeaf && losses_ > 0 ? Divide(first, last, depth % losses_) : first;
    if (middle == first) {
      for (int i = first; i < last; ++i) leaf_of_[order_[i]] = index;
      return index;
    }
    const int left = Grow(first, middle, index, depth + 1);
    const int right = Grow(middle, last, index, depth + 1);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
  }

  const std::vector<Contender>& contenders_;
  const std::vector<int>& members_;
  std::size_t losses_;
  std::vector<int> order_, leaf_of_;  // members as the tree has them; their leaves
  std::vector<bool> added_;
  std::vector<Node> nodes_;
  std::vector<double> least_;  // per node and loss
};

}  // namespace

Skyband KeepBest(const std::vector<Contender>& contenders, int k, double tie,
                 const std::function<bool()>& stop) {
  constexpr int kBetweenLooks = 256;
  std::vector<int> order(contenders.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const Contender &x = contenders[a], &y = contenders[b];
    return x.objective != y.objective ? x.objective < y.objective : ListedFirst(x, y);
  });
  std::unordered_map<std::string_view, std::size_t> number_of;
  std::vector<std::vector<int>> classes;
  for (int index : order) {
    const auto [entry, fresh] = number_of.try_emplace(contenders[index].mates, classes.size());
    if (fresh) classes.emplace_back();
    classes[entry->second].push_back(index);
  }
  Skyband result;
  std::vector<ProofItem> dominators;
  for (const std::vector<int>& members : classes) {
    LossTree kept(contenders, members);
    for (int member = 0; member < static_cast<int>(members.size()); ++member) {
      if (stop && member % kBetweenLooks == 0 && stop()) return {};
      const Contender& contender = contenders[members[member]];
      dominators.clear();
      kept.NoWorse(contender.losses, [&](int other) {
        const Contender& better = contenders[members[other]];
        if (better.objective < contender.objective - tie || ListedFirst(better, contender))
          dominators.push_back(better.item);
        return static_cast<int>(dominators.size()) < k;
      });
      if (static_cast<int>(dominators.size()) == k) {
        result.left_out.push_back({contender.item, dominators});
        continue;
      }
      kept.Add(member);
      result.kept.push_back(members[member]);
    }
  }
  return result;
}

}  // namespace plenum::optimizer
