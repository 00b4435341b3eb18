// Numbers of the simulator: double, or a dual number that carries derivatives through the run.
//
// The equations, the integrator and the events are templates over the number T. With T = DualOf<N>
// each number is value + Σ (∂/∂θ_j)·ε_j for up to N parameters θ at once (forward mode;
// ceres::Jet). Comparisons see the values alone.
#ifndef PLENUM_MODEL_FLOW_SCALAR_H_
#define PLENUM_MODEL_FLOW_SCALAR_H_

#include <ceres/jet.h>

#include <span>

#include "model/physics/monotone_curve.h"

namespace plenum::model {

template <int N>
using DualOf = ceres::Jet<double, N>;

// Most fits have 7 to 10 numbers that move a run; two effects and a clock make them 11 or 12, for
// which one run in wide numbers takes the place of two.
inline constexpr int kDirections = 10, kWideDirections = 12;
using Dual = DualOf<kDirections>;
using WideDual = DualOf<kWideDirections>;

template <class T>
inline constexpr int kDirectionsOf = 0;
template <int N>
inline constexpr int kDirectionsOf<DualOf<N>> = N;

template <class T>
inline constexpr bool kIsDual = kDirectionsOf<T> > 0;

inline double ValueOf(double x) { return x; }
template <int N>
double ValueOf(const DualOf<N>& x) {
  return x.a;
}

// Zero, and no parameter moves it from there.
inline bool IsZero(double x) { return x == 0.0; }
template <int N>
bool IsZero(const DualOf<N>& x) {
  return x.a == 0.0 && x.v.isZero(0.0);
}

// f(x) with its derivative df/dx, both taken at the value of x.
inline double Chain(double, double f, double) { return f; }
template <int N>
DualOf<N> Chain(const DualOf<N>& x, double f, double slope) {
  return DualOf<N>(f, slope * x.v);
}

template <class T>
T CurveAt(const MonotoneCurve& curve, const T& x) {
  if constexpr (kIsDual<T>) return Chain(x, curve(x.a), curve.Slope(x.a));
  return T(curve(ValueOf(x)));
}

template <class T>
T CurveSlopeAt(const MonotoneCurve& curve, const T& x) {
  if constexpr (kIsDual<T>) return Chain(x, curve.Slope(x.a), curve.Curvature(x.a));
  return T(curve.Slope(ValueOf(x)));
}

// One number of a rig that moves with one direction, by `weight` per unit of it.
struct Seed {
  const double* number = nullptr;
  int direction = 0;  // below kDirectionsOf<T>
  double weight = 1.0;
};

// Turns the numbers of a rig into T. A number is known by its address in the rig: it starts with
// the weights of its seeds as derivatives, one without seeds with none.
class Lift {
 public:
  explicit Lift(std::span<const Seed> seeds = {}) : seeds_(seeds) {}

  template <class T>
  T operator()(const double& number) const {
    T lifted(number);
    if constexpr (kIsDual<T>) {
      for (const Seed& seed : seeds_) {
        if (seed.number == &number) lifted.v[seed.direction] += seed.weight;
      }
    }
    return lifted;
  }

 private:
  std::span<const Seed> seeds_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_SCALAR_H_
