#include "model/physics/compressor.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "model/physics/air.h"

namespace plenum::model {
namespace {

// Curves are tables: outside them the end values hold.
double Clamped(const MonotoneCurve& curve, double x) {
  return curve(std::clamp(x, curve.front(), curve.back()));
}

// The pressures in (low, high) where a curve changes its piece, with both ends.
std::vector<double> Pieces(const CompressorCurve& curve, double low_pa, double high_pa) {
  std::vector<double> pieces{low_pa, high_pa};
  for (const MonotoneCurve* table : {&curve.free_air_m3_per_s, &curve.current_a})
    for (double x : table->x())
      if (x > low_pa && x < high_pa) pieces.push_back(x);
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

}  // namespace

double HighestPressure(const CompressorCurve& curve) {
  return curve.free_air_m3_per_s.empty()
             ? 0.0
             : std::min(curve.free_air_m3_per_s.back(), curve.pressure_max_pa);
}

double FreeAirDelivery(const CompressorCurve& curve, double pressure_pa) {
  const MonotoneCurve& flow = curve.free_air_m3_per_s;
  if (flow.empty() || pressure_pa > flow.back() || pressure_pa >= curve.pressure_max_pa) return 0.0;
  return Clamped(flow, pressure_pa);
}

double ElectricalPower(const CompressorCurve& curve, double pressure_pa) {
  return curve.current_a.empty() ? 0.0 : curve.voltage_v * Clamped(curve.current_a, pressure_pa);
}

double LargestCurrent(const CompressorCurve& curve, double low_pa, double high_pa) {
  const MonotoneCurve& current = curve.current_a;
  if (current.empty()) return 0.0;
  // The interpolation has its extremes at the table's points.
  double largest = std::max(Clamped(current, low_pa), Clamped(current, high_pa));
  for (std::size_t i = 0; i < current.x().size(); ++i)
    if (current.x()[i] > low_pa && current.x()[i] < high_pa)
      largest = std::max(largest, current.y()[i]);
  return largest;
}

double EnergyToFill(const CompressorCurve& curve, double volume_m3, double low_pa, double high_pa,
                    double temperature_k) {
  if (low_pa >= high_pa) return 0.0;
  const MonotoneCurve& flow = curve.free_air_m3_per_s;
  // The flow never rises, so it vanishes on the way exactly if it has vanished at the end. The
  // pressure limit itself is reached: the pump delivers right up to it.
  if (high_pa > HighestPressure(curve) || Clamped(flow, high_pa) <= 0.0)
    return std::numeric_limits<double>::infinity();

  const auto energy_per_gas = [&](double p) {
    return ElectricalPower(curve, p) / Clamped(flow, p);
  };
  const std::vector<double> pieces = Pieces(curve, low_pa, high_pa);
  double integral = 0.0;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    integral += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
        energy_per_gas, pieces[i - 1], pieces[i], 10, 1e-9);
  return StandardVolume(volume_m3, temperature_k) * integral;
}

}  // namespace plenum::model
