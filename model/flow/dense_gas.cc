#include "model/flow/dense_gas.h"

#include <array>
#include <cstddef>

namespace plenum::model {
namespace {

struct CriticalPoint {
  double temperature_k, pressure_pa, acentric_factor;
};
// In the order of the gases; NIST Chemistry WebBook, of air a mixture's (Lemmon et al. 2000).
constexpr std::array<CriticalPoint, kGasNames.size()> kCritical = {{
    {132.53, 3.786e6, 0.0335},
    {126.19, 3.396e6, 0.0372},
    {154.58, 5.043e6, 0.0222},
    {5.195, 0.2276e6, -0.385},
    {33.145, 1.2964e6, -0.219},
    {150.69, 4.863e6, -0.0022},
    {304.13, 7.377e6, 0.2239},
}};

}  // namespace

DenseGas::DenseGas(Gas gas) {
  const CriticalPoint& at = kCritical[static_cast<std::size_t>(gas)];
  critical_k_ = at.temperature_k;
  critical_pa_ = at.pressure_pa;
  constexpr double kOctane = 0.3978;
  const auto between = [&](double simple, double octane) {
    return simple + at.acentric_factor / kOctane * (octane - simple);
  };
  b1_ = between(0.1181193, 0.2026579);
  b2_ = between(0.265728, 0.331511);
  b3_ = between(0.154790, 0.027655);
  b4_ = between(0.030323, 0.203488);
  c1_ = between(0.0236744, 0.0313385);
  c2_ = between(0.0186984, 0.0503618);
  c3_ = between(0.0, 0.016901);
  c4_ = between(0.042724, 0.041577);
  d1_ = between(0.155488e-4, 0.48736e-4);
  d2_ = between(0.623689e-4, 0.0740336e-4);
  beta_ = between(0.65392, 1.226);
  gamma_ = between(0.060167, 0.03754);
}

}  // namespace plenum::model
