// An actuator with some of its effects and its forward sensitivities by CVODES. The equations are
// written once more from the laws, for numbers of any kind, and share nothing with the simulator.
// The right-hand side of the sensitivities, J·s + ∂f/∂θ, is the imaginary part of f at (y + i·h·s,
// θ + i·h): exact to rounding, where the difference quotient inside CVODES would leave 1e-7.
#ifndef PLENUM_TESTS_MODEL_SIMULATE_CVODES_PLANT_H_
#define PLENUM_TESTS_MODEL_SIMULATE_CVODES_PLANT_H_

#include <cvodes/cvodes.h>
#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "model/simulate/simulate.h"

namespace plenum::model {

using Complex = std::complex<double>;
inline constexpr double kTiny = 1e-30;  // the imaginary step

enum Number {
  kRest,
  kRatio,
  kFillC,
  kFillB,
  kVentC,
  kVentB,
  kSource,
  kOperating,
  kLeakC,
  kLeakB,
  kCreepFraction,
  kCreepTime,
  kFrequency,
  kDamping,
  kHeatTime,
  kNumbers
};
template <class T>
using Numbers = std::array<T, kNumbers>;

// States in units that make them of size 1 to 100: pressure in bar; creep, swinging volume and its
// rate in mL and mL/s; content in mL ANR. Those that a plant has no use for stand still.
enum State { kPressure, kCreep, kSwing, kSwingRate, kContent, kStates };
template <class T>
using States = std::array<T, kStates>;
inline constexpr double kBar = 1e5, kMl = 1e-6, kP0 = 1e5, kT0 = 293.15;
inline constexpr double kAmbientBar = 1.0, kAmbientK = 300.0;

struct Plant {
  Numbers<double> value = {50e-6, 1.8, 0.07e-8, 0.3, 0.09e-8, 0.25, 3.6e5, 2e5,
                           0.0,   0.2, 0.0,     1.0, 30.0,    0.5,  0.2};
  bool inertia = false, heated = false;
  bool close_at_operating = false;
  std::vector<Number> numbers = {kRest,  kRatio, kFillC,  kFillB,
                                 kVentC, kVentB, kSource, kOperating};
};

template <class T>
T Psi(const T& ratio, const T& b) {
  const auto ellipse = [&](const T& r) {
    const T x = (r - b) / (1.0 - b);
    return T(std::sqrt(1.0 - x * x));
  };
  if (std::real(ratio) <= std::real(b)) return T(1.0);
  if (std::real(ratio) <= 0.999) return ellipse(ratio);
  return ellipse(T(0.999)) * (1.0 - ratio) / 0.001;
}

// mL/s ANR; zero against the pressure.
template <class T>
T Flow(const T& c, const T& b, const T& up_bar, const T& down_bar, const T& temperature_k) {
  if (std::real(down_bar) >= std::real(up_bar)) return T(0.0);
  return c * (kBar / kMl) * up_bar * std::sqrt(kT0 / temperature_k) * Psi(T(down_bar / up_bar), b);
}

template <class T>
States<T> AtAmbient(const Numbers<T>& n) {
  const T rest = n[kRest] / kMl;
  return {T(kAmbientBar), T(0.0), rest, T(0.0),
          rest * (kAmbientBar * kBar / kP0 * kT0 / kAmbientK)};
}

template <class T>
States<T> Slopes(const Plant& plant, ValveState valve, const Numbers<T>& n, const States<T>& y) {
  const T p = y[kPressure], rest = n[kRest] / kMl, operating = n[kOperating] / kBar;
  const T follow = rest * (n[kRatio] - 1.0) / (operating - kAmbientBar);  // dV_qs/dp
  const T quasi_static = rest + follow * (p - kAmbientBar);
  States<T> rate = {};
  rate[kCreep] = (n[kCreepFraction] * (quasi_static - rest) - y[kCreep]) / n[kCreepTime];
  T volume = quasi_static + y[kCreep], volume_slope = follow, volume_rate = rate[kCreep];
  if (plant.inertia) {
    rate[kSwing] = y[kSwingRate];
    rate[kSwingRate] = n[kFrequency] * n[kFrequency] * (volume - y[kSwing]) -
                       2.0 * n[kDamping] * n[kFrequency] * y[kSwingRate];
    volume = y[kSwing], volume_slope = T(0.0), volume_rate = y[kSwingRate];
  }
  const T ambient(kAmbientBar), ambient_k(kAmbientK);
  const T gas_k = plant.heated ? T(p * volume / y[kContent] * (kBar / kP0 * kT0)) : ambient_k;
  T in(0.0), out = Flow(n[kLeakC], n[kLeakB], p, ambient, gas_k);
  if (valve == ValveState::kInflate) {
    in = Flow(n[kFillC], n[kFillB], T(n[kSource] / kBar), p, ambient_k);
  }
  if (valve == ValveState::kDeflate) out += Flow(n[kVentC], n[kVentB], p, ambient, gas_k);
  // First law, d(pV)/dt/(κ−1) = κ/(κ−1)·R·(T_a·ṁ_in − T·ṁ_out) − p·V̇ + hA·(T_a − T); κ → 1 leaves
  // the isothermal balance.
  const double kappa = plant.heated ? 1.4 : 1.0;
  const T heat =
      plant.heated
          ? T(operating * rest * n[kRatio] / (kAmbientK * n[kHeatTime]) * (kAmbientK - gas_k))
          : T(0.0);
  const T push = kappa * kP0 / kT0 / kBar * (kAmbientK * in - gas_k * out) + heat;
  rate[kPressure] = (push - kappa * p * volume_rate) / (volume + kappa * p * volume_slope);
  if (plant.heated) rate[kContent] = in - out;
  return rate;
}

// Value and imaginary part: θ moves as θ·(1 + i·h), so that s is ∂y/∂ln θ.
inline Numbers<Complex> Moved(const Plant& plant, Number number) {
  Numbers<Complex> n;
  std::copy(plant.value.begin(), plant.value.end(), n.begin());
  n[number] *= Complex(1.0, kTiny);
  return n;
}

// State and sensitivities at a time.
struct Point {
  States<double> y;
  std::vector<States<double>> s;
};

inline Point Start(const Plant& plant) {
  Point point = {AtAmbient(plant.value), std::vector<States<double>>(plant.numbers.size())};
  for (std::size_t j = 0; j < point.s.size(); ++j) {
    const States<Complex> y = AtAmbient(Moved(plant, plant.numbers[j]));
    for (int i = 0; i < kStates; ++i) point.s[j][i] = y[i].imag() / kTiny;
  }
  return point;
}

// CVODES over one position of the valve.
class Phase {
 public:
  Phase(const Plant& plant, ValveState valve, double start_s, double end_s, const Point& point)
      : plant_(plant), valve_(valve), count_(static_cast<int>(plant.numbers.size())) {
    SUNContext_Create(nullptr, &context_);
    y_ = N_VNew_Serial(kStates, context_);
    s_ = N_VCloneVectorArray(count_, y_);
    matrix_ = SUNDenseMatrix(kStates, kStates, context_);
    solver_ = SUNLinSol_Dense(y_, matrix_, context_);
    std::copy(point.y.begin(), point.y.end(), N_VGetArrayPointer(y_));
    for (int j = 0; j < count_; ++j) {
      const States<double>& s = point.s[static_cast<std::size_t>(j)];
      std::copy(s.begin(), s.end(), N_VGetArrayPointer(s_[j]));
    }
    std::vector<double> tolerances(plant.numbers.size(), 1e-11);
    cvodes_ = CVodeCreate(CV_BDF, context_);
    Check(CVodeInit(cvodes_, Rate, start_s, y_));
    Check(CVodeSetUserData(cvodes_, this));
    Check(CVodeSStolerances(cvodes_, 1e-11, 1e-11));
    Check(CVodeSetLinearSolver(cvodes_, solver_, matrix_));
    Check(CVodeSetMaxNumSteps(cvodes_, 200000));
    Check(CVodeSensInit1(cvodes_, count_, CV_STAGGERED, SensitivityRate, s_));
    Check(CVodeSensSStolerances(cvodes_, 1e-11, tolerances.data()));
    Check(CVodeSetSensErrCon(cvodes_, 1));
    Check(CVodeSetStopTime(cvodes_, end_s));
    if (plant.close_at_operating && valve == ValveState::kInflate) {
      Check(CVodeRootInit(cvodes_, 1, AboveOperating));
    }
  }
  Phase(const Phase&) = delete;
  ~Phase() {
    CVodeFree(&cvodes_);
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    N_VDestroyVectorArray(s_, count_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }

  // Up to that time or to the operating pressure; true if the latter.
  bool To(double time_s, double* now_s, Point* point) {
    const int outcome = CVode(cvodes_, time_s, y_, now_s, CV_NORMAL);
    Check(outcome);
    Check(CVodeGetSens(cvodes_, now_s, s_));
    point->y = Of(y_);
    for (int j = 0; j < count_; ++j) point->s[static_cast<std::size_t>(j)] = Of(s_[j]);
    return outcome == CV_ROOT_RETURN;
  }

 private:
  static void Check(int outcome) { EXPECT_GE(outcome, 0) << "CVODES"; }
  static States<double> Of(N_Vector v) {
    States<double> y;
    std::copy_n(N_VGetArrayPointer(v), kStates, y.begin());
    return y;
  }
  static int Rate(double, N_Vector y, N_Vector rate, void* self) {
    const Phase& phase = *static_cast<Phase*>(self);
    const auto slopes = Slopes(phase.plant_, phase.valve_, phase.plant_.value, Of(y));
    std::copy(slopes.begin(), slopes.end(), N_VGetArrayPointer(rate));
    return 0;
  }
  static int SensitivityRate(int, double, N_Vector y, N_Vector, int j, N_Vector s, N_Vector rate,
                             void* self, N_Vector, N_Vector) {
    const Phase& phase = *static_cast<Phase*>(self);
    const States<double> values = Of(y), parts = Of(s);
    States<Complex> moved;
    for (int i = 0; i < kStates; ++i) moved[i] = {values[i], kTiny * parts[i]};
    const Number number = phase.plant_.numbers[static_cast<std::size_t>(j)];
    const auto slopes = Slopes(phase.plant_, phase.valve_, Moved(phase.plant_, number), moved);
    for (int i = 0; i < kStates; ++i) N_VGetArrayPointer(rate)[i] = slopes[i].imag() / kTiny;
    return 0;
  }
  static int AboveOperating(double, N_Vector y, double* value, void* self) {
    const Plant& plant = static_cast<Phase*>(self)->plant_;
    value[0] = N_VGetArrayPointer(y)[kPressure] - plant.value[kOperating] / kBar;
    return 0;
  }

  const Plant& plant_;
  ValveState valve_;
  int count_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr;
  N_Vector* s_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  void* cvodes_ = nullptr;
};

struct Reference {
  std::vector<Point> points;  // at the times asked for
  double reached_s = 0.0;     // the operating pressure, and its time's derivatives
  std::vector<double> reached;
};

inline Reference Integrate(const Plant& plant, const std::vector<ValveCommand>& schedule,
                           const std::vector<double>& times_s) {
  Reference reference;
  Point point = Start(plant);
  double now_s = 0.0;
  ValveState valve = ValveState::kHold;
  std::size_t sample = 0;
  for (std::size_t next = 0; next <= schedule.size(); ++next) {
    const double end_s = next < schedule.size() ? schedule[next].time_s : times_s.back();
    while (now_s < end_s) {
      Phase phase(plant, valve, now_s, end_s, point);
      bool closed = false;
      while (!closed && now_s < end_s) {
        const bool sampling = sample < times_s.size() && times_s[sample] <= end_s;
        if (sampling && times_s[sample] <= now_s) {
          reference.points.push_back(point), ++sample;
          continue;
        }
        closed = phase.To(sampling ? times_s[sample] : end_s, &now_s, &point);
      }
      if (!closed) continue;
      // The instant t* at which p = p_op moves by (∂p_op − s_p)/ṗ, and with it the change of slope.
      const auto before = Slopes(plant, valve, plant.value, point.y);
      valve = ValveState::kHold;
      const auto after = Slopes(plant, valve, plant.value, point.y);
      reference.reached_s = now_s;
      for (std::size_t j = 0; j < point.s.size(); ++j) {
        const double level = plant.numbers[j] == kOperating ? plant.value[kOperating] / kBar : 0.0;
        const double moves = (level - point.s[j][kPressure]) / before[kPressure];
        reference.reached.push_back(moves);
        for (int i = 0; i < kStates; ++i) point.s[j][i] += (before[i] - after[i]) * moves;
      }
    }
    if (next < schedule.size()) valve = schedule[next].state;
  }
  while (sample++ < times_s.size()) reference.points.push_back(point);
  return reference;
}

}  // namespace plenum::model

#endif  // PLENUM_TESTS_MODEL_SIMULATE_CVODES_PLANT_H_
