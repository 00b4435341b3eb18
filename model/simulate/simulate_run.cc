#include "model/simulate/simulate_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace plenum::model {
namespace {

constexpr std::size_t kStepsBetweenQuestions = 64, kSamplesBetweenQuestions = 4096;
// A valve counts as closed when it is this share of the tolerance away from equal pressures.
constexpr double kSettledShare = 1e-3;
// Above this relative tolerance a step may pass some points of a record, if it has many: one that
// follows its sensor's noise has, and the error control sees the bends that matter.
constexpr double kRough = 1e-5;
// Steps at the border of stability after which CVODE is the better integrator.
constexpr std::size_t kStiffSteps = 800;
// Times the tolerance to the −1/3 about twice the steps of the method that damps, of order 3.
constexpr double kDampedSteps = 10.0;
constexpr std::size_t kStiffShare = 20;  // of steps_max: a run to be damped starts anew early
// Pressures this close have arrived at the same instant.
constexpr double kTogetherShare = 1e-9;
// Nothing moves by more than this share of its size until the end: the state is steady.
constexpr double kStalledShare = 1e-6;

}  // namespace

template <class T, class Stepper>
Run<T, Stepper>::Run(const Rig& rig, const SimulateOptions& options, RunUntil until,
                     const Lift& lift)
    : rig_(rig),
      options_(options),
      until_(until),
      lift_(lift),
      system_(rig, {options.linear_ratio, options.relative_tolerance}, lift,
              until == RunUntil::kEnd && options.record == Record::kAll),
      stepper_(system_, options.relative_tolerance, options.absolute_tolerance_pa),
      y_(system_.InitialState()),
      sample_(system_.size()),
      valves_(rig.groups.size()) {
  response_.groups.resize(rig.groups.size());
  if (!options.sample_times_s.empty()) {
    sample_count_ = options.sample_times_s.size();
  } else if (options.sample_hz > 0.0) {
    sample_count_ =
        1 + static_cast<std::size_t>(std::ceil(options.end_s * options.sample_hz * (1.0 - 1e-12)));
  }
  response_.t_s.reserve(sample_count_);
  if (system_.has_source()) response_.source_pressure_pa.reserve(sample_count_);
  for (std::size_t i = 0; i < rig.groups.size(); ++i) {
    response_.groups[i].name = rig.groups[i].name;
    response_.groups[i].pressure_pa.reserve(sample_count_);
  }
}

template <class T, class Stepper>
void Run<T, Stepper>::Resume(std::vector<ValveProgress<T>> valves,
                             std::vector<StrokeOf<T>> strokes) {
  valves_ = std::move(valves);
  response_.strokes = std::move(strokes);
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    system_.filling(i) = valves_[i].filling;
    system_.venting(i) = valves_[i].venting;
  }
}

template <class T, class Stepper>
std::vector<ValveProgress<T>> Run<T, Stepper>::final_valves() const {
  std::vector<ValveProgress<T>> valves = valves_;
  for (std::size_t i = 0; i < valves.size(); ++i) {
    valves[i].filling = system_.filling(i);
    valves[i].venting = system_.venting(i);
  }
  return valves;
}

template <class T, class Stepper>
ResponseOf<T> Run<T, Stepper>::Execute(std::span<const T> start) {
  std::copy(start.begin(), start.end(), y_.begin());
  response_.status = SimulateStatus::kDone;
  system_.Look(t_s_, y_);
  response_.source_lowest_pressure_pa = system_.SourcePressure(t_s_, y_);
  for (std::size_t i = 0; i < system_.groups(); ++i) {
    response_.groups[i].gas_start_m3 = system_.Stored(i, y_);
    response_.groups[i].energy_start_j = system_.Energy(i);
  }
  ApplySwitches();
  SampleTo(0.0, SampleFrom::kRest);
  while (!IsDue(options_.end_s, ValueOf(t_s_)) && IntegrateTo(NextBoundary())) ApplySwitches();
  RecordEnd();
  return std::move(response_);
}

