#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint.hpp>
#include <cstdint>

#include "bench/method.h"
#include "bench/pressure_rate.h"

namespace plenum::bench {
namespace {

namespace odeint = boost::numeric::odeint;

using Dopri5 =
    odeint::runge_kutta_dopri5<double, double, double, double, odeint::vector_space_algebra>;

// Seconds from `from_pa` until the dense output passes `to_pa`.
template <class Rate>
double Crossing(const Rate& rate, double from_pa, double to_pa, double tolerance) {
  const auto system = [&rate](double p, double& dpdt, double) { dpdt = rate(p); };
  auto stepper = odeint::make_dense_output(0.0, tolerance, Dopri5());
  stepper.initialize(from_pa, 0.0, 0.1 * (to_pa - from_pa) / rate(from_pa));
  while (stepper.current_state() < to_pa) stepper.do_step(system);

  const auto excess = [&](double t) {
    double p;
    stepper.calc_state(t, p);
    return p - to_pa;
  };
  constexpr int kBits = 40;
  std::uintmax_t iterations_max = 50;
  const auto bracket = boost::math::tools::toms748_solve(
      excess, stepper.previous_time(), stepper.current_time(), stepper.previous_state() - to_pa,
      stepper.current_state() - to_pa, boost::math::tools::eps_tolerance<double>(kBits),
      iterations_max);
  return 0.5 * (bracket.first + bracket.second);
}

double Through(const RiseRig& rig, double tolerance) {
  return Crossing(PressureRate(rig), rig.ambient_pa, rig.TargetPa(), tolerance);
}

double StopAtSwitch(const RiseRig& rig, double tolerance) {
  const PressureRate rate(rig);
  const double target_pa = rig.TargetPa();
  const double switch_pa = std::min(rate.critical_pa, target_pa);
  double rise_s = 0.0;
  double from_pa = rig.ambient_pa;
  if (from_pa < switch_pa) {
    rise_s += Crossing([&](double p) { return rate.Choked(p); }, from_pa, switch_pa, tolerance);
    from_pa = switch_pa;
  }
  if (from_pa < target_pa) {
    rise_s += Crossing([&](double p) { return rate.Subsonic(p); }, from_pa, target_pa, tolerance);
  }
  return rise_s;
}

}  // namespace

std::vector<Method> OdeintMethods() {
  return {OneByOne("odeint dopri5", true, Through),
          OneByOne("odeint dopri5, stops at switch", true, StopAtSwitch)};
}

}  // namespace plenum::bench
