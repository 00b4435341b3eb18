#include "model/strokes/refill.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <vector>

namespace plenum::model {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-10;
constexpr double kRounding = 1e-6;
constexpr int kHalvings = 50;

// Pressure; time that pumps have run, or air that they delivered; energy of all pumps.
using State = std::array<double, 3>;

double Delivered(const RefillInput& input, double pa) {
  return input.compressors * input.duty * FreeAirDelivery(*input.compressor, pa);
}
double Power(const RefillInput& input, double pa) {
  const CompressorCurve& curve = *input.compressor;
  const double low_pa = curve.current_a.empty() ? pa : std::min(curve.current_a.front(), pa);
  return input.compressors * input.duty * curve.voltage_v * LargestCurrent(curve, low_pa, pa);
}

// Until the tank has fallen to a pressure by the draw alone.
double FallSeconds(const RefillInput& input, double to_pa) {
  return input.capacity_m3_per_pa * (input.fill_pa - to_pa) / input.draw_m3_per_s;
}

template <typename Rate>
State Integrate(const Rate& rate, State state, double to) {
  using boost::numeric::odeint::runge_kutta_dopri5;
  if (!(to > 0.0)) return state;
  const auto stepper =
      boost::numeric::odeint::make_controlled<runge_kutta_dopri5<State>>(kTolerance, kTolerance);
  boost::numeric::odeint::integrate_adaptive(stepper, rate, state, 0.0, to, to * 1e-3);
  return state;
}

// While pumps run and the tank falls all the same from one pressure to another.
double SecondsBetween(const RefillInput& input, double high_pa, double low_pa) {
  std::vector<double> pieces{low_pa, high_pa};
  for (const double pa : input.compressor->free_air_m3_per_s.x())
    if (pa > low_pa && pa < high_pa) pieces.push_back(pa);
  std::sort(pieces.begin(), pieces.end());
  const auto per_pa = [&](double pa) {
    return input.capacity_m3_per_pa / (input.draw_m3_per_s - Delivered(input, pa));
  };
  double seconds = 0.0;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    seconds += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
        per_pa, pieces[i - 1], pieces[i], 15, kTolerance);
  return seconds;
}

double LastsSeconds(const RefillInput& input, double stop_pa) {
  if (stop_pa < input.kept_pa) return FallSeconds(input, input.kept_pa);
  if (Delivered(input, input.kept_pa) >= input.draw_m3_per_s) return kEndless;
  return FallSeconds(input, stop_pa) + SecondsBetween(input, stop_pa, input.kept_pa);
}

// The tank stays at one pressure.
void Hold(const RefillInput& input, double pa, double air_m3, Refill& refill) {
  const double running_s = air_m3 / Delivered(input, pa);
  refill.stop_pa = pa;
  refill.on_s = input.duty * running_s;
  refill.energy_j = running_s * Power(input, pa);
}

// Forwards in time from the stop pressure.
void RunFrom(const RefillInput& input, double stop_pa, double seconds, Refill& refill) {
  if (Delivered(input, stop_pa) >= input.draw_m3_per_s)
    return Hold(input, stop_pa, seconds * input.draw_m3_per_s, refill);
  const auto rate = [&](const State& state, State& slope, double) {
    slope = {(Delivered(input, state[0]) - input.draw_m3_per_s) / input.capacity_m3_per_pa,
             input.duty, Power(input, state[0])};
  };
  const State end = Integrate(rate, {stop_pa, 0.0, 0.0}, seconds);
  refill.stop_pa = stop_pa;
  refill.on_s = end[1];
  refill.energy_j = end[2];
}

// Backwards in time from the pressure that is kept, until so much air is pumped.
void RunTo(const RefillInput& input, double air_m3, double highest_pa, Refill& refill) {
  using boost::numeric::odeint::runge_kutta_dopri5;
  const auto rate = [&](const State& state, State& slope, double) {
    const double pa = std::min(state[0], highest_pa);
    const double delivered = Delivered(input, pa);
    slope = {(input.draw_m3_per_s - delivered) / input.capacity_m3_per_pa, delivered,
             Power(input, pa)};
  };
  auto stepper = boost::numeric::odeint::make_dense_output(kTolerance, kTolerance,
                                                           runge_kutta_dopri5<State>());
  stepper.initialize(State{input.kept_pa, 0.0, 0.0}, 0.0, input.seconds * 1e-3);
  // Pumps whose delivery vanishes at the highest pressure may come to it a little early.
  const auto done = [&](const State& state) {
    return state[1] >= air_m3 || state[0] >= highest_pa;
  };
  while (!done(stepper.current_state()) && stepper.current_time() < input.seconds)
    stepper.do_step(rate);
  double early_s = stepper.previous_time(), late_s = stepper.current_time();
  State state = stepper.current_state();
  for (int i = 0; i < kHalvings && done(stepper.current_state()); ++i) {
    const double middle_s = 0.5 * (early_s + late_s);
    stepper.calc_state(middle_s, state);
    (done(state) ? late_s : early_s) = middle_s;
  }
  if (done(stepper.current_state())) stepper.calc_state(late_s, state);
  refill.stop_pa = std::min(state[0], highest_pa);
  refill.on_s = input.duty * late_s;
  refill.energy_j = state[2];
}

// The stop pressure that is given, else the highest. One that is what is kept but for rounding is
// it.
double MostPa(const RefillInput& input) {
  const double highest_pa = std::min(input.fill_pa, HighestPressure(*input.compressor));
  if (!(input.stop_pa > 0.0)) return highest_pa;
  const bool is_kept = std::abs(input.stop_pa / input.kept_pa - 1.0) < kRounding;
  return std::min(is_kept ? input.kept_pa : input.stop_pa, highest_pa);
}

}  // namespace

double LastingSeconds(const RefillInput& input) { return LastsSeconds(input, MostPa(input)); }

Refill RefillTank(const RefillInput& input) {
  const double highest_pa = std::min(input.fill_pa, HighestPressure(*input.compressor));
  const bool given = input.stop_pa > 0.0;
  const double most_pa = MostPa(input);
  Refill refill{.stop_pa = input.kept_pa, .lasts_s = LastingSeconds(input)};
  if (!(input.kept_pa <= input.fill_pa)) return refill;
  const double air_m3 = input.draw_m3_per_s * (input.seconds - FallSeconds(input, input.kept_pa));
  if (given || refill.lasts_s < input.seconds) {
    refill.stop_pa = given ? input.stop_pa : std::max(most_pa, input.kept_pa);
    const double seconds = std::min(input.seconds, refill.lasts_s) - FallSeconds(input, most_pa);
    if (seconds > 0.0 && most_pa >= input.kept_pa) RunFrom(input, most_pa, seconds, refill);
  } else if (air_m3 > 0.0) {
    if (Delivered(input, input.kept_pa) >= input.draw_m3_per_s)
      Hold(input, input.kept_pa, air_m3, refill);
    else
      RunTo(input, air_m3, highest_pa, refill);
  }
  return refill;
}

}  // namespace plenum::model
