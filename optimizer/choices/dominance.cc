#include "optimizer/choices/dominance.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace plenum::optimizer {
namespace {

bool EarlierId(const Contender& a, const Contender& b) {
  const bool same = a.id.data() == b.id.data() || a.id == b.id;
  return same ? a.item.quantity < b.item.quantity : a.id < b.id;
}

bool ListedFirst(const Contender& a, const Contender& b) {
  return a.tie != b.tie ? a.tie < b.tie : EarlierId(a, b);
}

// Whether a is listed first whatever packs other choices of a design share with the two.
bool SurelyFirst(const Contender& a, const PackEnd& most, const Contender& b, const PackEnd& least,
                 double tie) {
  if (most.cost_eur > least.cost_eur) return false;
  if (most.objective < least.objective - tie) return true;
  return most.objective <= least.objective &&
         (most.tie != least.tie ? most.tie < least.tie : EarlierId(a, b));
}

// The contenders by id and quantity. Most ids differ in their first characters, which are kept with
// what is sorted.
void SortById(const std::vector<Contender>& contenders, std::vector<int>& chosen) {
  struct Named {
    std::array<std::uint64_t, 2> head{};
    int contender;
  };
  std::vector<Named> names;
  names.reserve(chosen.size());
  for (int i : chosen) {
    Named name{.contender = i};
    const std::string_view id = contenders[i].id;
    for (std::size_t at = 0; at < 16; ++at)
      name.head[at / 8] =
          name.head[at / 8] << 8 | (at < id.size() ? static_cast<unsigned char>(id[at]) : 0u);
    names.push_back(name);
  }
  std::sort(names.begin(), names.end(), [&](const Named& a, const Named& b) {
    return a.head != b.head ? a.head < b.head
                            : EarlierId(contenders[a.contender], contenders[b.contender]);
  });
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = names[i].contender;
}

struct Share {  // of the objective
  int mates;
  double objective;
  int contender;
};

// Counts dominators of one contender after another, each other series once.
class SeriesSeen {
 public:
  explicit SeriesSeen(const std::vector<Contender>& contenders) {
    int most = -1;
    for (const Contender& contender : contenders) most = std::max(most, contender.series);
    last_.resize(static_cast<std::size_t>(most) + 1, -1);
  }
  // Whether it is the first of its series for this contender.
  bool IsFirst(int series, int contender) {
    return series < 0 || std::exchange(last_[series], contender) != contender;
  }

 private:
  std::vector<int> last_;  // per series: the contender that met it last
};

// Class by class, the least share of the objective first.
std::vector<Share> InOrder(const std::vector<Contender>& contenders) {
  std::vector<Share> order;
  order.reserve(contenders.size());
  for (int i = 0; i < static_cast<int>(contenders.size()); ++i)
    order.push_back({contenders[i].mates, contenders[i].objective, i});
  std::sort(order.begin(), order.end(), [&](const Share& a, const Share& b) {
    if (a.mates != b.mates) return a.mates < b.mates;
    return a.objective != b.objective
               ? a.objective < b.objective
               : ListedFirst(contenders[a.contender], contenders[b.contender]);
  });
  return order;
}

// Losses of the contenders of one class that are kept, in chunks as they come, and in a chunk loss
// by loss, so that one of several contenders is compared at once.
class KeptLosses {
 public:
  explicit KeptLosses(std::size_t width) : width_(width) {}

  void Clear() {
    size_ = 0;
    lanes_.clear();
    least_.clear();
  }

  void Add(std::span<const double> losses) {
    const std::size_t place = size_++ % kChunk;
    if (place == 0) {
      lanes_.resize(lanes_.size() + width_ * kRows);
      least_.resize(least_.size() + width_, std::numeric_limits<double>::infinity());
    }
    Lanes* row = lanes_.data() + (lanes_.size() - width_ * kRows) + place / kLanes * width_;
    double* least = least_.data() + (least_.size() - width_);
    for (std::size_t k = 0; k < width_; ++k) {
      row[k][place % kLanes] = losses[k];
      least[k] = std::min(least[k], losses[k]);
    }
  }

