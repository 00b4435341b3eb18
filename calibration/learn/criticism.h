// Whether a fit leaves structure that a term of the model could take up, though it looks like
// noise: the tests of a residual against no alternative are weak where the noise remembers.
//
// Of each of a set of terms, absent in the fit and linear in its numbers near 0, the gain in χ² is
// known to first order without a fit (a score test). With e the whitened residuals with the priors,
// J their derivatives at the optimum and A those with respect to the term's numbers,
//   Δχ² = gᵀ·M⁻¹·g,  g = Aᵀ·N·e,  M = Aᵀ·N·A,  N = I − J·(JᵀJ)⁻¹·Jᵀ.
// e counts as n/φ independent readings (evidence.h), so that a memory that the whitening missed, or
// the sawtooth of a coarse grid, is no structure: Δχ² of n readings becomes Δχ²/φ. The terms are
// leaks, line conductances, volume laws and sensor curves that depend on the pressure
// or the expansion (model/effects/learned/learned.h). Source: Rao's score test.
#ifndef PLENUM_CALIBRATION_LEARN_CRITICISM_H_
#define PLENUM_CALIBRATION_LEARN_CRITICISM_H_

#include "calibration/fit/fit.h"

namespace plenum::calibration {

// The largest gain in BIC of any term, with residuals worth 1/memory of their number; 0 where none
// gains or a run cannot be simulated.
double LearnableGain(const FitData& data, const Fit& fit, double memory, const FitOptions& options);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_LEARN_CRITICISM_H_
