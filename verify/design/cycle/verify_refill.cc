#include "verify/design/cycle/verify_refill.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "model/physics/compressor.h"
#include "model/physics/storage.h"
#include "verify/design/verify_finding.h"
#include "verify/design/verify_tank.h"

namespace plenum::verify {
namespace {

constexpr int kPanels = 160;
constexpr int kHalvings = 60;

// Largest where the pressure that is kept is nearly one that the pumps hold.
double GradedPressure(double low_pa, double high_pa, int i) {
  const double share = static_cast<double>(i) / kPanels;
  return low_pa + (high_pa - low_pa) * share * share * share;
}

double CurrentMargin(const Problem& problem, const Assembly& a, const Cycle& cycle,
                     double stop_pa) {
  const double current_a =
      a.compressors *
          model::LargestCurrent(a.filler()->curve, problem.ambient.pressure_pa, stop_pa) +
      cycle.coil_w / a.battery->nominal_voltage_v;
  return 1.0 - current_a / (a.batteries * a.battery->current_max_a);
}

// Least of what gas, energy and current leave of the mission, as a share of it.
double MissionMargin(const Problem& problem, const Assembly& a, const Cycle& cycle,
                     const Refilled& refilled) {
  double actuations = refilled.lasts_s * problem.frequency_hz + 1.0;
  if (!a.battery) return actuations / problem.actuations - 1.0;
  const double available_j =
      a.batteries * model::UsableEnergy(a.battery->capacity_ah, a.battery->nominal_voltage_v);
  const double cycle_j = cycle.electric_j() + refilled.energy_j / problem.actuations;
  if (cycle_j > 0.0) actuations = std::min(actuations, available_j / cycle_j);
  return std::min(actuations / problem.actuations - 1.0,
                  CurrentMargin(problem, a, cycle, refilled.stop_pa));
}

double LastTrue(double low, double high, const auto& holds) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return high;
}

}  // namespace

RefillCurve::RefillCurve(const Problem& problem, const Assembly& a, double source_pa, double air_m3)
    : curve_(a.filler()->curve),
      pumps_(a.compressors),
      duty_(a.filler()->duty_max),
      capacity_m3_per_pa_(model::StandardVolume(TankVolume(a), problem.ambient.temperature_k)),
      draw_m3_per_s_(air_m3 * problem.frequency_hz),
      seconds_((problem.actuations - 1.0) / problem.frequency_hz),
      kept_pa_(InletPa(problem, a, source_pa) + air_m3 / capacity_m3_per_pa_),
      highest_pa_(std::max(kept_pa_, model::HighestPressure(curve_))) {
  holds_ = Delivered(kept_pa_) >= draw_m3_per_s_;
  if (holds_) return;
  for (int i = 0; i <= kPanels; ++i)
    pressures_pa_.push_back(GradedPressure(kept_pa_, highest_pa_, i));
  for (const double pa : curve_.free_air_m3_per_s.x())
    if (pa > kept_pa_ && pa < highest_pa_) pressures_pa_.push_back(pa);
  std::sort(pressures_pa_.begin(), pressures_pa_.end());
  fallen_.resize(pressures_pa_.size());
  for (std::size_t i = 1; i < pressures_pa_.size(); ++i) {
    const Fallen more = Between(pressures_pa_[i - 1], pressures_pa_[i]);
    fallen_[i] = {fallen_[i - 1].seconds + more.seconds, fallen_[i - 1].air_m3 + more.air_m3,
                  fallen_[i - 1].energy_j + more.energy_j};
  }
}

double RefillCurve::Delivered(double pa) const {
  return pumps_ * duty_ * model::FreeAirDelivery(curve_, pa);
}

// As much as at any pressure below.
double RefillCurve::Power(double pa) const {
  if (curve_.current_a.empty()) return 0.0;
  const double low_pa = std::min(pa, curve_.current_a.front());
  return pumps_ * duty_ * curve_.voltage_v * model::LargestCurrent(curve_, low_pa, pa);
}

