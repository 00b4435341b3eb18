#include "model/simulate_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace plenum::model {
namespace {

constexpr std::size_t kStepsBetweenQuestions = 64;
// A valve counts as closed when it is this share of the tolerance away from equal pressures.
constexpr double kSettledShare = 1e-3;

}  // namespace

Run::Run(const Rig& rig, const SimulateOptions& options, RunUntil until)
    : rig_(rig),
      options_(options),
      until_(until),
      system_(rig, options.linear_ratio),
      stepper_(system_.size()),
      y_(system_.InitialState()),
      valves_(rig.groups.size()) {
  for (const GroupRig& group : rig.groups) response_.groups.emplace_back().name = group.name;
  if (options.sample_hz > 0.0) {
    sample_count_ =
        1 + static_cast<std::size_t>(std::ceil(options.end_s * options.sample_hz * (1.0 - 1e-12)));
    response_.t_s.reserve(sample_count_);
  }
}

Response Run::Execute() {
  response_.status = SimulateStatus::kDone;
  SampleTo(0.0, SampleFrom::kRest);
  ApplyCommands();
  while (t_s_ < options_.end_s && IntegrateTo(NextBoundary())) ApplyCommands();
  for (std::size_t i = 0; i < system_.groups(); ++i) {
    CollectCrossed(i);
    response_.groups[i].final_pressure_pa = y_[i];
  }
  response_.source_final_pressure_pa = y_[system_.source()];
  response_.compressor_on_s = y_[system_.pump_on()];
  response_.compressor_air_m3 = y_[system_.pump_air()];
  response_.compressor_energy_j = y_[system_.pump_energy()];
  return std::move(response_);
}

void Run::ApplyCommands() {
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const auto& schedule = rig_.groups[i].schedule;
    std::size_t& next = valves_[i].next_command;
    while (next < schedule.size() && schedule[next].time_s <= t_s_) {
      Command(i, schedule[next++].state);
    }
    // A valve that was closed at equal pressures may have something to pass again.
    if (valves_[i].state == ValveState::kDeflate) system_.set_valve(i, ValveFlow::kOut);
    if (valves_[i].state == ValveState::kInflate) system_.set_valve(i, ValveFlow::kIn);
  }
}

void Run::Command(std::size_t group, ValveState state) {
  CollectCrossed(group);
  Valve& valve = valves_[group];
  valve.state = state;
  valve.stroke = -1;
  valve.target_pending = valve.operating_pending = false;
  system_.set_valve(group, ValveFlow::kNone);
  if (state == ValveState::kHold) return;

  const double source_pa =
      system_.has_source() ? y_[system_.source()] : std::numeric_limits<double>::quiet_NaN();
  valve.stroke = static_cast<int>(response_.strokes.size());
  response_.strokes.push_back({.group = static_cast<int>(group),
                               .state = state,
                               .command_s = t_s_,
                               .start_pressure_pa = y_[group],
                               .source_start_pressure_pa = source_pa,
                               .source_lowest_pressure_pa = source_pa});
  const double fraction =
      state == ValveState::kInflate ? options_.rise_fraction : options_.fall_fraction;
  const Chamber& chamber = rig_.groups[group].chamber;
  valve.target_pa = rig_.ambient.pressure_pa +
                    fraction * (chamber.operating_pressure_pa - rig_.ambient.pressure_pa);
  valve.target_pending = true;
  valve.operating_pending = state == ValveState::kInflate;
}

double Run::NextBoundary() const {
  double boundary_s = options_.end_s;
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const auto& schedule = rig_.groups[i].schedule;
    const std::size_t next = valves_[i].next_command;
    if (next < schedule.size()) boundary_s = std::min(boundary_s, schedule[next].time_s);
  }
  return boundary_s;
}

bool Run::IntegrateTo(double boundary_s) {
  while (t_s_ < boundary_s) {
    for (std::size_t i = 0; i < valves_.size(); ++i) CheckTargets(i);
    ChoosePumpState();
    CloseSettledValves();
    if (until_ == RunUntil::kTargets && TargetsDecided()) return false;

    stepper_.Start(system_, t_s_, y_, 0.0);
    const auto slope = stepper_.derivative();
    if (std::all_of(slope.begin(), slope.end(), [](double s) { return s == 0.0; })) {
      SampleTo(boundary_s, SampleFrom::kRest);
      t_s_ = boundary_s;
      break;
    }
    stepper_.Start(system_, t_s_, y_, InitialStep(boundary_s - t_s_));
    for (bool switched = false; !switched && t_s_ < boundary_s;) {
      if (response_.steps >= options_.steps_max) {
        return Fail(SimulateStatus::kTooManySteps,
                    "more than " + std::to_string(options_.steps_max) + " steps");
      }
      if (response_.steps % kStepsBetweenQuestions == 0 && options_.cancelled &&
          options_.cancelled()) {
        return Fail(SimulateStatus::kCancelled, "cancelled");
      }
      if (TryStep(boundary_s) == DormandPrince::Outcome::kNotFinite) {
        return Fail(SimulateStatus::kNotFinite, "pressure is not finite");
      }
      const Event event = FirstEvent();
      RecordStep(std::min(event.theta, 1.0));
      TakeState(event);
      if (event.theta > 1.0 && stepper_.step() == boundary_s - stepper_.start_time()) {
        t_s_ = boundary_s;
      }
      switched = event.theta <= 1.0 || CloseSettledValves() ||
                 (until_ == RunUntil::kTargets && TargetsDecided());
    }
  }
  return true;
}

