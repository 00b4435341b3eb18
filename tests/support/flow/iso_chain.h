// ISO 6358 elements in series, solved by bisection on the mass flow; shares no code with the model.
#ifndef PLENUM_TESTS_SUPPORT_FLOW_ISO_CHAIN_H_
#define PLENUM_TESTS_SUPPORT_FLOW_ISO_CHAIN_H_

#include <cmath>
#include <vector>

namespace plenum::test {

inline constexpr double kGasConstant = 287.05;  // R of air, J/(kg·K)
inline constexpr double kReferenceK = 293.15;
inline constexpr double kReferenceDensity = 1e5 / (kGasConstant * kReferenceK);  // ρ0, kg/m³

struct MassElement {
  double conductance = 0.0;  // C, m³/(s·Pa)
  double critical_ratio = 0.0;
  double index = 0.5;
  double cracking_pa = 0.0;
};

// x in [low, high] with f(x) = 0, f falling.
template <class Function>
double Bisect(double low, double high, const Function& f, double width) {
  while (high - low > width) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (f(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Mass flow through the elements in the order crossed, kg/s; never backwards. `density` is
// ρ0·√(T0/T1) in  ṁ = density·C·p1·Ψ. Where the downstream pressure is above `linear_ratio` of the
// upstream one (less the cracking pressures) flow falls to zero along a straight line.
double ChainFlow(const std::vector<MassElement>& chain, double upstream_pa, double downstream_pa,
                 double density, double linear_ratio);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_FLOW_ISO_CHAIN_H_
