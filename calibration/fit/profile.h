// Intervals from the profile of the likelihood: how far a number may be moved, all others fitted
// again, until what is minimised has risen by the 95 % quantile of χ² with one degree of freedom,
//   Q(u) = min over the others of χ²_data/s + χ²_prior,  Q(u) − Q(û) = 3.84,
// s being what the readings' χ² is inflated by (fit.h). Where χ² is a parabola that is ±1.96
// standard deviations; a conductance whose critical ratio is fitted with it is far from one. A side
// on which Q does not rise that far ends at the coordinate's bound: the data do not tell it.
// Source: Raue et al., Bioinformatics 25 (2009) 1923.
#ifndef PLENUM_CALIBRATION_FIT_PROFILE_H_
#define PLENUM_CALIBRATION_FIT_PROFILE_H_

#include <Eigen/Core>
#include <vector>

#include "calibration/fit/fit.h"

namespace plenum::calibration {

// Replaces the intervals of the named effects' numbers (effect_sets.h); `covariance` is of the
// coordinates, `inflation` is s. An interval stays where a fit fails or is stopped.
void ProfileIntervals(const FitData& data, const Fit& fit, const Eigen::MatrixXd& covariance,
                      double inflation, const FitOptions& options,
                      std::vector<Estimate>& estimates);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_PROFILE_H_
