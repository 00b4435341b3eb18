// The stairs that the points of a front in two amounts make, and the gaps between them.
#ifndef PLENUM_OPTIMIZER_FRONT_STAIRS_H_
#define PLENUM_OPTIMIZER_FRONT_STAIRS_H_

#include <array>
#include <vector>

#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {

using Pair = std::array<double, 2>;  // of two amounts

class Stairs {
 public:
  explicit Stairs(Pair first) : points_{first} {}

  // By rising first, falling second amount; of two points of which one beats the other one stays.
  const std::vector<Pair>& points() const { return points_; }
  void Add(Pair point);

  // Whether what takes at least `low` of the amounts may be below the stairs, by more than a tie.
  bool Below(const Pair& low) const { return low[1] < Step(After(low[0]), kUnlimited); }

  // Whether it may lie in a gap within `limits`, its sum with the weights being at least `sum`. The
  // corner of a gap has the first amount of the point on its right and the second of that on its
  // left.
  bool Admit(const Pair& low, const Pair& limits, const Pair& weights, double sum) const;

 private:
  // Number of points with no more than so much of the first amount.
  std::size_t After(double first) const;
  // The second amount that a point to the right of so many must stay below.
  double Step(std::size_t points, double limit) const {
    return points == 0 ? limit : std::min(limit, points_[points - 1][1] * (1.0 - kTie));
  }

  std::vector<Pair> points_;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_FRONT_STAIRS_H_
