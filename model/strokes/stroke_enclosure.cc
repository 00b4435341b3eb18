#include "model/strokes/stroke_enclosure.h"

#include <algorithm>
#include <cmath>

#include "model/physics/air.h"

namespace plenum::model {
namespace {

constexpr double kRounding = 1e-7;  // and the quadrature's error
constexpr double kPasses = 1e-8;  // least 1 − z² of a node: closer to choking, slopes lose digits
using Nodes = std::array<double, kEnclosureNodes>;

bool Enclosed(const FlowElement& element) {
  return element.subsonic_index == 0.5 && element.critical_ratio >= 0.0 &&
         element.cracking_pressure_pa == 0.0;
}

// Ratio and slope at every node, and a bound from above on the choked flow: at nodes where the line
// passes their flow, elsewhere (`passed` < 0) it is none.
void March(std::span<const FlowElement> elements, double flow_factor, const Nodes& flow,
           Nodes& ratio, Nodes& slope, Nodes& choked, Nodes& passed) {
  ratio.fill(1.0);
  slope.fill(0.0);
  passed.fill(1.0);
  choked.fill(std::numeric_limits<double>::infinity());
  for (const FlowElement& element : elements) {
    const double c = element.sonic_conductance_m3_per_s_pa * flow_factor;
    const double inverse_c = 1.0 / c;
    const double b = element.critical_ratio;
    const double width = 1.0 - b;
    for (std::size_t j = 0; j < kEnclosureNodes; ++j) {
      const double z = flow[j] * inverse_c / ratio[j];
      const double square = 1.0 - z * z;
      passed[j] = std::min(passed[j], square);
      const double s = std::sqrt(std::max(1e-16, square));
      choked[j] = std::min(choked[j], flow[j] + (c * ratio[j] - flow[j]) / (1.0 - c * slope[j]));
      slope[j] = slope[j] * (b + width * s) - width * z / s * (inverse_c - z * slope[j]);
      ratio[j] *= b + width * s;
    }
  }
}

// The integral of w/q over ratios. `Moments(a, b)` gives ∫w and ∫w·r.
struct Integrals {
  double w, wr;
};

class Curve {
 public:
  explicit Curve(const CurveNodes& nodes) : nodes_(nodes) {}

  template <typename Moments>
  Enclosure Integrate(double from, double to, const Moments& moments) const {
    Enclosure sum{0.0, 0.0};
    double a = from;
    double inverse_a = 1.0 / LeastFlow(0, from);
    for (std::size_t j = 0; j <= nodes_.size && a < to; ++j) {
      // Up to node j, and behind the last one.
      const double b = j < nodes_.size ? std::min(nodes_.ratio[j], to) : to;
      if (!(b > a)) continue;
      const double inverse_b = 1.0 / LeastFlow(j, b);
      const Integrals mean = moments(a, b);
      const double centroid = std::clamp(mean.wr / mean.w, a, b);
      const double share = (centroid - a) / (b - a);
      sum.low_s += mean.w / MostFlow(j, centroid);
      sum.high_s += mean.w * (j == 0 ? inverse_b : (1.0 - share) * inverse_a + share * inverse_b);
      a = b;
      inverse_a = inverse_b;
    }
    return sum;
  }

 private:
  double Tangent(std::size_t j, double ratio) const {
    return nodes_.flow[j] + (ratio - nodes_.ratio[j]) / nodes_.slope[j];
  }
  // In the interval that ends at node j.
  double MostFlow(std::size_t j, double ratio) const {
    double most = nodes_.flow_max;
    if (j > 0) most = std::min(most, Tangent(j - 1, ratio));
    if (j < nodes_.size) most = std::min(most, Tangent(j, ratio));
    return most;
  }
  double LeastFlow(std::size_t j, double ratio) const {
    while (j < nodes_.size && nodes_.ratio[j] < ratio) ++j;
    if (j == 0) return nodes_.flow[0];
    const bool last = j == nodes_.size;
    const double r0 = nodes_.ratio[j - 1], r1 = last ? 1.0 : nodes_.ratio[j];
    const double q0 = nodes_.flow[j - 1], q1 = last ? 0.0 : nodes_.flow[j];
    return q0 + (q1 - q0) * ((ratio - r0) / (r1 - r0));
  }

