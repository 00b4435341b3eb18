#include "calibration/fit/within_bounds.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <random>

namespace plenum::calibration {
namespace within_bounds_test {

// |A·u − b|², and how often it was asked for.
class Squares : public ceres::CostFunction {
 public:
  Squares(Eigen::MatrixXd a, Eigen::VectorXd b) : a_(std::move(a)), b_(std::move(b)) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(a_.cols()));
    set_num_residuals(static_cast<int>(a_.rows()));
  }
  bool Evaluate(double const* const* u, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::VectorXd>(residuals, a_.rows()) =
        a_ * Eigen::Map<const Eigen::VectorXd>(u[0], a_.cols()) - b_;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (jacobians && jacobians[0]) Eigen::Map<RowMajor>(jacobians[0], a_.rows(), a_.cols()) = a_;
    ++asked;
    return true;
  }
  mutable int asked = 0;

 private:
  Eigen::MatrixXd a_;
  Eigen::VectorXd b_;
};

// A circle's arc: an angle and a radius that must come to a point outside the bounds.
struct Arc {
  template <class T>
  bool operator()(const T* u, T* residuals) const {
    residuals[0] = u[1] * cos(u[0]) - 0.5;
    residuals[1] = u[1] * sin(u[0]) - 2.0;
    return true;
  }
};

void Bound(ceres::Problem& problem, Eigen::VectorXd& u, double low, double high) {
  for (int j = 0; j < u.size(); ++j) {
    problem.SetParameterLowerBound(u.data(), j, low);
    problem.SetParameterUpperBound(u.data(), j, high);
  }
}

ceres::Solver::Options Options(int iterations_max) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = iterations_max;
  options.max_num_line_search_step_size_iterations = 0;
  options.function_tolerance = 1e-12;
  options.gradient_tolerance = 0.0;
  options.initial_trust_region_radius = 1e6;
  options.logging_type = ceres::SILENT;
  return options;
}

// The least of |A·u − b|² in [−1, 1]ⁿ: of all ways to put numbers at their bounds.
double LeastOfAll(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const auto size = static_cast<int>(a.cols());
  double least = std::numeric_limits<double>::infinity();
  int ways = 1;
  for (int j = 0; j < size; ++j) ways *= 3;
  for (int way = 0; way < ways; ++way) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(size);
    std::vector<int> free;
    for (int j = 0, rest = way; j < size; ++j, rest /= 3) {
      if (rest % 3 == 0) free.push_back(j);
      u[j] = rest % 3 - (rest % 3 == 2 ? 3 : 0);
    }
    if (!free.empty()) {
      Eigen::MatrixXd of_free(a.rows(), free.size());
      for (std::size_t k = 0; k < free.size(); ++k)
        of_free.col(static_cast<Eigen::Index>(k)) = a.col(free[k]);
      const Eigen::VectorXd x = of_free.colPivHouseholderQr().solve(b - a * u);
      for (std::size_t k = 0; k < free.size(); ++k) u[free[k]] = x[static_cast<Eigen::Index>(k)];
    }
    if (u.cwiseAbs().maxCoeff() <= 1.0) least = std::min(least, (a * u - b).squaredNorm());
  }
  return least;
}

TEST(WithinBounds, FindsTheLeastSquaresOfABox) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 200; ++k) {
    // Columns that are much alike: a step is far beyond the bounds.
    Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(8, 4, [&] { return normal(random); });
    for (int j = 1; j < 4; ++j) a.col(j) = a.col(0) + 0.1 * a.col(j);
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(8, [&] { return normal(random); });
    Eigen::VectorXd u = Eigen::VectorXd::Zero(4);
    ceres::Problem problem;
    auto* squares = new Squares(a, b);
    problem.AddResidualBlock(squares, nullptr, u.data());
    Bound(problem, u, -1.0, 1.0);
    const BoundedSolution solution = SolveWithinBounds(Options(200), problem, u);
    EXPECT_EQ(solution.termination, ceres::CONVERGENCE) << solution.message;
    EXPECT_NEAR(2.0 * solution.cost, LeastOfAll(a, b), 1e-6) << k;
    EXPECT_NEAR(2.0 * solution.cost, (a * u - b).squaredNorm(), 1e-12);
    EXPECT_LE(u.cwiseAbs().maxCoeff(), 1.0);
  }
}

BoundedSolution SolveArc(int iterations_max, Eigen::VectorXd& u) {
  ceres::Problem problem;
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Arc, 2, 2>(new Arc), nullptr, u.data());
  Bound(problem, u, 0.1, 1.9);
  return SolveWithinBounds(Options(iterations_max), problem, u);
}

TEST(WithinBounds, LetsGoWhatIsNotPressedAnyMore) {
  Eigen::VectorXd u = Eigen::Vector2d(0.1, 1.9);  // both at a bound, the angle not for good
  EXPECT_EQ(SolveArc(100, u).termination, ceres::CONVERGENCE);
  EXPECT_NEAR(u[0], std::atan2(2.0, 0.5), 1e-5);  // the nearest point of the circle
  EXPECT_EQ(u[1], 1.9);
}

TEST(WithinBounds, StepsCountTogether) {
  Eigen::VectorXd u = Eigen::Vector2d(0.1, 1.9);
  EXPECT_EQ(SolveArc(1, u).termination, ceres::NO_CONVERGENCE);
  EXPECT_NE(u[0], 0.1);
}

TEST(WithinBounds, StaysWhereAllArePressed) {
  Eigen::VectorXd u = Eigen::VectorXd::Ones(2);
  ceres::Problem problem;
  auto* squares = new Squares(Eigen::MatrixXd::Identity(2, 2), Eigen::VectorXd::Constant(2, 3.0));
  problem.AddResidualBlock(squares, nullptr, u.data());
  Bound(problem, u, -1.0, 1.0);
  const BoundedSolution solution = SolveWithinBounds(Options(50), problem, u);
  EXPECT_EQ(solution.termination, ceres::CONVERGENCE);
  EXPECT_EQ(u, Eigen::VectorXd::Ones(2));
  EXPECT_DOUBLE_EQ(solution.cost, 4.0);
  EXPECT_LE(squares->asked, 3);
}

}  // namespace within_bounds_test
}  // namespace plenum::calibration
