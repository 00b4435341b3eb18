#include "model/strokes/pump_stroke.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <vector>

#include "model/physics/air.h"

namespace plenum::model {
namespace {

constexpr double kTolerance = 1e-8;
constexpr unsigned kHalvingsMax = 10;
constexpr int kRootBits = 44;  // of the pressure between pumps and valves
constexpr boost::uintmax_t kEvaluationsMax = 100;

// Up to and including the highest pressure, which a pump still reaches.
double Delivery(const PumpStrokeInput& in, double pressure_pa) {
  const MonotoneCurve& flow = in.compressor->free_air_m3_per_s;
  if (flow.empty() || pressure_pa > HighestPressure(*in.compressor)) return 0.0;
  return in.compressors * flow(std::max(flow.front(), pressure_pa));
}

// Where a function that changes its sign between two values does.
template <class Function>
double RootIn(const Function& f, double low, double high) {
  boost::uintmax_t evaluations_max = kEvaluationsMax;
  const auto bracket = boost::math::tools::toms748_solve(
      f, low, high, boost::math::tools::eps_tolerance<double>(kRootBits), evaluations_max);
  return 0.5 * (bracket.first + bracket.second);
}

// The chamber's pressure while one between pumps and valves is `node_pa` and so much flows.
double ChamberBehind(const PumpStrokeInput& in, double node_pa, double flow) {
  const double choked = in.fill->choked_flow_m3_per_s_pa;
  const double mirror_pa = MirrorPa(*in.chamber);
  if (!(mirror_pa > 0.0))
    return flow < choked * node_pa ? node_pa * RatioAtFlow(*in.fill, flow / node_pa) : 0.0;
  // The flow rises with the pressure in the chamber, p·F(s/p).
  const double sink_pa = mirror_pa - node_pa, choked_pa = sink_pa / in.fill->choked_ratio;
  if (flow >= choked * choked_pa) return mirror_pa - flow / choked;
  const auto surplus = [&](double p) { return p * FlowAtRatio(*in.fill, sink_pa / p) - flow; };
  return mirror_pa - RootIn(surplus, sink_pa, choked_pa);
}

// And where the line is no longer choked.
double ChokedUntil(const PumpStrokeInput& in) {
  const double mirror_pa = MirrorPa(*in.chamber);
  if (!(mirror_pa > 0.0))
    return in.fill->choked_ratio * NodeBehindPumps(in, in.from_pa).pressure_pa;
  const auto beyond = [&](double p) {
    return (mirror_pa - NodeBehindPumps(in, p).pressure_pa) / (mirror_pa - p) -
           in.fill->choked_ratio;
  };
  return beyond(in.from_pa) < 0.0 && beyond(in.operating_pa) > 0.0
             ? RootIn(beyond, in.from_pa, in.operating_pa)
             : in.from_pa;
}

// The chamber's pressures on the way at which the flow changes its law: where the line is no longer
// choked, and where the pressure in front of it passes a point of the pump's tables.
std::vector<double> Borders(const PumpStrokeInput& in) {
  std::vector<double> borders{in.from_pa, in.target_pa, in.operating_pa};
  const auto add = [&](double p) {
    if (p > in.from_pa && p < in.operating_pa) borders.push_back(p);
  };
  add(ChokedUntil(in));
  const auto add_node = [&](double node_pa) {
    const double flow = Delivery(in, node_pa) / in.count;
    if (flow > 0.0) add(ChamberBehind(in, node_pa, flow));
  };
  add_node(HighestPressure(*in.compressor));
  for (const MonotoneCurve* table : {&in.compressor->free_air_m3_per_s, &in.compressor->current_a})
    for (const double knot_pa : table->x()) add_node(knot_pa);
  for (const double p : in.chamber->volume_curve.x()) add(p);
  std::sort(borders.begin(), borders.end());
  return borders;
}

// Panel by panel, up to `to`.
template <class Function>
double Integral(const Function& f, const std::vector<double>& borders, double from, double to) {
  double sum = 0.0;
  for (std::size_t i = 1; i < borders.size(); ++i)
    if (borders[i - 1] >= from && borders[i] <= to && borders[i] > borders[i - 1])
      sum += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
          f, borders[i - 1], borders[i], kHalvingsMax, kTolerance);
  return sum;
}

}  // namespace

PumpNode NodeBehindPumps(const PumpStrokeInput& in, double chamber_pa) {
  const double highest_pa = HighestPressure(*in.compressor);
  if (!(chamber_pa < highest_pa)) return {chamber_pa, 0.0};
  const auto taken = [&](double node_pa) {
    return in.count * FlowBetween(*in.fill, MirrorPa(*in.chamber), node_pa, chamber_pa);
  };
  const auto surplus = [&](double node_pa) { return Delivery(in, node_pa) - taken(node_pa); };
  const double at_chamber = surplus(chamber_pa), at_highest = surplus(highest_pa);
  if (at_highest >= 0.0) return {highest_pa, taken(highest_pa) / in.count};
  if (!(at_chamber > 0.0)) return {chamber_pa, 0.0};  // nothing is delivered any more
  boost::uintmax_t evaluations_max = kEvaluationsMax;
  const auto bracket = boost::math::tools::toms748_solve(
      surplus, chamber_pa, highest_pa, at_chamber, at_highest,
      boost::math::tools::eps_tolerance<double>(kRootBits), evaluations_max);
  const double node_pa = 0.5 * (bracket.first + bracket.second);
  return {node_pa, Delivery(in, node_pa) / in.count};
}

PumpStroke FillFromPumps(const PumpStrokeInput& in) {
  PumpStroke stroke;
  if (in.compressor->free_air_m3_per_s.empty()) return stroke;
  const PumpNode end = NodeBehindPumps(in, in.operating_pa);
  if (!(end.flow_m3_per_s > 0.0)) return stroke;
  const double content_per_volume =
      kReferencePressurePa * in.temperature_k / kReferenceTemperatureK;
  const auto seconds_per_pa = [&](double chamber_pa, const PumpNode& node) {
    return ContentSlope(*in.chamber, chamber_pa) / (content_per_volume * node.flow_m3_per_s);
  };
  const auto seconds = [&](double p) { return seconds_per_pa(p, NodeBehindPumps(in, p)); };
  const auto joules = [&](double p) {
    const PumpNode node = NodeBehindPumps(in, p);
    return seconds_per_pa(p, node) * ElectricalPower(*in.compressor, node.pressure_pa);
  };
  const std::vector<double> borders = Borders(in);
  stroke.rise_s = Integral(seconds, borders, in.from_pa, in.target_pa);
  stroke.inflate_s = stroke.rise_s + Integral(seconds, borders, in.target_pa, in.operating_pa);
  stroke.pump_energy_j = in.compressors * Integral(joules, borders, in.from_pa, in.operating_pa);
  stroke.node_end_pa = end.pressure_pa;
  stroke.reached = std::isfinite(stroke.inflate_s) && std::isfinite(stroke.pump_energy_j);
  return stroke;
}

}  // namespace plenum::model
