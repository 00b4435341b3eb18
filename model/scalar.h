// Numbers of the simulator: double, or a dual number that carries derivatives through the run.
//
// The equations, the integrator and the events are templates over the number T. With T = Dual each
// number is value + Σ (∂/∂θ_j)·ε_j for up to kDirections parameters θ at once (forward mode;
// ceres::Jet). Comparisons see the values alone.
#ifndef PLENUM_MODEL_SCALAR_H_
#define PLENUM_MODEL_SCALAR_H_

#include <ceres/jet.h>

#include <span>
#include <type_traits>

#include "model/monotone_curve.h"

namespace plenum::model {

inline constexpr int kDirections = 10;  // most fits have 7 to 10 numbers that move a run
using Dual = ceres::Jet<double, kDirections>;

template <class T>
inline constexpr bool kIsDual = !std::is_same_v<T, double>;

inline double ValueOf(double x) { return x; }
inline double ValueOf(const Dual& x) { return x.a; }

// Zero, and no parameter moves it from there.
inline bool IsZero(double x) { return x == 0.0; }
inline bool IsZero(const Dual& x) { return x.a == 0.0 && x.v.isZero(0.0); }

// f(x) with its derivative df/dx, both taken at the value of x.
inline double Chain(double, double f, double) { return f; }
inline Dual Chain(const Dual& x, double f, double slope) { return Dual(f, slope * x.v); }

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
  int direction = 0;  // below kDirections
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

#endif  // PLENUM_MODEL_SCALAR_H_