// All commands and movements of valves that are due.
template <class T, class Stepper>
void Run<T, Stepper>::ApplySwitches() {
  bool switched = false;
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const auto& schedule = rig_.groups[i].schedule;
    Valve& valve = valves_[i];
    while (valve.next_command < schedule.size() &&
           IsDue(schedule[valve.next_command].time_s, ValueOf(t_s_))) {
      Command(i, schedule[valve.next_command++]);
    }
    while (valve.next_move < schedule.size()) {
      const ValveCommand& command = schedule[valve.next_move];
      const T at_s = lift_.operator()<T>(command.time_s) + system_.valve_delay_s(i);
      if (!IsDue(ValueOf(at_s), ValueOf(t_s_))) break;
      SwitchAt(i, at_s, [&] { Move(i, command.state, at_s); });
      switched = true;
      ++valve.next_move;
    }
    if (valve.close_at_s && IsDue(ValueOf(*valve.close_at_s), ValueOf(t_s_))) {
      SwitchAt(i, *valve.close_at_s, [&] { system_.filling(i).Turn(*valve.close_at_s, 0.0); });
      valve.close_at_s.reset();
      switched = true;
    }
    // A valve that was closed at equal pressures may have something to pass again.
    system_.set_settled(i, false);
  }
  // At a point of a record alone the step goes on as it was.
  smooth_ = MovesSmoothly(rig_, system_.driven()) && !switched && response_.steps > 0;
}

// Switches that fall together keep their own derivatives: between the instant of one and that of
// another the state follows the slopes of before.
template <class T, class Stepper>
template <class Change>
void Run<T, Stepper>::SwitchAt(std::size_t group, const T& at_s, const Change& change) {
  if constexpr (kIsDual<T>) {
    if (at_s.v != t_s_.v) {
      const T apart_s(0.0, at_s.v - t_s_.v);
      std::vector<T> before(y_.size()), after(y_.size());
      system_(t_s_, y_, before);
      change();
      system_.set_settled(group, false);
      system_(t_s_, y_, after);
      for (std::size_t i = 0; i < y_.size(); ++i) {
        y_[i] += (before[i].a - after[i].a) * apart_s;
      }
      return;
    }
  }
  change();
}

template <class T, class Stepper>
void Run<T, Stepper>::Move(std::size_t group, ValveState state, const T& at_s) {
  system_.filling(group).Turn(at_s, state == ValveState::kInflate ? 1.0 : 0.0);
  system_.venting(group).Turn(at_s, state == ValveState::kDeflate ? 1.0 : 0.0);
}

template <class T, class Stepper>
void Run<T, Stepper>::Command(std::size_t group, const ValveCommand& command) {
  Valve& valve = valves_[group];
  valve.state = command.state;
  valve.stroke = -1;
  valve.target_pending = valve.operating_pending = false;
  if (command.state == ValveState::kHold || command.time_s < 0.0 || !FollowsStrokes(group)) return;

  const T source_pa = system_.has_source() ? system_.HeadPressure(group, t_s_, y_)
                                           : T(std::numeric_limits<double>::quiet_NaN());
  valve.stroke = static_cast<int>(response_.strokes.size());
  StrokeOf<T>& stroke = response_.strokes.emplace_back();
  stroke.group = static_cast<int>(group);
  stroke.state = command.state;
  stroke.command_s = lift_.operator()<T>(command.time_s);
  stroke.start_pressure_pa = y_[system_.pressure(group)];
  stroke.source_start_pressure_pa = stroke.source_lowest_pressure_pa = source_pa;
  const bool inflate = command.state == ValveState::kInflate;
  const double fraction = inflate ? options_.rise_fraction : options_.fall_fraction;
  const GroupSetup<T>& setup = system_.setup(group);
  const double low_pa = rig_.groups[group].chamber.low_pressure_pa;
  const T rest_pa = inflate || low_pa == 0.0 ? setup.ambient_pressure_pa : T(low_pa);
  valve.target_pa = rest_pa + fraction * (setup.operating_pressure_pa - rest_pa);
  valve.target_pending = true;
  valve.operating_pending = inflate;
}

