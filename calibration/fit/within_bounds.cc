#include "calibration/fit/within_bounds.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "calibration/values/symmetric.h"

namespace plenum::calibration {
namespace {

constexpr double kRidge = 1e-10;  // of the diagonal: numbers that nothing depends on

std::vector<int> AtBounds(const ceres::Problem& problem, const Eigen::VectorXd& u) {
  std::vector<int> at;
  for (int j = 0; j < u.size(); ++j)
    if (u[j] <= problem.GetParameterLowerBound(u.data(), j) ||
        u[j] >= problem.GetParameterUpperBound(u.data(), j))
      at.push_back(j);
  return at;
}

// J and e of the problem where u is; empty where it cannot be evaluated.
std::pair<Eigen::MatrixXd, Eigen::VectorXd> Linearised(ceres::Problem& problem, Eigen::Index size) {
  std::vector<double> e;
  ceres::CRSMatrix rows;
  if (!problem.Evaluate({}, nullptr, &e, nullptr, &rows)) return {};
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(rows.num_rows, size);
  for (int i = 0; i < rows.num_rows; ++i)
    for (auto k = static_cast<std::size_t>(rows.rows[static_cast<std::size_t>(i)]);
         k < static_cast<std::size_t>(rows.rows[static_cast<std::size_t>(i) + 1]); ++k)
      j(i, rows.cols[k]) = rows.values[k];
  return {j, Eigen::Map<const Eigen::VectorXd>(e.data(), static_cast<Eigen::Index>(e.size()))};
}

// The step of Gauss and Newton; of those held none.
Eigen::VectorXd StepOf(const Eigen::MatrixXd& jj, const Eigen::VectorXd& je,
                       const std::vector<int>& held) {
  Eigen::MatrixXd free = jj;
  Eigen::VectorXd down = -je;
  free.diagonal() *= 1.0 + kRidge;
  for (const int j : held) {
    free.row(j).setZero();
    free.col(j).setZero();
    free(j, j) = 1.0;
    down[j] = 0.0;
  }
  return SolvedSymmetric(free, down);
}

// The numbers to be held at their bounds.
std::vector<int> Pressed(ceres::Problem& problem, const Eigen::VectorXd& u) {
  const std::vector<int> at = AtBounds(problem, u);
  if (at.empty()) return {};
  const auto [j, e] = Linearised(problem, u.size());
  if (e.size() == 0) return {};
  const Eigen::MatrixXd jj = j.transpose() * j;
  const Eigen::VectorXd je = j.transpose() * e;
  Eigen::VectorXd step = -je;
  std::vector<int> held;
  for (bool more = true; more; step = StepOf(jj, je, held)) {
    more = false;
    for (const int k : at) {
      const bool low = u[k] <= problem.GetParameterLowerBound(u.data(), k);
      const bool beyond = low ? step[k] < 0.0 : step[k] > 0.0;
      if (beyond) held.push_back(k), more = true;
    }
  }
  std::sort(held.begin(), held.end());
  return held;
}

// Ends a lap where a step has come to a bound at which the lap did not begin.
class StopAtBound : public ceres::IterationCallback {
 public:
  StopAtBound(const ceres::Problem& problem, const Eigen::VectorXd& u)
      : problem_(problem), u_(u), start_(AtBounds(problem, u)) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    if (!step.step_is_successful || step.iteration == 0) return ceres::SOLVER_CONTINUE;
    return AtBounds(problem_, u_) == start_ ? ceres::SOLVER_CONTINUE
                                            : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const ceres::Problem& problem_;
  const Eigen::VectorXd& u_;
  std::vector<int> start_;
};

}  // namespace

BoundedSolution SolveWithinBounds(ceres::Solver::Options solver, ceres::Problem& problem,
                                  Eigen::VectorXd& u) {
  const int size = static_cast<int>(u.size());
  const double radius = solver.initial_trust_region_radius;
  solver.update_state_every_iteration = true;
  solver.callbacks.push_back(nullptr);
  std::vector<int> held = Pressed(problem, u);
  while (true) {
    if (static_cast<int>(held.size()) == size) {
      BoundedSolution stays{ceres::CONVERGENCE, "all at their bounds"};
      problem.Evaluate({}, &stays.cost, nullptr, nullptr, nullptr);
      return stays;
    }
    if (!held.empty()) problem.SetManifold(u.data(), new ceres::SubsetManifold(size, held));
    StopAtBound stop(problem, u);
    solver.callbacks.back() = &stop;
    ceres::Solver::Summary lap;
    ceres::Solve(solver, &problem, &lap);
    problem.SetManifold(u.data(), nullptr);
    BoundedSolution solution{lap.termination_type, lap.message, lap.final_cost};
    const bool at_bound = lap.termination_type == ceres::USER_SUCCESS;
    if (!at_bound && lap.termination_type != ceres::CONVERGENCE) return solution;
    solver.max_num_iterations -= static_cast<int>(lap.iterations.size()) - 1;
    if (at_bound && solver.max_num_iterations <= 0)
      return {ceres::NO_CONVERGENCE, solution.message, solution.cost};
    std::vector<int> pressed = Pressed(problem, u);
    const bool gained =
        lap.initial_cost - lap.final_cost > solver.function_tolerance * lap.final_cost;
    if (!at_bound && (pressed == held || !gained)) return solution;
    if (solver.max_num_iterations <= 0)
      return {ceres::NO_CONVERGENCE, solution.message, solution.cost};
    held = std::move(pressed);
    solver.initial_trust_region_radius =
        at_bound ? lap.iterations.back().trust_region_radius : radius;
  }
}

}  // namespace plenum::calibration
