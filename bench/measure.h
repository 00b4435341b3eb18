// Tolerance, error and time of a method.
#ifndef PLENUM_BENCH_MEASURE_H_
#define PLENUM_BENCH_MEASURE_H_

#include <optional>
#include <span>
#include <vector>

#include "bench/method.h"

namespace plenum::bench {

inline constexpr double kErrorMax = 1e-6;  // of the rise time, relative, over all rigs
inline constexpr int kRepetitions = 7;

// The loosest tolerance of 10^−2, 10^−2.125, …, 10^−13 at which no rig's error exceeds kErrorMax;
// none where no tolerance does.
std::optional<double> LoosestTolerance(const Method& method, std::span<const RiseRig> rigs,
                                       std::span<const double> reference_s);

struct Errors {
  double max;
  double median;
};
Errors ErrorsAt(const Method& method, double tolerance, std::span<const RiseRig> rigs,
                std::span<const double> reference_s);

// Wall time per rig of passes over all rigs that last 20 ms or more together, s.
double SecondsPerRig(const Method& method, double tolerance, std::span<const RiseRig> rigs);

double Median(std::vector<double> values);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_MEASURE_H_
