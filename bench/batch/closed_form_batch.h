// Rise and fall times of many candidates at once, each with one equivalent (C, b) for its line
// (m = ½, no cracking pressure) and a chamber of the linear volume law, isothermal.
//
// With W(p) = d(pV)/dp = V(0) + 2·V'·p and the ellipse φ of ISO 6358,
//   rise       t = 1/(P0·T/T0) · ∫ W dp / (C·p_s·φ(p/p_s))      p_s constant
//   fall       t = 1/(P0·T/T0) · ∫ W dp / (C·p·φ(p_a/p))        p_a constant
//   reservoir  as rise with p_s = (M − p·V(p))/V_R, M the content that reservoir and chamber share.
// Rise and fall are closed forms without cancellation, also at b = ½ and for short strokes: within
// 1e-14 of the exact time of the given numbers. The reservoir is a quadrature of 30 nodes, within
// 1e-11 for source pressures up to 100 times the chamber's; where the target is all but the common
// pressure, rounding of M counts as the root of its relative size.
//
// Only + − × ÷ √, in the same order in every variant and without contraction to FMA: all variants
// give the same bits, and a candidate's time does not depend on its place in the batch.
#ifndef PLENUM_BENCH_BATCH_CLOSED_FORM_BATCH_H_
#define PLENUM_BENCH_BATCH_CLOSED_FORM_BATCH_H_

#include <span>

#include "model/physics/air.h"

namespace plenum::bench {

// One entry per candidate in every array that the function reads. Pressures > 0, absolute.
struct StrokeBatch {
  std::span<const double> sonic_conductance_m3_per_s_pa;  // C > 0, with gas and temperature factor
  std::span<const double> critical_ratio;                 // b in [−0.5, 1); below 0 never choked
  std::span<const double> volume_at_zero_m3;              // Volume(chamber, 0), may be negative
  std::span<const double> volume_slope_m3_per_pa;         // VolumeSlope(chamber, 0) ≥ 0
  // The pressure at the other end: the source (rise), ambient (fall), the reservoir at the start.
  std::span<const double> outer_pa;
  std::span<const double> from_pa;
  std::span<const double> to_pa;
  std::span<const double> reservoir_m3;  // share of one chamber: V_R/n; only for the reservoir
};

enum class Instructions { kBaseline, kAvx2, kAvx512 };
bool Supported(Instructions instructions);
Instructions WidestSupported();

// Seconds into `time_s`, as long as the batch. 0 where the stroke goes nowhere (rise: from ≥ to,
// fall: from ≤ to), else +∞ where the target is out of reach (rise: above the source or the
// pressure common to reservoir and chamber; fall: below ambient).
void RiseTimes(const StrokeBatch& batch, std::span<double> time_s,
               double temperature_k = model::kReferenceTemperatureK,
               Instructions instructions = WidestSupported());
void FallTimes(const StrokeBatch& batch, std::span<double> time_s,
               double temperature_k = model::kReferenceTemperatureK,
               Instructions instructions = WidestSupported());
void RiseTimesFromReservoir(const StrokeBatch& batch, std::span<double> time_s,
                            double temperature_k = model::kReferenceTemperatureK,
                            Instructions instructions = WidestSupported());

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_BATCH_CLOSED_FORM_BATCH_H_
