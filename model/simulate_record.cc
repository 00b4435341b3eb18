// What a run finds inside a step: events, target crossings, samples.
#include <algorithm>
#include <cmath>

#include "model/simulate_root.h"
#include "model/simulate_run.h"

namespace plenum::model {
namespace {

constexpr double kThetaTolerance = 1e-14;

}  // namespace

// Where in the step state `i` passes `level`, given that it does.
double Run::CrossingTheta(std::size_t i, double level) const {
  const auto excess = [&](double theta) { return stepper_.At(theta, i) - level; };
  const double before = stepper_.start_state()[i] - level;
  const double after = stepper_.state()[i] - level;
  return RootBetween(excess, 0.0, before, 1.0, after, kThetaTolerance);
}

Run::Event Run::FirstEvent() const {
  Event first = SourceEvent();
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const GroupRig& group = rig_.groups[i];
    const double operating_pa = group.chamber.operating_pressure_pa;
    const bool closes = group.close_at_operating && valves_[i].state == ValveState::kInflate;
    if (!closes || stepper_.state()[i] < operating_pa) continue;
    const double theta = CrossingTheta(i, operating_pa);
    if (theta < first.theta) first = {theta, static_cast<int>(i)};
  }
  return first;
}

// The source comes to the pressure at which the pumps stop, from below while they run, from above
// while they stand.
Run::Event Run::SourceEvent() const {
  const PumpState pump = system_.pump();
  if (pump != PumpState::kRunning && pump != PumpState::kStopped) return {};
  const std::size_t s = system_.source();
  const double limit_pa = system_.pump_limit_pa();
  const double sign = pump == PumpState::kRunning ? 1.0 : -1.0;
  const double before = sign * (stepper_.start_state()[s] - limit_pa);
  const double after = sign * (stepper_.state()[s] - limit_pa);
  if (after < 0.0) return {};
  if (before < 0.0) return {CrossingTheta(s, limit_pa), -1};
  // It left the limit and came back within the step.
  const auto excess = [&](double theta) { return sign * (stepper_.At(theta, s) - limit_pa); };
  if (excess(0.5) >= 0.0) return {1.0, -1};
  return {RootBetween(excess, 0.5, excess(0.5), 1.0, after, kThetaTolerance), -1};
}

void Run::RecordStep(double theta_end) {
  const double start_s = stepper_.start_time();
  const double step_s = stepper_.step();
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    Valve& valve = valves_[i];
    if (valve.stroke < 0) continue;
    Stroke& stroke = response_.strokes[static_cast<std::size_t>(valve.stroke)];
    const auto record = [&](double level, bool& pending, double& since_command_s) {
      const double after = stepper_.state()[i];
      const bool passed = valve.state == ValveState::kInflate ? after >= level : after <= level;
      if (!pending || !passed) return;
      const double theta = CrossingTheta(i, level);
      if (theta > theta_end) return;
      pending = false;
      since_command_s = start_s + theta * step_s - stroke.command_s;
    };
    record(valve.target_pa, valve.target_pending, stroke.to_target_s);
    record(rig_.groups[i].chamber.operating_pressure_pa, valve.operating_pending,
           stroke.to_operating_s);
  }
  if (system_.has_reservoir()) RecordSourceLowest(theta_end);
  SampleTo(start_s + theta_end * step_s, SampleFrom::kStep);
}

void Run::RecordSourceLowest(double theta_end) {
  const std::size_t s = system_.source();
  double lowest_pa = stepper_.At(theta_end, s);
  const auto slope = [&](double theta) { return stepper_.SlopeAt(theta, s); };
  if (slope(0.0) < 0.0 && slope(theta_end) > 0.0) {
    const double theta =
        RootBetween(slope, 0.0, slope(0.0), theta_end, slope(theta_end), kThetaTolerance);
    lowest_pa = std::min(lowest_pa, stepper_.At(theta, s));
  }
  for (const Valve& valve : valves_) {
    if (valve.stroke < 0) continue;
    double& lowest =
        response_.strokes[static_cast<std::size_t>(valve.stroke)].source_lowest_pressure_pa;
    lowest = std::min(lowest, lowest_pa);
  }
}

void Run::TakeState(const Event& event) {
  if (event.theta > 1.0) {
    std::copy(stepper_.state().begin(), stepper_.state().end(), y_.begin());
    t_s_ = stepper_.time();
    return;
  }
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] = stepper_.At(event.theta, i);
  t_s_ = stepper_.start_time() + event.theta * stepper_.step();
  if (event.group >= 0) {
    const auto i = static_cast<std::size_t>(event.group);
    y_[i] = rig_.groups[i].chamber.operating_pressure_pa;
  } else {
    y_[system_.source()] = system_.pump_limit_pa();
  }
}

void Run::SampleTo(double time_s, SampleFrom from) {
  while (response_.t_s.size() < sample_count_) {
    const std::size_t k = response_.t_s.size();
    const double sample_s =
        k + 1 == sample_count_ ? options_.end_s : static_cast<double>(k) / options_.sample_hz;
    if (sample_s > time_s) return;
    const auto state_at_sample = [&](std::size_t i) {
      if (from == SampleFrom::kRest) return y_[i];
      return stepper_.At((sample_s - stepper_.start_time()) / stepper_.step(), i);
    };
    response_.t_s.push_back(sample_s);
    for (std::size_t i = 0; i < system_.groups(); ++i) {
      const Chamber& chamber = rig_.groups[i].chamber;
      const double pressure_pa = state_at_sample(i);
      response_.groups[i].pressure_pa.push_back(pressure_pa);
      response_.groups[i].volume_m3.push_back(Volume(chamber, pressure_pa) -
                                              chamber.dead_volume_m3);
    }
    if (system_.has_source()) {
      response_.source_pressure_pa.push_back(state_at_sample(system_.source()));
    }
  }
}

}  // namespace plenum::model
