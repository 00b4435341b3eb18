#include "verify/corner/verify_least_line.h"

#include <limits>
#include <map>

namespace plenum::verify {
namespace {

constexpr int kLooksMax = 400;
constexpr int kSlotsOfLine = 3;

}  // namespace

double LeastLines::ShareOf(const Ranges& ranges, const Slots& slots) const {
  double sum = 0.0;
  for (const int slot : slots) sum += share_(ranges, slot).first;
  return sum;
}

// The slot whose choices differ most; −1 where each has one.
int LeastLines::SlotToDivide(const Ranges& ranges, const Slots& slots) const {
  int widest = -1;
  double most = -1.0;
  for (const int slot : slots) {
    if (ranges[slot].second - ranges[slot].first < 2) continue;
    const auto [low, high] = share_(ranges, slot);
    if (high - low <= most) continue;
    most = high - low;
    widest = slot;
  }
  return widest;
}

double LeastLines::Least(const Ranges& ranges, int group, const Slots& slots,
                         const Ask& ask) const {
  std::multimap<double, Ranges> open;
  open.emplace(ShareOf(ranges, slots), ranges);
  for (int looks = 0; !open.empty(); ++looks) {
    const auto first = open.begin();
    const double least = first->first;
    if (looks == kLooksMax) return least;
    Ranges left = std::move(first->second);
    open.erase(first);
    const BestLine& line = strokes_.Line(left, group);
    if (!line.mates || !line.works || ask.fails(line)) continue;
    const int slot = SlotToDivide(left, slots);
    if (slot < 0) return least;
    Ranges right = left;
    left[slot].second = right[slot].first = (left[slot].first + left[slot].second) / 2;
    open.emplace(ShareOf(left, slots), std::move(left));
    open.emplace(ShareOf(right, slots), std::move(right));
  }
  return std::numeric_limits<double>::infinity();
}

double LeastLines::Excess(const Ranges& ranges, int group, const Ask& ask) {
  const int slot = kSlotsOfLine * group;  // in the order of LineFamilies()
  const auto [entry, fresh] = known_.try_emplace(
      {group, ask.window_pa, {ranges[slot], ranges[slot + 1], ranges[slot + 2], ask.regulators}},
      0.0);
  if (fresh) {
    const Slots slots{slot, slot + 1, slot + 2};
    entry->second = Least(ranges, group, slots, ask) - ShareOf(ranges, slots);
  }
  return entry->second;
}

}  // namespace plenum::verify
