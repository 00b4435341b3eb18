#include "tests/support/flow/iso_chain.h"

#include <algorithm>

namespace plenum::test {
namespace {

double Ellipse(double ratio, double b, double index) {
  if (ratio <= b) return 1.0;
  if (ratio >= 1.0) return 0.0;
  return std::pow(1.0 - std::pow((ratio - b) / (1.0 - b), 2), index);
}

// Pressure behind an element that passes `flow`; negative where it cannot pass it.
double Behind(const MassElement& e, double upstream, double flow, double density) {
  const double p = upstream - e.cracking_pa;
  const double choked = density * e.conductance * p;
  if (p <= 0.0 || flow > choked) return -1.0;
  const double psi = flow / choked;
  const double root = 1.0 - (e.index == 0.5 ? psi * psi : std::pow(psi, 1.0 / e.index));
  return p * (e.critical_ratio + (1.0 - e.critical_ratio) * std::sqrt(root));
}

}  // namespace

double ChainFlow(const std::vector<MassElement>& chain, double upstream_pa, double downstream_pa,
                 double density, double linear_ratio) {
  double head = upstream_pa;
  for (const MassElement& e : chain) head -= e.cracking_pa;
  if (chain.empty() || head <= downstream_pa) return 0.0;
  const double ratio = downstream_pa / head;
  if (ratio > linear_ratio) {
    return ChainFlow(chain, upstream_pa, linear_ratio * head * (1.0 - 1e-15), density,
                     linear_ratio) *
           (1.0 - ratio) / (1.0 - linear_ratio);
  }
  if (chain.size() == 1) {
    const MassElement& e = chain[0];
    return density * e.conductance * head * Ellipse(ratio, e.critical_ratio, e.index);
  }
  double least_c = chain[0].conductance;
  for (const MassElement& e : chain) least_c = std::min(least_c, e.conductance);
  const double most = density * upstream_pa * least_c;
  const auto surplus = [&](double flow) {
    double p = upstream_pa;
    for (const MassElement& e : chain) {
      p = Behind(e, p, flow, density);
      if (p < 0.0) return -1.0;
    }
    return p - downstream_pa;
  };
  return Bisect(0.0, most, surplus, 1e-11 * most);
}

}  // namespace plenum::test