  const CurveNodes& nodes_;
};

Enclosure Times(Enclosure integral, double temperature_k) {
  const double content = kReferencePressurePa * temperature_k / kReferenceTemperatureK;
  return {integral.low_s / content * (1.0 - kRounding),
          integral.high_s >= 0.0 ? integral.high_s / content * (1.0 + kRounding)
                                 : std::numeric_limits<double>::infinity()};
}

// 1/√(Σ C_i⁻²), the choked flow without critical ratios; 0 where elements are not enclosed.
double LeastConductance(std::span<const FlowElement> elements, double flow_factor) {
  if (!std::all_of(elements.begin(), elements.end(), Enclosed)) return 0.0;
  double squares = 0.0;
  for (const FlowElement& element : elements) {
    const double c = element.sonic_conductance_m3_per_s_pa;
    squares += 1.0 / (c * c);
  }
  return flow_factor / std::sqrt(squares);
}

double Longest(double integral, double conductance, double temperature_k) {
  if (!(conductance > 0.0)) return std::numeric_limits<double>::infinity();
  return Times({0.0, integral / conductance}, temperature_k).high_s;
}

// As in stroke.cc: out of a source above the chamber's pressure, and into a sink below it.
Enclosure EncloseFillOutOf(const CurveNodes& nodes, const Chamber& chamber, double source_pa,
                           double from_pa, double to_pa, double temperature_k) {
  if (from_pa >= to_pa) return {0.0, 0.0};
  if (nodes.size == 0 || !chamber.volume_curve.empty() || !(to_pa < source_pa)) return {};
  // ∫ W(p) dp/(p_s·q), p = p_s·r
  const LinearContent law = LinearContentSlope(chamber);
  const double slope = law.b * source_pa;
  return Times(
      Curve(nodes).Integrate(from_pa / source_pa, to_pa / source_pa,
                             [&](double a, double b) {
                               const double mean = 0.5 * (a + b), width = b - a;
                               const double w = (law.a + slope * mean) * width;
                               return Integrals{w, w * mean + slope * width * width * width / 12.0};
                             }),
      temperature_k);
}

Enclosure EncloseEmptyInto(const CurveNodes& nodes, const Chamber& chamber, double sink_pa,
                           double from_pa, double to_pa, double temperature_k) {
  if (from_pa <= to_pa) return {0.0, 0.0};
  if (nodes.size == 0 || !chamber.volume_curve.empty() || !(to_pa > sink_pa)) return {};
  // ∫ W(p) dp/(p·q), p = p_s/r
  const LinearContent law = LinearContentSlope(chamber);
  const double slope = law.b * sink_pa;
  return Times(Curve(nodes).Integrate(sink_pa / from_pa, sink_pa / to_pa,
                                      [&](double a, double b) {
                                        const double log = std::log(b / a);
                                        return Integrals{law.a * log + slope * (1.0 / a - 1.0 / b),
                                                         law.a * (b - a) + slope * log};
                                      }),
               temperature_k);
}

double FillOutOfAtMost(std::span<const FlowElement> elements, double flow_factor,
                       const Chamber& chamber, double source_pa, double from_pa, double to_pa,
                       double temperature_k, double flow_max_m3_per_s) {
  const double conductance = LeastConductance(elements, flow_factor);
  if (!chamber.volume_curve.empty() || !(from_pa < to_pa && to_pa < source_pa) ||
      flow_max_m3_per_s < conductance * source_pa)
    return std::numeric_limits<double>::infinity();
  // ∫ W(p) dp/√(p_s² − p²)
  const LinearContent law = LinearContentSlope(chamber);
  const auto root = [&](double p) { return std::sqrt((source_pa - p) * (source_pa + p)); };
  const double angle = std::asin(to_pa / source_pa) - std::asin(from_pa / source_pa);
  return Longest(law.a * angle + law.b * (root(from_pa) - root(to_pa)), conductance, temperature_k);
}

double EmptyIntoAtMost(std::span<const FlowElement> elements, double flow_factor,
                       const Chamber& chamber, double sink_pa, double from_pa, double to_pa,
                       double temperature_k) {
  if (!chamber.volume_curve.empty() || !(sink_pa < to_pa && to_pa < from_pa))
    return std::numeric_limits<double>::infinity();
  // ∫ W(p) dp/√(p² − p_s²)
  const LinearContent law = LinearContentSlope(chamber);
  const auto root = [&](double p) { return std::sqrt((p - sink_pa) * (p + sink_pa)); };
  const double log = std::log((from_pa + root(from_pa)) / (to_pa + root(to_pa)));
  return Longest(law.a * log + law.b * (root(from_pa) - root(to_pa)),
                 LeastConductance(elements, flow_factor), temperature_k);
}

}  // namespace

CurveNodes MarchNodes(std::span<const FlowElement> elements, double flow_factor, double ratio_to,
                      double flow_max) {
  CurveNodes nodes;
  if (!std::all_of(elements.begin(), elements.end(), Enclosed) || !(flow_max > 0.0)) return nodes;
  // The cube law is some percent off the choked flow. Where one of the first flows passes, its
  // bound is close to the choked flow, and the flows of the second march begin there.
  double cubes = 0.0;
  for (const FlowElement& element : elements) {
    const double c = element.sonic_conductance_m3_per_s_pa * flow_factor;
    cubes += 1.0 / (c * c * c);
  }
  const double guess = std::min(1.0 / std::cbrt(cubes), flow_max);
  constexpr Nodes kFirst{1.1, 1.05, 1.02, 1.0, 0.97, 0.94, 0.9, 0.8};
  Nodes flow, ratio, slope, choked, passed;
  for (std::size_t j = 0; j < kEnclosureNodes; ++j) flow[j] = guess * kFirst[j];
  March(elements, flow_factor, flow, ratio, slope, choked, passed);
  double most = flow_max, ratio_choked = 0.0;
  for (std::size_t j = 0; j < kEnclosureNodes; ++j)
    if (passed[j] > kPasses) {
      most = std::min(most, choked[j]);
      ratio_choked = std::max(ratio_choked, j == 0 || passed[j - 1] <= kPasses ? ratio[j] : 0.0);
    }
  if (ratio_choked == 0.0) return nodes;  // the guess is too far off
  // Even in θ, q = q*·cosθ: close together at both ends, where the curve bends.
  const double sine_to = (ratio_to - ratio_choked) / (1.0 - ratio_choked);
  const double to = std::asin(std::clamp(sine_to + 0.05 * (1.0 - sine_to), 0.2, 0.9999));
  constexpr double kFrom = 0.03;
  for (std::size_t j = 0; j < kEnclosureNodes; ++j)
    flow[j] =
        most * std::cos(kFrom + (to - kFrom) * static_cast<double>(j) / (kEnclosureNodes - 1));
  March(elements, flow_factor, flow, ratio, slope, choked, passed);
  for (std::size_t j = 0; j < kEnclosureNodes; ++j) {
    if (!(passed[j] > kPasses)) continue;
    most = std::min(most, choked[j]);
    nodes.flow[nodes.size] = flow[j];
    nodes.ratio[nodes.size] = ratio[j];
    nodes.slope[nodes.size] = slope[j];
    ++nodes.size;
  }
  nodes.flow_max = most;
  return nodes;
}

Enclosure EncloseFillTime(const CurveNodes& nodes, const Chamber& chamber, double source_pa,
                          double from_pa, double to_pa, double temperature_k) {
  if (!chamber.evacuated)
    return EncloseFillOutOf(nodes, chamber, source_pa, from_pa, to_pa, temperature_k);
  const double mirror_pa = MirrorPa(chamber);
  return EncloseEmptyInto(nodes, Unmirrored(chamber), mirror_pa - source_pa, mirror_pa - from_pa,
                          mirror_pa - to_pa, temperature_k);
}

Enclosure EncloseEmptyTime(const CurveNodes& nodes, const Chamber& chamber, double from_pa,
                           double to_pa, double temperature_k) {
  if (!chamber.evacuated)
    return EncloseEmptyInto(nodes, chamber, ExhaustPa(chamber), from_pa, to_pa, temperature_k);
  const double ambient_pa = chamber.ambient_pressure_pa;
  const double mirror_pa = MirrorPa(chamber);
  return EncloseFillOutOf(nodes, Unmirrored(chamber), ambient_pa, mirror_pa - from_pa,
                          mirror_pa - to_pa, temperature_k);
}

double FillTimeAtMost(std::span<const FlowElement> elements, double flow_factor,
                      const Chamber& chamber, double source_pa, double from_pa, double to_pa,
                      double temperature_k, double flow_max_m3_per_s) {
  if (!chamber.evacuated)
    return FillOutOfAtMost(elements, flow_factor, chamber, source_pa, from_pa, to_pa, temperature_k,
                           flow_max_m3_per_s);
  const double mirror_pa = MirrorPa(chamber);
  return EmptyIntoAtMost(elements, flow_factor, Unmirrored(chamber), mirror_pa - source_pa,
                         mirror_pa - from_pa, mirror_pa - to_pa, temperature_k);
}

double EmptyTimeAtMost(std::span<const FlowElement> elements, double flow_factor,
                       const Chamber& chamber, double from_pa, double to_pa, double temperature_k) {
  if (!chamber.evacuated)
    return EmptyIntoAtMost(elements, flow_factor, chamber, ExhaustPa(chamber), from_pa, to_pa,
                           temperature_k);
  const double ambient_pa = chamber.ambient_pressure_pa;
  const double mirror_pa = MirrorPa(chamber);
  return FillOutOfAtMost(elements, flow_factor, Unmirrored(chamber), ambient_pa,
                         mirror_pa - from_pa, mirror_pa - to_pa, temperature_k,
                         std::numeric_limits<double>::infinity());
}

}  // namespace plenum::model
