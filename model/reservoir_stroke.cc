#include "model/reservoir_stroke.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>

#include "model/air.h"

namespace plenum::model {
namespace {

// From this ratio on the line no longer holds chamber and source apart.
constexpr double kEqualRatio = 1.0 - 1e-7;

using State = std::array<double, 4>;  // time, reservoir pressure, pump time, pump energy

class Stroke {
 public:
  explicit Stroke(const ReservoirStrokeInput& input)
      : in_(input),
        content_per_volume_(kReferencePressurePa * input.temperature_k / kReferenceTemperatureK) {}

  void operator()(const State& y, State& dy, double p) const {
    const double source_pa = y[1];
    const double flow = source_pa * (*in_.fill)(std::min(p / source_pa, kEqualRatio));
    const double draw = in_.count * flow;
    const double delivery = in_.compressors * FreeAirDelivery(*in_.compressor, source_pa);
    // At the stop pressure the pumps only make up for what is drawn.
    const double pumped = source_pa >= in_.stop_pa ? std::min(delivery, draw) : delivery;
    const double on_share = delivery > 0.0 ? pumped / delivery : 0.0;
    const double net = pumped - draw;
    const double volume = net < 0.0 ? in_.volume_falling_m3 : in_.volume_rising_m3;
    const double seconds = ContentSlope(*in_.chamber, p) / (content_per_volume_ * flow);
    dy[0] = seconds;
    dy[1] = content_per_volume_ / volume * net * seconds;
    dy[2] = on_share * seconds;
    dy[3] = on_share * seconds * in_.compressors * ElectricalPower(*in_.compressor, source_pa);
  }

 private:
  const ReservoirStrokeInput& in_;
  double content_per_volume_;
};

// Reservoir and chambers as one volume that the pumps fill, once the line no longer holds them
// apart. False where the pumps deliver nothing on the way.
bool FillTogether(const ReservoirStrokeInput& in, State& y, double from, double to) {
  const double content_per_volume =
      kReferencePressurePa * in.temperature_k / kReferenceTemperatureK;
  const auto seconds_per_pa = [&](double p) {
    return (in.volume_rising_m3 + in.count * ContentSlope(*in.chamber, p)) /
           (content_per_volume * in.compressors * FreeAirDelivery(*in.compressor, p));
  };
  if (to > in.stop_pa || !(FreeAirDelivery(*in.compressor, to) > 0.0)) return false;
  using Gauss = boost::math::quadrature::gauss<double, 10>;
  const double seconds = Gauss::integrate(seconds_per_pa, from, to);
  y[0] += seconds;
  y[1] = to;
  y[2] += seconds;
  y[3] += Gauss::integrate(
      [&](double p) {
        return seconds_per_pa(p) * in.compressors * ElectricalPower(*in.compressor, p);
      },
      from, to);
  return std::isfinite(seconds);
}

// Advances y from chamber pressure p to `end`; false if that is never reached.
bool Advance(const ReservoirStrokeInput& in, State& y, double p, double end) {
  using boost::numeric::odeint::runge_kutta_dopri5;
  const Stroke stroke(in);
  auto stepper = boost::numeric::odeint::make_controlled<runge_kutta_dopri5<State>>(1e-9, 1e-8);
  const double span = end - p;
  double step = span / 8.0;
  while (end - p > 1e-12 * end) {
    if (!(p < y[1] * kEqualRatio) || step < 1e-9 * span) return FillTogether(in, y, p, end);
    step = std::min(step, end - p);
    stepper.try_step(std::cref(stroke), y, p, step);
  }
  return std::isfinite(y[0]);
}

}  // namespace

ReservoirStroke FillFromReservoir(const ReservoirStrokeInput& input) {
  ReservoirStroke result;
  State y{0.0, input.stop_pa, 0.0, 0.0};
  if (!Advance(input, y, input.from_pa, input.target_pa)) return result;
  result.rise_s = y[0];
  if (!Advance(input, y, input.target_pa, input.operating_pa)) return result;
  result.inflate_s = y[0];
  result.reservoir_end_pa = y[1];
  result.pump_on_s = y[2];
  result.pump_energy_j = y[3];
  result.reached = true;
  return result;
}

double PumpUpTime(const CompressorCurve& curve, int compressors, double volume_m3, double low_pa,
                  double high_pa, double temperature_k) {
  if (!(high_pa > low_pa)) return 0.0;
  if (!(FreeAirDelivery(curve, high_pa) > 0.0)) return std::numeric_limits<double>::infinity();
  const auto slowness = [&](double p) { return 1.0 / FreeAirDelivery(curve, p); };
  // Panel by panel between the table's points, where the delivery is smooth.
  double sum = 0.0;
  double from = low_pa;
  const auto panel = [&](double to) {
    if (to > from) {
      sum += boost::math::quadrature::gauss<double, 10>::integrate(slowness, from, to);
      from = to;
    }
  };
  for (double knot : curve.free_air_m3_per_s.x())
    if (knot > low_pa && knot < high_pa) panel(knot);
  panel(high_pa);
  const double content_per_volume = kReferencePressurePa * temperature_k / kReferenceTemperatureK;
  return volume_m3 / (content_per_volume * compressors) * sum;
}

}  // namespace plenum::model
