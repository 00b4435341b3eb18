// The base model re-fitted within its uncertainties, by Gauss–Newton on the independent simulator:
// what an experimenter could make disappear without any effect.
#ifndef PLENUM_TESTS_SUPPORT_BENCH_BENCH_REFIT_H_
#define PLENUM_TESTS_SUPPORT_BENCH_BENCH_REFIT_H_

#include <cstddef>
#include <vector>

#include "tests/support/bench/bench_rig.h"

namespace plenum::test {

using Readings = std::vector<std::vector<double>>;  // by run and sample, gauge Pa; NaN: missing

// Pressures of the base model, no effects, with `factors` on the declared numbers.
Readings BaseReadings(const BenchRig& declared, const std::vector<BenchRun>& runs,
                      const Numbers& factors);

struct BaseFit {
  Numbers factors = kAsDeclared;
  Readings predicted;   // of all runs
  double rms_pa = 0.0;  // of data − predicted over the fitted runs
};

// Minimises Σ((data − model)/noise)² + Σ((factor − 1)/uncertainty)² over all runs but the last.
// The sensitivities are taken once, at `near`; each fit takes up to five steps with them, shortened
// where they do not improve. Factors stay within 0.6 and 1.6.
class BaseFitter {
 public:
  BaseFitter(const BenchRig& declared, const std::vector<BenchRun>& runs,
             const Numbers& uncertainty, const Numbers& near);
  BaseFit Fit(const Readings& data, double noise_pa) const;

 private:
  struct Normal;
  Normal NormalAt(const BaseFit& fit, const Readings& data, double noise_pa) const;

  const BenchRig& declared_;
  const std::vector<BenchRun>& runs_;
  const Numbers& uncertainty_;
  Numbers near_;
  std::vector<std::size_t> free_;
  std::vector<double> scale_;          // of a step in each free number
  std::vector<Readings> sensitivity_;  // per scale
};

// RMS of a − b over all runs but the last; missing readings do not count.
double FittedRms(const Readings& a, const Readings& b);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_BENCH_BENCH_REFIT_H_
