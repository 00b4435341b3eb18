// Monotone interpolation of a table y(x), x strictly rising (Fritsch–Carlson PCHIP): no overshoot,
// monotone where the data are. One point is a constant, two a straight line.
#ifndef PLENUM_MODEL_PHYSICS_MONOTONE_CURVE_H_
#define PLENUM_MODEL_PHYSICS_MONOTONE_CURVE_H_

#include <span>
#include <vector>

namespace plenum::model {

class MonotoneCurve {
 public:
  MonotoneCurve() = default;
  MonotoneCurve(std::vector<double> x, std::vector<double> y);

  // Outside the table the curve goes straight on with the end slope; callers that must not
  // extrapolate test the range first. At NaN the value is NaN.
  double operator()(double x) const;
  double Slope(double x) const;
  double Curvature(double x) const;  // second derivative; 0 outside the table

  bool empty() const { return x_.empty(); }
  double front() const { return x_.front(); }
  double back() const { return x_.back(); }
  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }
  bool operator==(const MonotoneCurve&) const = default;

 private:
  std::vector<double> x_, y_, slope_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_PHYSICS_MONOTONE_CURVE_H_
