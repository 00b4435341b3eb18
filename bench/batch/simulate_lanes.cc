#include "bench/batch/simulate_lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bench/batch/vector_kernel.h"

namespace plenum::bench {
namespace {

constexpr std::size_t kLanes = 64;
constexpr std::size_t kWidest = 8;  // lanes of the widest vector
constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr double kSafety = 0.9;
constexpr double kShrinkMost = 0.2;
constexpr double kGrowMost = 1.5;   // an estimate that is small by chance does little harm
constexpr double kFirstStep = 3.0;  // times rtol^0.2 of the way to the nearest singularity
constexpr double kLanding = 0.1;    // bound on what landing adds to the error, per tolerance
constexpr double kLastShare = 0.1;  // of the step may be left to landing

PLENUM_KERNEL double If(bool condition) { return condition ? 1.0 : 0.0; }

// x^(−1/5) within 4 % for x > 0, from the bits as a piecewise linear logarithm.
PLENUM_KERNEL double InverseFifthRoot(double x) {
  constexpr std::uint64_t kFifthOf2To32 = 858993459;
  constexpr std::uint64_t kOffset = 0x4CB8A8C154C98457;
  const std::uint64_t high = std::bit_cast<std::uint64_t>(x) >> 32;
  return std::bit_cast<double>(kOffset - high * kFifthOf2To32);
}

struct LegRate {
  double g, b, inverse_rest, v0, v1, outer, share, start;

  template <LegStroke kStroke>
  PLENUM_KERNEL double Outer(double p) const {
    if constexpr (kStroke != LegStroke::kRiseFromReservoir) return outer;
    return outer - share * ((p - start) * (v0 + v1 * (p + start)));
  }

  // dp/dt
  template <LegStroke kStroke, LegFlow kFlow>
  PLENUM_KERNEL double At(double p) const {
    constexpr bool kFall = kStroke == LegStroke::kFall;
    const double other = Outer<kStroke>(p);
    const double front = kFall ? p : other;
    const double behind = kFall ? other : p;
    double flow = front;
    if constexpr (kFlow == LegFlow::kSubsonic) {
      const double z = (behind - b * front) * inverse_rest;
      flow = std::sqrt(Max((front - z) * (front + z), 0.0));
    }
    if constexpr (kFlow == LegFlow::kLinear) flow = front - behind;
    return g * flow / (v0 + 2.0 * v1 * p);
  }
};

// State and numbers of all lanes.
struct Lanes {
  using Column = std::array<double, kLanes>;
  alignas(64) Column g, b, inverse_rest, v0, v1, outer, share, start;
  alignas(64) Column to, inverse_rate_to;
  alignas(64) Column p, t, h, rate, inverse_rate;
  alignas(64) Column landed;  // 0 or 1
  std::array<std::size_t, kLanes> leg, steps;

  PLENUM_KERNEL LegRate Rate(std::size_t l) const {
    return {g[l], b[l], inverse_rest[l], v0[l], v1[l], outer[l], share[l], start[l]};
  }

  template <LegStroke kStroke, LegFlow kFlow>
  PLENUM_KERNEL void Load(std::size_t l, const Leg& from, std::size_t index, double root_of_rtol) {
    constexpr bool kFall = kStroke == LegStroke::kFall;
    leg[l] = index;
    steps[l] = 0;
    g[l] = kFall ? -from.conductance_pa_m3_per_s_pa : from.conductance_pa_m3_per_s_pa;
    b[l] = from.critical_ratio;
    inverse_rest[l] = 1.0 / (1.0 - from.critical_ratio);
    v0[l] = from.volume_at_zero_m3;
    v1[l] = from.volume_slope_m3_per_pa;
    outer[l] = from.outer_pa;
    share[l] = from.per_reservoir_m3;
    start[l] = from.start_pa;
    p[l] = from.from_pa;
    to[l] = from.to_pa;
    t[l] = 0.0;
    const LegRate law = Rate(l);
    rate[l] = law.At<kStroke, kFlow>(p[l]);
    inverse_rate[l] = 1.0 / rate[l];
    inverse_rate_to[l] = 1.0 / law.At<kStroke, kFlow>(to[l]);
    const double other = law.Outer<kStroke>(p[l]);
    const double front = kFall ? p[l] : other;
    double flow_way = std::abs(p[l] - other);
    if (kFlow == LegFlow::kChoked) flow_way = kStroke == LegStroke::kRise ? kInfinity : front;
    const double volume_way = (v0[l] + 2.0 * v1[l] * p[l]) / (2.0 * v1[l]);  // +∞ if rigid
    h[l] = kFirstStep * root_of_rtol * Min(flow_way, volume_way) * std::abs(inverse_rate[l]);
  }

