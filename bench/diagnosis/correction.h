// A correction of the model's output that knows no physics: the residual as a function of what the
// model and the schedule say at the moment, learned from the fitted runs. The rival that a
// diagnosis has to beat on runs held out.
#ifndef PLENUM_BENCH_DIAGNOSIS_CORRECTION_H_
#define PLENUM_BENCH_DIAGNOSIS_CORRECTION_H_

#include <Eigen/Dense>
#include <vector>

#include "calibration/values/dataset.h"

namespace plenum::bench {

// One row a sample: pressure and its rate, time since the last command, source pressure, blocked or
// not, each by valve state, and their squares and products; scaled to about 1.
Eigen::MatrixXd Features(const calibration::Run& run, const std::vector<double>& predicted_pa);

struct Sample {  // of one run
  Eigen::MatrixXd features;
  Eigen::VectorXd residual;
};

// RMS of the last run's residual after the correction learned from the others. The ridge penalty
// and the number of neighbours are the ones that do best when each fitted run in turn is left out.
double RidgeError(const std::vector<Sample>& runs);
double NeighbourError(const std::vector<Sample>& runs);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_DIAGNOSIS_CORRECTION_H_
