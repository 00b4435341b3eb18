#include "bench/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace plenum::bench {
namespace {

double RelativeError(double value, double reference) {
  const double error = std::abs(value / reference - 1.0);
  return std::isnan(error) ? INFINITY : error;
}

bool AllWithin(const Method& method, double tolerance, std::span<const RiseRig> rigs,
               std::span<const double> reference_s) {
  // In pieces, because most tolerances that are too loose show it soon.
  constexpr std::size_t kPiece = 100;
  std::vector<double> rise_s(kPiece);
  for (std::size_t first = 0; first < rigs.size(); first += kPiece) {
    const std::size_t size = std::min(kPiece, rigs.size() - first);
    method.run(rigs.subspan(first, size), tolerance, std::span(rise_s).first(size));
    for (std::size_t i = 0; i < size; ++i) {
      if (RelativeError(rise_s[i], reference_s[first + i]) > kErrorMax) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<double> LoosestTolerance(const Method& method, std::span<const RiseRig> rigs,
                                       std::span<const double> reference_s) {
  const int last = method.takes_tolerance ? 88 : 0;
  for (int eighth = 0; eighth <= last; ++eighth) {
    const double tolerance = std::pow(10.0, -2.0 - eighth / 8.0);
    if (AllWithin(method, tolerance, rigs, reference_s)) return tolerance;
  }
  return std::nullopt;
}

Errors ErrorsAt(const Method& method, double tolerance, std::span<const RiseRig> rigs,
                std::span<const double> reference_s) {
  std::vector<double> errors(rigs.size());
  method.run(rigs, tolerance, errors);
  std::transform(errors.begin(), errors.end(), reference_s.begin(), errors.begin(), RelativeError);
  return {*std::max_element(errors.begin(), errors.end()), Median(errors)};
}

double SecondsPerRig(const Method& method, double tolerance, std::span<const RiseRig> rigs) {
  constexpr double kLeastS = 0.02;
  std::vector<double> rise_s(rigs.size());
  const auto start = std::chrono::steady_clock::now();
  std::chrono::duration<double> elapsed{0.0};
  double passes = 0.0;
  while (elapsed.count() < kLeastS) {
    method.run(rigs, tolerance, rise_s);
    passes += 1.0;
    elapsed = std::chrono::steady_clock::now() - start;
  }
  return elapsed.count() / (passes * static_cast<double>(rigs.size()));
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace plenum::bench
