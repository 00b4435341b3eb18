#include "bench/batch/closed_form_batch.h"

#include <bit>
#include <boost/math/quadrature/gauss.hpp>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "bench/batch/vector_kernel.h"

namespace plenum::bench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTiny = std::numeric_limits<double>::min();

PLENUM_KERNEL double Root(double a) { return std::sqrt(Max(a, 0.0)); }

// H(z) = 1/3 + z/5 + z²/7 + …, for arctan(w) = w·(1 − w²·H(−w²)) and artanh(w) = w·(1 + w²·H(w²)).
// Rational interpolation at 15 Chebyshev nodes of [−1, ¼], where it holds to 1e-16.
constexpr double kSeriesEnd = 0.25;
PLENUM_KERNEL double SeriesTail(double z) {
  double p = -6.451312700734868e-07;
  p = p * z + 0.0007981278841081629;
  p = p * z - 0.020707426488478807;
  p = p * z + 0.172261228059782;
  p = p * z - 0.6352267226496411;
  p = p * z + 1.149658448070622;
  p = p * z - 0.9995096126695848;
  p = p * z + 0.3333333333333333;
  double q = -0.0009144957734516518;
  q = q * z + 0.029582164717853878;
  q = q * z - 0.31136438524454124;
  q = q * z + 1.50647096870949;
  q = q * z - 3.80449958748881;
  q = q * z + 5.17952121844569;
  q = q * z - 3.5985288380087543;
  q = q * z + 1.0;
  return p / q;
}

// ln(n/d) for n, d > 0, from n − d so that a ratio close to 1 keeps its digits: with n/d = 2^e·m,
// m in [√½, √2), it is e·ln 2 + 2·artanh((m − 1)/(m + 1)).
PLENUM_KERNEL double LogRatio(double n, double d, double n_minus_d) {
  constexpr std::uint64_t kOne = 1023, kMantissaBits = 52;
  constexpr std::uint64_t kRootHalf = 0x3FE6A09E667F3BCD;
  constexpr std::uint64_t kTwoTo52 = 0x4330000000000000;
  const std::uint64_t exponent =
      (std::bit_cast<std::uint64_t>(n / d) - kRootHalf + (kOne << kMantissaBits)) >> kMantissaBits;
  const double scale = std::bit_cast<double>((2 * kOne - exponent) << kMantissaBits);
  const double e = std::bit_cast<double>(kTwoTo52 | exponent) - (4503599627370496.0 + kOne);
  const double scaled = n * scale;
  const double s = (e == 0.0 ? n_minus_d : scaled - d) / (scaled + d);
  return e * std::numbers::ln2 + 2.0 * s * (1.0 + s * s * SeriesTail(s * s));
}

struct Stroke {
  double c, b, v0, v1, outer, from, to, reservoir;
};

PLENUM_KERNEL double Select(bool nowhere, bool out_of_reach, double time) {
  return nowhere ? 0.0 : (out_of_reach ? kInfinity : time);
}

// With r = b + a·sinθ and u = tan(Δθ/2) = (sinθ2 − sinθ1)/(cosθ1 + cosθ2):
//   Δθ = 2u·(1 − u²·H(−u²)),  −Δcosθ = (sinθ1 + sinθ2)·u,
// and p_s·(b·Δθ − a·Δcosθ) = u·(p1 + p2 − 2·p_s·b·u²·H).
PLENUM_KERNEL double RiseIntegral(const Stroke& k) {
  const double ps = k.outer;
  const double a = 1.0 - k.b;
  const double start = Max(k.from, Min(k.to, k.b * ps));
  const double choked = (start - k.from) * (k.v0 + k.v1 * (start + k.from)) / ps;
  const double inverse = 1.0 / (ps * a);
  const double rest_1 = (ps - start) * inverse;  // 1 − sinθ
  const double rest_2 = (ps - k.to) * inverse;
  const double cosines = Root(rest_1 * (2.0 - rest_1)) + Root(rest_2 * (2.0 - rest_2));
  const double u = (k.to - start) * inverse / Max(cosines, kTiny);
  const double tail = u * u * SeriesTail(-u * u);
  const double subsonic =
      2.0 * a * u * (k.v0 * (1.0 - tail) + k.v1 * (start + k.to - 2.0 * ps * k.b * tail));
  return Select(k.from >= k.to, k.to > ps, (choked + subsonic) / k.c);
}

