// The verdict on a search, from what its fits left over.
#ifndef PLENUM_CALIBRATION_JUDGE_VERDICT_H_
#define PLENUM_CALIBRATION_JUDGE_VERDICT_H_

#include <optional>
#include <string>

#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

// What a fitted model leaves over.
struct Leftover {
  ResidualReport residual;
  double rms_pa = 0.0;       // of the fitted runs
  double noise_pa = 0.0;     // of the same samples
  bool rough_noise = false;  // few differences showed it, and they may be the signal's
  std::optional<double> holdout_rms_pa;
  std::optional<double> holdout_noise_pa;
  // Σ e² of the other recorded channels, whitened, above as many as there are: 0 without one. And
  // how many pressure readings it stands beside.
  double channels_above = 0.0;
  std::size_t pressure_readings = 0;
  double holdout_spread_pa = 0.0;  // what the uncertainty of the fitted numbers adds to it
  double learnable_bic = 0.0;      // what a learned term would gain (criticism.h)
  bool priors_hold = true;         // the declared numbers are where their uncertainties let them be
};

// White and independent of the inputs, no more of it than the readings show.
bool PassesTests(const ResidualReport& residual);

// Nothing but noise: white and independent of the inputs, no more of it than the readings show, and
// nothing in it that a learned term could take up.
bool IsNoise(const Leftover& leftover);

// Whether the fit predicts runs that it did not see worse than the base model does, and not to
// within their noise.
bool PredictsWorse(const Leftover& before, const Leftover& after);

// Whether `after` predicts runs that no fit saw better than `before`; none where there are none.
std::optional<bool> PredictsBetter(const std::optional<double>& before_rms_pa,
                                   const std::optional<double>& after_rms_pa);

// Share of the variance above the noise that is left of what the base model left, over all recorded
// channels in units of their noise.
double UnexplainedFraction(const Leftover& before, const Leftover& after);

struct Evidence {
  bool complete = false;   // every fit that matters came to its end
  bool accepted = false;   // the chosen set has effects (which BIC accepted)
  int tied = 0;            // other sets of its size as good as it
  Leftover before, after;  // of the base model and the chosen set
  bool imitated = false;   // one learned term alone does as well as its effects
};

// In this order: kUndecided if not complete. Without an accepted effect kAdequate if the base model
// leaves noise alone with declared numbers within their uncertainties, else kUnexplained. With one,
// kUnexplained where structure is left that is neither noise nor small (kLeftOver, kNegligible),
// where runs that the fit did not see are off by more than
// √(kHoldout²·noise² + kHoldoutSpread·spread²), and where the set only imitates what is missing:
// where the noise is rough it leaves more than kEstablished of the base model's error, it needs
// declared numbers beyond their uncertainties, one term of unknown cause does better than its
// effects or as well with fewer numbers, or it predicts worse than the base model. Then kTie if
// others are as good; else kExplained.
Verdict Judge(const Evidence& evidence);

// Whether it says what is missing.
inline bool IsNamed(Verdict verdict) {
  return verdict == Verdict::kExplained || verdict == Verdict::kTie;
}

// Why the set that fits best is not taken for the explanation; empty of the base model.
std::string DoubtOf(const Evidence& evidence);

// What keeps the model from leaving noise alone, in words that follow "but"; of the base model,
// too. Where all tests of the residual pass it is not structure that they see.
std::string WhatIsOpen(const Evidence& evidence);

// A tie claims less than an explanation: it stands where each of several sets leaves at most
// kEstablished of what the base model left, though that is structure, and holds out.
bool IsTieBesideStructure(const Evidence& evidence);

// The verdict, or that tie where it is none of an explanation.
Verdict JudgeBesideStructure(const Evidence& evidence);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_VERDICT_H_
