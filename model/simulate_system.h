// The equations that the simulator integrates, between two switches.
#ifndef PLENUM_MODEL_SIMULATE_SYSTEM_H_
#define PLENUM_MODEL_SIMULATE_SYSTEM_H_

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/regulator_node.h"
#include "model/series.h"
#include "model/simulate.h"
#include "model/simulate_line.h"

namespace plenum::model {

// What a group's valve lets through. A valve that is open but at equal pressures passes nothing and
// counts as closed until the next command.
enum class ValveFlow { kNone, kIn, kOut };

// kHolding: the reservoir is at the limit pressure and the pumps run the share of time that covers
// what the lines draw.
enum class PumpState { kAbsent, kRunning, kHolding, kStopped };

// State vector: pressure of one actuator per group; pressure of the source; per group, m³ ANR that
// crossed the valve into or out of all its actuators since its command; and the pumps' on-time,
// delivered m³ ANR and electrical energy.
class System {
 public:
  // The rig must be valid and outlive the system.
  System(const Rig& rig, double linear_ratio);

  std::size_t size() const { return 2 * groups_ + 4; }
  std::size_t groups() const { return groups_; }
  std::size_t source() const { return groups_; }
  std::size_t crossed(std::size_t group) const { return groups_ + 1 + group; }
  std::size_t pump_on() const { return 2 * groups_ + 1; }
  std::size_t pump_air() const { return 2 * groups_ + 2; }
  std::size_t pump_energy() const { return 2 * groups_ + 3; }

  std::vector<double> InitialState() const;
  void operator()(double t, std::span<const double> y, std::span<double> dydt);

  ValveFlow valve(std::size_t group) const { return valve_[group]; }
  void set_valve(std::size_t group, ValveFlow flow) { valve_[group] = flow; }
  PumpState pump() const { return pump_; }
  void set_pump(PumpState pump) { pump_ = pump; }

  // Pressure at which the pumps stop: the stop pressure or, below it, the end of their table.
  double pump_limit_pa() const { return pump_limit_pa_; }
  bool has_source() const { return regulated_ != nullptr || reservoir_ != nullptr; }
  bool has_reservoir() const { return reservoir_ != nullptr; }

  // m³/s ANR that the open lines take from the source, and what all pumps deliver while running.
  double Draw(std::span<const double> y);
  double Delivery(double source_pa) const;

  // Whether running pumps raise the source's pressure.
  bool source_may_rise(double source_pa) const;

  // Pressure that the group approaches through its open valve while the source stays as it is.
  double FinalPressure(std::size_t group, double source_pa) const;

 private:
  double AlongTable(const MonotoneCurve& table, double source_pa) const;
  double PumpPower(double source_pa) const;  // electrical, all pumps while running
  void UpdateFlows(std::span<const double> y);
  bool TakeFlowInSeries(std::size_t group, double pressure_pa);

  const Rig& rig_;
  std::size_t groups_;
  double content_rate_;  // P0·T_a/T0: Pa·m³ per m³ ANR
  const RegulatedSource* regulated_ = nullptr;
  const ReservoirSource* reservoir_ = nullptr;
  NodeSupply supply_;
  bool node_at_supply_ = true;
  double pump_limit_pa_;
  std::vector<Line> fill_, exhaust_;
  std::vector<std::optional<Series>> with_regulator_;  // regulator's share and fill line
  std::vector<ValveFlow> valve_;
  PumpState pump_ = PumpState::kAbsent;
  std::vector<double> flow_;  // per actuator
  std::vector<NodeOutlet> outlets_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_SYSTEM_H_