  void Move(std::size_t to_lane, std::size_t from_lane) {
    for (Column* column : {&g, &b, &inverse_rest, &v0, &v1, &outer, &share, &start, &to,
                           &inverse_rate_to, &p, &t, &h, &rate, &inverse_rate, &landed}) {
      (*column)[to_lane] = (*column)[from_lane];
    }
    leg[to_lane] = leg[from_lane];
    steps[to_lane] = steps[from_lane];
  }

  // One try of a step.
  template <LegStroke kStroke, LegFlow kFlow>
  PLENUM_KERNEL void Step(std::size_t l, double rtol, double atol) {
    const LegRate law = Rate(l);
    const double p0 = p[l], end = to[l], k1 = rate[l];
    const double way = end - p0;
    const double wanted = h[l], t0 = t[l];
    const double inverse_k1 = inverse_rate[l], inverse_end = inverse_rate_to[l];
    const double aim = 0.5 * way * (inverse_k1 + inverse_end);
    const double s = Min(wanted, aim);

    const double k2 = law.At<kStroke, kFlow>(p0 + s * (1.0 / 5 * k1));
    const double k3 = law.At<kStroke, kFlow>(p0 + s * (3.0 / 40 * k1 + 9.0 / 40 * k2));
    const double k4 =
        law.At<kStroke, kFlow>(p0 + s * (44.0 / 45 * k1 - 56.0 / 15 * k2 + 32.0 / 9 * k3));
    const double k5 = law.At<kStroke, kFlow>(p0 + s * (19372.0 / 6561 * k1 - 25360.0 / 2187 * k2 +
                                                       64448.0 / 6561 * k3 - 212.0 / 729 * k4));
    const double k6 = law.At<kStroke, kFlow>(p0 + s * (9017.0 / 3168 * k1 - 355.0 / 33 * k2 +
                                                       46732.0 / 5247 * k3 + 49.0 / 176 * k4 -
                                                       5103.0 / 18656 * k5));
    const double p1 = p0 + s * (35.0 / 384 * k1 + 500.0 / 1113 * k3 + 125.0 / 192 * k4 -
                                2187.0 / 6784 * k5 + 11.0 / 84 * k6);
    const double k7 = law.At<kStroke, kFlow>(p1);
    const double error = s * (71.0 / 57600 * k1 - 71.0 / 16695 * k3 + 71.0 / 1920 * k4 -
                              17253.0 / 339200 * k5 + 22.0 / 525 * k6 - 1.0 / 40 * k7);

    const double allowed = rtol * Max(p0, p1) + atol;
    const double norm = std::abs(error) / allowed;
    const double factor =
        Min(Max(kSafety * InverseFifthRoot(Max(Min(norm, 1e10), 1e-10)), kShrinkMost), kGrowMost);

    const double left = end - p1;
    const double inverse_k7 = 1.0 / k7;
    const double mismatch = k7 * inverse_end - 1.0;
    const double shift = 0.5 * left * (inverse_k7 + inverse_end);
    // Conditions as 0 or 1: bits of doubles are what every vector unit can select by.
    const double good = If(norm <= 1.0);  // 0 for NaN
    const double near = If(std::abs(left) * mismatch * mismatch <= kLanding * allowed) *
                        If(std::abs(left) <= kLastShare * std::abs(way));
    const double passed = If(left * way <= 0.0);
    const double lands = good * near;
    const double moves = good * (1.0 - passed);
    const double cut = good * If(s < wanted);

    const double next = s * factor;
    const double onward = cut > 0.0 ? Max(next, wanted) : next;
    h[l] = good * passed > 0.0 ? Max(s + shift, kShrinkMost * s) : onward;
    const double moved = moves > 0.0 ? s : 0.0;
    t[l] = t0 + (lands > 0.0 ? s + shift : moved);
    p[l] = moves > 0.0 ? p1 : p0;
    rate[l] = moves > 0.0 ? k7 : k1;
    inverse_rate[l] = moves > 0.0 ? inverse_k7 : inverse_k1;
    landed[l] = lands;
  }
};

template <LegStroke kStroke, LegFlow kFlow>
PLENUM_KERNEL void Integrate(std::span<const Leg> legs, const LegTolerance& tolerance,
                             std::span<double> time_s) {
  Lanes lanes;
  const double root_of_rtol = std::pow(tolerance.relative, 0.2);
  std::size_t next = std::min(kLanes, legs.size());
  std::size_t running = next;
  for (std::size_t l = 0; l < running; ++l) {
    lanes.Load<kStroke, kFlow>(l, legs[l], l, root_of_rtol);
  }
  // Lanes that fill up the last vector run along for nothing.
  for (std::size_t l = running; l < kLanes && running > 0; ++l) lanes.Move(l, 0);
  while (running > 0) {
    const std::size_t whole = (running + kWidest - 1) / kWidest * kWidest;
#pragma GCC ivdep
    for (std::size_t l = 0; l < whole; ++l) {
      lanes.Step<kStroke, kFlow>(l, tolerance.relative, tolerance.absolute_pa);
    }
    for (std::size_t l = running; l-- > 0;) {
      ++lanes.steps[l];
      if (lanes.landed[l] == 0.0 && lanes.steps[l] < tolerance.steps_max) continue;
      time_s[lanes.leg[l]] =
          lanes.landed[l] != 0.0 ? lanes.t[l] : std::numeric_limits<double>::quiet_NaN();
      if (next < legs.size()) {
        lanes.Load<kStroke, kFlow>(l, legs[next], next, root_of_rtol);
        ++next;
      } else {
        lanes.Move(l, --running);
      }
    }
  }
}

template <LegStroke kStroke, LegFlow kFlow>
void IntegrateBaseline(std::span<const Leg> legs, const LegTolerance& tolerance,
                       std::span<double> time_s) {
  Integrate<kStroke, kFlow>(legs, tolerance, time_s);
}

template <LegStroke kStroke, LegFlow kFlow>
PLENUM_TARGET("avx2")
void IntegrateAvx2(std::span<const Leg> legs, const LegTolerance& tolerance,
                   std::span<double> time_s) {
  Integrate<kStroke, kFlow>(legs, tolerance, time_s);
}

template <LegStroke kStroke, LegFlow kFlow>
PLENUM_TARGET("avx512f,prefer-vector-width=512")
void IntegrateAvx512(std::span<const Leg> legs, const LegTolerance& tolerance,
                     std::span<double> time_s) {
  Integrate<kStroke, kFlow>(legs, tolerance, time_s);
}

template <LegStroke kStroke, LegFlow kFlow>
void Run(std::span<const Leg> legs, const LegTolerance& tolerance, std::span<double> time_s,
         Instructions instructions) {
  switch (instructions) {
    case Instructions::kBaseline:
      return IntegrateBaseline<kStroke, kFlow>(legs, tolerance, time_s);
    case Instructions::kAvx2:
      return IntegrateAvx2<kStroke, kFlow>(legs, tolerance, time_s);
    case Instructions::kAvx512:
      return IntegrateAvx512<kStroke, kFlow>(legs, tolerance, time_s);
  }
}

template <LegStroke kStroke, class... Rest>
void RunFlow(LegFlow flow, Rest&&... rest) {
  switch (flow) {
    case LegFlow::kChoked:
      return Run<kStroke, LegFlow::kChoked>(rest...);
    case LegFlow::kSubsonic:
      return Run<kStroke, LegFlow::kSubsonic>(rest...);
    case LegFlow::kLinear:
      return Run<kStroke, LegFlow::kLinear>(rest...);
  }
}

}  // namespace

void LegTimes(LegStroke stroke, LegFlow flow, std::span<const Leg> legs,
              const LegTolerance& tolerance, std::span<double> time_s, Instructions instructions) {
  assert(Supported(instructions) && time_s.size() == legs.size());
  switch (stroke) {
    case LegStroke::kRise:
      return RunFlow<LegStroke::kRise>(flow, legs, tolerance, time_s, instructions);
    case LegStroke::kRiseFromReservoir:
      return RunFlow<LegStroke::kRiseFromReservoir>(flow, legs, tolerance, time_s, instructions);
    case LegStroke::kFall:
      return RunFlow<LegStroke::kFall>(flow, legs, tolerance, time_s, instructions);
  }
}

}  // namespace plenum::bench
