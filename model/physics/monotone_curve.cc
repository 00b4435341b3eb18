#include "model/physics/monotone_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace plenum::model {
namespace {

// Three-point slope at an end, limited so that the first piece keeps the sign and the shape of the
// data (h0, d0: width and secant of the end piece; h1, d1: of its neighbour).
double EndSlope(double h0, double h1, double d0, double d1) {
  const double slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (slope * d0 <= 0.0) return 0.0;
  if (d0 * d1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(d0)) return 3.0 * d0;
  return slope;
}

// Weighted harmonic mean of the secants on both sides; 0 at a local extremum.
double InnerSlope(double h0, double h1, double d0, double d1) {
  if (d0 * d1 <= 0.0) return 0.0;
  const double w0 = 2.0 * h1 + h0;
  const double w1 = h1 + 2.0 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

}  // namespace

MonotoneCurve::MonotoneCurve(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), slope_(x_.size(), 0.0) {
  assert(x_.size() == y_.size());
  const std::size_t n = x_.size();
  if (n < 2) return;
  std::vector<double> width(n - 1), secant(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    width[i] = x_[i + 1] - x_[i];
    assert(width[i] > 0.0);
    secant[i] = (y_[i + 1] - y_[i]) / width[i];
  }
  if (n == 2) {
    slope_ = {secant[0], secant[0]};
    return;
  }
  slope_.front() = EndSlope(width[0], width[1], secant[0], secant[1]);
  slope_.back() = EndSlope(width[n - 2], width[n - 3], secant[n - 2], secant[n - 3]);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    slope_[i] = InnerSlope(width[i - 1], width[i], secant[i - 1], secant[i]);
  }
}

// The conditions are such that NaN finds no place inside the table.
double MonotoneCurve::operator()(double x) const {
  assert(!empty());
  if (!(x > x_.front())) return y_.front() + slope_.front() * (x - x_.front());
  if (x >= x_.back()) return y_.back() + slope_.back() * (x - x_.back());
  const auto i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
  const double h = x_[i] - x_[i - 1];
  const double t = (x - x_[i - 1]) / h;
  const double s = 1.0 - t;
  return s * s * ((1.0 + 2.0 * t) * y_[i - 1] + t * h * slope_[i - 1]) +
         t * t * ((1.0 + 2.0 * s) * y_[i] - s * h * slope_[i]);
}

double MonotoneCurve::Slope(double x) const {
  assert(!empty());
  if (!(x > x_.front())) return slope_.front();
  if (x >= x_.back()) return slope_.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
  const double h = x_[i] - x_[i - 1];
  const double t = (x - x_[i - 1]) / h;
  const double s = 1.0 - t;
  return 6.0 * t * s * (y_[i] - y_[i - 1]) / h + s * (1.0 - 3.0 * t) * slope_[i - 1] +
         t * (1.0 - 3.0 * s) * slope_[i];
}

double MonotoneCurve::Curvature(double x) const {
  assert(!empty());
  if (!(x > x_.front()) || x >= x_.back()) return 0.0;
  const auto i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
  const double h = x_[i] - x_[i - 1];
  const double t = (x - x_[i - 1]) / h;
  return (6.0 * (1.0 - 2.0 * t) * (y_[i] - y_[i - 1]) / h + (6.0 * t - 4.0) * slope_[i - 1] +
          (6.0 * t - 2.0) * slope_[i]) /
         h;
}

}  // namespace plenum::model
