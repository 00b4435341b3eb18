// A unit in motion: it takes the commands of its valves and, where they are imposed, the volumes of
// its actuators, and goes on from one communication point to the next.
#ifndef PLENUM_FMU_UNIT_RUN_H_
#define PLENUM_FMU_UNIT_RUN_H_

#include <vector>

#include "fmu/fmu_unit.h"
#include "model/simulate/simulate_run.h"

namespace plenum::fmu {

// What the robot's side says of an actuator, held from one communication point to the next.
struct ActuatorInput {
  int command = 0;         // 1 inflate, 0 hold, −1 deflate
  double volume_m3 = 0.0;  // without the tube's; 0: the law of the requirements
  bool operator==(const ActuatorInput&) const = default;
};

struct ActuatorOutput {
  double pressure_pa = 0.0;    // absolute, also of an evacuated one
  double flow_m3_per_s = 0.0;  // ANR, into it, mean over the last step; below 0 out of it
  double volume_m3 = 0.0;      // without the tube's
};

// A value: a copy goes on by itself from the same state.
//
// Between two points all is as in model/simulate: events (a valve that closes at the operating
// pressure, pumps that stop and start, choked flow) are located inside, and the step before does
// not show in the next but by the state. A volume that is imposed stays as it is during a step;
// where it changes at a point, the gas inside is conserved and the pressure follows at once, p·V:
// an error of the first order in the step for an actuator that moves meanwhile. A valve that cannot
// hold stays as it is when told to, venting at the start.
class UnitRun {
 public:
  explicit UnitRun(const Unit& unit);

  std::vector<ActuatorInput> inputs;
  bool close_at_operating = true;  // valves that hold close at the operating pressure by themselves

  // To the start: full source, all actuators at ambient pressure, nothing used.
  void Reset();
  // One communication step, s, above 0. False where the simulator gave up; why is in `detail`.
  bool Step(double step_s);

  const std::vector<ActuatorOutput>& outputs() const { return outputs_; }
  double source_pressure_pa() const { return source_pa_; }  // absolute
  bool has_source() const;
  double energy_used_j() const { return energy_used_j_; }  // pumps, coils, regulator
  double air_used_m3() const { return air_used_m3_; }      // ANR, by the lines from the source
  const std::string& detail() const { return detail_; }

 private:
  void Command(std::size_t actuator);
  void Impose(std::size_t actuator);
  template <class Stepper>
  model::Response Go(const model::SimulateOptions& options, bool& stiff);
  void KeepValves(const model::Response& response, std::vector<model::ValveProgress<double>> valves,
                  double step_s);
  double CoilEnergy(std::size_t actuator, const model::Response& response, double step_s) const;
  void Account(const model::Response& response, double step_s);

  const Unit* unit_;
  model::Rig rig_;           // with what is imposed, and commands on the clock of the next step
  std::vector<int> obeyed_;  // the command that each valve obeys
  std::vector<double> imposed_m3_;  // 0: none
  std::vector<double> state_;  // pressures of the actuators, then that of the reservoir, if any
  std::vector<model::ValveProgress<double>> valves_;  // empty at the start
  std::vector<model::Stroke> strokes_;                // under way
  std::vector<ActuatorOutput> outputs_;
  double source_pa_ = 0.0, energy_used_j_ = 0.0, air_used_m3_ = 0.0;
  std::string detail_;
};

}  // namespace plenum::fmu

#endif  // PLENUM_FMU_UNIT_RUN_H_
