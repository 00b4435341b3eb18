#include "tests/support/chambers/chamber_net.h"

#include <algorithm>
#include <cmath>

namespace plenum::test {
namespace {

constexpr double kLinear = 0.999;

using Masses = std::vector<double>;  // of the chambers, then what came through the valve and leaked

class Net {
 public:
  explicit Net(const ChamberNet& net)
      : net_(net),
        count_(net.chambers.size()),
        density_(kReferenceDensity * std::sqrt(kReferenceK / net.temperature_k)) {}

  double Pressure(std::size_t i, double mass_kg) const {
    const NetChamber& one = net_.chambers[i];
    const double content = mass_kg * kGasConstant * net_.temperature_k;
    const double per_pa = one.rest_m3 * (one.ratio - 1.0) / (one.operating_pa - net_.ambient_pa);
    const double at_zero = one.rest_m3 - per_pa * net_.ambient_pa;
    const double root = std::sqrt(at_zero * at_zero + 4.0 * per_pa * content);
    if (at_zero >= 0.0) return 2.0 * content / (at_zero + root);
    return (root - at_zero) / (2.0 * per_pa);
  }
  double Mass(std::size_t i, double pa) const {
    const NetChamber& one = net_.chambers[i];
    const double x = (pa - net_.ambient_pa) / (one.operating_pa - net_.ambient_pa);
    return pa * one.rest_m3 * (1.0 + (one.ratio - 1.0) * x) / kGasConstant / net_.temperature_k;
  }

  // Either way, by the chain of that way.
  double Both(const std::vector<MassElement>& way, const std::vector<MassElement>& back,
              double a_pa, double b_pa) const {
    return a_pa >= b_pa ? ChainFlow(way, a_pa, b_pa, density_, kLinear)
                        : -ChainFlow(back, b_pa, a_pa, density_, kLinear);
  }

  Masses Slopes(const Masses& masses, int direction) const {
    Masses slope(masses.size(), 0.0);
    std::vector<double> pa(count_);
    for (std::size_t i = 0; i < count_; ++i) pa[i] = Pressure(i, masses[i]);
    // A valve passes gas one way: in from a source or out to it, whichever it is for.
    if (direction != 0) {
      const double beyond_pa = direction > 0 ? net_.source_pa : net_.ambient_pa;
      const bool in = (direction > 0) == (net_.source_pa > net_.ambient_pa);
      const double flow = in ? ChainFlow(net_.fill, beyond_pa, pa[0], density_, kLinear)
                             : -ChainFlow(net_.exhaust, pa[0], beyond_pa, density_, kLinear);
      slope[0] += flow;
      slope[count_] += flow;
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const NetChamber& one = net_.chambers[i];
      if (one.from) {
        const double flow = Both(one.way, one.back, pa[*one.from], pa[i]);
        slope[*one.from] -= flow;
        slope[i] += flow;
      }
      if (!(one.leak.conductance > 0.0)) continue;
      const double out = Both({one.leak}, {one.leak}, pa[i], net_.ambient_pa);
      slope[i] -= out;
      slope[count_ + 1] += out;
    }
    return slope;
  }

  Masses Step(const Masses& masses, double h_s, int direction) const {
    const auto beside = [&](const Masses& slope, double share_s) {
      Masses at = masses;
      for (std::size_t i = 0; i < at.size(); ++i) at[i] += share_s * slope[i];
      return at;
    };
    const Masses a = Slopes(masses, direction), b = Slopes(beside(a, 0.5 * h_s), direction);
    const Masses c = Slopes(beside(b, 0.5 * h_s), direction);
    const Masses d = Slopes(beside(c, h_s), direction);
    Masses next = masses;
    for (std::size_t i = 0; i < next.size(); ++i)
      next[i] += h_s / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    return next;
  }

  Masses Advance(Masses masses, double from_s, double to_s, double step_s, int direction) const {
    const double steps = std::max(1.0, std::ceil((to_s - from_s) / step_s - 1e-9));
    for (int k = 0; k < static_cast<int>(steps); ++k)
      masses = Step(masses, (to_s - from_s) / steps, direction);
    return masses;
  }

 private:
  const ChamberNet& net_;
  std::size_t count_;
  double density_;
};

}  // namespace

NetResult SimulateNet(const ChamberNet& net, const std::vector<double>& t_s, double step_s) {
  const Net equations(net);
  const std::size_t count = net.chambers.size();
  Masses masses;
  for (std::size_t i = 0; i < count; ++i)
    masses.push_back(equations.Mass(i, net.chambers[i].initial_pa));
  masses.resize(count + 2, 0.0);
  NetResult result;
  result.pressure_pa.resize(count);
  double now_s = std::min(0.0, t_s.front());
  std::size_t next = 0;
  int direction = 0;
  for (const double sample_s : t_s) {
    while (now_s < sample_s || (next < net.schedule.size() && net.schedule[next].time_s <= now_s)) {
      while (next < net.schedule.size() && net.schedule[next].time_s <= now_s)
        direction = net.schedule[next++].direction;
      double to_s = sample_s;
      if (next < net.schedule.size()) to_s = std::min(to_s, net.schedule[next].time_s);
      if (to_s > now_s) masses = equations.Advance(masses, now_s, to_s, step_s, direction);
      now_s = std::max(now_s, to_s);
    }
    double gas_kg = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      result.pressure_pa[i].push_back(equations.Pressure(i, masses[i]));
      gas_kg += masses[i];
    }
    result.gas_kg.push_back(gas_kg);
  }
  result.through_valve_kg = masses[count];
  result.leaked_kg = masses[count + 1];
  return result;
}

}  // namespace plenum::test
