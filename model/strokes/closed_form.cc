#include "model/strokes/closed_form.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/strokes/gauss_legendre.h"

namespace plenum::model {
namespace {

// k in v = 1 + k·(p − 1).
double Growth(const NormalisedStroke& stroke) {
  return (stroke.expansion_ratio - 1.0) / (stroke.operating_pressure_ratio - 1.0);
}

// θ with ratio = b + (1−b)·sinθ, by the complement, which keeps its digits near π/2.
double Angle(double ratio, double b) {
  const double rest = std::max(0.0, 1.0 - ratio) / (1.0 - b);  // 1 − sinθ
  return std::numbers::pi / 2.0 - 2.0 * std::asin(std::sqrt(0.5 * rest));
}

// I1(θ) = ∫ dθ/(b + s·sinθ), I2(θ) = ∫ dθ/(b + s·sinθ)², s = 1 − b.
struct Antiderivatives {
  double i1;
  double i2;
};

// Not for b = ½. For b < ½ the logarithm is written with s − √(s²−b²) = b²/(s + √(s²−b²)), and
// without its constant factor b, so that it holds down to b = 0.
Antiderivatives DeflationIntegrals(double theta, double b) {
  const double s = 1.0 - b;
  const double u = std::tan(0.5 * theta);
  const double square = b * b - s * s;
  const double r = std::sqrt(std::abs(square));
  const double i1 = b < 0.5 ? std::log((u + b / (s + r)) / (b * u + s + r)) / r
                            : 2.0 / r * std::atan((b * u + s) / r);
  const double i2 = s * std::cos(theta) / (square * (b + s * std::sin(theta))) + b * i1 / square;
  return {i1, i2};
}

// ∫ [(1−k)/p' + 2k/p'²] dθ with p' = b + (1−b)·sinθ = 1/p.
double SubsonicDeflation(double theta_1, double theta_2, double b, double k) {
  constexpr double kNearHalf = 0.05;
  if (std::abs(b - 0.5) < kNearHalf) {
    return GaussLegendre(theta_1, theta_2, [&](double theta) {
      const double p = 1.0 / (b + (1.0 - b) * std::sin(theta));
      return (1.0 - k) * p + 2.0 * k * p * p;
    });
  }
  const Antiderivatives at_1 = DeflationIntegrals(theta_1, b);
  const Antiderivatives at_2 = DeflationIntegrals(theta_2, b);
  return (1.0 - k) * (at_2.i1 - at_1.i1) + 2.0 * k * (at_2.i2 - at_1.i2);
}

}  // namespace

double NormalisedRiseTime(const NormalisedStroke& stroke, double source_pressure_ratio, double from,
                          double to) {
  assert(from <= to);
  const double ps = source_pressure_ratio;
  if (to > ps) return std::numeric_limits<double>::infinity();
  const double b = stroke.critical_ratio;
  const double k = Growth(stroke);
  const auto content = [&](double p) { return p * (1.0 + k * (p - 1.0)); };
  const double choked_end = b * ps;
  double tau = 0.0;
  if (from < choked_end) tau += (content(std::min(to, choked_end)) - content(from)) / ps;
  if (to > choked_end) {
    const double theta_1 = Angle(std::max(from, choked_end) / ps, b);
    const double theta_2 = Angle(to / ps, b);
    tau += (1.0 - b) * ((1.0 - k + 2.0 * k * ps * b) * (theta_2 - theta_1) -
                        2.0 * k * ps * (1.0 - b) * (std::cos(theta_2) - std::cos(theta_1)));
  }
  return tau;
}

double NormalisedFallTime(const NormalisedStroke& stroke, double from, double to) {
  assert(from >= to && to >= 1.0);
  const double b = stroke.critical_ratio;
  const double k = Growth(stroke);
  double tau = 0.0;
  double subsonic_start = from;
  if (from * b > 1.0) {
    subsonic_start = std::max(to, 1.0 / b);
    tau += (1.0 - k) * std::log(from / subsonic_start) + 2.0 * k * (from - subsonic_start);
  }
  if (subsonic_start > to) {
    tau += (1.0 - b) * SubsonicDeflation(Angle(1.0 / subsonic_start, b), Angle(1.0 / to, b), b, k);
  }
  return tau;
}

}  // namespace plenum::model
