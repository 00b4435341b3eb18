// The rig that the simulator runs, the options of a run, and its response, as values.
#ifndef PLENUM_MODEL_SIMULATE_SIMULATE_RIG_H_
#define PLENUM_MODEL_SIMULATE_SIMULATE_RIG_H_

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/effects/effect.h"
#include "model/flow/iso6358.h"
#include "model/physics/air.h"
#include "model/physics/chamber.h"
#include "model/physics/compressor.h"
#include "model/simulate/told/driven_source.h"
#include "model/simulate/told/told.h"

namespace plenum::model {

enum class ValveState { kHold, kInflate, kDeflate };
inline constexpr std::size_t kValveStates = 3;

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
      schedule;  // times not falling; before the first command the valve holds. Commands before 0
                 // set the valve's position at the start and make no stroke
  bool close_at_operating = false;  // an inflating valve closes when p_op is reached
  bool close_at_low = false;        // a deflating one when the chamber's low pressure is
  double initial_pressure_pa = kReferencePressurePa;
  double initial_temperature_k = 0.0;  // matters to heat_transfer alone; 0: the ambient's
  bool blocked = false;                // the volume stays at the rest volume
  // Elements between source and the inlet sensor (after the valve, before the tube), the same ones
  // on the way out; 0: no such sensor.
  std::size_t inlet_after = 0;
  std::vector<Effect> effects;
  Told told;
};

// Always open between the actuators of two groups, each of one actuator and not mirrored.
struct Link {
  std::size_t from = 0, to = 0;         // groups
  std::vector<FlowElement> fill, back;  // in the order crossed from `from` to `to`, and back
};

struct NoSource {};

struct RegulatedSource {
  double pressure_pa = 0.0;
  std::optional<FlowElement> regulator = std::nullopt;                 // shared by all lines
  double flow_max_m3_per_s = std::numeric_limits<double>::infinity();  // ANR, all lines together
};

struct ReservoirSource {
  double volume_m3 = 0.0;
  // The volume that counts while the pressure rises, if it differs
  // (model/strokes/reservoir_stroke.h: bounds over an interval of volumes); 0: the same.
  double volume_rising_m3 = 0.0;
  double initial_pressure_pa = 0.0;
  CompressorCurve compressor = {};  // empty curves: none
  int compressor_count = 1;
  double duty = 1.0;  // factor on the delivery, a mean over fast switching
  // The compressor stops when the reservoir reaches this and runs again as soon as it falls.
  double stop_pressure_pa = std::numeric_limits<double>::infinity();
};

// Pumps that feed the lines themselves. What lies between them and the valves has no volume: its
// pressure is where the pumps deliver what the lines take,
//   duty·n·Q_c(p_n) = Σ n_i·Q_i(p_n, p_i).
// They run while a valve is open to inflate, and nothing flows back through them.
struct PumpSource {
  CompressorCurve compressor;
  int compressor_count = 1;
  double duty = 1.0;  // factor on the delivery, a mean over fast switching
};

using Source = std::variant<NoSource, RegulatedSource, ReservoirSource, DrivenSource, PumpSource>;

// Evacuated actuators (chamber.h): all groups of a rig are, or none. Source and initial pressures
// are then mirror images, too, elements stand in the order crossed from the actuator to the source
// (`fill`) and from the surroundings to the actuator (`exhaust`), and what a pump delivers is what
// it takes in. The gas inside counts as a lack of it, below 0. Effects and inlet sensors have no
// meaning there.
struct Rig {
  Ambient ambient;
  Gas gas = Gas::kAir;
  bool dense = false;  // too dense to be ideal (flow/dense_gas.h): not of evacuated actuators
  double exhaust_pressure_pa = 0.0;  // what lines open into when they deflate; 0: the ambient's
  Source source;
  std::vector<GroupRig> groups;
  std::vector<Link> links = {};  // of gas that is not dense
};

// What a group deflates into: its own pressure, the rig's, or the ambient one.
inline const double& ExhaustOf(const Rig& rig, const GroupRig& group) {
  if (group.chamber.exhaust_pressure_pa > 0.0) return group.chamber.exhaust_pressure_pa;
  return rig.exhaust_pressure_pa > 0.0 ? rig.exhaust_pressure_pa : rig.ambient.pressure_pa;
}

// Whether it holds gas from kDenseFromPa (flow/dense_gas.h) on.
bool IsDense(const Rig& rig);

// Whether what moves by itself, the groups' valves or the source (`driven`), jumps nowhere, nor its
// rate in the equations.
bool MovesSmoothly(const Rig& rig, bool driven);

