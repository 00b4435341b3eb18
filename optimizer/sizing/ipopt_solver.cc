#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>
#include <mutex>

#include "optimizer/sizing/nlp.h"

namespace plenum::optimizer {
namespace {

constexpr double kIpoptInfinity = 2e19;

// Ipopt's view of an Nlp. Values and derivatives of one point are computed once each and shared by
// the callbacks; the line search asks for values alone.
class IpoptProblem : public Ipopt::TNLP {
 public:
  IpoptProblem(const Nlp& nlp, NlpResult& result) : nlp_(nlp), result_(result) {}

  bool get_nlp_info(int& n, int& m, int& nnz_jacobian, int& nnz_hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<int>(nlp_.low.size());
    m = nlp_.constraints;
    nnz_jacobian = n * m;
    nnz_hessian = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(int n, double* low, double* high, int m, double* g_low,
                       double* g_high) override {
    std::copy_n(nlp_.low.begin(), n, low);
    std::copy_n(nlp_.high.begin(), n, high);
    std::fill_n(g_low, m, 0.0);
    std::fill_n(g_high, m, kIpoptInfinity);
    return true;
  }

  bool get_starting_point(int n, bool, double* x, bool, double*, double*, int, bool,
                          double*) override {
    std::copy_n(nlp_.start.begin(), n, x);
    return true;
  }

  bool eval_f(int n, const double* x, bool, double& value) override {
    if (!UpdateValues(n, x)) return false;
    value = values_.objective;
    return true;
  }

  bool eval_grad_f(int n, const double* x, bool, double* gradient) override {
    if (!UpdateDerivatives(n, x)) return false;
    std::copy_n(at_.gradient.begin(), n, gradient);
    return true;
  }

  bool eval_g(int n, const double* x, bool, int m, double* g) override {
    if (!UpdateValues(n, x)) return false;
    std::copy_n(values_.constraints.begin(), m, g);
    return true;
  }

  bool eval_jac_g(int n, const double* x, bool, int m, int, int* rows, int* columns,
                  double* values) override {
    if (values == nullptr) {
      for (int c = 0; c < m; ++c)
        for (int i = 0; i < n; ++i) {
          rows[c * n + i] = c;
          columns[c * n + i] = i;
        }
      return true;
    }
    if (!UpdateDerivatives(n, x)) return false;
    for (int c = 0; c < m; ++c) std::copy_n(at_.jacobian[c].begin(), n, values + c * n);
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, int, double, double, double, double, double,
                             double, double, double, int, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    return !Stopped();
  }

  void finalize_solution(Ipopt::SolverReturn, int n, const double* x, const double*, const double*,
                         int, const double*, const double*, double objective,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    result_.x.assign(x, x + n);
    result_.objective = objective;
  }

 private:
  bool Stopped() const { return nlp_.stop && nlp_.stop(); }

  // False (Ipopt then shortens the step) where the model is not defined. Nothing may be thrown
  // through Ipopt.
  bool UpdateValues(int n, const double* x) {
    std::vector<double> point(x, x + n);
    for (int i = 0; i < n; ++i) point[i] = std::clamp(point[i], nlp_.low[i], nlp_.high[i]);
    if (point == point_) return defined_;
    point_ = std::move(point);
    differentiated_ = false;
    ++result_.evaluations;
    defined_ = !Stopped() && nlp_.evaluate(point_, values_);
    return defined_;
  }

  bool UpdateDerivatives(int n, const double* x) {
    if (!UpdateValues(n, x)) return false;
    if (!differentiated_) differentiated_ = nlp_.differentiate(point_, at_);
    return differentiated_;
  }

  const Nlp& nlp_;
  NlpResult& result_;
  std::vector<double> point_;
  NlpValues values_;
  NlpDerivatives at_;
  bool defined_ = false, differentiated_ = false;
};

}  // namespace

NlpResult SolveWithIpopt(const Nlp& nlp) {
  // The linear solver beneath Ipopt (MUMPS) keeps its state in globals: two threads in it at a time
  // end the process.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  NlpResult result;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  application->Options()->SetIntegerValue("print_level", 0);
  application->Options()->SetStringValue("sb", "yes");
  application->Options()->SetStringValue("hessian_approximation", "limited-memory");
  application->Options()->SetNumericValue("tol", 1e-8);
  application->Options()->SetIntegerValue("max_iter", 100);
  result.status = NlpStatus::kFailed;
  if (application->Initialize() != Ipopt::Solve_Succeeded) return result;
  const Ipopt::ApplicationReturnStatus status =
      application->OptimizeTNLP(new IpoptProblem(nlp, result));
  if (result.x.empty()) return result;
  result.status = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level
                      ? NlpStatus::kSolved
                      : NlpStatus::kNotConverged;
  return result;
}

}  // namespace plenum::optimizer
