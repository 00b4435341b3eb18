#include "verify/corner/verify_least_line.h"

#include <limits>
#include <map>

namespace plenum::verify {
namespace {

constexpr int kLooksMax = 400;

double ShareOf(const LineChoices& choices, const Ranges& ranges) {
  double sum = 0.0;
  for (const int slot : choices.slots) sum += choices.share(ranges, slot).first;
  return sum;
}

// The slot whose choices differ most; −1 where each has one.
int SlotToDivide(const LineChoices& choices, const Ranges& ranges) {
  int widest = -1;
  double most = -1.0;
  for (const int slot : choices.slots) {
    if (ranges[slot].second - ranges[slot].first < 2) continue;
    const auto [low, high] = choices.share(ranges, slot);
    if (high - low <= most) continue;
    most = high - low;
    widest = slot;
  }
  return widest;
}

}  // namespace

double LeastLine(const LineChoices& choices, const Ranges& ranges) {
  std::multimap<double, Ranges> open;
  open.emplace(ShareOf(choices, ranges), ranges);
  for (int looks = 0; !open.empty(); ++looks) {
    const auto first = open.begin();
    const double least = first->first;
    if (looks == kLooksMax) return least;
    Ranges left = std::move(first->second);
    open.erase(first);
    if (choices.fails(left)) continue;
    const int slot = SlotToDivide(choices, left);
    if (slot < 0) return least;
    Ranges right = left;
    left[slot].second = right[slot].first = (left[slot].first + left[slot].second) / 2;
    open.emplace(ShareOf(choices, left), std::move(left));
    open.emplace(ShareOf(choices, right), std::move(right));
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace plenum::verify
