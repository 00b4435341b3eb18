#include "model/strokes/reservoir_stroke.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "model/physics/air.h"

namespace plenum::model {
namespace {

// Differences between reservoir and chambers, of their pressure.
constexpr double kEqual = 1e-7;
constexpr double kNearlyEqual = 2e-5;

// Time, reservoir pressure, pump time, pump energy, pumped air.
using State = std::array<double, 5>;

// FreeAirDelivery up to and including the highest pressure, which a pump still reaches.
double Delivery(const CompressorCurve& curve, double pressure_pa) {
  const MonotoneCurve& flow = curve.free_air_m3_per_s;
  if (flow.empty()) return 0.0;
  return flow(std::max(flow.front(), std::min(pressure_pa, HighestPressure(curve))));
}

class Stroke {
 public:
  explicit Stroke(const ReservoirStrokeInput& input)
      : in_(input),
        content_per_volume_(kReferencePressurePa * input.temperature_k / kReferenceTemperatureK) {}

  double Flow(double source_pa, double p) const {
    const double mirror_pa = MirrorPa(*in_.chamber);
    const double from_pa = mirror_pa > 0.0 ? mirror_pa - p : source_pa;
    const double to_pa = mirror_pa > 0.0 ? mirror_pa - source_pa : p;
    return from_pa * (*in_.fill)(std::min(to_pa / from_pa, 1.0 - kEqual));
  }

  // Whether the pumps cover the draw of a full reservoir.
  bool Covered(double p) const {
    return in_.count * Flow(in_.stop_pa, p) <=
           in_.compressors * Delivery(*in_.compressor, in_.stop_pa);
  }

  void operator()(const State& y, State& dy, double p) const {
    const double source_pa = y[1];
    const double flow = Flow(source_pa, p);
    const double delivery = in_.compressors * Delivery(*in_.compressor, source_pa);
    const double net = delivery - in_.count * flow;
    const double volume = net < 0.0 ? in_.volume_falling_m3 : in_.volume_rising_m3;
    const double seconds = ContentSlope(*in_.chamber, p) / (content_per_volume_ * flow);
    dy[0] = seconds;
    dy[1] = content_per_volume_ / volume * net * seconds;
    dy[2] = seconds;
    dy[3] = seconds * in_.compressors * ElectricalPower(*in_.compressor, source_pa);
    dy[4] = seconds * delivery;
  }

