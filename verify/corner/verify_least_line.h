// The least of the single lines of a box that may work: best first over ranges of its choices.
// Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_LEAST_LINE_H_
#define PLENUM_VERIFY_CORNER_VERIFY_LEAST_LINE_H_

#include <array>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

#include "verify/corner/verify_known_strokes.h"
#include "verify/corner/verify_ranges.h"

namespace plenum::verify {

// Keeps what it found: boxes of one tree share most of their lines.
class LeastLines {
 public:
  // Share of the objective of a slot's choices, the least and the most of them.
  using Share = std::function<std::pair<double, double>(const Ranges&, int slot)>;
  // What a line must do, and what that depends on: source pressures and regulators, if any.
  struct Ask {
    std::pair<double, double> window_pa;
    std::pair<int, int> regulators;
    std::function<bool(const BestLine&)> fails;  // the best of a box: every line of it
  };

  LeastLines(Share share, KnownStrokes& strokes) : share_(std::move(share)), strokes_(strokes) {}

  // By how much more than its parts at their least, at least, a line of the group in the box weighs
  // that works and does not fail; +∞ where all do. After so many looks the least of what is not
  // looked at.
  double Excess(const Ranges& ranges, int group, const Ask& ask);

 private:
  using Slots = std::array<int, 3>;
  using Key = std::tuple<int, std::pair<double, double>, std::array<std::pair<int, int>, 4>>;

  double ShareOf(const Ranges& ranges, const Slots& slots) const;
  int SlotToDivide(const Ranges& ranges, const Slots& slots) const;
  double Least(const Ranges& ranges, int group, const Slots& slots, const Ask& ask) const;

  Share share_;
  KnownStrokes& strokes_;
  std::map<Key, double> known_;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_LEAST_LINE_H_
