#include "model/strokes/stroke.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/strokes/gauss_legendre.h"

namespace plenum::model {
namespace {

// The subsonic part is integrated over y with t = tan(θ/2) = 1 − y², so that no trigonometric
// function is needed and y = 0 is the choked end:
//   sinθ = 2t/(1+t²),  cosθ = (1−t²)/(1+t²),  dθ = −4y dy/(1+t²).
// In y the curve stays smooth even where two elements choke at the same flow.

double YFromCosine(double cosine) {
  const double t = std::sqrt((1.0 - cosine) / (1.0 + cosine));
  return std::sqrt(2.0 * cosine / ((1.0 + cosine) * (1.0 + t)));
}

// Distance from y = 0 to the nearest singularity of the march: an element that is close to choking
// at q* without being the one that chokes has 1 − z² = 0 a little beyond. Before the choking
// element 1 − z² grows with c² there, behind it with c, c = cosθ ≈ y².
double SingularityDistance(const Series& series) {
  const double flow = series.choked_flow_m3_per_s_pa;
  double distance = kNever;
  double pressure = 1.0;
  double slope = 0.0;   // dp/dq, before the choking element
  double growth = 0.0;  // d ln p/dc, behind it
  for (std::size_t i = 0; i < series.size; ++i) {
    const FlowElement& element = series.elements[i];
    if (!(pressure > 0.0)) break;
    const double inverse = 1.0 / (element.sonic_conductance_m3_per_s_pa * pressure);
    const double z = flow * inverse;
    const double z_slope = inverse * (1.0 - flow * slope / pressure);
    const double rest = 1.0 - z * z;
    const double width = 1.0 - element.critical_ratio;
    if (rest < 1e-14) {
      pressure *= element.critical_ratio;
      growth += std::sqrt(flow * z_slope) * width / element.critical_ratio;
      continue;
    }
    const double s = std::sqrt(rest);
    const double ratio = element.critical_ratio + width * s;
    if (growth > 0.0) {
      distance = std::min(distance, rest / (2.0 * z * z * growth));
      growth *= 1.0 + width * z * z / (s * ratio);
    } else {
      distance = std::min(distance, std::sqrt(rest / (z * flow * z_slope)));
      slope = slope * ratio - pressure * width * z * z_slope / s;
    }
    pressure *= ratio;
  }
  return std::max(1e-5, std::sqrt(distance));
}

using PanelArray = std::array<double, kGaussNodes>;

// Ratio and slope dr/dq at all nodes of a panel, element by element so that the loop vectorises.
void MarchPanel(const Series& series, const PanelArray& flow, PanelArray& ratio,
                PanelArray& slope) {
  ratio.fill(1.0);
  slope.fill(0.0);
  for (std::size_t i = 0; i < series.size; ++i) {
    const FlowElement& element = series.elements[i];
    const double inverse_c = 1.0 / element.sonic_conductance_m3_per_s_pa;
    const double b = element.critical_ratio;
    const double width = 1.0 - b;
    const bool ellipse = element.subsonic_index == 0.5;
    const double exponent = 1.0 / element.subsonic_index;
    for (std::size_t j = 0; j < kGaussNodes; ++j) {
      const double z = flow[j] * inverse_c / ratio[j];
      const double power = ellipse ? z : std::pow(z, exponent - 1.0);
      const double s = std::sqrt(std::max(1e-16, 1.0 - power * z));
      const double half_slope = ellipse ? z : 0.5 * exponent * power;
      // p·dz/dq = 1/C − z·p'
      slope[j] = slope[j] * (b + width * s) - width * half_slope / s * (inverse_c - z * slope[j]);
      ratio[j] *= b + width * s;
    }
  }
}

struct CurvePoint {
  double y;
  double ratio;
};

CurvePoint PointAtRatio(const Series& series, double ratio) {
  return {YFromCosine(CosineAtRatio(series, ratio)), ratio};
}

double FlowAtY(const Series& series, double y) {
  const double t = (1.0 - y) * (1.0 + y);
  return series.choked_flow_m3_per_s_pa * 2.0 * t / (1.0 + t * t);
}

// ∫ g(r) dr/q over one panel, where q falls from start to end. The rule's error in ∫ dr alone is
// known and taken off at the start's g/q: close to the choked end rounding in 1 − z² would show.
template <class Weight>
double PanelIntegral(const Series& series, const CurvePoint& start, const CurvePoint& end,
                     const Weight& weight) {
  const double middle = 0.5 * (start.y + end.y);
  const double half = 0.5 * (end.y - start.y);
  PanelArray flow, ratio, slope, ratio_step;
  for (std::size_t j = 0; j < kGaussNodes; ++j) {
    const double y = middle + half * kGaussNode[j];
    const double t = (1.0 - y) * (1.0 + y);
    const double scale = 1.0 / (1.0 + t * t);
    flow[j] = series.choked_flow_m3_per_s_pa * 2.0 * t * scale;
    ratio_step[j] = kGaussWeight[j] * y * y * y * (2.0 - y * y) * scale * scale;
  }
  MarchPanel(series, flow, ratio, slope);
  double sum = 0.0;
  double ratio_sum = 0.0;
  for (std::size_t j = 0; j < kGaussNodes; ++j) {
    ratio_step[j] *= -4.0 * half * series.choked_flow_m3_per_s_pa * slope[j];
    ratio_sum += ratio_step[j];
    sum += ratio_step[j] * weight(ratio[j]) / flow[j];
  }
  return sum +
         (end.ratio - start.ratio - ratio_sum) * weight(start.ratio) / FlowAtY(series, start.y);
}

// The same over any range; panels grow with their distance from the singularity at ±i·distance.
template <class Weight>
double GradedIntegral(const Series& series, CurvePoint start, const CurvePoint& end,
                      double distance, const Weight& weight) {
  constexpr double kGrowth = 2.0;
  double sum = 0.0;
  while (start.y < end.y) {
    const double width = kGrowth * std::hypot(start.y, distance);
    CurvePoint next = end;
    if (start.y + 1.3 * width < end.y) {
      next.y = start.y + width;
      next.ratio = RatioAtFlow(series, FlowAtY(series, next.y));
    }
    sum += PanelIntegral(series, start, next, weight);
    start = next;
  }
  return sum;
}

// m of the element that rules near zero flow.
double LargestIndex(const Series& series) {
  double m = 0.0;
  for (std::size_t i = 0; i < series.size; ++i) m = std::max(m, series.elements[i].subsonic_index);
  return m;
}

bool AllEllipses(const Series& series) {
  return std::all_of(series.elements.begin(), series.elements.begin() + series.size,
                     [](const FlowElement& element) { return element.subsonic_index == 0.5; });
}

// ∫ g(r) dr/q between two points. For m ≠ ½ the integrand goes with t^(1/m − 2) at zero flow:
// panels shrink towards it and the last bit is integrated as that power.
template <class Weight>
double SubsonicIntegral(const Series& series, CurvePoint start, const CurvePoint& end,
                        double distance, const Weight& weight) {
  if (AllEllipses(series)) return GradedIntegral(series, start, end, distance, weight);
  constexpr double kSmallest = 1e-8;
  const double t_end = (1.0 - end.y) * (1.0 + end.y);
  double sum = 0.0;
  double t = (1.0 - start.y) * (1.0 + start.y);
  while (t > 4.0 * std::max(t_end, kSmallest)) {
    t *= 0.25;
    CurvePoint next{std::sqrt(1.0 - t), 1.0};
    next.ratio = RatioAtFlow(series, FlowAtY(series, next.y));
    sum += GradedIntegral(series, start, next, distance, weight);
    start = next;
  }
  if (t_end > kSmallest) return sum + GradedIntegral(series, start, end, distance, weight);
  const double power = 1.0 / LargestIndex(series) - 1.0;  // of the integral
  if (power <= 0.0 && t_end <= 0.0) return kNever;
  const double flow = FlowAtY(series, start.y);
  const double density = -2.0 * RatioAndSlopeAtFlow(series, flow).slope_pa_s_per_m3 * weight(1.0) /
                         flow * series.choked_flow_m3_per_s_pa;  // per t
  return sum + (power > 0.0 ? density * t / power * (1.0 - std::pow(t_end / t, power))
                            : density * t * std::log(t / t_end));
}

// Calls f(a, b) for the pieces of [p_1, p_2] between the knots of a table, in either direction.
template <class Function>
void ForEachPiece(const Chamber& chamber, double p_1, double p_2, const Function& f) {
  const auto knots = chamber.volume_curve.x();
  double a = p_1;
  const auto visit = [&](double knot) {
    if ((knot - a) * (p_2 - knot) <= 0.0) return;
    f(a, knot);
    a = knot;
  };
  if (p_1 < p_2) {
    std::for_each(knots.begin(), knots.end(), visit);
  } else {
    std::for_each(knots.rbegin(), knots.rend(), visit);
  }
  f(a, p_2);
}

// ∫ g(r) dr/q while the chamber goes from p_1, where the line is at `start`, to p_2.
template <class RatioAt, class Weight>
double SubsonicIntegral(const Series& series, const Chamber& chamber, double p_1, double p_2,
                        CurvePoint start, double distance, const RatioAt& ratio_at,
                        const Weight& weight) {
  double sum = 0.0;
  ForEachPiece(chamber, p_1, p_2, [&](double, double b) {
    const CurvePoint end = PointAtRatio(series, ratio_at(b));
    sum += SubsonicIntegral(series, start, end, distance, weight);
    start = end;
  });
  return sum;
}

// Distance in y from a start at ratio r to a pole of the weight at or below r = 0, as a share of
// √r.
constexpr double kPoleShare = 0.5;

// W(p) = d(pV)/dp, with the linear law reduced to two coefficients.
class ContentSlopeLaw {
 public:
  explicit ContentSlopeLaw(const Chamber& chamber)
      : chamber_(chamber), linear_(chamber.volume_curve.empty()) {
    if (linear_) law_ = LinearContentSlope(chamber);
  }
  double operator()(double p) const {
    return linear_ ? law_.a + law_.b * p : ContentSlope(chamber_, p);
  }
  // ∫ W/p dp from p_1 to p_2 within one piece.
  double LogIntegral(double p_1, double p_2) const {
    if (linear_) return law_.a * std::log(p_2 / p_1) + law_.b * (p_2 - p_1);
    return GaussLegendre(std::log(p_1), std::log(p_2),
                         [this](double y) { return ContentSlope(chamber_, std::exp(y)); });
  }

