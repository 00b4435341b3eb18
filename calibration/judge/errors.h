// How far a model is from the runs of a data set: from those that it was fitted to, and from those
// that it was not.
#ifndef PLENUM_CALIBRATION_JUDGE_ERRORS_H_
#define PLENUM_CALIBRATION_JUDGE_ERRORS_H_

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "calibration/fit/fit.h"
#include "calibration/judge/verdict.h"

namespace plenum::calibration {

// The runs and how they are judged. What it refers to must outlive it.
struct Bench {
  const Dataset& dataset;
  const ForwardModel& forward;
  const std::vector<ObservedRun>& observed;
  FitData data;                       // the runs that fits may see
  std::vector<std::size_t> held_out;  // the others, without copies
  // By run: the first run with the same readings; the run itself where it is that one. Copies are
  // no evidence of their own, and nothing is fitted to them.
  std::vector<std::size_t> original;
  FitOptions tight;  // of final fits; `cancelled` is the end of all
};

bool Stopped(const Bench& bench);

// By run: the run whose readings it repeats, itself for most. Among equal ones it is the first that
// is fitted. A recording that was copied is no second measurement: noise does not repeat itself.
std::vector<std::size_t> OriginalsOf(const Dataset& dataset);
inline bool IsCopy(const Bench& bench, std::size_t run) { return bench.original[run] != run; }

bool HeldOut(const Bench& bench, std::size_t run);

// Sum of squares and worst of many residuals.
struct Squares {
  double sum = 0.0, peak = 0.0;
  std::size_t count = 0;
  void Add(double residual) {
    if (!std::isfinite(residual)) return;
    sum += residual * residual;
    peak = std::max(peak, std::abs(residual));
    ++count;
  }
  void Add(const Squares& other) {
    sum += other.sum;
    peak = std::max(peak, other.peak);
    count += other.count;
  }
  double Rms() const { return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count)); }
};

// What the model reads in a run, also when the time is over. Empty where the simulation failed.
Reading Shown(const Bench& bench, const ModelState& state, std::size_t run);

// Pressure residuals of a run that the fit saw.
Squares ErrorsOf(const Bench& bench, std::size_t run, const ModelState& state);

// The state aligned to a run that the fit did not see (fit.h). Whether clocks are off one fitted
// run does not show.
Fit AlignedFit(const Bench& bench, std::size_t run, const ModelState& state);
ModelState Aligned(const Bench& bench, std::size_t run, const ModelState& state);

// Of a run that it did not see, by the aligned state.
Squares ErrorsUnseen(const Bench& bench, std::size_t run, const ModelState& state);

// Root mean square of the noise of the usable samples of these runs.
double NoiseOf(const Bench& bench, const std::vector<std::size_t>& runs);

// Error on runs that a fit did not see, and what it is made of where the model is right: the noise,
// with it the scatter between pieces where the run is of one that no fit saw, and the spread
// √(∂p/∂uᵀ·Σ·∂p/∂u) in the mean, Σ the covariance of the fitted coordinates u. Few runs fix few
// numbers, and a model that is right then predicts others badly.
struct UnseenError {
  double rms_pa = 0.0, noise_pa = 0.0, spread_pa = 0.0;
};

// Of the runs held out.
UnseenError HeldOutError(const Bench& bench, const Fit& fit);

// Of runs left out one by one, each predicted by a fit to the others; none of one run.
std::optional<UnseenError> LeaveOneOut(const Bench& bench, const Fit& fit);

// With the error on runs held out, or left out one by one, if that is asked for.
Leftover LeftoverOf(const Bench& bench, const Fit& fit, bool with_holdout);

// Whitened pressure residuals by run.
std::vector<std::vector<double>> WhitenedOf(const Bench& bench, const Fit& fit);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_ERRORS_H_