// Gauss' rule with three points.
RefillCurve::Fallen RefillCurve::Between(double low_pa, double high_pa) const {
  constexpr double kPlaces[] = {-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr double kWeights[] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  Fallen fallen;
  const double half_pa = 0.5 * (high_pa - low_pa);
  for (std::size_t i = 0; i < std::size(kPlaces); ++i) {
    const double pa = low_pa + half_pa * (1.0 + kPlaces[i]);
    const double delivered = Delivered(pa);
    const double seconds =
        kWeights[i] * half_pa * capacity_m3_per_pa_ / (draw_m3_per_s_ - delivered);
    fallen.seconds += seconds;
    fallen.air_m3 += seconds * delivered;
    fallen.energy_j += seconds * Power(pa);
  }
  return fallen;
}

RefillCurve::Fallen RefillCurve::Down(double from_pa) const {
  const auto above = std::upper_bound(pressures_pa_.begin(), pressures_pa_.end(), from_pa);
  const std::size_t i = std::max<std::ptrdiff_t>(above - pressures_pa_.begin() - 1, 0);
  const Fallen more = Between(pressures_pa_[i], std::max(from_pa, pressures_pa_[i]));
  return {fallen_[i].seconds + more.seconds, fallen_[i].air_m3 + more.air_m3,
          fallen_[i].energy_j + more.energy_j};
}

double RefillCurve::StopFor(double air_m3) const {
  return LastTrue(kept_pa_, highest_pa_, [&](double pa) { return Down(pa).air_m3 < air_m3; });
}

// A fill that is what is kept, but for what strokes are off by, is enough where the pumps hold it.
Refilled RefillCurve::At(double fill_pa) const {
  Refilled refilled{.stop_pa = kept_pa_};
  const double alone_s = capacity_m3_per_pa_ * (fill_pa - kept_pa_) / draw_m3_per_s_;
  const double top_pa = std::min(fill_pa, highest_pa_);
  refilled.lasts_s = alone_s;
  if (top_pa < kept_pa_ * (1.0 - kTimeTolerance)) return refilled;
  const double air_m3 = draw_m3_per_s_ * (seconds_ - alone_s);
  if (holds_) {
    refilled.lasts_s = kUnlimited;
    if (air_m3 <= 0.0) return refilled;
    const double running_s = air_m3 / Delivered(kept_pa_);
    refilled.on_s = duty_ * running_s;
    refilled.energy_j = Power(kept_pa_) * running_s;
    return refilled;
  }
  const Fallen most = Down(top_pa);
  refilled.lasts_s = capacity_m3_per_pa_ * (fill_pa - top_pa) / draw_m3_per_s_ + most.seconds;
  if (air_m3 <= 0.0) return refilled;
  refilled.stop_pa = air_m3 >= most.air_m3 ? top_pa : StopFor(air_m3);
  const Fallen fallen = Down(refilled.stop_pa);
  refilled.on_s = duty_ * fallen.seconds;
  refilled.energy_j = fallen.energy_j;
  return refilled;
}

double FillFor(const Problem& problem, const Assembly& a, double source_pa, const Cycle& cycle,
               double slack) {
  if (!a.filler())
    return LeastFillPa(problem, a, source_pa, (1.0 - slack) * problem.actuations * cycle.air_m3);
  const RefillCurve curve(problem, a, source_pa, cycle.air_m3);
  const double most_pa = MostFillPa(problem, a);
  const auto misses = [&](double fill_pa) {
    return MissionMargin(problem, a, cycle, curve.At(fill_pa)) < -slack;
  };
  if (misses(most_pa)) return most_pa;
  double low_pa = std::min(curve.LeastFill(), most_pa);
  if (misses(low_pa)) low_pa = LastTrue(low_pa, most_pa, misses);
  if (problem.objective.energy_wh == 0.0) return low_pa;
  // Weighted, both are one valley.
  double high_pa = most_pa;
  const auto objective = [&](double fill_pa) {
    return problem.objective.mass_kg * a.tanks * ChargeKg(problem, *a.tank, fill_pa) +
           problem.objective.energy_wh * curve.At(fill_pa).energy_j / optimizer::kJoulePerWattHour;
  };
  for (int i = 0; i < 2 * kHalvings; ++i) {
    const double left_pa = low_pa + (high_pa - low_pa) / 3.0;
    const double right_pa = high_pa - (high_pa - low_pa) / 3.0;
    if (objective(left_pa) <= objective(right_pa))
      high_pa = right_pa;
    else
      low_pa = left_pa;
  }
  return low_pa;
}

}  // namespace plenum::verify
