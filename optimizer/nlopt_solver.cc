#include <nlopt.h>

#include <algorithm>
#include <memory>

#include "optimizer/nlp.h"

namespace plenum::optimizer {
namespace {

struct Callback {
  const Nlp* nlp;
  NlpResult* result;
  nlopt_opt solver;
};

NlpDerivatives At(Callback& callback, unsigned n, const double* x) {
  NlpDerivatives at;
  ++callback.result->evaluations;
  const bool stopped = callback.nlp->stop && callback.nlp->stop();
  if (stopped || !Differentiate(*callback.nlp, {x, x + n}, at)) {
    nlopt_force_stop(callback.solver);
    at.values.objective = 0.0;
    at.values.constraints.assign(callback.nlp->constraints, 0.0);
    at.gradient.assign(n, 0.0);
    at.jacobian.assign(callback.nlp->constraints, std::vector<double>(n, 0.0));
  }
  return at;
}

double ObjectiveCallback(unsigned n, const double* x, double* gradient, void* data) {
  const NlpDerivatives at = At(*static_cast<Callback*>(data), n, x);
  if (gradient != nullptr) std::copy_n(at.gradient.begin(), n, gradient);
  return at.values.objective;
}

// NLopt wants g(x) ≤ 0.
void ConstraintCallback(unsigned m, double* values, unsigned n, const double* x, double* gradient,
                        void* data) {
  const NlpDerivatives at = At(*static_cast<Callback*>(data), n, x);
  for (unsigned c = 0; c < m; ++c) {
    values[c] = -at.values.constraints[c];
    if (gradient == nullptr) continue;
    for (unsigned i = 0; i < n; ++i) gradient[c * n + i] = -at.jacobian[c][i];
  }
}

}  // namespace

NlpResult SolveWithNlopt(const Nlp& nlp) {
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
  return result;
}

}  // namespace plenum::optimizer
