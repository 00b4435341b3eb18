// Fits a model to measured runs: the least whitened squares with the priors of the declared
// numbers,
//   χ² = Σ e² + Σ u²,
// e the whitened residuals (observations.h), u the deviations of declared numbers in their standard
// deviations. Minimised by Levenberg–Marquardt within bounds (Ceres), with derivatives of the
// simulated steps, which are coarser ones than those of the residuals (run_cost.h).
//
// Intervals: the curvature of χ² at the optimum gives the covariance of the coordinates
// (coordinates.h), that of the readings inflated by χ²/(n − k) where that is above 1 and by the
// memory of their residuals (evidence.h); ±1.96 standard deviations there,
// carried to the numbers through the coordinate and cut at its bounds. A number at its bound still
// moves in the others' intervals: the data alone would have carried it further. A parameter whose
// standard deviation is above kUnidentified (in e-folds, or of a declared number's prior) is not
// identified.
//
// fit_intervals.cc: what a fit tells of its numbers; measured.cc: of those that are measured.
#ifndef PLENUM_CALIBRATION_FIT_FIT_H_
#define PLENUM_CALIBRATION_FIT_FIT_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibration/fit/coordinates.h"
#include "calibration/fit/fit_data.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

enum class FitStatus { kConverged, kIterationsSpent, kFailed, kCancelled };

struct Fit {
  FitStatus status = FitStatus::kFailed;
  std::string detail;  // for kFailed
  ModelState state;
  std::vector<Coordinate> coordinates;
  Eigen::VectorXd u;
  double chi2_data = 0.0, chi2_prior = 0.0;
  std::size_t rows = 0;  // residuals
  // ln of R²/(2π·σ²) of each ratio among the effects' numbers; empty until Narrow.
  std::vector<double> narrowed;
  double bic = 0.0;
  bool Usable() const {
    return status == FitStatus::kConverged || status == FitStatus::kIterationsSpent;
  }
};

// From the state: its effects and factors are the start. With nuisance_only the phases of what
// swings are looked for all around. Specimens that the runs do not tell end with the means of the
// others.
Fit FitModel(const FitData& data, const ModelState& from, const FitOptions& options);

// What the free numbers of a fit cost beside n·ln(χ²/n), of readings that are worth 1/memory of
// their number n: ln(n/memory) each, which is what a number costs that n readings fix. A ratio that
// only shapes an effect (critical, damping) costs no more than its range R is narrowed,
// ln R²/(2π·σ²) (Laplace's marginal likelihood): one of which the readings say nothing, as of a
// restriction that is never choked, is no reason against its effect.
double Penalty(const Fit& fit, double memory);

// n·ln(χ²/n) + χ²_prior + the penalty, of readings without memory.
double Bic(const Fit& fit);

// Looks at how far the readings narrow such ratios, and counts it in BIC. Costs one evaluation.
void Narrow(const FitData& data, const FitOptions& options, Fit& fit);

// Whether the run's line has declared pairs (C, b) that no run of the data has.
bool HasOwnPairs(const FitData& data, std::size_t run);

// The state with what a run that a fit to the data did not see has of its own: its clock and its
// initial pressure, where unknown, and the pairs (C, b) of a line that no run of the data has.
// Nothing that was learned from other runs can tell them, so that they alone are fitted, the pairs
// within their uncertainties. A run of the data, left out in turn, that is the only one of its
// specimen tells the numbers of that, too; a run held out of a specimen that no run of the data is
// of has the means that FitModel gave it (specimens.h).
Fit AlignedFit(const FitData& data, const ModelState& state, std::size_t run, FitOptions options);
// Its state; the one given where it failed.
ModelState Aligned(const FitData& data, const ModelState& state, std::size_t run,
                   FitOptions options);

// Whether the declared numbers are where their uncertainties let them be, but for a chance of
// kFalseAlarm (whiteness.h): what is missing may hide in them and leave nothing but noise.
bool PriorsHold(const Fit& fit);

// The state to fit anew from with what the fit lacks: declared numbers that were stretched in its
// place are in its way and stand as declared again, unless the priors hold. Those of unknown
// uncertainty stay fitted: as declared they say nothing.
ModelState Unstretched(const FitData& data, const Fit& fit);

inline constexpr double kUnidentified = 0.9;

// What χ² of the readings is divided by before it is weighed against priors: χ²/(n − k) where that
// is above 1, times their memory.
double Inflation(const Fit& fit, double memory);

// Of the coordinates u, of readings that are worth 1/memory of their number. Costs one evaluation.
Eigen::MatrixXd Covariance(const FitData& data, const Fit& fit, const FitOptions& options,
                           double memory = 1.0);

// Per coordinate, from their covariance.
std::vector<Estimate> Intervals(const Fit& fit, const Eigen::MatrixXd& covariance);

// The measured numbers (dataset.h) among the coordinates; of a pump the delivery at each point of
// its table in place of what it falls by.
std::vector<MeasuredEstimate> MeasuredEstimates(const Dataset& dataset, const Fit& fit,
                                                const Eigen::MatrixXd& covariance);

// Adds to their intervals and deviations what a room thermometer leaves open: kRoomK, one standard
// deviation. Of one pressure record C and V go with T^(−1/2) and T^(1/2), a pump's delivery with
// 1/T.
inline constexpr double kRoomK = 2.0;
void WidenByRoom(const Dataset& dataset, std::vector<MeasuredEstimate>& estimates);

// Readings of a run that the fitted model predicts. Empty where the simulation failed.
Reading Predicted(const FitData& data, const ModelState& state, std::size_t run,
                  const FitOptions& options);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_FIT_H_
