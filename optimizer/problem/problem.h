// The design problem and its answer, as values. SI, absolute pressures.
#ifndef PLENUM_OPTIMIZER_PROBLEM_PROBLEM_H_
#define PLENUM_OPTIMIZER_PROBLEM_PROBLEM_H_

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "model/effects/effect.h"
#include "model/flow/parts.h"
#include "model/physics/air.h"
#include "model/physics/chamber.h"
#include "model/simulate/periodic.h"
#include "optimizer/problem/big_count.h"
#include "optimizer/problem/configuration.h"
#include "optimizer/problem/proof.h"

namespace plenum::optimizer {

inline constexpr double kJoulePerWattHour = 3600.0;

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

enum class NlpSolver { kIpopt, kNlopt };
const char* Name(NlpSolver solver);  // "ipopt", "nlopt"

enum class Family {
  kTubing,
  kFitting,
  kValve,
  kCompressor,
  kCylinder,
  kCo2,
  kBattery,
  kRegulator,
  kReservoir,
  kTank,  // a reservoir that is filled beforehand
  kVacuumPump,
  kManifold,  // of joints.h: no choice
  kEjector,
  kCheckValve,      // as manifolds
  kVacuumReservoir  // of the vacuum beside a pressure supply
};
const char* Name(Family family);  // as in the catalogue: "tubing", "fitting", …

// When the actuators of a group are filled (gait.h): stroke k of n begins at (phase + k/n) mod 1 of
// a period and may last `inflate_fraction` of 1/n; what is left until the next one empties them.
struct Gait {
  // In [0, 1): one for all or one an actuator; empty: Problem::simultaneous says.
  std::vector<double> phases;
  double inflate_fraction = 0.5;
  int strokes_per_period = 1;
  bool operator==(const Gait&) const = default;
};

struct ActuatorGroup {
  std::string name;
  int count = 1;
  model::Chamber chamber;  // without the tube's dead volume
  double tube_length_m = 0.0;
  int fittings_per_line = 0;
  double rise_time_max_s = kUnlimited;
  double fall_time_max_s = kUnlimited;
  double pressure_max_pa = 0.0;
  std::vector<model::Effect> effects;  // of a revised model; none: the base model
  Gait gait = {};
  std::optional<model::Chamber> least = {};  // of what tolerances allow the one that fills first
  int entry = -1;                            // in the request's list; −1: as in that of groups
  // Its part of what joins lines should pass (joints.h).
  double joint_conductance_m3_per_s_pa = 0.0;
  bool fed_past_valve = false;  // the valve only vents (pump_feed.h)
  bool held_by_pumps = false;   // pumps run on while it holds; of all groups or of none
};

struct Objective {  // weighted sum; a plain objective has one weight of 1
  double mass_kg = 0.0, volume_l = 0.0, cost_eur = 0.0, energy_wh = 0.0;
  bool operator==(const Objective&) const = default;
};

// What drives pumps, valves and regulators. Of wall or robot `batteries` has a supply without mass.
enum class PowerKind { kBattery, kWall, kRobot };
const char* Name(PowerKind kind);  // "battery", "wall", "robot"
struct Power {
  PowerKind kind = PowerKind::kBattery;
  double voltage_v = 0.0;  // of the robot
  std::optional<double> energy_wh_max, current_a_max;
};

struct Mains {
  double pressure_pa = 0.0;
  double flow_max_m3_per_s = kUnlimited;
};

// What a list holds: the best combinations of parts, or the best design of each of the best kinds
// (kind.h).
enum class ListOf { kCombinations, kKinds };
const char* Name(ListOf list);  // "combinations", "kinds"

// How many regulators follow the common source: one for all groups, one for each group, or
// whichever of the two is better (own_regulators.h).
enum class Regulation { kShared, kPerGroup, kAny };
const char* Name(Regulation regulation);  // "shared", "per_group", "any"

// What pumps without a reservoir feed, each feed by pumps of its own (pump_feed.h).
enum class PumpFeed { kShared, kPerGroup, kPerActuator };
const char* Name(PumpFeed feed);  // "shared", "per_group", "per_actuator"

struct Limits {
  // Most identical parts in parallel.
  int compressors = 2, batteries = 4, cylinders = 4, co2 = 4, reservoirs = 2;
  int per_source = 3;  // most kinds on the list with the same sources
};

// The parts are at the worst of their tolerances (model/flow/parts.h): a design that meets the
// requirements with them meets them with all numbers within. That holds of one group and of groups
// that take turns, where valves hold: parts that pass more never harm. Of one group, valves that
// cannot hold are enclosed (evaluate_strokes.cc).
struct Guarantee {
  double made_share = 0.0;  // half-width of mass and outer volume of a made-to-measure reservoir
};

struct Problem {
  std::vector<ActuatorGroup> groups;  // at least one
  double frequency_hz = 0.0;
  double actuations = 0.0;
  bool simultaneous = true;
  double rise_fraction = 0.95;
  double fall_fraction = 0.05;
  std::set<Configuration> configurations;
  Mains mains;
  Mains compressed_air;  // that ejectors take; pressure 0: there is none
  Regulation regulation = Regulation::kShared;
  PumpFeed pump_feed = PumpFeed::kShared;  // others: all configurations are direct (IsDirect)
  Power power;
  double source_pressure_max_pa = kUnlimited;
  double tank_fill_max_pa = kUnlimited;  // a tank is filled to its rating at most, too
  double rail_floor_pa = 0.0;  // vacuum pumps keep a rail at this or above; 0: there are none
  double mass_max_kg = kUnlimited, volume_max_l = kUnlimited, cost_max_eur = kUnlimited;
  bool unpriced_allowed = false;  // where cost matters: a part without a price counts as free
  model::Ambient ambient;
  Objective objective;
  Objective joints_by{.mass_kg = 1.0};  // what joints are least of (joints.h)
  Limits limits;
  std::map<Family, std::set<std::string>> require;  // only these ids; "custom" reservoir
  std::set<std::string> exclude;                    // may hold "custom"
  std::set<std::string> own;                        // at hand: these cost nothing
  bool orderable_only = false;                      // no parts that are no products
  int count = 20;
  ListOf list = ListOf::kCombinations;
  NlpSolver solver = NlpSolver::kIpopt;  // of continuous settings, the one that is asked first
  std::optional<Guarantee> guarantee;
  model::Parts parts;
};

// Whether the actuators are evacuated, all of them. All pressures of the problem, its parts and its
// designs are then mirror images at ambient (model/physics/chamber.h): so an evacuated problem is
// one of compressors, and what holds of one holds of the other.
inline bool Evacuated(const Problem& problem) {
  return !problem.groups.empty() && problem.groups.front().chamber.evacuated;
}
inline bool PumpsRail(const Problem& problem) { return problem.rail_floor_pa > 0.0; }

// Whether pumps run on while what they filled holds (pump_feed.h): then all configurations are
// direct (IsDirect).
inline bool PumpsHoldOn(const Problem& problem) {
  return !problem.groups.empty() && problem.groups.front().held_by_pumps;
}
inline void SetPumpsHoldOn(bool hold_on, Problem& problem) {
  for (ActuatorGroup& group : problem.groups) group.held_by_pumps = hold_on;
}

// What pumps there are to choose from.
inline Family PumpFamily(Configuration configuration) {
  return IsEjector(configuration)  ? Family::kEjector
         : IsVacuum(configuration) ? Family::kVacuumPump
                                   : Family::kCompressor;
}
inline const std::vector<model::Compressor>& PumpsIn(const model::Parts& parts, Family family) {
  return family == Family::kEjector      ? parts.ejectors
         : family == Family::kVacuumPump ? parts.vacuum_pumps
                                         : parts.compressors;
}
inline const std::vector<model::Compressor>& PumpsOf(const Problem& problem,
                                                     Configuration configuration) {
  return PumpsIn(problem.parts, PumpFamily(configuration));
}
inline bool IsPump(Family family) {
  return family == Family::kCompressor || family == Family::kVacuumPump ||
         family == Family::kEjector;
}

// A pressure as people count it, kPa gauge, below 0 under vacuum, and back.
double KpaGauge(const Problem& problem, double pressure_pa);
double PaFromKpaGauge(const Problem& problem, double kpa_gauge);

// JSON pointers: of a group's entry in the request, and where requests limit the pressure of a
// group and that of the source.
std::string GroupPointer(const Problem& problem, int group);
std::string PressureLimitPointer(const Problem& problem, int group);
std::string SourceLimitPointer(const Problem& problem);

// Bottles of CO2 give over a mission what their own heat allows (model::Co2Draw): of `parts` after
// the mission is known or changed.
void FollowMission(double mission_s, model::Parts& parts);
inline void FollowMission(Problem& problem) {
  FollowMission(problem.actuations / problem.frequency_hz, problem.parts);
}

// Target pressures of a group: shares of the way from ambient to the operating pressure, and back
// to where it rests.
double RiseTarget(const Problem& problem, const ActuatorGroup& group);
double FallTarget(const Problem& problem, const ActuatorGroup& group);

struct Progress {
  double seconds = 0.0;
  long long evaluated = 0;
  long long open = 0;  // nodes that wait
  std::optional<double> best;
  double lower_bound = 0.0;
  bool infeasible = false;  // it is proved; what goes on looks for the reasons
};

// Finds the periodic state of a rig: model::FindPeriodicState, unless a test takes its place.
using PeriodicSolver = std::function<model::PeriodicState(const model::Rig&, double period_s,
                                                          const model::SimulateOptions&,
                                                          const model::PeriodicOptions&)>;

struct SearchOptions {
  bool record = false;  // fill Proof::record
  double time_limit_s = 30.0;
  bool any_design = false;  // the first design found is enough; nothing is proved of it then
  std::function<bool()> cancelled;                // may be empty
  std::function<void(const Progress&)> progress;  // a few times a second; may be empty
  PeriodicSolver periodic = model::FindPeriodicState;
  // The parts that other `require` and `exclude` leave; empty: these two cannot be dropped.
  std::function<model::Parts(const Problem&)> select;
  std::size_t crowd = 16384;          // boxes that wait from which on room is saved
  double objective_max = kUnlimited;  // designs above it are of no interest
  long long steps_max = std::numeric_limits<long long>::max();  // of work, as at the time limit
};

// One row of the parts list.
struct Choice {
  Family family;
  std::string id;                         // "custom" for a made-to-measure reservoir
  int group = -1;                         // −1: shared by all; of a regulator: its own
  double quantity = 1;                    // pieces; for tubing the metres
  double mass_kg = 0.0, volume_m3 = 0.0;  // whole row, gas charge included
  std::optional<double> cost_eur = {};    // by its share of the packs that are bought (packs.h)
};

struct Settings {
  double source_pressure_pa = 0.0;  // with regulators of their own the highest of all groups
  std::optional<double> compressor_duty;
  std::optional<double> reservoir_volume_m3;
  std::vector<double> valve_duty;  // per group
  std::optional<double> tank_fill_pa = {}, pump_stop_pa = {};
  std::vector<double> group_pressure_pa = {};  // behind each group's own regulator
  std::optional<RailSettings> rail = {};
};

struct Totals {
  double mass_kg = 0.0, volume_m3 = 0.0;
  std::optional<double> cost_eur;
  double energy_j = 0.0;
  double cost_known_eur = 0.0;  // of the parts that have a price
};

// T here and below: double, or a dual number that carries derivatives (model/flow/scalar.h).
template <class T>
struct GroupPerformanceOf {
  T rise_time_s = T(0.0), fall_time_s = T(0.0);
  T inflate_time_s = T(0.0);  // to the operating pressure
  T frequency_max_hz = T(0.0);
  // Of the periodic state with effects, else 0; of a design at least the peak (closing.h).
  T highest_pressure_pa = T(0.0);
};
using GroupPerformance = GroupPerformanceOf<double>;

struct Performance {
  std::vector<GroupPerformance> groups;
  double frequency_sustained_hz = 0.0;
  double air_per_actuation_m3 = 0.0;  // ANR, mean over all actuators, tube share included
  double air_total_m3 = 0.0;  // ANR, all actuators, all cycles (and first fill of a reservoir)
  double run_time_s = 0.0;
};

template <class T>
struct MarginOf {
  std::string requirement;  // JSON pointer into the requirements
  double required = 0.0;    // in the units of the requirement's field
  T achieved = T(0.0);
  T relative_margin = T(0.0);  // ≥ 0: met
};
using Margin = MarginOf<double>;

// What is bought of a part that is sold in packs, for all its rows.
struct PackRow {
  Family family;
  std::string id;
  double quantity = 0.0;  // that the design needs; pieces, for tubing metres
  double pack = 0.0;      // that one pack holds
  double packs = 0.0;
  double cost_eur = 0.0;
  bool operator==(const PackRow&) const = default;
};

// A design of the same kind as a listed one that does nearly as well.
struct Variant {
  double objective = 0.0;
  std::vector<Choice> parts;
};

// The feasible designs of a kind within 1 % of its best, that one itself left out.
struct Variants {
  std::vector<Variant> found;  // the best first, at most 100
  bool complete = false;       // proved: there are no others
};

struct Design {
  Configuration configuration;
  std::vector<Choice> parts;
  std::vector<PackRow> packs = {};
  Settings settings;
  Totals totals;
  Performance performance;
  std::vector<Margin> margins;
  double objective = 0.0;
  struct Trace {
    std::vector<double> t_s;
    std::vector<std::vector<double>> pressure_pa;  // per squad (gait.h)
    std::vector<double> source_pressure_pa;
  } response;                             // one cycle of the periodic state
  std::optional<Variants> variants = {};  // where they were looked for
};

enum class Status { kOptimal, kFeasible, kInfeasible, kCancelled };
const char* Name(Status status);

// An entry of a conflict: a field of the request that can be dropped or loosened.
struct Conflict {
  std::string requirement;         // JSON pointer; "prices"
  std::optional<double> required;  // in the units of the field; none: it is no number
  // What it reaches while the rest of the relaxation is applied; none: nothing was found.
  std::optional<double> best;
  std::optional<double> bound;  // proved: nothing harder than this is reached
  bool proved = true;  // without it a design was found; false: time ran out before that was known
};

struct Concession {
  std::string requirement;
  std::optional<double> required, value;  // none: it is dropped
  double change = 1.0;                    // relative; 1 of what is dropped
};

// Why there is no design (conflict.h).
struct Infeasibility {
  std::vector<std::vector<Conflict>> conflicts;  // disjoint, each minimal
  std::vector<Concession> relaxation;            // makes it feasible; empty: none was found
  bool complete = false;                         // false: time ran out before all was found
};

// As FindConflicts (conflict.h): of an infeasible problem, with so much of the time limit used.
using FindConflictsFunction = std::function<Infeasibility(
    const Problem& problem, const SearchOptions& options, double used_s)>;

// The best design of some, whether or not it is on the list: of a configuration, say.
struct BestDesign {
  Configuration configuration{};
  Status status = Status::kCancelled;
  std::optional<Design> design = {};
  int rank = 0;                         // on the list; 0: it is not there
  double lower_bound = 0.0;             // of the objective of all its designs
  std::vector<Conflict> conflict = {};  // where there is none
};

struct Answer {
  Status status = Status::kCancelled;
  std::vector<Design> designs;
  std::vector<BestDesign> by_configuration = {};  // of a list of kinds
  std::optional<BestDesign> orderable = {};       // the same: of parts that are products
  Proof proof;
  bool lower_bound_prices = false;  // parts without a price counted as free
  Infeasibility infeasibility;
  double seconds = 0.0;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_PROBLEM_H_
