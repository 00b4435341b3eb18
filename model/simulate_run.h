// One run of the simulator: integrates from switch to switch and keeps the record.
#ifndef PLENUM_MODEL_SIMULATE_RUN_H_
#define PLENUM_MODEL_SIMULATE_RUN_H_

#include <cstddef>
#include <string>
#include <vector>

#include "model/dormand_prince.h"
#include "model/simulate.h"
#include "model/simulate_system.h"

namespace plenum::model {

// When a run ends: at end_s, or already when every stroke has reached its target or cannot.
enum class RunUntil { kEnd, kTargets };

class Run {
 public:
  // Rig and options must be valid and outlive the run.
  Run(const Rig& rig, const SimulateOptions& options, RunUntil until);

  Response Execute();

 private:
  // The command that a group obeys now.
  struct Valve {
    std::size_t next_command = 0;
    ValveState state = ValveState::kHold;
    int stroke = -1;  // index into response_.strokes
    double target_pa = 0.0;
    bool target_pending = false;
    bool operating_pending = false;
  };
  // What cuts a step short.
  struct Event {
    double theta = 2.0;  // of the step; above 1: none
    int group = -1;      // closes at its operating pressure; −1: the source reaches pump_limit_pa
  };

  void ApplyCommands();
  void Command(std::size_t group, ValveState state);
  double NextBoundary() const;
  bool IntegrateTo(double boundary_s);

  void CheckTargets(std::size_t group);
  void ChoosePumpState();
  bool CloseSettledValves();
  bool TargetsDecided() const;

  DormandPrince::Outcome TryStep(double boundary_s);
  Event FirstEvent() const;
  Event SourceEvent() const;
  double CrossingTheta(std::size_t state, double level) const;
  void RecordStep(double theta_end);
  void RecordSourceLowest(double theta_end);
  void TakeState(const Event& event);

  void CollectCrossed(std::size_t group);
  // Appends the samples up to and including `time_s`, out of the last step or of y_ at rest.
  enum class SampleFrom { kStep, kRest };
  void SampleTo(double time_s, SampleFrom from);
  bool Fail(SimulateStatus status, const std::string& what);
  double InitialStep(double remaining_s) const;
  double Tolerance(double pressure_pa) const;

  const Rig& rig_;
  const SimulateOptions& options_;
  RunUntil until_;
  System system_;
  DormandPrince stepper_;
  double t_s_ = 0.0;
  std::vector<double> y_;
  std::vector<Valve> valves_;
  Response response_;
  std::size_t sample_count_ = 0;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_RUN_H_
