// Small smooth programs for the continuous settings, and the two solvers behind one interface.
//
//   minimise f(x)  subject to  g_i(x) ≥ 0,  low ≤ x ≤ high
//
// Both are local: `kSolved` says that a point met the first-order conditions, never that it is the
// best or that a failure means infeasible. Callers re-check every point.
//
// The solvers: ipopt_solver.cc, nlopt_solver.cc.
#ifndef PLENUM_OPTIMIZER_SIZING_NLP_H_
#define PLENUM_OPTIMIZER_SIZING_NLP_H_

#include <functional>
#include <vector>

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

struct NlpValues {
  double objective = 0.0;
  std::vector<double> constraints;
};

struct NlpDerivatives {
  std::vector<double> gradient;               // n
  std::vector<std::vector<double>> jacobian;  // constraints × n
};

struct Nlp {
  std::vector<double> low, high, start;  // finite; scaled to about 1 by the caller
  int constraints = 0;
  // False where the model is not defined at x; the solver then shortens its step.
  std::function<bool(const std::vector<double>& x, NlpValues& values)> evaluate;
  // First derivatives, exact.
  std::function<bool(const std::vector<double>& x, NlpDerivatives& derivatives)> differentiate;
  std::function<bool()> stop;  // asked at every point; may be empty
};

enum class NlpStatus { kNotRun, kSolved, kNotConverged, kFailed };

struct NlpResult {
  NlpStatus status = NlpStatus::kNotRun;
  std::vector<double> x;
  double objective = 0.0;
  int evaluations = 0;
};

// The solver asked first, and the other where that one does not converge: of the two the one that
// is solved.
NlpResult Solve(const Nlp& nlp, NlpSolver first);
NlpResult SolveWithIpopt(const Nlp& nlp);  // interior point, limited-memory BFGS for the Hessian
NlpResult SolveWithNlopt(const Nlp& nlp);  // SLSQP

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SIZING_NLP_H_