 private:
  const ReservoirStrokeInput& in_;
  double content_per_volume_;
};

// Halves until it is exact: 1/Q_c is steep where a table ends close to zero.
template <class Function>
double Integral(const Function& f, double from, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(f, from, to, 12, 1e-9);
}

// The values of u = √(1 − r) from which on a fill out of a full reservoir is smooth, in order:
// where the pieces of the line's table and of a measured volume meet.
std::vector<double> Panels(const ReservoirStrokeInput& in, double first, double last) {
  std::vector<double> borders{first, last};
  const auto add = [&](double ratio) {
    const double u = std::sqrt(std::max(0.0, 1.0 - ratio));
    if (u > first && u < last) borders.push_back(u);
  };
  for (int i = 1; i <= FlowTable::kCells; ++i) add(in.fill->KnotRatio(i));
  for (double p : in.chamber->volume_curve.x()) add(p / in.stop_pa);
  std::sort(borders.begin(), borders.end());
  return borders;
}

// How far the reservoir stays above the chambers while both rise together: by what drives a line's
// share of the delivery, q ∝ √(1 − r) near equal pressures.
double Lead(const ReservoirStrokeInput& in, double p) {
  const double slope = ContentSlope(*in.chamber, p);
  const double share = slope / (in.count * slope + in.volume_rising_m3);
  const double flow = share * in.compressors * Delivery(*in.compressor, p);
  const double head_pa = std::abs(p - MirrorPa(*in.chamber));
  const double flow_per_root = head_pa * (*in.fill)(1.0 - 1e-8) / 1e-4;
  return head_pa * std::pow(flow / flow_per_root, 2);
}

// Whether the line no longer holds reservoir and chambers apart. Explicit steps would have to be
// short from here on.
bool Together(const ReservoirStrokeInput& in, double source_pa, double p) {
  const double lead = source_pa - p;
  return lead <= kEqual * p ||
         (lead <= kNearlyEqual * p && std::abs(lead - Lead(in, p)) <= kEqual * p);
}

// Reservoir and chambers as one volume that the pumps fill. False where they deliver nothing on the
// way.
bool FillTogether(const ReservoirStrokeInput& in, State& y, double from, double to) {
  if (to > in.stop_pa || !(Delivery(*in.compressor, to) > 0.0)) return false;
  const double content_per_volume =
      kReferencePressurePa * in.temperature_k / kReferenceTemperatureK;
  const auto source_pa = [&](double p) { return std::min(p + Lead(in, p), in.stop_pa); };
  const auto pump_seconds = [&](double content, double p) {
    return content / (content_per_volume * in.compressors * Delivery(*in.compressor, source_pa(p)));
  };
  const auto seconds_per_pa = [&](double p) {
    return pump_seconds(in.volume_rising_m3 + in.count * ContentSlope(*in.chamber, p), p);
  };
  const auto power = [&](double p) {
    return in.compressors * ElectricalPower(*in.compressor, source_pa(p));
  };
  // The reservoir rises by a little less or more than the chambers, about evenly on the way.
  const double middle_pa = 0.5 * (from + to);
  const double rest_pa = (source_pa(to) - to) - (y[1] - from);
  const double rest_s = pump_seconds(in.volume_rising_m3 * rest_pa, middle_pa);
  const double seconds = Integral(seconds_per_pa, from, to) + rest_s;
  y[0] += seconds;
  y[1] = source_pa(to);
  y[2] += seconds;
  y[3] += Integral([&](double p) { return seconds_per_pa(p) * power(p); }, from, to) +
          rest_s * power(middle_pa);
  y[4] += (in.volume_rising_m3 * (to - from + rest_pa) +
           in.count * (Content(*in.chamber, to) - Content(*in.chamber, from))) /
          content_per_volume;
  return std::isfinite(seconds);
}

// The rest out of a full reservoir whose pumps cover the draw; they then do to the end, since the
// draw only falls. With r = 1 − u², p = r·p_s, the integrand is smooth up to equal pressures. Of an
// evacuated chamber r = p_s/p of the pressures as they are.
bool FillFromFull(const ReservoirStrokeInput& in, State& y, double from, double to) {
  if (to > in.stop_pa) return false;
  constexpr double kLast = 1e-4;  // u from which on the integrand is that of equal pressures
  const double content_per_volume =
      kReferencePressurePa * in.temperature_k / kReferenceTemperatureK;
  const double mirror_pa = MirrorPa(*in.chamber);
  const auto seconds_per_u = [&](double u) {
    const double ratio = 1.0 - u * u;
    const double p =
        mirror_pa > 0.0 ? mirror_pa - (mirror_pa - in.stop_pa) / ratio : ratio * in.stop_pa;
    const double slope = ContentSlope(*in.chamber, p) / (mirror_pa > 0.0 ? ratio : 1.0);
    return 2.0 * u * slope / (content_per_volume * (*in.fill)(ratio));
  };
  const auto u_of = [&](double p) {
    return std::sqrt((in.stop_pa - p) / (mirror_pa > 0.0 ? mirror_pa - p : in.stop_pa));
  };
  const double begin = u_of(from), end = u_of(to);
  if (begin > kLast) {
    const std::vector<double> borders = Panels(in, std::max(end, kLast), begin);
    for (std::size_t i = 1; i < borders.size(); ++i)
      y[0] += boost::math::quadrature::gauss<double, 7>::integrate(seconds_per_u, borders[i - 1],
                                                                   borders[i]);
  }
  if (end < kLast) y[0] += (std::min(begin, kLast) - end) * seconds_per_u(kLast);
  const double air_m3 =
      in.count * (Content(*in.chamber, to) - Content(*in.chamber, from)) / content_per_volume;
  const double on_s = air_m3 / (in.compressors * Delivery(*in.compressor, in.stop_pa));
  y[2] += on_s;
  y[3] += on_s * in.compressors * ElectricalPower(*in.compressor, in.stop_pa);
  y[4] += air_m3;
  return true;
}

// Together until the reservoir is full, and from it alone over what lead it has then.
bool FillTogetherUntilFull(const ReservoirStrokeInput& in, State& y, double from, double to) {
  const auto short_of_full = [&](double p) { return in.stop_pa - p - Lead(in, p); };
  if (to > in.stop_pa || short_of_full(to) >= 0.0) return FillTogether(in, y, from, to);
  double low = from, high = to;
  while (high - low > 1e-12 * to) {
    const double middle = 0.5 * (low + high);
    (short_of_full(middle) > 0.0 ? low : high) = middle;
  }
  if (!FillTogether(in, y, from, low)) return false;
  y[1] = in.stop_pa;
  return FillFromFull(in, y, low, to);
}

// Fills to `end` in one piece by `fill`, or up to the pressure that is reached when time is up: by
// where the line between both ends crosses, and a little beyond; by halves where that fails. False
// if neither happens.
template <class Fill>
bool FillUntil(const Fill& fill, State& y, double& p, double end, double until_s) {
  constexpr double kPressureTolerance = 1e-11;
  const State before = y;
  const bool reached_end = fill(y, p, end);
  if (reached_end && y[0] <= until_s) {
    p = end;
    return true;
  }
  if (std::isinf(until_s)) return false;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double low = p, high = end, short_s = until_s - before[0];
  double late_s = reached_end ? y[0] - until_s : kNever;
  const auto width = [&] { return high - low; };
  const auto narrow = [&](double to) {
    y = before;
    const bool reached = fill(y, p, to);
    if (reached && y[0] <= until_s) {
      low = to;
      short_s = until_s - y[0];
    } else {
      high = to;
      late_s = reached ? y[0] - until_s : kNever;
    }
  };
  while (width() > kPressureTolerance * end) {
    const double before_width = width(), step = 0.4 * kPressureTolerance * end;
    const double crossing = low + before_width * short_s / (short_s + late_s);
    if (std::isfinite(late_s) && width() > 2.0 * step) {
      narrow(std::clamp(crossing, low + step, high - step));
      const double other = crossing + (low >= crossing ? step : -step);
      if (other > low && other < high) narrow(other);
    }
    if (width() > 0.5 * before_width) narrow(low + 0.5 * width());
  }
  y = before;
  if (low > p && !fill(y, p, low)) return false;
  p = low;
  y[0] = until_s;
  return true;
}

// Advances y from chamber pressure p to `end`, or until `until_s`; false if neither comes.
bool Advance(const ReservoirStrokeInput& in, State& y, double& p, double end,
             double until_s = std::numeric_limits<double>::infinity()) {
  using boost::numeric::odeint::runge_kutta_dopri5;
  const Stroke stroke(in);
  auto stepper = boost::numeric::odeint::make_controlled<runge_kutta_dopri5<State>>(1e-9, 1e-8);
  const double span = end - p;
  double step = span / 8.0;
  const auto from_full = [&](State& at, double from, double to) {
    return FillFromFull(in, at, from, to);
  };
  const auto together = [&](State& at, double from, double to) {
    return FillTogetherUntilFull(in, at, from, to);
  };
  while (end - p > 1e-12 * end && y[0] < until_s) {
    if (y[1] >= in.stop_pa && stroke.Covered(p)) return FillUntil(from_full, y, p, end, until_s);
    if (Together(in, y[1], p) || step < 1e-9 * span) return FillUntil(together, y, p, end, until_s);
    step = std::min(step, end - p);
    const State before = y;
    const double before_p = p;
    if (stepper.try_step(std::cref(stroke), y, p, step) != boost::numeric::odeint::success ||
        (y[1] <= in.stop_pa && y[0] <= until_s))
      continue;
    // The reservoir became full within the step, or time is up: cut it there.
    const auto over = [&](double width) {
      runge_kutta_dopri5<State>().do_step(std::cref(stroke), before, before_p, y, width);
      return y[1] > in.stop_pa || y[0] > until_s;
    };
    double low = 0.0, high = p - before_p;
    while (high - low > 1e-12 * span) {
      const double middle = 0.5 * (low + high);
      (over(middle) ? high : low) = middle;
    }
    over(high);
    p = before_p + high;
    if (y[1] > in.stop_pa) y[1] = in.stop_pa;
    stepper.reset();
  }
  return std::isfinite(y[0]);
}

}  // namespace

ReservoirStroke FillFromReservoir(const ReservoirStrokeInput& input) {
  ReservoirStroke result;
  if (!(input.volume_falling_m3 > 0.0 && input.volume_rising_m3 > 0.0)) return result;
  State y{0.0, input.start_pa > 0.0 ? input.start_pa : input.stop_pa, 0.0, 0.0, 0.0};
  double p = input.from_pa;
  if (!Advance(input, y, p, input.target_pa)) return result;
  result.rise_s = y[0];
  if (!Advance(input, y, p, input.operating_pa)) return result;
  result.inflate_s = y[0];
  if (y[0] < input.open_s && !Advance(input, y, p, input.stop_pa, input.open_s)) return result;
  result.chamber_end_pa = p;
  result.reservoir_end_pa = y[1];
  result.pump_on_s = y[2];
  result.pump_energy_j = y[3];
  result.pump_air_m3 = y[4];
  result.reached = true;
  return result;
}

double PumpUpTime(const CompressorCurve& curve, int compressors, double volume_m3, double low_pa,
                  double high_pa, double temperature_k) {
  if (!(high_pa > low_pa)) return 0.0;
  if (high_pa > HighestPressure(curve) || !(Delivery(curve, high_pa) > 0.0))
    return std::numeric_limits<double>::infinity();
  const auto slowness = [&](double p) { return 1.0 / Delivery(curve, p); };
  // Panel by panel between the table's points, where the delivery is smooth.
  double sum = 0.0;
  double from = low_pa;
  const auto panel = [&](double to) {
    if (to > from) {
      sum += Integral(slowness, from, to);
      from = to;
    }
  };
  for (double knot : curve.free_air_m3_per_s.x())
    if (knot > low_pa && knot < high_pa) panel(knot);
  panel(high_pa);
  const double content_per_volume = kReferencePressurePa * temperature_k / kReferenceTemperatureK;
  return volume_m3 / (content_per_volume * compressors) * sum;
}

double PressureAfterPumping(const CompressorCurve& curve, int compressors, double volume_m3,
                            double low_pa, double stop_pa, double seconds, double temperature_k) {
  constexpr double kClose = 1e-11;  // of a pressure
  const auto time_to = [&](double pa) {
    return PumpUpTime(curve, compressors, volume_m3, low_pa, pa, temperature_k);
  };
  if (!(stop_pa > low_pa) || time_to(stop_pa) <= seconds) return std::max(low_pa, stop_pa);
  // Newton's method between what is known to be too little and too much.
  const double content_per_volume = kReferencePressurePa * temperature_k / kReferenceTemperatureK;
  double below_pa = low_pa, above_pa = stop_pa, pa = low_pa;
  for (double time_s = 0.0; above_pa - below_pa > kClose * above_pa; time_s = time_to(pa)) {
    (time_s <= seconds ? below_pa : above_pa) = pa;
    const double rise_pa =
        (seconds - time_s) * content_per_volume * compressors * Delivery(curve, pa) / volume_m3;
    if (std::abs(rise_pa) <= kClose * pa) return pa;
    pa += rise_pa;
    if (!(pa > below_pa && pa < above_pa)) pa = 0.5 * (below_pa + above_pa);
  }
  return below_pa;
}

}  // namespace plenum::model
