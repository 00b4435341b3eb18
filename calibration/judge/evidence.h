// How much a residual with structure proves.
//
// BIC counts every reading as evidence of its own. Where a model leaves structure, neighbouring
// residuals tell the same thing over and over: n of them are worth n/φ independent ones,
//   φ = 1 + 2·Σ ρ_k, over lags k up to the first ρ_k ≤ 0,
// and sets of effects are compared by
//   (n/φ)·ln(χ²/n) + χ²_prior + the penalty of n/φ readings (fit.h),
// each at its least, where χ² weighs 1/φ over χ²/n beside the priors: a prior that is stretched to
// follow what every reading says would else count in full.
// Source: effective sample size of correlated data (Bayley & Hammersley, J. R. Stat. Soc. 8 (1946)
// 184), truncated as in Geyer's initial positive sequence (Stat. Sci. 7 (1992) 473).
#ifndef PLENUM_CALIBRATION_JUDGE_EVIDENCE_H_
#define PLENUM_CALIBRATION_JUDGE_EVIDENCE_H_

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/search/effect_search.h"

namespace plenum::calibration {

// φ of several series of one unit of measure, lags within each; at least 1.
double MemoryOf(std::span<const std::vector<double>> series);

// BIC of a fit whose residuals are worth 1/memory of their number.
double BicWith(const Fit& fit, double memory);

// A fit from `start` to readings that are worth 1/memory of their number; `from` is of the same
// readings, or of as many.
Fit FitWeighed(const FitData& data, FitOptions options, double memory, const Fit& from,
               const ModelState& start);

// Fits the base model and the best few of each size again with that weight, where less weight may
// make one the best.
void Reweigh(const FitData& data, const FitOptions& options, double memory,
             std::vector<Contender>& contenders);

// Whether a set of some of its effects, with the same numbers freed, leaves no more of the
// readings: what the set has ahead then is only that declared numbers are nearer to what was
// declared. To be so is what a number is freed for.
bool FitsNoBetter(const Contender& set, std::span<const Contender> contenders);

// The place in the list of the set that stands then: forwards from the base model, a larger set
// being better by kAccept than the best smaller one, of those that fit the readings better than any
// part of them.
std::size_t Standing(std::span<const Contender> contenders, double memory);

// The same after the subsets of what stands were fitted from where it is.
std::size_t StandingBesideSubsets(const FitData& data, const FitOptions& options, double memory,
                                  std::vector<Contender>& contenders);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_EVIDENCE_H_
