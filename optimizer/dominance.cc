#include "optimizer/dominance.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace plenum::optimizer {
namespace {

bool ListedFirst(const Contender& a, const Contender& b) {
  return a.id != b.id ? a.id < b.id : a.item.quantity < b.item.quantity;
}

// Losses of the contenders of one class that are kept, in chunks as they come: one column for each
// loss, so that one of a whole chunk is compared at once.
class KeptLosses {
 public:
  explicit KeptLosses(std::size_t losses) : losses_(losses) {}

  void Add(const Losses& losses) {
    const std::size_t place = size_++ % kChunk;
    if (place == 0) chunks_.resize(chunks_.size() + losses_);
    Column* columns = chunks_.data() + (chunks_.size() - losses_);  // none where nothing counts
    for (std::size_t k = 0; k < losses_; ++k) {
      columns[k].loss[place] = losses[k];
      columns[k].least = std::min(columns[k].least, losses[k]);
    }
  }

  // Hands the numbers of those that lose no more anywhere to `found`, until it returns false. The
  // last to come are the first: with a share of the objective that is hardly smaller they are the
  // likeliest to lose no more, and most chunks of much smaller shares have none that does.
  template <typename Found>
  void NoWorse(const Losses& losses, const Found& found) const {
    for (std::size_t last = size_; last > 0;) {
      const std::size_t first = (last - 1) / kChunk * kChunk;
      const Column* columns = chunks_.data() + first / kChunk * losses_;
      std::array<std::int64_t, kChunk> worse;
      if (AnyNoWorse(columns, losses, worse))
        for (std::size_t i = last - first; i-- > 0;)
          if (worse[i] == 0 && !found(first + i)) return;
      last = first;
    }
  }

 private:
  static constexpr std::size_t kChunk = 64;
  struct Column {
    double least = std::numeric_limits<double>::infinity();
    std::array<double, kChunk> loss;
    Column() { loss.fill(std::numeric_limits<double>::infinity()); }
  };

  bool AnyNoWorse(const Column* columns, const Losses& losses,
                  std::array<std::int64_t, kChunk>& worse) const {
    for (std::size_t k = 0; k < losses_; ++k)
      if (columns[k].least > losses[k]) return false;
    worse.fill(0);
    for (std::size_t k = 0; k < losses_; ++k) {
      const double* column = columns[k].loss.data();
      const double loss = losses[k];
      for (std::size_t i = 0; i < kChunk; ++i) worse[i] |= column[i] > loss;
    }
    return std::find(worse.begin(), worse.end(), 0) != worse.end();
  }

  std::size_t losses_, size_ = 0;
  std::vector<Column> chunks_;  // of each loss one per chunk
};

}  // namespace

Skyband KeepBest(const std::vector<Contender>& contenders, int k, double tie, bool name_left_out,
                 const std::function<bool()>& stop) {
  constexpr int kBetweenLooks = 256;
  using Share = std::pair<double, int>;  // of the objective; the contender
  std::vector<Share> order;
  order.reserve(contenders.size());
  for (int i = 0; i < static_cast<int>(contenders.size()); ++i)
    order.emplace_back(contenders[i].objective, i);
  std::sort(order.begin(), order.end(), [&](const Share& a, const Share& b) {
    return a.first != b.first ? a.first < b.first
                              : ListedFirst(contenders[a.second], contenders[b.second]);
  });
  std::unordered_map<std::string_view, std::size_t> number_of;
  std::vector<std::vector<int>> classes;
  for (const auto& [share, index] : order) {
    const auto [entry, fresh] = number_of.try_emplace(contenders[index].mates, classes.size());
    if (fresh) classes.emplace_back();
    classes[entry->second].push_back(index);
  }
  Skyband result;
  std::vector<ProofItem> dominators;
  for (const std::vector<int>& members : classes) {
    KeptLosses kept_losses(contenders[members.front()].losses.size());
    std::vector<int> kept, outdone;
    for (std::size_t member = 0; member < members.size(); ++member) {
      if (stop && member % kBetweenLooks == 0 && stop()) return {};
      const Contender& contender = contenders[members[member]];
      dominators.clear();
      kept_losses.NoWorse(contender.losses, [&](std::size_t other) {
        const Contender& better = contenders[kept[other]];
        if (better.objective < contender.objective - tie || ListedFirst(better, contender))
          dominators.push_back(better.item);
        return static_cast<int>(dominators.size()) < k;
      });
      if (static_cast<int>(dominators.size()) == k) {
        if (name_left_out) result.left_out.push_back({contender.item, dominators});
        continue;
      }
      kept_losses.Add(contender.losses);
      kept.push_back(members[member]);
      outdone.push_back(static_cast<int>(dominators.size()));
    }
    result.kept.insert(result.kept.end(), kept.begin(), kept.end());
    result.outdone.insert(result.outdone.end(), outdone.begin(), outdone.end());
  }
  return result;
}

}  // namespace plenum::optimizer