DormandPrince::Outcome Run::TryStep(double boundary_s) {
  ++response_.steps;
  return stepper_.Step(system_, boundary_s - t_s_,
                       [&](std::span<const double> before, std::span<const double> after,
                           std::span<const double> error) {
                         double norm = 0.0;
                         for (std::size_t i = 0; i <= system_.groups(); ++i) {
                           const double size = std::max(std::abs(before[i]), std::abs(after[i]));
                           const double share = std::abs(error[i]) / Tolerance(size);
                           if (!(share <= norm)) norm = share;
                         }
                         return norm;
                       });
}

double Run::InitialStep(double remaining_s) const {
  double step_s = remaining_s;
  for (std::size_t i = 0; i <= system_.groups(); ++i) {
    const double slope = std::abs(stepper_.derivative()[i]);
    if (slope > 0.0) step_s = std::min(step_s, 1e-2 * y_[i] / slope);
  }
  return step_s;
}

double Run::Tolerance(double pressure_pa) const {
  return options_.relative_tolerance * pressure_pa + options_.absolute_tolerance_pa;
}

bool Run::Fail(SimulateStatus status, const std::string& what) {
  std::ostringstream text;
  text.precision(12);
  text << what << " at t = " << t_s_ << " s";
  response_.status = status;
  response_.detail = text.str();
  return false;
}

// What holds at this instant without a step: targets already passed, valves to be closed.
void Run::CheckTargets(std::size_t group) {
  Valve& valve = valves_[group];
  if (valve.stroke < 0) return;
  Stroke& stroke = response_.strokes[static_cast<std::size_t>(valve.stroke)];
  const bool inflating = valve.state == ValveState::kInflate;
  const double pressure_pa = y_[group];
  if (valve.target_pending &&
      (inflating ? pressure_pa >= valve.target_pa : pressure_pa <= valve.target_pa)) {
    stroke.to_target_s = t_s_ - stroke.command_s;
    valve.target_pending = false;
  }
  // Equal groups reach their pressure in the same step, apart by rounding.
  const double operating_pa = rig_.groups[group].chamber.operating_pressure_pa;
  if (!inflating || pressure_pa < operating_pa * (1.0 - 1e-13)) return;
  if (valve.operating_pending) stroke.to_operating_s = t_s_ - stroke.command_s;
  valve.operating_pending = false;
  if (rig_.groups[group].close_at_operating) {
    system_.set_valve(group, ValveFlow::kNone);
    valve.stroke = -1;
    CollectCrossed(group);
    valve.state = ValveState::kHold;
  }
}

void Run::ChoosePumpState() {
  if (system_.pump() == PumpState::kAbsent) return;
  const double source_pa = y_[system_.source()];
  const double limit_pa = system_.pump_limit_pa();
  if (source_pa == limit_pa) {
    const bool covers = system_.Draw(y_) <= system_.Delivery(limit_pa);
    system_.set_pump(covers ? PumpState::kHolding : PumpState::kRunning);
  } else {
    system_.set_pump(source_pa < limit_pa ? PumpState::kRunning : PumpState::kStopped);
  }
}

// Valves with nothing left to pass. Filling from a closed reservoir ends when all groups have
// arrived, since each one's draw moves the source of the others.
bool Run::CloseSettledValves() {
  const double source_pa = y_[system_.source()];
  const auto arrived = [&](std::size_t i) {
    const double left = system_.FinalPressure(i, source_pa) - y_[i];
    const double signed_left = system_.valve(i) == ValveFlow::kOut ? -left : left;
    return signed_left <= kSettledShare * Tolerance(y_[i]);
  };
  bool inflow_settles = !system_.source_may_rise(source_pa);
  if (system_.has_reservoir() && system_.pump() != PumpState::kHolding) {
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      if (system_.valve(i) == ValveFlow::kIn) inflow_settles = inflow_settles && arrived(i);
    }
  }
  bool closed = false;
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const ValveFlow flow = system_.valve(i);
    if (flow == ValveFlow::kNone || (flow == ValveFlow::kIn && !inflow_settles)) continue;
    if (!arrived(i)) continue;
    system_.set_valve(i, ValveFlow::kNone);
    closed = true;
  }
  return closed;
}

bool Run::TargetsDecided() const {
  double source_pa = y_[system_.source()];
  if (system_.has_reservoir()) source_pa = std::max(source_pa, system_.pump_limit_pa());
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const Valve& valve = valves_[i];
    if (!valve.target_pending || system_.valve(i) == ValveFlow::kNone) continue;
    const double final_pa = system_.FinalPressure(i, source_pa);
    const bool reachable = valve.state == ValveState::kInflate ? valve.target_pa <= final_pa
                                                               : valve.target_pa >= final_pa;
    if (reachable) return false;
  }
  return true;
}

void Run::CollectCrossed(std::size_t group) {
  double& crossed = y_[system_.crossed(group)];
  GroupResponse& response = response_.groups[group];
  if (valves_[group].state == ValveState::kInflate) response.air_in_m3 += crossed;
  if (valves_[group].state == ValveState::kDeflate) response.air_out_m3 += crossed;
  crossed = 0.0;
}

}  // namespace plenum::model