// kAutomatic: Dormand–Prince, and CVODE where that turns out stiff. kDamped: Dormand–Prince, and a
// linearly implicit method (rosenbrock.h) where fast modes take its steps; what rings too fast to
// move the actuators' pressures is then damped. kImplicit: that method from the start. With
// sensitivities it stands for CVODE too.
enum class Integrator { kAutomatic, kDormandPrince, kCvode, kDamped, kImplicit };

// What a run keeps beside its samples: strokes and the accounts of gas and energy (kAll), or
// nothing (kSamples); kPressures samples only what pressure sensors read: actuator and source.
enum class Record { kAll, kSamples, kPressures };

struct SimulateOptions {
  double end_s = 0.0;
  double sample_hz = 0.0;              // 0: no samples, only strokes and balances
  std::vector<double> sample_times_s;  // not falling, within the run; if any, instead of sample_hz
  double rise_fraction = 0.95;
  double fall_fraction = 0.05;
  double relative_tolerance = 1e-8;  // local error of each pressure ≤ rtol·p + atol, and of every
  double absolute_tolerance_pa = 1e-4;  // other state ≤ rtol·(its size)
  Integrator integrator = Integrator::kAutomatic;
  double linear_ratio = kLinearRatio;
  std::size_t steps_max = 2'000'000;
  std::function<bool()> cancelled;  // asked now and then; may be empty
  Record record = Record::kAll;
};

// One inflating or deflating command and what came of it. Times are from the command; +∞ where not
// reached before the next command or the end. T is double, or a dual number inside
// model/simulate/sensitivity.h.
template <class T>
struct StrokeOf {
  int group = 0;
  ValveState state = ValveState::kInflate;
  T command_s = T(0.0);
  T start_pressure_pa = T(0.0);
  T source_start_pressure_pa = T(0.0);  // at the head of the line; NaN without a source
  // Until the next command or until the valve closes at the operating pressure.
  T source_lowest_pressure_pa = T(0.0);
  T to_target_s = T(std::numeric_limits<double>::infinity());     // rise or fall fraction
  T to_operating_s = T(std::numeric_limits<double>::infinity());  // inflating only: p_op reached
};
using Stroke = StrokeOf<double>;

// kNotFinite: the step that leaves the range of the equations could not be taken at any size.
enum class SimulateStatus { kNotRun, kDone, kCancelled, kTooManySteps, kNotFinite, kInvalid };

template <class T>
struct GroupResponseOf {
  std::string name;
  std::vector<T> pressure_pa;    // at t_s
  std::vector<T> reading_pa;     // what the sensor shows, absolute; empty without a sensor effect
  std::vector<T> volume_m3;      // of the actuator without dead volume
  std::vector<T> temperature_k;  // of the gas; empty without heat_transfer
  std::vector<T> flow_m3_per_s;  // ANR, into the line of one actuator
  // Behind the first inlet_after elements; the pressure at the line's end while nothing flows.
  std::vector<T> inlet_pressure_pa;  // empty without an inlet sensor
  T final_pressure_pa = T(0.0);
  // All actuators of the group together, m³ ANR.
  T air_drawn_m3 = T(0.0);                         // from the source
  T air_in_m3 = T(0.0);                            // through the lines, in
  T air_out_m3 = T(0.0);                           // through the lines, vented
  T air_leaked_m3 = T(0.0);                        // net, leak effects
  T gas_start_m3 = T(0.0), gas_final_m3 = T(0.0);  // behind the valves
  // With heat_transfer, J: what the gas in the actuators gained and its sources.
  T energy_start_j = T(0.0), energy_final_j = T(0.0);
  T enthalpy_in_j = T(0.0), enthalpy_out_j = T(0.0), wall_heat_j = T(0.0), work_j = T(0.0);
};
using GroupResponse = GroupResponseOf<double>;

template <class T>
struct ResponseOf {
  SimulateStatus status = SimulateStatus::kNotRun;
  std::string detail;  // for any status but kDone: where and why
  std::vector<double> t_s;
  std::vector<GroupResponseOf<T>> groups;
  // At t_s; empty without a source. Of pumps without a reservoir that between them and the valves,
  // ambient while they are off.
  std::vector<T> source_pressure_pa;
  T source_final_pressure_pa = T(0.0);
  T source_lowest_pressure_pa = T(0.0);  // of the run; of a swinging source at steps' ends
  // ∫ share of time that each pump runs: the duty while on; at the stop pressure the part of it
  // that covers the draw; 0 while off.
  T compressor_on_s = T(0.0);
  T compressor_air_m3 = T(0.0);      // m³ ANR delivered
  T compressor_energy_j = T(0.0);    // electrical, all pumps
  std::vector<StrokeOf<T>> strokes;  // in order of their commands
  std::size_t steps = 0;
  bool stiff = false;  // CVODE took over
};
using Response = ResponseOf<double>;

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_SIMULATE_RIG_H_
