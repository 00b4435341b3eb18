#include "optimizer/front/stairs.h"

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {

void Stairs::Add(Pair point) {
  std::erase_if(points_, [&](const Pair& p) { return point[0] <= p[0] && point[1] <= p[1]; });
  points_.insert(points_.begin() + static_cast<std::ptrdiff_t>(After(point[0])), point);
}

std::size_t Stairs::After(double first) const {
  const auto after = std::partition_point(points_.begin(), points_.end(),
                                          [&](const Pair& p) { return p[0] <= first; });
  return static_cast<std::size_t>(after - points_.begin());
}

bool Stairs::Admit(const Pair& low, const Pair& limits, const Pair& weights, double sum) const {
  for (std::size_t next = After(low[0]); next <= points_.size(); ++next) {
    const double second = Step(next, limits[1]);
    if (low[1] >= second) return false;
    const double right = next == points_.size() ? kUnlimited : points_[next][0] * (1.0 - kTie);
    const double first = std::min(limits[0], right);
    if (low[0] < first && (std::isinf(first) || sum < weights[0] * first + weights[1] * second))
      return true;
    if (right >= limits[0]) return false;
  }
  return false;
}

}  // namespace plenum::optimizer
