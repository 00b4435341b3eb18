// Whether one run alone tells two fits apart. No other run confirms there what it shows.
//
// Two things that BIC takes for granted then do not hold. It charges ln n for every number, also
// for one that the run does not fix; the marginal likelihood (Laplace) charges what the data take
// from its prior,
//   E = (n/φ)·ln(χ²/n) + χ²_prior + ln det(1 + H/φ),
// H the curvature of χ² from the data in the fit's coordinates, whose scale is the prior's
// deviation or the typical size of an effect. And it takes the gap between two fits for what n
// readings of known noise tell. Where the better fit is right the gap is
//   G = (n/χ²)/φ·Σ (d_i² + 2·e_i·d_i),
// e its whitened residuals and d the difference of the other's to them; the second term is chance:
//   sd² = ((n/χ²)/φ)²·4·φ_p·Σ p_i²,  p_i = e_i·d_i,
// φ_p the memory of p (evidence.h), so that slow noise beside a slow difference counts as the few
// independent pieces that it is. Sources: Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773; Vuong,
// Econometrica 57 (1989) 307, for the scatter of a likelihood ratio.
#ifndef PLENUM_CALIBRATION_JUDGE_CLOSENESS_H_
#define PLENUM_CALIBRATION_JUDGE_CLOSENESS_H_

#include "calibration/fit/fit.h"
#include "calibration/judge/errors.h"

namespace plenum::calibration {

// E of a fit whose residuals are worth 1/memory of their number; infinite where it cannot be had.
double EvidenceOf(const Bench& bench, const Fit& fit, double memory);

// Of `fit`, the better one, to `other`: G with the difference in χ²_prior and in BIC's charge, and
// its sd.
struct Gap {
  double size = 0.0, scatter = 0.0;
};
Gap GapTo(const Bench& bench, const Fit& fit, const Fit& other, double memory);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_CLOSENESS_H_
