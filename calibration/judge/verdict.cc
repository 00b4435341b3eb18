#include "calibration/judge/verdict.h"

#include <algorithm>
#include <cmath>

#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

double Above(const Leftover& leftover) {
  return std::max(0.0, leftover.rms_pa * leftover.rms_pa - leftover.noise_pa * leftover.noise_pa);
}

// Of the pressure and of all other channels, in pressure: in units of the noise they are one sum.
double AboveInAll(const Leftover& leftover, double noise_pa) {
  if (leftover.channels_above == 0.0) return Above(leftover);
  return Above(leftover) + leftover.channels_above * noise_pa * noise_pa /
                               static_cast<double>(leftover.pressure_readings);
}

bool IsSmall(const Leftover& before, const Leftover& after) {
  const double share = Above(after) / std::max(Above(before), 1e-300);
  return share < kLeftOver && std::sqrt(Above(after)) < kNegligible * after.noise_pa;
}

bool HoldsOut(const Leftover& leftover) {
  if (!leftover.holdout_rms_pa) return true;
  const double noise_pa = kHoldout * leftover.holdout_noise_pa.value_or(leftover.noise_pa);
  return *leftover.holdout_rms_pa <=
         std::hypot(noise_pa, std::sqrt(kHoldoutSpread) * leftover.holdout_spread_pa);
}

}  // namespace

bool PassesTests(const ResidualReport& residual) {
  return residual.white && residual.independent_of_inputs &&
         residual.lack_of_fit <= residual.lack_of_fit_limit;
}

bool IsNoise(const Leftover& leftover) {
  return PassesTests(leftover.residual) && leftover.learnable_bic <= kAccept;
}

bool PredictsWorse(const Leftover& before, const Leftover& after) {
  if (!before.holdout_rms_pa || !after.holdout_rms_pa) return false;
  const double noise_pa = after.holdout_noise_pa.value_or(after.noise_pa);
  return *after.holdout_rms_pa > std::max(*before.holdout_rms_pa, kHoldout * noise_pa);
}

std::optional<bool> PredictsBetter(const std::optional<double>& before_rms_pa,
                                   const std::optional<double>& after_rms_pa) {
  if (!before_rms_pa || !after_rms_pa) return {};
  return *after_rms_pa < *before_rms_pa;
}

double UnexplainedFraction(const Leftover& before, const Leftover& after) {
  const double all_before = AboveInAll(before, before.noise_pa);
  if (IsNoise(after) || all_before == 0.0) return 0.0;
  return std::min(1.0, AboveInAll(after, before.noise_pa) / all_before);
}

Verdict Judge(const Evidence& evidence) {
  if (!evidence.complete) return Verdict::kUndecided;
  if (!evidence.accepted)
    return IsNoise(evidence.before) && evidence.before.priors_hold ? Verdict::kAdequate
                                                                   : Verdict::kUnexplained;
  const bool clean = IsNoise(evidence.after) || IsSmall(evidence.before, evidence.after);
  const bool imitation = evidence.imitated || !evidence.after.priors_hold ||
                         PredictsWorse(evidence.before, evidence.after);
  const bool told =
      !evidence.after.rough_noise ||
      std::pow(evidence.after.rms_pa, 2) <= kEstablished * std::pow(evidence.before.rms_pa, 2);
  if (!clean || !told || !HoldsOut(evidence.after) || imitation) return Verdict::kUnexplained;
  return evidence.tied > 0 ? Verdict::kTie : Verdict::kExplained;
}

std::string DoubtOf(const Evidence& evidence) {
  if (!evidence.accepted) return "";
  if (PredictsWorse(evidence.before, evidence.after))
    return "predicts runs that no fit saw worse than the model without it";
  if (evidence.imitated) return "is outdone by one learned term in its place";
  if (!evidence.after.priors_hold)
    return "fits only with declared numbers that are beyond their uncertainties";
  if (UnexplainedFraction(evidence.before, evidence.after) > kEstablished)
    return "leaves more than a fifth of what the base model leaves";
  return "does no better beside a learned term than the term alone";
}

std::string WhatIsOpen(const Evidence& evidence) {
  const Leftover& after = evidence.after;
  const std::string structure = "structure is left that no known effect accounts for";
  const std::string beyond = "declared numbers are beyond their uncertainties";
  if (!PassesTests(after.residual)) return structure;
  if (after.learnable_bic > kAccept)
    return "a term that has no name would take up part of what looks like noise";
  if (!evidence.accepted) return after.priors_hold ? structure : beyond;
  if (!HoldsOut(after)) return "runs that no fit saw are off by more than their noise";
  if (!after.priors_hold) return beyond;
  if (after.rough_noise) return "the noise is not known well enough to say that only noise is left";
  return structure;
}

bool IsTieBesideStructure(const Evidence& evidence) {
  return evidence.accepted && evidence.tied > 0 && HoldsOut(evidence.after) &&
         evidence.after.priors_hold && !evidence.imitated &&
         !PredictsWorse(evidence.before, evidence.after) &&
         UnexplainedFraction(evidence.before, evidence.after) <= kEstablished;
}

Verdict JudgeBesideStructure(const Evidence& evidence) {
  const Verdict verdict = Judge(evidence);
  return verdict == Verdict::kUnexplained && IsTieBesideStructure(evidence) ? Verdict::kTie
                                                                            : verdict;
}

}  // namespace plenum::calibration