template <class T, class Stepper>
T Run<T, Stepper>::NextBoundary() const {
  T boundary_s(options_.end_s);
  const bool rough = options_.relative_tolerance > kRough;
  const auto consider = [&](const T& time_s) {
    if (!IsDue(ValueOf(time_s), ValueOf(t_s_)) && time_s < boundary_s) boundary_s = time_s;
  };
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const auto& schedule = rig_.groups[i].schedule;
    const Valve& valve = valves_[i];
    if (valve.next_command < schedule.size()) {
      consider(lift_.operator()<T>(schedule[valve.next_command].time_s));
    }
    if (valve.next_move < schedule.size()) {
      consider(lift_.operator()<T>(schedule[valve.next_move].time_s) + system_.valve_delay_s(i));
    }
    if (valve.close_at_s) consider(*valve.close_at_s);
    consider(system_.filling(i).EndTime());
    consider(system_.venting(i).EndTime());
    consider(NextPointOf(rig_.groups[i].told, ValueOf(t_s_), system_.valve_delay_s(i), rough));
  }
  if (const auto* driven = std::get_if<DrivenSource>(&rig_.source))
    consider(T(NextPointOfCourse(driven->time_s, ValueOf(t_s_), rough)));
  return boundary_s;
}

template <class T, class Stepper>
bool Run<T, Stepper>::IntegrateTo(const T& boundary_s) {
  while (t_s_ < boundary_s) {
    for (std::size_t i = 0; i < valves_.size(); ++i) CheckTargets(i);
    // A valve that closes after its delay adds a boundary of its own.
    if (NextBoundary() < boundary_s) return true;
    ChoosePumpState();
    CloseSettledValves();
    if (until_ == RunUntil::kTargets && TargetsDecided()) return false;
    system_.Settle(t_s_, y_);
    AddGuards();
    stepper_.Start(t_s_, y_, smooth_);
    if (AtRest()) {
      SampleTo(ValueOf(boundary_s), SampleFrom::kRest);
      t_s_ = boundary_s;
      break;
    }
    smooth_ = true;
    for (bool cut = false; !cut && t_s_ < boundary_s;) {
      if (!StepsLeft() || !TakeStep(boundary_s)) return false;
      cut = stepper_.event().has_value();
      if (cut) smooth_ = !TakeEvent(*stepper_.event());
      if (CloseSettledValves()) cut = true, smooth_ = false;
      if (until_ == RunUntil::kTargets && (TargetsDecided() || Stalled())) return false;
    }
  }
  return true;
}

template <class T, class Stepper>
bool Run<T, Stepper>::StepsLeft() {
  if (response_.steps >= options_.steps_max) {
    return Fail(SimulateStatus::kTooManySteps,
                "more than " + std::to_string(options_.steps_max) + " steps");
  }
  if (Cancelled()) return Fail(SimulateStatus::kCancelled, "cancelled");
  const bool damped = options_.integrator == Integrator::kDamped;
  const auto held_down = static_cast<std::size_t>(damped ? stepper_.steps_in_fast_modes()
                                                         : stepper_.steps_at_stability());
  std::size_t bound = kStiffSteps;
  if (damped) {
    const double worth = kDampedSteps / std::cbrt(options_.relative_tolerance);
    bound = std::min({bound, options_.steps_max / kStiffShare, static_cast<std::size_t>(worth)});
  }
  if (options_.integrator != Integrator::kDormandPrince && held_down > bound) {
    stiff_ = true;
    return Fail(SimulateStatus::kTooManySteps, "steps held down by stability");
  }
  return true;
}

