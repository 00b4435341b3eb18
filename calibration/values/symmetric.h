// Factors of symmetric matrices, compiled once: the templates of a matrix library's decompositions
// cost each source that uses them much of the compiler's time.
#ifndef PLENUM_CALIBRATION_VALUES_SYMMETRIC_H_
#define PLENUM_CALIBRATION_VALUES_SYMMETRIC_H_

#include <Eigen/Core>

namespace plenum::calibration {

// A = V·diag(values)·Vᵀ, values rising; of the lower triangle of A, which must be finite.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // a column each
};
SymmetricEigen EigenOf(const Eigen::MatrixXd& a);

// x of A·x = b by A = Pᵀ·L·D·Lᵀ·P, A positive or negative semidefinite; of a matrix b a column for
// each of its own.
Eigen::VectorXd SolvedSymmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd SolvedSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// The diagonal of D.
Eigen::VectorXd PivotsOf(const Eigen::MatrixXd& a);

// R with Rᵀ·R = A, of A = Pᵀ·L·D·Lᵀ·P with what of D is negative counted as 0.
Eigen::MatrixXd RootOf(const Eigen::MatrixXd& a);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_SYMMETRIC_H_
