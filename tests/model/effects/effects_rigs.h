// Rigs of the simulator for the tests of its effects, also made from those of effect_form.h.
#ifndef PLENUM_TESTS_MODEL_EFFECTS_EFFECTS_RIGS_H_
#define PLENUM_TESTS_MODEL_EFFECTS_EFFECTS_RIGS_H_

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "model/simulate/simulate.h"
#include "tests/model/effects/effect_rigs.h"
#include "tests/model/simulate/simulate_rigs.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::model {

inline constexpr double kAdiabaticS = 1e9;  // the longest time constant that heat_transfer takes

// Parameters in the order of the spec.
inline Effect MakeEffect(std::string_view id, std::vector<double> parameters,
                         std::string_view law = {}) {
  return {FindEffect(id, law), std::move(parameters)};
}

inline std::vector<Effect> EffectsOf(const test::EffectRig& rig) {
  std::vector<Effect> effects;
  const auto add = [&](std::string_view id, std::vector<double> parameters,
                       std::string_view law = {}) {
    effects.push_back(MakeEffect(id, std::move(parameters), law));
  };
  if (rig.leak) {
    if (const auto* leak = std::get_if<test::OrificeLeak>(&*rig.leak))
      add("leak", {leak->conductance, leak->critical_ratio}, "orifice");
    if (const auto* leak = std::get_if<test::LaminarLeak>(&*rig.leak))
      add("leak", {leak->conductance}, "laminar");
    if (const auto* leak = std::get_if<test::PorousLeak>(&*rig.leak))
      add("leak", {leak->viscous_pa2_s_per_kg, leak->inertial_pa2_s2_per_kg2}, "porous");
  }
  if (const auto& e = rig.inertia)
    add("inertia", {e->natural_frequency_rad_per_s, e->damping_ratio});
  if (const auto& e = rig.creep) add("creep", {e->fraction, e->time_constant_s});
  if (rig.hysteresis_half_width_pa) add("hysteresis", {*rig.hysteresis_half_width_pa});
  if (rig.heat_time_constant_s)
    add("heat_transfer", {std::min(*rig.heat_time_constant_s, kAdiabaticS)});
  if (rig.valve_delay_s > 0.0) add("valve_delay", {rig.valve_delay_s});
  if (rig.valve_ramp_s > 0.0) add("valve_ramp", {rig.valve_ramp_s});
  if (rig.dead_volume_m3 > 0.0) add("dead_volume", {rig.dead_volume_m3});
  if (const auto& e = rig.supply_droop)
    add("supply_droop", {e->volume_m3, e->conductance, e->critical_ratio});
  if (const auto& e = rig.exhaust_restriction)
    add("exhaust_restriction", {e->conductance, e->critical_ratio});
  if (const auto& e = rig.compliance) add("nonlinear_compliance", {e->curvature, e->s_amplitude});
  if (rig.sensor_lag_s > 0.0) add("sensor_lag", {rig.sensor_lag_s});
  if (rig.sensor_gain != 1.0) add("sensor_gain", {rig.sensor_gain});
  if (rig.sensor_offset_pa != 0.0) add("sensor_offset", {rig.sensor_offset_pa});
  if (rig.cracking_pa > 0.0) add("cracking_pressure", {rig.cracking_pa});
  if (rig.fill_factor != 1.0) add("directional_conductance", {rig.fill_factor});
  if (const auto& e = rig.line) add("line_dynamics", {e->length_m, e->inner_diameter_m});
  return effects;
}

inline Rig ModelRig(const test::EffectRig& from) {
  GroupRig group;
  group.chamber = {.rest_volume_m3 = from.rest_volume_m3,
                   .expansion_ratio = from.expansion_ratio,
                   .operating_pressure_pa = from.operating_pa,
                   .ambient_pressure_pa = from.ambient_pa,
                   .volume_curve = {}};
  for (const test::MassElement& e : from.fill)
    group.fill.push_back(
        {.sonic_conductance_m3_per_s_pa = e.conductance, .critical_ratio = e.critical_ratio});
  for (const test::MassElement& e : from.exhaust)
    group.exhaust.push_back(
        {.sonic_conductance_m3_per_s_pa = e.conductance, .critical_ratio = e.critical_ratio});
  for (const test::MassCommand& command : from.schedule) {
    group.schedule.push_back({command.time_s, command.direction > 0   ? ValveState::kInflate
                                              : command.direction < 0 ? ValveState::kDeflate
                                                                      : ValveState::kHold});
  }
  group.initial_pressure_pa = from.initial_pa;
  group.initial_temperature_k = from.initial_k.value_or(0.0);
  group.blocked = from.blocked;
  group.effects = EffectsOf(from);

  Rig rig;
  rig.ambient = {from.ambient_pa, from.ambient_k};
  if (from.source == test::EffectRig::Source::kRegulated) rig.source = Regulated(from.source_pa);
  if (from.source == test::EffectRig::Source::kReservoir) {
    rig.source = ReservoirSource{
        .volume_m3 = from.reservoir_m3, .initial_pressure_pa = from.source_pa, .compressor = {}};
  }
  rig.groups = {std::move(group)};
  return rig;
}

// The bench of effect_rigs.h with effects.
inline Rig BenchWith(std::vector<Effect> effects) {
  Rig rig = ModelRig(test::Bench());
  rig.groups[0].effects = std::move(effects);
  return rig;
}

// What the sensor shows, or the pressure where no sensor effect stands in between.
inline const std::vector<double>& Reading(const Response& response) {
  const GroupResponse& group = response.groups[0];
  return group.reading_pa.empty() ? group.pressure_pa : group.reading_pa;
}

}  // namespace plenum::model

#endif  // PLENUM_TESTS_MODEL_EFFECTS_EFFECTS_RIGS_H_
