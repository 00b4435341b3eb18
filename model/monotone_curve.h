// Monotone interpolation of a table y(x), x strictly rising (Fritsch–Carlson PCHIP): no overshoot,
// monotone where the data are. One point is a constant, two a straight line.
#ifndef PLENUM_MODEL_MONOTONE_CURVE_H_
#define PLENUM_MODEL_MONOTONE_CURVE_H_

#include <algorithm>
#include <cstddef>
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
  // The same; `piece` is where the search for its piece begins (0 at first) and what it was:
  // quicker for arguments next to each other.
  double At(double x, std::size_t& piece) const;
  double Slope(double x) const;
  double Curvature(double x) const;  // second derivative; 0 outside the table

  bool empty() const { return x_.empty(); }
  double front() const { return x_.front(); }
  double back() const { return x_.back(); }
  std::span<const double> x() const { return x_; }
  std::span<const double> y() const { return y_; }
  bool operator==(const MonotoneCurve&) const = default;

 private:
  // Between points i − 1 and i.
  double Inside(double x, std::size_t i) const {
    const double h = x_[i] - x_[i - 1];
    const double t = (x - x_[i - 1]) / h;
    const double s = 1.0 - t;
    return s * s * ((1.0 + 2.0 * t) * y_[i - 1] + t * h * slope_[i - 1]) +
           t * t * ((1.0 + 2.0 * s) * y_[i] - s * h * slope_[i]);
  }

  std::vector<double> x_, y_, slope_;
};

inline double MonotoneCurve::At(double x, std::size_t& piece) const {
  if (!(x > x_.front()) || x >= x_.back()) return (*this)(x);
  piece = std::clamp<std::size_t>(piece, 1, x_.size() - 1);
  while (x < x_[piece - 1]) --piece;
  while (x >= x_[piece]) ++piece;
  return Inside(x, piece);
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_MONOTONE_CURVE_H_
