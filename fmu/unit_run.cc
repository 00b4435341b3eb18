#include "fmu/unit_run.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "model/simulate/simulate_validate.h"

namespace plenum::fmu {
namespace {

// Pressures of evacuated actuators and of their source are images inside (model/physics/chamber.h).
double Told(const model::Chamber& chamber, double pressure_pa) {
  return chamber.evacuated ? model::MirrorPa(chamber) - pressure_pa : pressure_pa;
}

double StartOf(const model::Source& source) {
  if (const auto* regulated = std::get_if<model::RegulatedSource>(&source))
    return regulated->pressure_pa;
  if (const auto* reservoir = std::get_if<model::ReservoirSource>(&source))
    return reservoir->initial_pressure_pa;
  return 0.0;
}

model::ValveState StateOf(int command) {
  return command > 0   ? model::ValveState::kInflate
         : command < 0 ? model::ValveState::kDeflate
                       : model::ValveState::kHold;
}

}  // namespace

UnitRun::UnitRun(const Unit& unit) : inputs(unit.rig.groups.size()), unit_(&unit) { Reset(); }

bool UnitRun::has_source() const {
  return !std::holds_alternative<model::NoSource>(unit_->rig.source);
}

void UnitRun::Reset() {
  const std::size_t count = unit_->rig.groups.size();
  rig_ = unit_->rig;
  inputs.assign(count, {});
  obeyed_.assign(count, 0);
  imposed_m3_.assign(count, 0.0);
  state_.clear();
  for (const model::GroupRig& group : rig_.groups) state_.push_back(group.initial_pressure_pa);
  if (const auto* reservoir = std::get_if<model::ReservoirSource>(&rig_.source))
    state_.push_back(reservoir->initial_pressure_pa);
  valves_.clear();
  strokes_.clear();
  outputs_.assign(count, {});
  energy_used_j_ = air_used_m3_ = 0.0;
  detail_.clear();
  // Of pumps that feed the lines themselves: ambient, as they are off.
  const model::Chamber& chamber = rig_.groups.front().chamber;
  const double start_pa = StartOf(rig_.source);
  source_pa_ = start_pa > 0.0 ? Told(chamber, start_pa) : rig_.ambient.pressure_pa;
  for (std::size_t i = 0; i < count; ++i) {
    const model::GroupRig& group = rig_.groups[i];
    outputs_[i].pressure_pa = Told(group.chamber, group.initial_pressure_pa);
    outputs_[i].volume_m3 =
        Volume(group.chamber, group.initial_pressure_pa) - group.chamber.dead_volume_m3;
  }
}

void UnitRun::Command(std::size_t actuator) {
  const int asked = inputs[actuator].command;
  const int before = obeyed_[actuator];
  const int stays = before == 0 ? -1 : before;
  const int now = asked == 0 && !unit_->valves[actuator].holds ? stays : asked;
  if (now == before) return;
  rig_.groups[actuator].schedule.push_back({0.0, StateOf(now)});
  obeyed_[actuator] = now;
}

// The chamber becomes a rigid one of the volume that is given, or again that of its law; the gas
// inside stays.
void UnitRun::Impose(std::size_t actuator) {
  const double asked_m3 = inputs[actuator].volume_m3;
  if (asked_m3 == imposed_m3_[actuator]) return;
  model::Chamber& chamber = rig_.groups[actuator].chamber;
  const double content = Content(chamber, state_[actuator]);
  chamber = unit_->rig.groups[actuator].chamber;
  imposed_m3_[actuator] = asked_m3;
  if (asked_m3 > 0.0) {
    chamber.rest_volume_m3 = asked_m3;
    chamber.expansion_ratio = 1.0;
    chamber.volume_curve = {};
  }
  // p·V(p) rises with p: Newton's method within a bracket.
  double& pressure_pa = state_[actuator];
  double low_pa = 0.0, high_pa = chamber.evacuated ? model::MirrorPa(chamber) : 1e12;
  for (int i = 0; i < 200; ++i) {
    const double excess = Content(chamber, pressure_pa) - content;
    (excess > 0.0 ? high_pa : low_pa) = pressure_pa;
    const double next_pa = pressure_pa - excess / ContentSlope(chamber, pressure_pa);
    const double inside_pa =
        next_pa > low_pa && next_pa < high_pa ? next_pa : 0.5 * (low_pa + high_pa);
    if (std::abs(inside_pa - pressure_pa) <= 1e-15 * pressure_pa) break;
    pressure_pa = inside_pa;
  }
}

template <class Stepper>
model::Response UnitRun::Go(const model::SimulateOptions& options, bool& stiff) {
  model::Run<double, Stepper> run(rig_, options, model::RunUntil::kEnd);
  if (!valves_.empty()) run.Resume(valves_, strokes_);
  model::Response response = run.Execute(state_);
  stiff = run.stiff();
  if (stiff || response.status != model::SimulateStatus::kDone) return response;
  const std::span<const double> end = run.final_state();
  std::vector<model::ValveProgress<double>> valves = run.final_valves();
  for (std::size_t i = 0; i < valves.size(); ++i)
    energy_used_j_ += CoilEnergy(i, response, options.end_s);
  state_.assign(end.begin(), end.end());
  KeepValves(response, std::move(valves), options.end_s);
  return response;
}

// A coil is on while its valve is open; of a 3/2 while it inflates. A valve that closed at the
// operating pressure holds at the end.
double UnitRun::CoilEnergy(std::size_t actuator, const model::Response& response,
                           double step_s) const {
  const auto& [power_w, holds] = unit_->valves[actuator];
  const int command = obeyed_[actuator];
  if (command == 0) return 0.0;
  if (command < 0) return holds ? power_w * step_s : 0.0;
  const bool is_new = !rig_.groups[actuator].schedule.empty();
  if (!is_new && valves_[actuator].filling.end == 0.0) return 0.0;
  if (!rig_.groups[actuator].close_at_operating) return power_w * step_s;
  double open_s = step_s;
  for (const model::Stroke& stroke : response.strokes)
    if (stroke.group == static_cast<int>(actuator) && stroke.state == model::ValveState::kInflate)
      open_s = std::min(open_s, stroke.command_s + stroke.to_operating_s);
  return power_w * std::max(open_s, 0.0);
}

// On the clock of the next step.
void UnitRun::KeepValves(const model::Response& response,
                         std::vector<model::ValveProgress<double>> valves, double step_s) {
  valves_ = std::move(valves);
  strokes_.clear();
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    model::ValveProgress<double>& valve = valves_[i];
    rig_.groups[i].schedule.clear();
    valve.next_command = valve.next_move = 0;
    valve.filling.since_s -= step_s;
    valve.venting.since_s -= step_s;
    if (valve.stroke < 0) continue;
    strokes_.push_back(response.strokes[static_cast<std::size_t>(valve.stroke)]);
    strokes_.back().command_s -= step_s;
    valve.stroke = static_cast<int>(strokes_.size()) - 1;
  }
}