 private:
  const Chamber& chamber_;
  bool linear_;
  LinearContent law_;
};

// Content (Pa·m³) that 1 m³ ANR makes at this temperature.
double ContentPerStandardVolume(double temperature_k) {
  return kReferencePressurePa * temperature_k / kReferenceTemperatureK;
}

// The chamber pressure at which p/p_s = ratio while V_R·p_s + n·p·V(p) = total, between a and b.
double PressureAtRatio(const Chamber& chamber, double reservoir_m3, int count, double total,
                       double ratio, double a, double b) {
  double p = 0.5 * (a + b);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double excess = reservoir_m3 * p / ratio + count * Content(chamber, p) - total;
    (excess > 0.0 ? b : a) = p;
    double next = p - excess / (reservoir_m3 / ratio + count * ContentSlope(chamber, p));
    if (!(next >= a && next <= b)) next = 0.5 * (a + b);
    const double step = std::abs(next - p);
    p = next;
    if (step <= 1e-9 * p) break;
  }
  return p;
}

// Out of a source above the chamber's pressure.
double FillOutOf(const Series& fill, const Chamber& chamber, double source_pa, double from_pa,
                 double to_pa, double temperature_k, double flow_max_m3_per_s) {
  if (from_pa >= to_pa) return 0.0;
  if (to_pa > source_pa || !(flow_max_m3_per_s > 0.0)) return kNever;
  const double flow = std::min(fill.choked_flow_m3_per_s_pa, flow_max_m3_per_s / source_pa);
  const bool capped = flow < fill.choked_flow_m3_per_s_pa;
  const double constant_ratio = capped ? RatioAtFlow(fill, flow) : fill.choked_ratio;
  const double constant_end = constant_ratio * source_pa;
  double integral = 0.0;  // of content over flow
  CurvePoint point;
  if (from_pa < constant_end) {
    const double end = std::min(to_pa, constant_end);
    integral += (Content(chamber, end) - Content(chamber, from_pa)) / (source_pa * flow);
    const double share = flow / fill.choked_flow_m3_per_s_pa;
    point = {YFromCosine(std::sqrt((1.0 - share) * (1.0 + share))), constant_ratio};
  } else {
    point = PointAtRatio(fill, from_pa / source_pa);
  }
  const double start = std::max(from_pa, constant_end);
  if (start < to_pa) {
    const ContentSlopeLaw w(chamber);
    integral += SubsonicIntegral(
        fill, chamber, start, to_pa, point, SingularityDistance(fill),
        [&](double p) { return p / source_pa; },
        [&](double ratio) { return w(ratio * source_pa); });
  }
  return integral / ContentPerStandardVolume(temperature_k);
}

// Into a sink below the chamber's pressure.
double EmptyInto(const Series& exhaust, const Chamber& chamber, double sink_pa, double from_pa,
                 double to_pa, double temperature_k) {
  if (from_pa <= to_pa) return 0.0;
  if (to_pa < sink_pa) return kNever;
  const ContentSlopeLaw w(chamber);
  double integral = 0.0;
  double start = from_pa;
  CurvePoint point;
  if (exhaust.choked_ratio * from_pa > sink_pa) {
    start = std::max(to_pa, sink_pa / exhaust.choked_ratio);
    point = {0.0, exhaust.choked_ratio};
    ForEachPiece(chamber, from_pa, start, [&](double a, double b) {
      integral += w.LogIntegral(b, a) / exhaust.choked_flow_m3_per_s_pa;
    });
  } else {
    point = PointAtRatio(exhaust, sink_pa / from_pa);
  }
  if (start > to_pa) {
    // dp/p = −dr/r: the weight has a pole at r = 0.
    const double distance =
        std::min(SingularityDistance(exhaust), kPoleShare * std::sqrt(point.ratio));
    integral += SubsonicIntegral(
        exhaust, chamber, start, to_pa, point, distance, [&](double p) { return sink_pa / p; },
        [&](double ratio) { return w(sink_pa / ratio) / ratio; });
  }
  return integral / ContentPerStandardVolume(temperature_k);
}

}  // namespace