template <class T, class Stepper>
bool Run<T, Stepper>::Cancelled() {
  const std::size_t samples = response_.t_s.size();
  const bool due = response_.steps % kStepsBetweenQuestions == 0 ||
                   samples >= samples_at_question_ + kSamplesBetweenQuestions;
  if (!due || !options_.cancelled) return false;
  samples_at_question_ = samples;
  return options_.cancelled();
}

template <class T, class Stepper>
bool Run<T, Stepper>::TakeStep(const T& boundary_s) {
  ++response_.steps;
  if (stepper_.Step(boundary_s) == StepOutcome::kNotFinite) {
    return Fail(SimulateStatus::kNotFinite,
                "the equations leave their range (volume or its slope not positive, or a pressure "
                "not finite)");
  }
  RecordSourceLowest();
  SampleTo(ValueOf(stepper_.time()), SampleFrom::kStep);
  std::copy(stepper_.state().begin(), stepper_.state().end(), y_.begin());
  const bool whole = !stepper_.event() && ValueOf(stepper_.time()) >= ValueOf(boundary_s);
  t_s_ = whole ? boundary_s : stepper_.time();
  return true;
}

// Nothing changes by itself until the boundary.
template <class T, class Stepper>
bool Run<T, Stepper>::AtRest() const {
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    if (system_.Moving(i, ValueOf(t_s_))) return false;
    if (system_.driven() && system_.Fed(i, ValueOf(t_s_))) return false;
  }
  const auto slope = stepper_.slope();
  return std::all_of(slope.begin(), slope.end(), [](const T& s) { return IsZero(s); });
}

template <class T, class Stepper>
bool Run<T, Stepper>::TakeEvent(std::size_t event) {
  const Guard<T> guard = system_.guards()[event];
  switch (guard.kind) {
    case GuardKind::kKink:
      system_.PassKink(guard);
      return false;
    case GuardKind::kTarget: {
      Valve& valve = valves_[guard.group];
      StrokeOf<T>& stroke = StrokeOfValve(valve);
      stroke.to_target_s = t_s_ - stroke.command_s;
      valve.target_pending = false;
      return false;
    }
    case GuardKind::kOperating:
      y_[system_.pressure(guard.group)] = guard.level;
      CheckTargets(guard.group);
      return guard.sign < 0.0 || rig_.groups[guard.group].close_at_operating;
    case GuardKind::kPumpLimit:
      y_[*system_.source_state()] = guard.level;
      return true;
    case GuardKind::kPumpDemand:
      demand_exceeds_ = true;
      return true;
    case GuardKind::kEffect:
      return true;
  }
  return true;
}

// Guards of what the run itself watches.
template <class T, class Stepper>
void Run<T, Stepper>::AddGuards() {
  std::vector<Guard<T>>& guards = system_.guards();
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const Valve& valve = valves_[i];
    if (valve.stroke < 0) continue;
    const double sign = valve.state == ValveState::kInflate ? 1.0 : -1.0;
    if (valve.target_pending) guards.push_back({GuardKind::kTarget, i, 0, sign, valve.target_pa});
    if (valve.operating_pending) {
      guards.push_back({GuardKind::kOperating, i, 0, 1.0, system_.setup(i).operating_pressure_pa});
    }
    const GroupRig& rig = rig_.groups[i];
    if (sign < 0.0 && rig.close_at_low)
      guards.push_back({GuardKind::kOperating, i, 0, sign, T(rig.chamber.low_pressure_pa)});
  }
  const PumpState pump = system_.pump();
  if (pump == PumpState::kRunning || pump == PumpState::kStopped) {
    const double sign = pump == PumpState::kRunning ? 1.0 : -1.0;
    guards.push_back({GuardKind::kPumpLimit, 0, 0, sign, system_.pump_limit_pa()});
  }
  if (pump == PumpState::kHolding) guards.push_back({GuardKind::kPumpDemand});
}

template <class T, class Stepper>
double Run<T, Stepper>::Tolerance(double pressure_pa) const {
  return ErrorBound(pressure_pa, 0.0, options_.relative_tolerance, options_.absolute_tolerance_pa);
}