void UnitRun::Account(const model::Response& response, double step_s) {
  energy_used_j_ += response.compressor_energy_j + unit_->regulator_power_w * step_s;
  if (has_source())
    source_pa_ = Told(rig_.groups.front().chamber, response.source_pressure_pa.back());
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const model::GroupResponse& group = response.groups[i];
    const model::Chamber& chamber = rig_.groups[i].chamber;
    const double gained_m3 = group.air_in_m3 - group.air_out_m3;  // of air, or of the lack of it
    outputs_[i] = {Told(chamber, state_[i]), (chamber.evacuated ? -gained_m3 : gained_m3) / step_s,
                   Volume(chamber, state_[i]) - chamber.dead_volume_m3};
    air_used_m3_ += group.air_drawn_m3;
  }
}

bool UnitRun::Step(double step_s) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    Impose(i);
    Command(i);
    rig_.groups[i].close_at_operating = close_at_operating && unit_->valves[i].holds;
  }
  model::SimulateOptions options;
  options.end_s = step_s;
  options.sample_times_s = {step_s};
  detail_ = model::WhyInvalid(rig_);
  if (!detail_.empty()) return false;
  bool stiff = false;
  model::Response response = Go<model::ExplicitIntegrator<double>>(options, stiff);
  if (stiff) response = Go<model::ImplicitIntegrator<double>>(model::DampedOptions(options), stiff);
  detail_ = response.detail;
  if (response.status != model::SimulateStatus::kDone) return false;
  Account(response, step_s);
  return true;
}

}  // namespace plenum::fmu
