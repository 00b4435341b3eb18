// The curve of elements in series (series.h) tabulated for many solutions of one line: cubics
// between points that are equal steps of c = √(1 − (q/q*)²) apart, each with the exact ratio and
// slope. In c a line's ratio is smooth and nearly straight, so its inverse is; the error of the
// flow is that of cubic Hermite interpolation, h⁴/384·|c⁗|, most where two elements choke nearly
// together.
#ifndef PLENUM_MODEL_FLOW_SERIES_CURVE_H_
#define PLENUM_MODEL_FLOW_SERIES_CURVE_H_

#include <cstddef>
#include <optional>
#include <vector>

#include "model/flow/series.h"

namespace plenum::model {

// Of the flow, relative, at most; a hundredth of it in nine lines of ten.
inline constexpr double kCurveError = 1e-6;

class SeriesCurve {
 public:
  // None where it would be off by more, halfway between its points: rare, with high critical
  // ratios.
  static std::optional<SeriesCurve> Of(const Series& series);

  // c at a ratio from the choked one to 1. Remembers the place: ratios that follow each other are
  // found at once, and an object serves one run at a time.
  double CosineAt(double ratio);

 private:
  explicit SeriesCurve(const Series& series);

  struct Point {
    double ratio, slope;  // dc/dr
  };
  std::vector<Point> points_;
  std::size_t at_ = 0;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_SERIES_CURVE_H_
