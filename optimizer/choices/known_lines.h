// What is known of boxes of lines of one group: what they miss, or where their line is. Searches
// ask this of millions of boxes, far more often than of anything else that is kept, so that it is
// packed: 16 bytes each, next to each other.
#ifndef PLENUM_OPTIMIZER_CHOICES_KNOWN_LINES_H_
#define PLENUM_OPTIMIZER_CHOICES_KNOWN_LINES_H_

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "optimizer/choices/hash.h"
#include "optimizer/choices/plan.h"
#include "optimizer/problem/proof.h"

namespace plenum::optimizer {

class KnownLines {
 public:
  using Nodes = std::array<int, kSlotsPerGroup>;  // one of each of a group's trees

  class Known {
   public:
    Known() = default;
    static Known Missing(Constraint missed) { return Known(~static_cast<int>(missed)); }
    static Known Made(int line) { return Known(line); }
    Constraint missed() const {
      return value_ < 0 ? static_cast<Constraint>(~value_) : Constraint::kNone;
    }
    int line() const { return std::max(value_, -1); }  // that was made of it; −1: none
    bool operator==(const Known&) const = default;

   private:
    explicit Known(int value) : value_(value) {}
    int value_ = -1;  // the line or, inverted, what is missed
  };

  // Null where nothing is known of the box. Until the next Set().
  const Known* Find(const Nodes& nodes) const {
    if (places_.empty()) return nullptr;
    const Place& place = places_[PlaceOf(nodes)];
    return place.free() ? nullptr : &place.known;
  }

  // Beyond so many all are forgotten.
  void Set(const Nodes& nodes, Known known) {
    if (size_ == kMost) *this = {};
    if (4 * (size_ + 1) > 3 * places_.size()) Grow();
    Place& place = places_[PlaceOf(nodes)];
    size_ += place.free();
    place = {nodes, known};
  }

  // That a line was made of the box; it misses nothing all the same.
  void ForgetLine(const Nodes& nodes, int line) {
    if (places_.empty()) return;
    Place& place = places_[PlaceOf(nodes)];
    if (place.known == Known::Made(line)) place.known = {};
  }

 private:
  static constexpr std::size_t kMost = 12'000'000, kFirst = 1024;
  struct Place {
    Nodes nodes{-1, -1, -1};
    Known known;
    bool free() const { return nodes[0] < 0; }
  };

  // Without a call of memcmp().
  static bool Same(const Nodes& a, const Nodes& b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
  }

  // Where the box is, or would be put.
  std::size_t PlaceOf(const Nodes& nodes) const {
    Hash hash;
    for (int node : nodes) hash.Add(node);
    const std::size_t last = places_.size() - 1;  // a power of 2 less 1
    std::size_t at = hash.place() & last;
    while (!Same(places_[at].nodes, nodes) && !places_[at].free()) at = (at + 1) & last;
    return at;
  }

  void Grow() {
    std::vector<Place> before =
        std::exchange(places_, std::vector<Place>(std::max(kFirst, 2 * places_.size())));
    for (const Place& place : before)
      if (!place.free()) places_[PlaceOf(place.nodes)] = place;
  }

  std::vector<Place> places_;
  std::size_t size_ = 0;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_KNOWN_LINES_H_