// With p_a/p = b + a·cosψ, v = tan(ψ/2) and g = 1 − 2b: p_a/p = (1 − g·v²)/(1 + v²), and
//   J1 = ∫dψ·p/p_a   = 2·T·(1 + z·H(z)),   T = d/(1 − g·v1·v2),  d = v1 − v2,  z = g·T²
//   J2 = ∫dψ·(p/p_a)² = 2·ΔG + 2b·(T·(2·v1·v2·(1 − g·v1·v2) + d²)/(o1·o2) − T³·H(z))
// with G = v/(1 − g·v²), o = 1 − g·v². No difference is left that could cancel, and g = 0 (b = ½)
// is a point like any other.
PLENUM_KERNEL double FallIntegral(const Stroke& k) {
  const double pa = k.outer;
  const double a = 1.0 - k.b;
  const double g = 1.0 - 2.0 * k.b;
  const double start = Min(k.from, Max(k.to, pa / Max(k.b, kTiny)));
  const double choked =
      k.v0 * LogRatio(k.from, start, k.from - start) + 2.0 * k.v1 * (k.from - start);

  const double inverse_1 = 1.0 / (g * start + pa);
  const double inverse_2 = 1.0 / (g * k.to + pa);
  const double o_1 = 2.0 * a * pa * inverse_1;
  const double o_2 = 2.0 * a * pa * inverse_2;
  const double v_1 = Root((start - pa) * inverse_1);
  const double v_2 = Root((k.to - pa) * inverse_2);
  const double d = o_1 * inverse_2 * (start - k.to) / Max(v_1 + v_2, kTiny);
  const double rest = 0.5 * (o_1 + o_2 + g * d * d);  // 1 − g·v1·v2
  const double t = d / rest;
  const double z = g * t * t;
  const double inverse_oo = 1.0 / (o_1 * o_2);

  const double w = std::sqrt(Max(z, kSeriesEnd));
  const double below_1 = o_1 * o_2 / (rest * rest) / (1.0 + w);  // 1 − w
  const double artanh = 0.5 * LogRatio(1.0 + w, below_1, 2.0 * w);
  const double tail = z > kSeriesEnd ? (artanh / w - 1.0) / z : SeriesTail(z);

  const double j_1 = 2.0 * t * (1.0 + z * tail);
  const double j_2 =
      2.0 * d * (2.0 - rest) * inverse_oo +
      2.0 * k.b * (t * (2.0 * v_1 * v_2 * rest + d * d) * inverse_oo - t * t * t * tail);
  const double subsonic = a * (k.v0 * j_1 + 2.0 * k.v1 * pa * j_2);
  return Select(k.from <= k.to, k.to < pa, (choked + subsonic) / k.c);
}

using Rule = boost::math::quadrature::gauss<double, 30>;

// In x = p/p_s = b + a·sinθ: dt = V_R·W dx/(C·φ·S), S = √((V(0)·x + V_R)² + 4·V'·M·x²). The
// subsonic part is taken over s with t = tan(θ/2) = t0 + s², dx/φ = a·4s ds/(1 + t²). With s = 0 at
// the least x there is, b or 0, the poles of 1/S around x = 0 stay far.
struct ReservoirCurve {
  double v0, v1, mass, reservoir, b, t0;

  // W/S at s, times s.
  PLENUM_KERNEL double Density(double s) const {
    const double t = t0 + s * s;
    const double scale = 1.0 + t * t;
    const double x = b * scale + 2.0 * (1.0 - b) * t;  // times scale, as what follows
    const double linear = v0 * x + reservoir * scale;
    const double bend = 4.0 * v1 * mass * x;
    const double root = std::sqrt(linear * linear + bend * x);
    return s * (v0 * (linear + root) + bend) / ((linear + root) * root);
  }

  template <std::size_t... kNode>
  PLENUM_KERNEL double Integral(double middle, double half, std::index_sequence<kNode...>) const {
    return half *
           (... + (Rule::weights()[kNode] * (Density(middle - half * Rule::abscissa()[kNode]) +
                                             Density(middle + half * Rule::abscissa()[kNode]))));
  }
};

PLENUM_KERNEL double ReservoirIntegral(const Stroke& k) {
  const double a = 1.0 - k.b;
  const double inverse_vr = 1.0 / k.reservoir;
  const double mass = k.outer * k.reservoir + k.from * (k.v0 + k.v1 * k.from);
  const double fall_2 = (k.to - k.from) * (k.v0 + k.v1 * (k.to + k.from)) * inverse_vr;
  const double ps_2 = k.outer - fall_2;

  const double choke = Max(k.b, 0.0);
  const double linear = k.v0 * choke + k.reservoir;
  const double root = std::sqrt(linear * linear + 4.0 * k.v1 * mass * choke * choke);
  const double start = Max(k.from, Min(k.to, 2.0 * mass * choke / (linear + root)));
  const double fall_1 = (start - k.from) * (k.v0 + k.v1 * (start + k.from)) * inverse_vr;
  const double ps_1 = k.outer - fall_1;
  const double choked = LogRatio(k.outer, Max(ps_1, kTiny), fall_1);

  const double rest_1 = Min(1.0, (ps_1 - start) / (ps_1 * a));  // 1 − sinθ
  const double rest_2 = Min(1.0, (ps_2 - k.to) / (ps_2 * a));
  const double cos_1 = Root(rest_1 * (2.0 - rest_1));
  const double cos_2 = Root(rest_2 * (2.0 - rest_2));
  const double t_1 = (1.0 - rest_1) / (1.0 + cos_1);
  const double t_2 = (1.0 - rest_2) / (1.0 + cos_2);
  const double u = ((k.to - start) * ps_1 + start * (fall_2 - fall_1)) /
                   (ps_1 * ps_2 * a * Max(cos_1 + cos_2, kTiny));
  const double sin_0 = Max(0.0, -k.b) / a;
  const double t_0 = sin_0 / (1.0 + Root((1.0 - sin_0) * (1.0 + sin_0)));
  const double s_1 = Root(t_1 - t_0);
  const double s_2 = Root(t_2 - t_0);
  const double half = 0.5 * u * (1.0 + t_1 * t_2) / Max(s_1 + s_2, kTiny);
  const ReservoirCurve curve{k.v0, k.v1, mass, k.reservoir, k.b, t_0};
  const double subsonic =
      4.0 * a * curve.Integral(s_1 + half, half, std::make_index_sequence<15>());
  return Select(k.from >= k.to, ps_2 < k.to, k.reservoir * (choked + subsonic) / k.c);
}

