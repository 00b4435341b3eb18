#include "calibration/values/symmetric.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace plenum::calibration {

SymmetricEigen EigenOf(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::VectorXd SolvedSymmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.ldlt().solve(b);
}

Eigen::MatrixXd SolvedSymmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.ldlt().solve(b);
}

Eigen::VectorXd PivotsOf(const Eigen::MatrixXd& a) { return a.ldlt().vectorD(); }

Eigen::MatrixXd RootOf(const Eigen::MatrixXd& a) {
  const Eigen::LDLT<Eigen::MatrixXd> factors(a);
  const Eigen::MatrixXd half =
      Eigen::MatrixXd(factors.matrixL()) * factors.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  return (factors.transpositionsP().transpose() * half).transpose();
}

}  // namespace plenum::calibration