  // Hands the numbers of those that lose no more anywhere to `found`, until it returns false. The
  // last to come are the first: with a share of the objective that is hardly smaller they are the
  // likeliest to lose no more, and most chunks of much smaller shares have none that does.
  template <typename Found>
  void NoWorse(std::span<const double> losses, const Found& found) const {
    for (std::size_t last = size_; last > 0; last = (last - 1) / kChunk * kChunk) {
      const std::size_t chunk = (last - 1) / kChunk;
      if (!MayLoseNoMore(chunk, losses)) continue;
      for (std::size_t row = (last - 1) / kLanes + 1; row-- > chunk * kRows;) {
        Masks worse{};
        if (AllWorse(lanes_.data() + row * width_, losses, worse)) continue;
        for (std::size_t i = kLanes; i-- > 0;)
          if (worse[i] == 0 && row * kLanes + i < size_ && !found(row * kLanes + i)) return;
      }
    }
  }

 private:
  static constexpr std::size_t kLanes = 8, kRows = 8, kChunk = kLanes * kRows;
  using Lanes [[gnu::vector_size(kLanes * sizeof(double))]] = double;
  using Masks [[gnu::vector_size(kLanes * sizeof(double))]] = std::int64_t;

  bool MayLoseNoMore(std::size_t chunk, std::span<const double> losses) const {
    const double* least = least_.data() + chunk * width_;
    for (std::size_t k = 0; k < width_; ++k)
      if (least[k] > losses[k]) return false;
    return true;
  }

  // `worse`: 0 before, −1 in the lanes of those that lose more somewhere.
  static bool AllWorse(const Lanes* row, std::span<const double> losses, Masks& worse) {
    for (std::size_t k = 0; k < losses.size(); ++k) worse |= row[k] > losses[k];
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < kLanes; ++i) sum += worse[i];
    return sum == -static_cast<std::int64_t>(kLanes);
  }

  std::size_t width_, size_ = 0;
  std::vector<Lanes> lanes_;   // per row of a chunk one of each loss
  std::vector<double> least_;  // per chunk one of each loss
};

}  // namespace

Skyband KeepBest(const std::vector<Contender>& contenders, int k, double tie, bool name_left_out,
                 const std::function<bool()>& stop, const std::vector<PackEnds>& ends) {
  constexpr int kBetweenLooks = 256;
  if (contenders.empty()) return {};
  // Closer together than in the contenders, which are not read in their order.
  const std::size_t width = contenders.front().losses.size();
  std::vector<double> losses;
  losses.reserve(contenders.size() * width);
  for (const Contender& contender : contenders)
    losses.insert(losses.end(), contender.losses.begin(), contender.losses.end());
  const auto losses_of = [&](int i) {
    return std::span<const double>(losses).subspan(static_cast<std::size_t>(i) * width, width);
  };
  const std::vector<Share> order = InOrder(contenders);

  Skyband result;
  result.outdone.resize(contenders.size());
  std::vector<ProofItem> dominators;
  KeptLosses kept_losses(width);
  std::vector<Share> kept;  // of one class
  SeriesSeen seen(contenders);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (stop && i % kBetweenLooks == 0 && stop()) return {};
    const Share& share = order[i];
    if (i == 0 || share.mates != order[i - 1].mates) {
      kept_losses.Clear();
      kept.clear();
    }
    int dominated = 0;
    dominators.clear();
    kept_losses.NoWorse(losses_of(share.contender), [&](std::size_t other) {
      const Share& better = kept[other];
      const Contender &a = contenders[better.contender], &b = contenders[share.contender];
      if (!(better.objective < share.objective - tie || ListedFirst(a, b))) return true;
      if (!ends.empty() &&
          !SurelyFirst(a, ends[better.contender].most, b, ends[share.contender].least, tie))
        return true;
      if (a.series >= 0 && a.series == b.series) {
        dominated = k;
        dominators.assign(1, a.item);
      } else if (seen.IsFirst(a.series, share.contender)) {
        ++dominated;
        if (name_left_out) dominators.push_back(a.item);
      }
      return dominated < k;
    });
    if (dominated == k) {
      if (name_left_out) result.left_out.push_back({contenders[share.contender].item, dominators});
      continue;
    }
    kept_losses.Add(losses_of(share.contender));
    kept.push_back(share);
    result.kept.push_back(share.contender);
    result.outdone[share.contender] = dominated;
  }
  SortById(contenders, result.kept);
  return result;
}

}  // namespace plenum::optimizer