template <class T, class Stepper>
bool Run<T, Stepper>::Fail(SimulateStatus status, const std::string& what) {
  std::ostringstream text;
  text.precision(12);
  text << what << " at t = " << ValueOf(t_s_) << " s";
  response_.status = status;
  response_.detail = text.str();
  return false;
}

// What holds at this instant without a step: targets already passed, valves to be closed.
template <class T, class Stepper>
void Run<T, Stepper>::CheckTargets(std::size_t group) {
  Valve& valve = valves_[group];
  if (valve.stroke < 0) return;
  StrokeOf<T>& stroke = StrokeOfValve(valve);
  const bool inflating = valve.state == ValveState::kInflate;
  const T& pressure_pa = y_[system_.pressure(group)];
  if (valve.target_pending &&
      (inflating ? pressure_pa >= valve.target_pa : pressure_pa <= valve.target_pa)) {
    stroke.to_target_s = CrossingTime(group, valve.target_pa) - stroke.command_s;
    valve.target_pending = false;
  }
  // Equal groups reach their pressure in the same step, apart by rounding.
  const double operating_pa = ValueOf(system_.setup(group).operating_pressure_pa);
  if (inflating && pressure_pa >= operating_pa * (1.0 - 1e-13)) ReachEnd(group);
  const double low_pa = rig_.groups[group].chamber.low_pressure_pa * (1.0 + 1e-13);
  if (!inflating && rig_.groups[group].close_at_low && pressure_pa <= low_pa) ReachEnd(group);
}

// At the operating pressure; a valve that deflates, at the low pressure.
template <class T, class Stepper>
void Run<T, Stepper>::ReachEnd(std::size_t group) {
  Valve& valve = valves_[group];
  StrokeOf<T>& stroke = StrokeOfValve(valve);
  const bool inflating = valve.state == ValveState::kInflate;
  const T reached_s =
      CrossingTime(group, inflating ? system_.setup(group).operating_pressure_pa
                                    : T(rig_.groups[group].chamber.low_pressure_pa));
  if (valve.operating_pending) stroke.to_operating_s = reached_s - stroke.command_s;
  valve.operating_pending = false;
  if (inflating && !rig_.groups[group].close_at_operating) return;
  valve.stroke = -1;
  valve.state = ValveState::kHold;
  const T close_s = reached_s + system_.valve_delay_s(group);
  Opening<T>& opening = inflating ? system_.filling(group) : system_.venting(group);
  if (close_s > t_s_)  // with effects, and so inflating
    valve.close_at_s = close_s;
  else
    SwitchAt(group, close_s, [&] { opening.Turn(close_s, 0.0); });
}

// Now, with the derivatives of the instant at which the group itself came to the level: groups that
// are equal in value reach it together, and only one of them ended the step there.
template <class T, class Stepper>
T Run<T, Stepper>::CrossingTime(std::size_t group, const T& level_pa) const {
  if constexpr (kIsDual<T>) {
    const std::size_t at = system_.pressure(group);
    const T left_pa = level_pa - y_[at];
    const double rate = stepper_.slope()[at].a;
    if (rate != 0.0 && std::abs(left_pa.a) <= kTogetherShare * level_pa.a) {
      return t_s_ + T(0.0, left_pa.v / rate);
    }
  }
  return t_s_;
}

template <class T, class Stepper>
void Run<T, Stepper>::ChoosePumpState() {
  if (system_.pump() == PumpState::kAbsent) return;
  const T& source_pa = y_[*system_.source_state()];
  const T& limit_pa = system_.pump_limit_pa();
  if (source_pa == limit_pa) {
    const bool covers = !demand_exceeds_ && system_.Draw(t_s_, y_) <= system_.Delivery(limit_pa);
    demand_exceeds_ = false;
    system_.set_pump(covers ? PumpState::kHolding : PumpState::kRunning);
  } else {
    system_.set_pump(source_pa < limit_pa ? PumpState::kRunning : PumpState::kStopped);
  }
}

