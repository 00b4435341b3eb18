// The simulator: groups of actuators on one source, through a schedule of valve commands.
//
// States: the pressure of one actuator per group (its `count` copies move alike), the pressure of
// the reservoir if there is one, and the gas that crossed each border, so that balances can be
// checked. Base model: isothermal at the ambient temperature T_a,
//   dp_i/dt = P0·(T_a/T0)·(Q_in,i − Q_out,i) / W_i(p_i),   W = V + p·dV/dp
//   dp_s/dt = P0·(T_a/T0)·(D·n_c·Q_c(p_s) − Σ n_i·Q_in,i) / V_r
// with Q from the exact series march of each line (source pressure to actuator when inflating,
// actuator to ambient when deflating). A regulator is one element shared by all lines: the node
// behind it is where its flow equals what the lines take. Flow only ever goes source → actuator →
// ambient: a check in the line holds against a source that has fallen below the actuator.
//
// Integration: Dormand–Prince 5(4) with error control and dense output; no step crosses a switch.
// Valve commands are exact step ends; reaching the operating pressure (with close_at_operating),
// the compressor's stop and restart, and target crossings are located by root finding on the dense
// output to 1e-12 s relative to the step.
#ifndef PLENUM_MODEL_SIMULATE_H_
#define PLENUM_MODEL_SIMULATE_H_

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/air.h"
#include "model/chamber.h"
#include "model/compressor.h"
#include "model/iso6358.h"

namespace plenum::model {

enum class ValveState { kHold, kInflate, kDeflate };

struct ValveCommand {
  double time_s = 0.0;
  ValveState state = ValveState::kHold;
  bool operator==(const ValveCommand&) const = default;
};

// `cycles` cycles of inflate and deflate: inflate from (i + phase)/f for inflate_fraction/f, then
// deflate to the end of the cycle.
std::vector<ValveCommand> CycleSchedule(double frequency_hz, double inflate_fraction, int cycles,
                                        double phase = 0.0);

struct GroupRig {
  std::string name;
  int count = 1;
  Chamber chamber;
  std::vector<FlowElement> fill;     // in the order crossed from source to actuator
  std::vector<FlowElement> exhaust;  // in the order crossed from actuator to ambient
  std::vector<ValveCommand>
      schedule;                     // times not falling; before the first command the valve holds
  bool close_at_operating = false;  // an inflating valve closes when p_op is reached
  double initial_pressure_pa = kReferencePressurePa;
};

struct NoSource {};

struct RegulatedSource {
  double pressure_pa = 0.0;
  std::optional<FlowElement> regulator = std::nullopt;                 // shared by all lines
  double flow_max_m3_per_s = std::numeric_limits<double>::infinity();  // ANR, all lines together
};

struct ReservoirSource {
  double volume_m3 = 0.0;
  // The volume that counts while the pressure rises, if it differs (model/reservoir_stroke.h:
  // bounds over an interval of volumes); 0: the same.
  double volume_rising_m3 = 0.0;
  double initial_pressure_pa = 0.0;
  CompressorCurve compressor = {};  // empty curves: none
  int compressor_count = 1;
  double duty = 1.0;  // factor on the delivery, a mean over fast switching
  // The compressor stops when the reservoir reaches this and runs again as soon as it falls.
  double stop_pressure_pa = std::numeric_limits<double>::infinity();
};

using Source = std::variant<NoSource, RegulatedSource, ReservoirSource>;

struct Rig {
  Ambient ambient;
  Gas gas = Gas::kAir;
  Source source;
  std::vector<GroupRig> groups;
};

struct SimulateOptions {
  double end_s = 0.0;
  double sample_hz = 0.0;  // 0: no samples, only strokes and balances
  double rise_fraction = 0.95;
  double fall_fraction = 0.05;
  double relative_tolerance = 1e-8;  // local error of each pressure ≤ rtol·p + atol
  double absolute_tolerance_pa = 1e-4;
  double linear_ratio = kLinearRatio;
  std::size_t steps_max = 2'000'000;
  std::function<bool()> cancelled;  // asked now and then; may be empty
};

// One inflating or deflating command and what came of it. Times are from the command; +∞ where not
// reached before the next command or the end.
struct Stroke {
  int group = 0;
  ValveState state = ValveState::kInflate;
  double command_s = 0.0;
  double start_pressure_pa = 0.0;
  double source_start_pressure_pa = 0.0;  // NaN without a source
  // Until the next command or until the valve closes at the operating pressure.
  double source_lowest_pressure_pa = 0.0;
  double to_target_s = std::numeric_limits<double>::infinity();     // rise or fall fraction
  double to_operating_s = std::numeric_limits<double>::infinity();  // inflating only: p_op reached
};

enum class SimulateStatus { kNotRun, kDone, kCancelled, kTooManySteps, kNotFinite, kInvalid };

struct GroupResponse {
  std::string name;
  std::vector<double> pressure_pa;  // at t_s
  std::vector<double> volume_m3;    // of the actuator without dead volume
  double final_pressure_pa = 0.0;
  double air_in_m3 = 0.0;   // m³ ANR into all actuators of the group
  double air_out_m3 = 0.0;  // m³ ANR vented by all of them
};

struct Response {
  SimulateStatus status = SimulateStatus::kNotRun;
  std::string detail;  // for any status but kDone: where and why
  std::vector<double> t_s;
  std::vector<GroupResponse> groups;
  std::vector<double> source_pressure_pa;  // at t_s; empty without a source
  double source_final_pressure_pa = 0.0;
  // ∫ share of time that each pump runs: the duty while on; at the stop pressure the part of it
  // that covers the draw; 0 while off.
  double compressor_on_s = 0.0;
  double compressor_air_m3 = 0.0;    // m³ ANR delivered
  double compressor_energy_j = 0.0;  // electrical, all pumps
  std::vector<Stroke> strokes;       // in order of their commands
  std::size_t steps = 0;
};

// Never throws for a physical reason: the status says what happened, and on any but kDone the
// numbers up to that point stand.
Response Simulate(const Rig& rig, const SimulateOptions& options);

// Full strokes by the contract's definition, whatever the schedule: rise from ambient to
// rise_fraction of the operating gauge pressure from the source's initial state with all groups
// inflating together, fall from the operating pressure to fall_fraction of it. +∞ where not
// reached, and everywhere for a rig that Simulate refuses. end_s and sample_hz are not used.
struct FullStroke {
  double rise_time_s;
  double fall_time_s;
  double frequency_max_hz;  // 1/(rise + fall); 0 where either is never reached
};
std::vector<FullStroke> FullStrokes(const Rig& rig, const SimulateOptions& options);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_H_
