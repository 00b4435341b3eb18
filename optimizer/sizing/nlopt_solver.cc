#include <nlopt.h>

#include <algorithm>
#include <memory>

#include "optimizer/sizing/nlp.h"

namespace plenum::optimizer {
namespace {

struct Callback {
  const Nlp* nlp;
  NlpResult* result;
  nlopt_opt solver;
};

// Where the program is not defined, or is told to stop, the solver ends and the numbers are void.
bool Defined(Callback& callback, const std::vector<double>& x, NlpValues& values,
             NlpDerivatives* derivatives) {
  ++callback.result->evaluations;
  const Nlp& nlp = *callback.nlp;
  const bool stopped = nlp.stop && nlp.stop();
  if (!stopped && nlp.evaluate(x, values) &&
      (derivatives == nullptr || nlp.differentiate(x, *derivatives)))
    return true;
  nlopt_force_stop(callback.solver);
  return false;
}

double ObjectiveCallback(unsigned n, const double* x, double* gradient, void* data) {
  NlpValues values;
  NlpDerivatives at;
  if (!Defined(*static_cast<Callback*>(data), {x, x + n}, values, gradient ? &at : nullptr))
    at.gradient.assign(n, 0.0);
  if (gradient != nullptr) std::copy_n(at.gradient.begin(), n, gradient);
  return values.objective;
}

// NLopt wants g(x) ≤ 0.
void ConstraintCallback(unsigned m, double* values, unsigned n, const double* x, double* gradient,
                        void* data) {
  NlpValues at;
  NlpDerivatives slopes;
  if (!Defined(*static_cast<Callback*>(data), {x, x + n}, at, gradient ? &slopes : nullptr)) {
    at.constraints.assign(m, 0.0);
    slopes.jacobian.assign(m, std::vector<double>(n, 0.0));
  }
  for (unsigned c = 0; c < m; ++c) {
    values[c] = -at.constraints[c];
    if (gradient == nullptr) continue;
    for (unsigned i = 0; i < n; ++i) gradient[c * n + i] = -slopes.jacobian[c][i];
  }
}

}  // namespace

NlpResult SolveWithNlopt(const Nlp& nlp) {
  constexpr double kMissed = -1e-6;  // of a constraint
  NlpResult result;
  const unsigned n = static_cast<unsigned>(nlp.low.size());
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> solver(
      nlopt_create(NLOPT_LD_SLSQP, n), &nlopt_destroy);
  Callback callback{&nlp, &result, solver.get()};
  nlopt_set_lower_bounds(solver.get(), nlp.low.data());
  nlopt_set_upper_bounds(solver.get(), nlp.high.data());
  nlopt_set_min_objective(solver.get(), ObjectiveCallback, &callback);
  if (nlp.constraints > 0) {
    const std::vector<double> tolerance(nlp.constraints, 1e-9);
    nlopt_add_inequality_mconstraint(solver.get(), static_cast<unsigned>(nlp.constraints),
                                     ConstraintCallback, &callback, tolerance.data());
  }
  nlopt_set_xtol_rel(solver.get(), 1e-10);
  nlopt_set_maxeval(solver.get(), 200);
  result.x = nlp.start;
  const nlopt_result status = nlopt_optimize(solver.get(), result.x.data(), &result.objective);
  result.status = status == NLOPT_SUCCESS || status == NLOPT_FTOL_REACHED ||
                          status == NLOPT_XTOL_REACHED || status == NLOPT_STOPVAL_REACHED
                      ? NlpStatus::kSolved
                  : status == NLOPT_MAXEVAL_REACHED || status == NLOPT_ROUNDOFF_LIMITED
                      ? NlpStatus::kNotConverged
                      : NlpStatus::kFailed;
  // A step that has become short is a success to it, feasible or not.
  NlpValues end;
  if (result.status == NlpStatus::kSolved &&
      (!nlp.evaluate(result.x, end) || std::any_of(end.constraints.begin(), end.constraints.end(),
                                                   [](double value) { return value < kMissed; })))
    result.status = NlpStatus::kNotConverged;
  return result;
}

NlpResult Solve(const Nlp& nlp, NlpSolver first) {
  const bool ipopt_first = first == NlpSolver::kIpopt;
  NlpResult result = ipopt_first ? SolveWithIpopt(nlp) : SolveWithNlopt(nlp);
  if (result.status == NlpStatus::kSolved) return result;
  NlpResult second = ipopt_first ? SolveWithNlopt(nlp) : SolveWithIpopt(nlp);
  return second.status == NlpStatus::kSolved ? second : result;
}

}  // namespace plenum::optimizer
