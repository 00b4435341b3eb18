// One run of the simulator: integrates from switch to switch and keeps the record.
//
// simulate_record.cc: what a run writes down.
#ifndef PLENUM_MODEL_SIMULATE_SIMULATE_RUN_H_
#define PLENUM_MODEL_SIMULATE_SIMULATE_RUN_H_

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/simulate/cvode_integrator.h"
#include "model/simulate/explicit_integrator.h"
#include "model/simulate/simulate_rig.h"
#include "model/simulate/simulate_system.h"

namespace plenum::model {

// When a run ends: at end_s, or already when every stroke has reached its target or cannot. Only
// runs to the end keep the accounts of gas and energy.
enum class RunUntil { kEnd, kTargets };

// What the valve of a group is doing, on the clock of its run.
// What is due within rounding is due now: a step of a few units in the last place has no end.
inline bool IsDue(double time_s, double now_s) {
  constexpr double kSameInstant = 1e-13;
  return time_s <= now_s * (1.0 + kSameInstant);
}

template <class T>
struct ValveProgress {
  std::size_t next_command = 0, next_move = 0;  // as given, and after the valve's delay
  ValveState state = ValveState::kHold;         // that the group obeys
  int stroke = -1;                              // index into Response::strokes
  T target_pa = T(0.0);
  bool target_pending = false;
  bool operating_pending = false;
  std::optional<T> close_at_s;  // on reaching the operating pressure, after the valve's delay
  Opening<T> filling, venting;  // where a run ended, and where another goes on
};

// T is double, Dual or WideDual, Stepper ExplicitIntegrator<T>, ImplicitIntegrator<T> or
// CvodeIntegrator.
template <class T, class Stepper>
class Run {
 public:
  // Rig and options must be valid and outlive the run.
  Run(const Rig& rig, const SimulateOptions& options, RunUntil until, const Lift& lift = Lift());

  // Goes on where another run of the rig ended, instead of at valves that hold: what the valves are
  // doing, and the strokes under way, which the record then begins with.
  void Resume(std::vector<ValveProgress<T>> valves, std::vector<StrokeOf<T>> strokes);

  // `start`: pressures, effect states and source in the order of the system's state vector, in
  // place of the rig's initial ones.
  ResponseOf<T> Execute(std::span<const T> start = {});

  // The dynamic part of the state at the end.
  std::span<const T> final_state() const { return {y_.data(), system_.dynamic_size()}; }
  // What the valves are doing at the end.
  std::vector<ValveProgress<T>> final_valves() const;
  // The run gave up because stability, not accuracy, held its steps down.
  bool stiff() const { return stiff_; }

 private:
  using Valve = ValveProgress<T>;

  void ApplySwitches();
  template <class Change>
  void SwitchAt(std::size_t group, const T& at_s, const Change& change);
  void Command(std::size_t group, const ValveCommand& command);
  // Strokes are kept, or close the valve at their end.
  bool FollowsStrokes(std::size_t group) const {
    return options_.record == Record::kAll || rig_.groups[group].close_at_operating ||
           rig_.groups[group].close_at_low;
  }
  void Move(std::size_t group, ValveState state, const T& at_s);
  T NextBoundary() const;
  bool IntegrateTo(const T& boundary_s);
  bool StepsLeft();
  bool Cancelled();
  bool AtRest() const;
  bool TakeStep(const T& boundary_s);
  bool TakeEvent(std::size_t event);  // whether the equations switch there

  void AddGuards();
  void CheckTargets(std::size_t group);
  void ReachEnd(std::size_t group);
  T CrossingTime(std::size_t group, const T& level_pa) const;
  void ChoosePumpState();
  bool CloseSettledValves();
  bool TargetsDecided() const;
  bool Stalled() const;

  void RecordSourceLowest();
  void RecordEnd();
  enum class SampleFrom { kStep, kRest };
  double SampleTime(std::size_t k) const;
  void SampleTo(double time_s, SampleFrom from);
  void TakeSample(double time_s, std::span<const T> y);
  bool Fail(SimulateStatus status, const std::string& what);
  double Tolerance(double pressure_pa) const;
  StrokeOf<T>& StrokeOfValve(const Valve& valve) {
    return response_.strokes[static_cast<std::size_t>(valve.stroke)];
  }

  const Rig& rig_;
  const SimulateOptions& options_;
  RunUntil until_;
  Lift lift_;
  System<T> system_;
  Stepper stepper_;
  T t_s_ = T(0.0);
  std::vector<T> y_, sample_;
  std::vector<Valve> valves_;
  ResponseOf<T> response_;
  std::size_t sample_count_ = 0;
  std::size_t samples_at_question_ = 0;  // whether the run is cancelled
  bool demand_exceeds_ = false;  // the lines take more than pumps that hold the limit can deliver
  bool smooth_ = false;          // the last cut changed nothing at once
  bool stiff_ = false;
};

// For the linearly implicit method, which is of lower order: more steps.
inline SimulateOptions DampedOptions(SimulateOptions options) {
  options.steps_max *= 4;
  return options;
}

extern template class Run<double, ExplicitIntegrator<double>>;
extern template class Run<double, CvodeIntegrator>;
extern template class Run<Dual, ExplicitIntegrator<Dual>>;
extern template class Run<WideDual, ExplicitIntegrator<WideDual>>;
extern template class Run<double, ImplicitIntegrator<double>>;
extern template class Run<Dual, ImplicitIntegrator<Dual>>;
extern template class Run<WideDual, ImplicitIntegrator<WideDual>>;

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_SIMULATE_RUN_H_