// Valves that have nothing left to pass: they have arrived. Filling from a closed reservoir ends
// when all groups have arrived, since each one's draw moves the source of the others.
template <class T, class Stepper>
bool Run<T, Stepper>::CloseSettledValves() {
  const T source_pa = system_.SourcePressure(t_s_, y_);
  const double now_s = ValueOf(t_s_);
  const auto filling = [&](std::size_t i) { return !system_.filling(i).Closed(now_s); };
  const auto arrived = [&](std::size_t i) {
    if (!system_.settles(i) || system_.Moving(i, now_s)) return false;
    const double pressure_pa = ValueOf(y_[system_.pressure(i)]);
    const double left = ValueOf(system_.FinalPressure(i, source_pa)) - pressure_pa;
    return (filling(i) ? left : -left) <= kSettledShare * Tolerance(pressure_pa);
  };
  bool inflow_settles = !system_.source_may_rise(ValueOf(source_pa));
  if (system_.has_reservoir() && system_.pump() != PumpState::kHolding) {
    for (std::size_t i = 0; i < valves_.size(); ++i) {
      if (system_.Passing(i, now_s) && filling(i)) inflow_settles = inflow_settles && arrived(i);
    }
  }
  bool closed = false;
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    if (!system_.Passing(i, now_s) || (filling(i) && !inflow_settles) || !arrived(i)) continue;
    system_.set_settled(i, true);
    // A source that has fallen below the actuator leaves it where it is.
    T& pressure_pa = y_[system_.pressure(i)];
    const T final_pa = system_.FinalPressure(i, source_pa);
    const double apart_pa = std::abs(ValueOf(final_pa) - ValueOf(pressure_pa));
    if (apart_pa <= kSettledShare * Tolerance(ValueOf(pressure_pa))) pressure_pa = final_pa;
    closed = true;
  }
  return closed;
}

template <class T, class Stepper>
bool Run<T, Stepper>::TargetsDecided() const {
  T source_pa = system_.SourcePressure(t_s_, y_);
  if (system_.has_reservoir() && source_pa < system_.pump_limit_pa()) {
    source_pa = system_.pump_limit_pa();
  }
  for (std::size_t i = 0; i < valves_.size(); ++i) {
    const Valve& valve = valves_[i];
    if (!valve.target_pending) continue;
    const bool moves = system_.driven() || system_.Moving(i, ValueOf(t_s_)) || valve.close_at_s ||
                       valve.next_move < rig_.groups[i].schedule.size();
    if (!system_.settles(i) || moves) return false;
    if (!system_.Passing(i, ValueOf(t_s_))) continue;
    const T final_pa = system_.FinalPressure(i, source_pa);
    const bool reachable = valve.state == ValveState::kInflate ? valve.target_pa <= final_pa
                                                               : valve.target_pa >= final_pa;
    if (reachable) return false;
  }
  return true;
}

// With effects: nothing will move noticeably before the end.
template <class T, class Stepper>
bool Run<T, Stepper>::Stalled() const {
  if (ValueOf(NextBoundary()) < options_.end_s) return false;
  const double left_s = options_.end_s - ValueOf(t_s_);
  for (std::size_t i = 0; i < system_.dynamic_size(); ++i) {
    const double size = std::max(std::abs(ValueOf(y_[i])), system_.sizes()[i]);
    if (!(std::abs(ValueOf(stepper_.slope()[i])) * left_s <= kStalledShare * size)) return false;
  }
  return true;
}

template class Run<double, ExplicitIntegrator<double>>;
template class Run<double, CvodeIntegrator>;
template class Run<Dual, ExplicitIntegrator<Dual>>;
template class Run<WideDual, ExplicitIntegrator<WideDual>>;
template class Run<double, ImplicitIntegrator<double>>;
template class Run<Dual, ImplicitIntegrator<Dual>>;
template class Run<WideDual, ImplicitIntegrator<WideDual>>;

}  // namespace plenum::model