template <auto kIntegral>
PLENUM_KERNEL void Loop(const StrokeBatch& batch, std::span<double> time_s, double per_content) {
  const double* const c = batch.sonic_conductance_m3_per_s_pa.data();
  const double* const b = batch.critical_ratio.data();
  const double* const v0 = batch.volume_at_zero_m3.data();
  const double* const v1 = batch.volume_slope_m3_per_pa.data();
  const double* const outer = batch.outer_pa.data();
  const double* const from = batch.from_pa.data();
  const double* const to = batch.to_pa.data();
  constexpr bool kReservoir = kIntegral == ReservoirIntegral;
  const double* const reservoir = kReservoir ? batch.reservoir_m3.data() : c;
  double* const out = time_s.data();
  const std::size_t size = time_s.size();
#pragma GCC ivdep
  for (std::size_t i = 0; i < size; ++i) {
    out[i] =
        per_content * kIntegral({c[i], b[i], v0[i], v1[i], outer[i], from[i], to[i], reservoir[i]});
  }
}

template <auto kIntegral>
void LoopBaseline(const StrokeBatch& batch, std::span<double> time_s, double per_content) {
  Loop<kIntegral>(batch, time_s, per_content);
}

template <auto kIntegral>
PLENUM_TARGET("avx2")
void LoopAvx2(const StrokeBatch& batch, std::span<double> time_s, double per_content) {
  Loop<kIntegral>(batch, time_s, per_content);
}

template <auto kIntegral>
PLENUM_TARGET("avx512f,prefer-vector-width=512")
void LoopAvx512(const StrokeBatch& batch, std::span<double> time_s, double per_content) {
  Loop<kIntegral>(batch, time_s, per_content);
}

template <auto kIntegral>
void Run(const StrokeBatch& batch, std::span<double> time_s, double temperature_k,
         Instructions instructions) {
  assert(Supported(instructions));
  for ([[maybe_unused]] const std::span<const double> array :
       {batch.sonic_conductance_m3_per_s_pa, batch.critical_ratio, batch.volume_at_zero_m3,
        batch.volume_slope_m3_per_pa, batch.outer_pa, batch.from_pa, batch.to_pa}) {
    assert(array.size() == time_s.size());
  }
  const double per_content =
      model::kReferenceTemperatureK / (model::kReferencePressurePa * temperature_k);
  switch (instructions) {
    case Instructions::kBaseline:
      return LoopBaseline<kIntegral>(batch, time_s, per_content);
    case Instructions::kAvx2:
      return LoopAvx2<kIntegral>(batch, time_s, per_content);
    case Instructions::kAvx512:
      return LoopAvx512<kIntegral>(batch, time_s, per_content);
  }
}

}  // namespace

bool Supported(Instructions instructions) {
#ifdef __x86_64__
  if (instructions == Instructions::kAvx512) return __builtin_cpu_supports("avx512f");
  if (instructions == Instructions::kAvx2) return __builtin_cpu_supports("avx2");
#endif
  return instructions == Instructions::kBaseline;
}

Instructions WidestSupported() {
  if (Supported(Instructions::kAvx512)) return Instructions::kAvx512;
  return Supported(Instructions::kAvx2) ? Instructions::kAvx2 : Instructions::kBaseline;
}

void RiseTimes(const StrokeBatch& batch, std::span<double> time_s, double temperature_k,
               Instructions instructions) {
  Run<RiseIntegral>(batch, time_s, temperature_k, instructions);
}

void FallTimes(const StrokeBatch& batch, std::span<double> time_s, double temperature_k,
               Instructions instructions) {
  Run<FallIntegral>(batch, time_s, temperature_k, instructions);
}

void RiseTimesFromReservoir(const StrokeBatch& batch, std::span<double> time_s,
                            double temperature_k, Instructions instructions) {
  assert(batch.reservoir_m3.size() == time_s.size());
  Run<ReservoirIntegral>(batch, time_s, temperature_k, instructions);
}

}  // namespace plenum::bench