double FillTime(const Series& fill, const Chamber& chamber, double source_pa, double from_pa,
                double to_pa, double temperature_k, double flow_max_m3_per_s) {
  if (!chamber.evacuated)
    return FillOutOf(fill, chamber, source_pa, from_pa, to_pa, temperature_k, flow_max_m3_per_s);
  const double mirror_pa = MirrorPa(chamber);
  return EmptyInto(fill, Unmirrored(chamber), mirror_pa - source_pa, mirror_pa - from_pa,
                   mirror_pa - to_pa, temperature_k);
}

double EmptyTime(const Series& exhaust, const Chamber& chamber, double from_pa, double to_pa,
                 double temperature_k) {
  if (!chamber.evacuated)
    return EmptyInto(exhaust, chamber, ExhaustPa(chamber), from_pa, to_pa, temperature_k);
  const double ambient_pa = chamber.ambient_pressure_pa;
  const double mirror_pa = MirrorPa(chamber);
  return FillOutOf(exhaust, Unmirrored(chamber), ambient_pa, mirror_pa - from_pa, mirror_pa - to_pa,
                   temperature_k, kNever);
}

double FillTimeFromReservoir(const Series& fill, const Chamber& chamber, int count,
                             double reservoir_m3, double reservoir_pa, double from_pa, double to_pa,
                             double temperature_k) {
  if (from_pa >= to_pa) return 0.0;
  const double total = reservoir_pa * reservoir_m3 + count * Content(chamber, from_pa);
  const auto source_at = [&](double p) {
    return (total - count * Content(chamber, p)) / reservoir_m3;
  };
  const auto ratio_at = [&](double p) { return p / source_at(p); };
  if (source_at(to_pa) < to_pa) return kNever;

  double integral = 0.0;
  double start = from_pa;
  CurvePoint point;
  if (ratio_at(from_pa) < fill.choked_ratio) {
    // n·W dp = −V_R dp_s
    start = ratio_at(to_pa) <= fill.choked_ratio
                ? to_pa
                : PressureAtRatio(chamber, reservoir_m3, count, total, fill.choked_ratio, from_pa,
                                  to_pa);
    point = {0.0, fill.choked_ratio};
    integral += reservoir_m3 / count * std::log(reservoir_pa / source_at(start)) /
                fill.choked_flow_m3_per_s_pa;
  } else {
    point = PointAtRatio(fill, ratio_at(from_pa));
  }
  if (start < to_pa) {
    // dp = p_s·dr/(1 + r·n·W/V_R)
    const ContentSlopeLaw w(chamber);
    const double share = count / reservoir_m3;
    const double distance =
        std::min(SingularityDistance(fill), kPoleShare * std::sqrt(point.ratio));
    integral +=
        SubsonicIntegral(fill, chamber, start, to_pa, point, distance, ratio_at, [&](double ratio) {
          const double p =
              PressureAtRatio(chamber, reservoir_m3, count, total, ratio, start, to_pa);
          return w(p) / (1.0 + ratio * share * w(p));
        });
  }
  return integral / ContentPerStandardVolume(temperature_k);
}

}  // namespace plenum::model
