// The differential equations of effect_form.h.
#ifndef PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_SYSTEM_H_
#define PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_SYSTEM_H_

#include <array>
#include <vector>

#include "tests/support/effects/effect_chamber.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::test {

// Masses of chamber, droop volume, tube and second chamber; the volume and its rate (with inertia)
// and the creep; the column's flow, m³/s ANR; the lagging sensor; and the totals of EffectResult,
// where kWork holds only what the quasi-static law does not.
// clang-format off
enum EffectIndex {
  kMass, kDroop, kNode, kSecond, kVolume, kVelocity, kCreep, kColumn, kSensor,
  kSource, kDelivered, kExhaust, kLeak, kHeat, kWork, kIn, kOut, kSize
};
// clang-format on
using EffectState = std::array<double, kSize>;

struct ChamberGas {
  double pressure_pa, volume_m3, temperature_k;
};

class EffectSystem {
 public:
  explicit EffectSystem(const EffectRig& declared);

  EffectState Start();
  EffectState Slope(double t_s, const EffectState& y, double fill_opening,
                    double exhaust_opening) const;

  ChamberGas Gas(const EffectState& y) const;
  double SupplyPressure(double t_s, const EffectState& y) const;
  double NodePressure(const EffectState& y) const;
  double Work(const EffectState& y) const;  // ∫p·dV since the start
  double Energy(const EffectState& y) const;

  const EffectRig& Rig() const { return rig_; }
  EffectChamber& Law() { return law_; }
  const EffectChamber& Law() const { return law_; }
  void Expect(double pressure_pa) { guess_pa_ = pressure_pa; }  // where inversion starts

 private:
  double TubeVolume() const { return bore_m2_ * rig_.line->length_m; }
  double SourcePressure(double t_s, const EffectState& y) const;
  double Delivery(double reservoir_pa) const;
  double LineFlow(const std::vector<MassElement>& line, double opening, double upstream_pa,
                  double downstream_pa, double temperature_k,
                  const std::optional<ExhaustRestriction>& after) const;
  double LeakFlow(const ChamberGas& gas) const;
  double SeamFlow(const ChamberGas& gas) const;
  double KinkOfLine(double volume_m3) const;
  double FlowToSecond(const EffectState& y, double pressure_pa) const;
  double ColumnRate(double flow, double node_pa, double pressure_pa) const;
  void MoveWall(const EffectState& y, double pressure_pa, EffectState& slope) const;

  EffectRig rig_;
  EffectChamber law_;
  double guess_pa_;
  double per_mass_;  // R·T_a
  double wall_w_per_k_ = 0.0, bore_m2_ = 0.0, start_energy_j_ = 0.0;
};

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_EFFECTS_EFFECT_SYSTEM_H_
