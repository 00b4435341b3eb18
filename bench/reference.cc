#include "bench/reference.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <stdexcept>

namespace plenum::bench {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;

template <class Integrand>
Real Integrate(const Integrand& integrand, const Real& from, const Real& to) {
  Real error;
  const Real value = boost::math::quadrature::gauss_kronrod<Real, 51>::integrate(
      integrand, from, to, 3, Real(1e-32), &error);
  if (!(error <= 1e-30 * value)) throw std::runtime_error("the reference missed 30 digits");
  return value;
}

}  // namespace

double ReferenceRiseTime(const RiseRig& rig) {
  const Real ambient = rig.ambient_pa;
  const Real source = rig.source_pa;
  const Real target = rig.TargetPa();
  const Real b = rig.critical_ratio;
  const Real growth = (Real(rig.expansion_ratio) - 1) / (Real(rig.operating_pa) - ambient);
  const auto content_slope = [&](const Real& p) -> Real {
    return rig.rest_volume_m3 * (1 + growth * (2 * p - ambient));
  };
  const Real critical = b * source;
  Real sum = 0;  // ∫ W/Ψ dp
  if (ambient < critical) {
    sum += Integrate(content_slope, ambient, critical < target ? critical : target);
  }
  if (critical < target) {
    const auto u_at = [&](const Real& p) -> Real { return sqrt(1 - p / source); };
    const auto integrand = [&](const Real& u) -> Real {
      const Real p = source * (1 - u * u);
      const Real z = (1 - u * u - b) / (1 - b);
      // Ψ = √((1 − z)(1 + z)) with 1 − z = u²/(1 − b); dp = −2·p_s·u du.
      return 2 * source * content_slope(p) * sqrt((1 - b) / (1 + z));
    };
    sum += Integrate(integrand, u_at(target), u_at(critical > ambient ? critical : ambient));
  }
  constexpr double kReferencePressurePa = 1e5;
  return static_cast<double>(
      Real(sum / (kReferencePressurePa * Real(rig.conductance_m3_per_s_pa) * source)));
}

}  // namespace plenum::bench
