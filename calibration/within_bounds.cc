#include "calibration/within_bounds.h"

#include <vector>

namespace plenum::calibration {
namespace {

bool AtBound(const ceres::Problem& problem, const Eigen::VectorXd& u, int j) {
  return u[j] <= problem.GetParameterLowerBound(u.data(), j) ||
         u[j] >= problem.GetParameterUpperBound(u.data(), j);
}

std::vector<int> AtBounds(const ceres::Problem& problem, const Eigen::VectorXd& u) {
  std::vector<int> at;
  for (int j = 0; j < u.size(); ++j)
    if (AtBound(problem, u, j)) at.push_back(j);
  return at;
}

// Of those at a bound the ones beyond which the sum of squares would fall.
std::vector<int> Pressed(ceres::Problem& problem, const Eigen::VectorXd& u) {
  std::vector<int> pressed = AtBounds(problem, u);
  if (pressed.empty()) return pressed;
  std::vector<double> slope;
  if (!problem.Evaluate({}, nullptr, nullptr, &slope, nullptr)) return {};
  std::erase_if(pressed, [&](int j) {
    const bool low = u[j] <= problem.GetParameterLowerBound(u.data(), j);
    return low ? slope[static_cast<std::size_t>(j)] < 0.0
               : slope[static_cast<std::size_t>(j)] > 0.0;
  });
  return pressed;
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
    const BoundedSolution solution{lap.termination_type, lap.message, lap.final_cost};
    const bool at_bound = lap.termination_type == ceres::USER_SUCCESS;
    if (!at_bound && lap.termination_type != ceres::CONVERGENCE) return solution;
    solver.max_num_iterations -= static_cast<int>(lap.iterations.size()) - 1;
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
