// The quasi-static volume law of effect_form.h with its play, and the pressure behind it.
#ifndef PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_CHAMBER_H_
#define PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_CHAMBER_H_

#include "tests/support/effects/effect_form.h"

namespace plenum::test {

class EffectChamber {
 public:
  explicit EffectChamber(const EffectRig& rig);

  double Volume(double pressure_pa) const { return VolumeAt(PlayOf(pressure_pa)); }

  // ∫p·dV along the law since the start.
  double Work(double pressure_pa) const;

  // p with  p·(V(p) + extra)·energy_per_pv + (with_work ? Work(p) : 0) = content.
  double Pressure(double content, double extra_m3, double energy_per_pv, bool with_work,
                  double guess_pa) const;

  // The play: +1 drags upwards, −1 downwards, 0 within its width. Without hysteresis it is +1.
  int Side() const { return side_; }
  // Distance beyond the play's width, positive outside.
  double Above(double pressure_pa) const { return pressure_pa - held_pa_ - half_width_pa_; }
  double Below(double pressure_pa) const { return held_pa_ - half_width_pa_ - pressure_pa; }
  void Turn(int side, double pressure_pa);

  // The end of a step: where the wall has been.
  void Remember(double pressure_pa);

 private:
  double PlayOf(double pressure_pa) const {
    return side_ == 0 ? held_pa_ : pressure_pa - side_ * half_width_pa_;
  }
  double VolumeAt(double pressure_pa) const;
  double VolumeIntegral(double pressure_pa) const;  // ∫V·dp from ambient

  double rest_m3_, growth_, ambient_pa_, span_pa_;
  Compliance compliance_;
  std::optional<Softening> softening_;
  std::optional<SnapThrough> snap_;
  double highest_x_;  // of the play, so far
  double half_width_pa_;
  int side_;
  double held_pa_;       // the play's output when it last turned
  double work_j_ = 0.0;  // then
};

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_CHAMBER_H_
