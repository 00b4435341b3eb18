#include "model/flow/iso6358.h"

#include <cmath>

namespace plenum::model {
namespace {

// 1 − ((r−b)/(1−b))², without the cancellation near r = 1.
double EllipseSquare(double ratio, double critical_ratio) {
  const double width = 1.0 - critical_ratio;
  return (1.0 - ratio) / width * (1.0 + (ratio - critical_ratio) / width);
}

}  // namespace

double FlowFunction(double ratio, double critical_ratio, double subsonic_index) {
  if (ratio >= 1.0) return 0.0;
  if (ratio <= critical_ratio) return 1.0;
  const double square = EllipseSquare(ratio, critical_ratio);
  return subsonic_index == 0.5 ? std::sqrt(square) : std::pow(square, subsonic_index);
}

}  // namespace plenum::model
