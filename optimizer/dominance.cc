#include "optimizer/dominance.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace plenum::optimizer {
namespace {

constexpr std::size_t kDominatorsTried = 2000;

bool ListedFirst(const Contender& a, const Contender& b) {
  return a.id != b.id ? a.id < b.id : a.item.quantity < b.item.quantity;
}

bool NoWorse(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] > b[i]) return false;
  return true;
}

}  // namespace

Skyband KeepBest(const std::vector<Contender>& contenders, int k, double tie) {
  std::vector<int> order(contenders.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const Contender &x = contenders[a], &y = contenders[b];
    return x.objective != y.objective ? x.objective < y.objective : ListedFirst(x, y);
  });
  Skyband result;
  std::unordered_map<std::string, std::vector<int>> kept_by_class;
  std::vector<ProofItem> dominators;
  for (int index : order) {
    const Contender& contender = contenders[index];
    std::vector<int>& kept = kept_by_class[contender.mates];
    dominators.clear();
    for (int other : kept) {
      const Contender& better = contenders[other];
      if ((better.objective < contender.objective - tie || ListedFirst(better, contender)) &&
          NoWorse(better.losses, contender.losses))
        dominators.push_back(better.item);
      if (static_cast<int>(dominators.size()) == k) break;
    }
    if (static_cast<int>(dominators.size()) == k) {
      result.left_out.push_back({contender.item, dominators});
      continue;
    }
    if (kept.size() < kDominatorsTried) kept.push_back(index);
    result.kept.push_back(index);
  }
  return result;
}

}  // namespace plenum::optimizer
