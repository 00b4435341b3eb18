#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "bench/method.h"
#include "bench/pressure_rate.h"

namespace plenum::bench {
namespace {

enum class Regime { kBoth, kChoked, kSubsonic };

struct Problem {
  PressureRate rate;
  Regime regime;
  double to_pa;
};

double Rate(const Problem& problem, double p) {
  switch (problem.regime) {
    case Regime::kChoked:
      return problem.rate.Choked(p);
    case Regime::kSubsonic:
      return problem.rate.Subsonic(p);
    case Regime::kBoth:
      break;
  }
  return problem.rate(p);
}

double Slope(const Problem& problem, double p) {
  switch (problem.regime) {
    case Regime::kChoked:
      return problem.rate.ChokedSlope(p);
    case Regime::kSubsonic:
      return problem.rate.SubsonicSlope(p);
    case Regime::kBoth:
      break;
  }
  return problem.rate.Slope(p);
}

int OnRate(realtype, N_Vector y, N_Vector ydot, void* user) {
  NV_DATA_S(ydot)[0] = Rate(*static_cast<Problem*>(user), NV_DATA_S(y)[0]);
  return 0;
}

int OnJacobian(realtype, N_Vector y, N_Vector, SUNMatrix jacobian, void* user, N_Vector, N_Vector,
               N_Vector) {
  SM_ELEMENT_D(jacobian, 0, 0) = Slope(*static_cast<Problem*>(user), NV_DATA_S(y)[0]);
  return 0;
}

int OnRoot(realtype, N_Vector y, realtype* excess, void* user) {
  excess[0] = NV_DATA_S(y)[0] - static_cast<Problem*>(user)->to_pa;
  return 0;
}

void Check(bool good, const char* what) {
  if (!good) throw std::runtime_error(what);
}

// One solver for all rigs. Adams with fixed-point iteration, BDF with Newton, the dense linear
// solver and the exact Jacobian, as SUNDIALS recommends for non-stiff and stiff problems.
class Cvode {
 public:
  explicit Cvode(int multistep) {
    Check(SUNContext_Create(nullptr, &context_) == 0, "SUNContext_Create");
    y_ = N_VNew_Serial(1, context_);
    memory_ = CVodeCreate(multistep, context_);
    Check(CVodeInit(memory_, OnRate, 0.0, y_) == CV_SUCCESS, "CVodeInit");
    Check(CVodeSStolerances(memory_, 1e-6, 0.0) == CV_SUCCESS, "CVodeSStolerances");
    Check(CVodeRootInit(memory_, 1, OnRoot) == CV_SUCCESS, "CVodeRootInit");
    Check(CVodeSetMaxNumSteps(memory_, 100000) == CV_SUCCESS, "CVodeSetMaxNumSteps");
    if (multistep == CV_ADAMS) {
      iteration_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
      Check(CVodeSetNonlinearSolver(memory_, iteration_) == CV_SUCCESS, "SetNonlinearSolver");
    } else {
      matrix_ = SUNDenseMatrix(1, 1, context_);
      linear_ = SUNLinSol_Dense(y_, matrix_, context_);
      Check(CVodeSetLinearSolver(memory_, linear_, matrix_) == CV_SUCCESS, "SetLinearSolver");
      Check(CVodeSetJacFn(memory_, OnJacobian) == CV_SUCCESS, "CVodeSetJacFn");
    }
  }
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;
  ~Cvode() {
    CVodeFree(&memory_);
    SUNNonlinSolFree(iteration_);
    SUNLinSolFree(linear_);
    SUNMatDestroy(matrix_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }

  // Seconds from `from_pa` to the problem's pressure; NaN where the solver fails.
  double Crossing(Problem problem, double from_pa, double tolerance) {
    NV_DATA_S(y_)[0] = from_pa;
    const double end_s = 2.0 * RiseTimeAtMost(problem.rate, from_pa, problem.to_pa);
    double t = 0.0;
    const bool crossed = CVodeSetUserData(memory_, &problem) == CV_SUCCESS &&
                         CVodeReInit(memory_, 0.0, y_) == CV_SUCCESS &&
                         CVodeSStolerances(memory_, tolerance, 0.0) == CV_SUCCESS &&
                         CVode(memory_, end_s, y_, &t, CV_NORMAL) == CV_ROOT_RETURN;
    return crossed ? t : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
  SUNNonlinearSolver iteration_ = nullptr;
  void* memory_ = nullptr;
};

Method Through(const std::string& name, std::shared_ptr<Cvode> cvode) {
  return OneByOne(name, true, [cvode](const RiseRig& rig, double tolerance) {
    const Problem problem{PressureRate(rig), Regime::kBoth, rig.TargetPa()};
    return cvode->Crossing(problem, rig.ambient_pa, tolerance);
  });
}

Method StopAtSwitch(const std::string& name, std::shared_ptr<Cvode> cvode) {
  return OneByOne(name, true, [cvode](const RiseRig& rig, double tolerance) {
    Problem problem{PressureRate(rig), Regime::kChoked, 0.0};
    const double target_pa = rig.TargetPa();
    const double switch_pa = std::min(problem.rate.critical_pa, target_pa);
    double rise_s = 0.0;
    double from_pa = rig.ambient_pa;
    if (from_pa < switch_pa) {
      problem.to_pa = switch_pa;
      rise_s += cvode->Crossing(problem, from_pa, tolerance);
      from_pa = switch_pa;
    }
    if (from_pa < target_pa) {
      problem.regime = Regime::kSubsonic;
      problem.to_pa = target_pa;
      rise_s += cvode->Crossing(problem, from_pa, tolerance);
    }
    return rise_s;
  });
}

}  // namespace

std::vector<Method> CvodeMethods() {
  const auto adams = std::make_shared<Cvode>(CV_ADAMS);
  const auto bdf = std::make_shared<Cvode>(CV_BDF);
  return {Through("CVODE Adams", adams), StopAtSwitch("CVODE Adams, stops at switch", adams),
          Through("CVODE BDF", bdf), StopAtSwitch("CVODE BDF, stops at switch", bdf)};
}

}  // namespace plenum::bench
