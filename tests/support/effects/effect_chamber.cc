#include "tests/support/effects/effect_chamber.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plenum::test {

EffectChamber::EffectChamber(const EffectRig& rig)
    : rest_m3_(rig.rest_volume_m3),
      growth_(rig.expansion_ratio - 1.0),
      ambient_pa_(rig.ambient_pa),
      span_pa_(rig.operating_pa - rig.ambient_pa),
      compliance_(rig.compliance.value_or(Compliance{})),
      softening_(rig.unlisted.softening),
      snap_(rig.unlisted.snap_through),
      highest_x_((rig.initial_pa - rig.ambient_pa) / span_pa_),
      half_width_pa_(rig.hysteresis_half_width_pa.value_or(0.0)),
      side_(half_width_pa_ > 0.0 ? 0 : 1),
      held_pa_(rig.initial_pa) {
  if ((softening_ || snap_) && rig.heat_time_constant_s) {
    throw std::invalid_argument("effect_chamber: this volume law has no work");
  }
}

double EffectChamber::VolumeAt(double pressure_pa) const {
  const double x = (pressure_pa - ambient_pa_) / span_pa_;
  const double turn = 2.0 * std::numbers::pi;
  double shape = x + compliance_.curvature * x * (x - 1.0) +
                 compliance_.s_amplitude * std::sin(turn * x) / turn;
  if (softening_ && x > 0.0 && x < highest_x_) {
    shape += softening_->share * x * (1.0 - x / highest_x_);
  }
  if (snap_) shape += SnappedShare(*snap_, x) - x;
  return rest_m3_ * (1.0 + growth_ * shape);
}

double EffectChamber::VolumeIntegral(double pressure_pa) const {
  const double x = (pressure_pa - ambient_pa_) / span_pa_;
  const double turn = 2.0 * std::numbers::pi;
  const double shape = x * x / 2.0 + compliance_.curvature * (x * x * x / 3.0 - x * x / 2.0) +
                       compliance_.s_amplitude * (1.0 - std::cos(turn * x)) / (turn * turn);
  return rest_m3_ * span_pa_ * (x + growth_ * shape);
}

double EffectChamber::Work(double pressure_pa) const {
  // With p = r ± h along the play r:  ∫p·dV = r·V − ∫V·dr ± h·V.
  const double play = PlayOf(pressure_pa);
  const auto stored = [&](double r) {
    return (r + side_ * half_width_pa_) * VolumeAt(r) - VolumeIntegral(r);
  };
  return work_j_ + stored(play) - stored(held_pa_);
}

double EffectChamber::Pressure(double content, double extra_m3, double energy_per_pv,
                               bool with_work, double guess_pa) const {
  const auto surplus = [&](double p) {
    return energy_per_pv * p * (Volume(p) + extra_m3) + (with_work ? Work(p) : 0.0) - content;
  };
  double p = guess_pa;
  for (int k = 0; k < 100; ++k) {
    const double h = 1e-4 * p;
    const double slope = (surplus(p + h) - surplus(p - h)) / (2.0 * h);
    const double next = std::clamp(p - surplus(p) / slope, 0.5 * p, 2.0 * p);
    if (std::abs(next - p) < 1e-12 * p) return next;
    p = next;
  }
  throw std::runtime_error("effect_form: no pressure for this content");
}

void EffectChamber::Turn(int side, double pressure_pa) {
  const double play = PlayOf(pressure_pa);
  work_j_ = Work(pressure_pa);
  held_pa_ = play;
  side_ = side;
}

void EffectChamber::Remember(double pressure_pa) {
  highest_x_ = std::max(highest_x_, (PlayOf(pressure_pa) - ambient_pa_) / span_pa_);
}

}  // namespace plenum::test
