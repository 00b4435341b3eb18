// Least squares within bounds by Levenberg–Marquardt (Ceres) with an active set. Ceres cuts a step
// at the bounds, and what the step does with the other numbers then goes with the part that was cut
// off: they stop short of their best, or creep. So a number is held at its bound while the sum of
// squares falls beyond it, or the Gauss–Newton step of the numbers that are free would take it
// there, and let go when neither holds any more.
// Source: Bertsekas, Projected Newton methods for optimization problems with simple constraints,
// SIAM J. Control Optim. 20 (1982) 221.
#ifndef PLENUM_CALIBRATION_FIT_WITHIN_BOUNDS_H_
#define PLENUM_CALIBRATION_FIT_WITHIN_BOUNDS_H_

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <string>

namespace plenum::calibration {

struct BoundedSolution {
  ceres::TerminationType termination = ceres::FAILURE;
  std::string message;
  double cost = 0.0;  // half of the sum of squares
};

// Moves u, the one parameter block of the problem, from a point within the bounds that are set
// there. Iterations count together, and end at `solver`'s number of them with NO_CONVERGENCE.
BoundedSolution SolveWithinBounds(ceres::Solver::Options solver, ceres::Problem& problem,
                                  Eigen::VectorXd& u);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_WITHIN_BOUNDS_H_
