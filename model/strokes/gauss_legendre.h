// Gauss–Legendre rule with 12 nodes on [−1, 1], exact for polynomials up to degree 23.
#ifndef PLENUM_MODEL_STROKES_GAUSS_LEGENDRE_H_
#define PLENUM_MODEL_STROKES_GAUSS_LEGENDRE_H_

#include <array>
#include <cstddef>

namespace plenum::model {

inline constexpr std::size_t kGaussNodes = 12;
inline constexpr std::array<double, kGaussNodes> kGaussNode = {
    -0.98156063424671924, -0.90411725637047491, -0.76990267419430469, -0.58731795428661748,
    -0.36783149899818018, -0.12523340851146891, 0.12523340851146891,  0.36783149899818018,
    0.58731795428661748,  0.76990267419430469,  0.90411725637047491,  0.98156063424671924};
inline constexpr std::array<double, kGaussNodes> kGaussWeight = {
    0.047175336386511828, 0.10693932599531843, 0.16007832854334622, 0.20316742672306592,
    0.23349253653835481,  0.24914704581340277, 0.24914704581340277, 0.23349253653835481,
    0.20316742672306592,  0.16007832854334622, 0.10693932599531843, 0.047175336386511828};

// ∫ f(x) dx from a to b.
template <class Function>
double GaussLegendre(double a, double b, const Function& f) {
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  double sum = 0.0;
  for (std::size_t i = 0; i < kGaussNodes; ++i)
    sum += kGaussWeight[i] * f(middle + half * kGaussNode[i]);
  return half * sum;
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_STROKES_GAUSS_LEGENDRE_H_
