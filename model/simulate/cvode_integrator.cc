#include "model/simulate/cvode_integrator.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>

namespace plenum::model {

// What CVODE holds; C handles freed in the order that they need.
struct CvodeIntegrator::Memory {
  System<double>* system = nullptr;
  double rtol = 0.0, atol_pa = 0.0;
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver solver = nullptr;
  void* cvode = nullptr;
  bool started = false;

  ~Memory() {
    if (cvode) CVodeFree(&cvode);
    if (solver) SUNLinSolFree(solver);
    if (matrix) SUNMatDestroy(matrix);
    if (y) N_VDestroy(y);
    if (context) SUNContext_Free(&context);
  }

  static std::span<double> Span(N_Vector v) {
    return {N_VGetArrayPointer(v), static_cast<std::size_t>(N_VGetLength_Serial(v))};
  }
  static int Slopes(double t, N_Vector y, N_Vector dydt, void* self) {
    const std::span<double> slopes = Span(dydt);
    (*static_cast<Memory*>(self)->system)(t, Span(y), slopes);
    const bool finite = std::all_of(slopes.begin(), slopes.end(),
                                    [](double slope) { return std::isfinite(slope); });
    return finite ? 0 : 1;  // 1: try a smaller step
  }
  static int Guards(double t, N_Vector y, double* values, void* self) {
    System<double>& system = *static_cast<Memory*>(self)->system;
    system.GuardValues(t, Span(y), {values, system.guards().size()});
    return 0;
  }
  static int Weights(N_Vector y, N_Vector weights, void* self) {
    const Memory& memory = *static_cast<Memory*>(self);
    const std::span<const double> sizes = memory.system->sizes();
    const std::span<const double> state = Span(y);
    const std::span<double> weight = Span(weights);
    for (std::size_t i = 0; i < state.size(); ++i) {
      weight[i] = 1.0 / ErrorBound(std::abs(state[i]), sizes[i], memory.rtol, memory.atol_pa);
    }
    return 0;
  }
};

CvodeIntegrator::CvodeIntegrator(System<double>& system, double relative_tolerance,
                                 double absolute_tolerance_pa)
    : system_(system),
      y1_(system.size()),
      slope_(system.size()),
      dense_(system.size()),
      memory_(std::make_unique<Memory>()) {
  Memory& m = *memory_;
  m.system = &system;
  m.rtol = relative_tolerance;
  m.atol_pa = absolute_tolerance_pa;
  SUNContext_Create(nullptr, &m.context);
  m.y = N_VNew_Serial(static_cast<sunindextype>(system.size()), m.context);
  m.matrix = SUNDenseMatrix(static_cast<sunindextype>(system.size()),
                            static_cast<sunindextype>(system.size()), m.context);
  m.solver = SUNLinSol_Dense(m.y, m.matrix, m.context);
  m.cvode = CVodeCreate(CV_BDF, m.context);
}

CvodeIntegrator::~CvodeIntegrator() = default;

void CvodeIntegrator::Start(double t, std::span<const double> y, bool) {
  Memory& m = *memory_;
  t0_ = t1_ = t;
  std::copy(y.begin(), y.end(), y1_.begin());
  std::copy(y.begin(), y.end(), Memory::Span(m.y).begin());
  system_(t, y1_, slope_);
  if (!m.started) {
    CVodeInit(m.cvode, Memory::Slopes, t, m.y);
    CVodeSetUserData(m.cvode, &m);
    CVodeWFtolerances(m.cvode, Memory::Weights);
    CVodeSetLinearSolver(m.cvode, m.solver, m.matrix);
    CVodeSetErrHandlerFn(
        m.cvode, [](int, const char*, const char*, char*, void*) {}, nullptr);
    m.started = true;
  } else {
    CVodeReInit(m.cvode, t, m.y);
  }
  const std::vector<int> falling(system_.guards().size(), -1);
  CVodeRootInit(m.cvode, static_cast<int>(falling.size()), Memory::Guards);
  if (!falling.empty()) CVodeSetRootDirection(m.cvode, const_cast<int*>(falling.data()));
  CVodeSetNoInactiveRootWarn(m.cvode);
}

StepOutcome CvodeIntegrator::Step(double boundary) {
  Memory& m = *memory_;
  event_.reset();
  t0_ = t1_;
  CVodeSetStopTime(m.cvode, boundary);
  const int flag = CVode(m.cvode, boundary, m.y, &t1_, CV_ONE_STEP);
  if (flag < 0) return StepOutcome::kNotFinite;
  const std::span<const double> y = Memory::Span(m.y);
  std::copy(y.begin(), y.end(), y1_.begin());
  if (flag == CV_TSTOP_RETURN) t1_ = boundary;
  if (flag == CV_ROOT_RETURN) {
    std::vector<int> turned(system_.guards().size());
    CVodeGetRootInfo(m.cvode, turned.data());
    const auto first =
        std::find_if(turned.begin(), turned.end(), [](int sign) { return sign != 0; });
    if (first != turned.end()) event_ = static_cast<std::size_t>(first - turned.begin());
  }
  system_(t1_, y1_, slope_);
  return StepOutcome::kTaken;
}

void CvodeIntegrator::StateAt(double time_s, std::span<double> y) {
  N_Vector out = N_VMake_Serial(static_cast<sunindextype>(y.size()), y.data(), memory_->context);
  CVodeGetDky(memory_->cvode, time_s, 0, out);
  N_VDestroy(out);
}

double CvodeIntegrator::Value(double theta, std::size_t i) {
  StateAt(t0_ + theta * (t1_ - t0_), dense_);
  return dense_[i];
}

double CvodeIntegrator::Slope(double theta, std::size_t i) {
  N_Vector out =
      N_VMake_Serial(static_cast<sunindextype>(dense_.size()), dense_.data(), memory_->context);
  CVodeGetDky(memory_->cvode, t0_ + theta * (t1_ - t0_), 1, out);
  N_VDestroy(out);
  return dense_[i] * (t1_ - t0_);
}

}  // namespace plenum::model
