// What a fit leaves over, judged: by phase, against its own past (whiteness.h), against the inputs
// (independence.h) and against the noise of the readings (noise.h).
//
// Lack of fit: with N readings in units of their runs' noise σ_j and p fitted numbers,
//   F = Σ r²/σ_j² / (N − p),   standard error √(Σ 2·n_j·(1+2·s²·ρ_j²/(1−ρ_j²)) + Σ (2·n_j·δ_j)²)/N,
// where δ_j is the relative error of σ_j, s the share of the noise that remembers (noise_memory.h)
// and ρ_j its correlation at the run's spacing: the
// limit allows for a noise that is itself an estimate, and for what its differences miss of σ² if
// it has the memory that the residual shows. Limits are passed by pure noise with
// kFalseAlarm each. Fitted numbers make residuals a little whiter, so that the other tests err to
// the quiet side.
//
// Where noise is below half of the readings' quantum, whiteness and independence are tested of the
// residual that rounding.h makes of it; where that shows structure, of what noise that remembers
// leaves (rounded_memory.h), and the milder result counts.
#ifndef PLENUM_CALIBRATION_JUDGE_RESIDUAL_H_
#define PLENUM_CALIBRATION_JUDGE_RESIDUAL_H_

#include <span>
#include <vector>

#include "calibration/judge/independence.h"
#include "calibration/noise/noise.h"
#include "calibration/values/dataset.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

// One run after a fit. `model_pa` is at the run's sample times, absolute, as the sensor would show
// it; clipped and wild readings are those of `noise`.
struct FittedRun {
  const Run* run = nullptr;
  std::vector<double> model_pa;
  Noise noise;
};

// measured − model; NaN where the reading is missing, clipped or wild, and where the model is
// within three standard deviations of an end of the sensor's range or beyond, because noise is cut
// there.
std::vector<double> Residual(const FittedRun& fitted);

// Mean, RMS and least-squares slope over each phase of the run.
std::vector<PhaseResidual> ResidualByPhase(const Run& run, std::span<const double> residual_pa);

// Of all runs together, and white only if each run by itself is: the portmanteau reported is the
// one furthest towards its limit. Where the noise's memory is an estimate, both tests of
// structure take the likeliest one, given the residuals, that the readings' differences allow.
// `by_input`, if asked, gets the statistic of every input. Once `cancelled` says so, the tests of
// structure are left out.
ResidualReport AssessResiduals(const std::vector<FittedRun>& runs, int fitted_numbers,
                               std::vector<InputCorrelation>* by_input = nullptr,
                               const std::function<bool()>& cancelled = {});

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_RESIDUAL_H_
