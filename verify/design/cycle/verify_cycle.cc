// The strokes of a design in its periodic state, by the simulator or by what it comes to where one
// group is alone on the source.
#include "verify/design/cycle/verify_cycle.h"

#include "model/simulate/simulate.h"
#include "model/strokes/reservoir_stroke.h"
#include "model/strokes/stroke.h"
#include "verify/design/cycle/verify_alone.h"
#include "verify/design/cycle/verify_open_valves.h"
#include "verify/design/cycle/verify_rig.h"
#include "verify/design/verify_tank.h"

namespace plenum::verify {
namespace {

constexpr int kCyclesMax = 2000;
constexpr double kFilled = 1e-9;    // of the pressure at which an actuator begins to vent
constexpr double kPeriodic = 1e-8;  // relative change of the source from cycle to cycle

// Pressure of an open tank when the last period of the mission begins.
double LastStart(const Problem& problem, const Settings& settings, const Assembly& assembly) {
  return settings.source_pressure_pa - FallPa(problem, assembly, problem.actuations - 1.0);
}

std::vector<double> RestingUnits(const Problem& problem) {
  std::vector<double> unit_pa;
  for (const Unit& unit : UnitsOf(problem))
    unit_pa.push_back(model::RestPa(problem.groups[unit.group].chamber));
  return unit_pa;
}

// The state at the start of a cycle that repeats; none where the simulator does not get there.
std::optional<State> Repeating(const Problem& problem, const Settings& settings,
                               const Assembly& assembly, double rising_m3, const Stop& stop) {
  State state{settings.source_pressure_pa, RestingUnits(problem)};
  const model::SimulateOptions options = OptionsOf(problem, 1.0 / problem.frequency_hz, stop);
  for (int cycle = 0; cycle < kCyclesMax; ++cycle) {
    model::Rig rig = MakeRig(problem, settings, assembly, state, 1, rising_m3);
    EmptyBeforeNext(problem, settings, assembly, rig);
    const model::Response response = model::Simulate(rig, options);
    if (response.status != model::SimulateStatus::kDone) return std::nullopt;
    State next = state;
    bool same = cycle > 0;
    if (assembly.pump()) next.source_pa = response.source_final_pressure_pa;
    same = same && Near(next.source_pa, state.source_pa, kPeriodic);
    for (std::size_t u = 0; u < next.unit_pa.size(); ++u) {
      next.unit_pa[u] = response.groups[u].final_pressure_pa;
      same = same && Near(next.unit_pa[u], state.unit_pa[u], kPeriodic);
    }
    state = std::move(next);
    if (same) return state;
  }
  return std::nullopt;
}

// What is the same for every way to the strokes: air, coils and regulator.
void AddNeeds(const Problem& problem, const Assembly& assembly, Cycle& cycle) {
  const double period_s = 1.0 / problem.frequency_hz;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const double strokes = problem.groups[g].gait.strokes_per_period;
    const model::Valve& valve = *assembly.lines[g].valve;
    const model::Chamber chamber = ChamberOf(problem.groups[g], assembly.lines[g]);
    const bool holds = model::Holds(valve.kind);
    const double full_pa = holds ? chamber.operating_pressure_pa : cycle.filled_pa[g];
    cycle.air_m3 += strokes * problem.groups[g].count *
                    model::StandardVolume(model::Content(chamber, full_pa) -
                                              model::Content(chamber, model::RestPa(chamber)),
                                          problem.ambient.temperature_k);
    const double coil_w = problem.groups[g].count * valve.coil_power_w;
    cycle.coil_w += coil_w;
    cycle.steady_j += coil_w * CoilSeconds(problem, g, holds);
    if (holds && !problem.groups[g].fed_past_valve && !PumpsHoldOn(problem))
      cycle.inflating_j += strokes * coil_w * cycle.inflate_s[g];
  }
  for (const model::Regulator* regulator : assembly.regulators) {
    cycle.coil_w += regulator->electrical_power_w;
    cycle.steady_j += regulator->electrical_power_w * period_s;
  }
}

// No time and no air, for the groups of a problem: the slowest of a group's units counts.
Cycle EmptyCycle(const Problem& problem) {
  Cycle cycle;
  cycle.rise_s.assign(problem.groups.size(), 0.0);
  cycle.inflate_s = cycle.fall_s = cycle.rise_s;
  for (const ActuatorGroup& group : problem.groups)
    cycle.filled_pa.push_back(group.chamber.operating_pressure_pa);
  return cycle;
}

void Raise(double& most, double value) { most = std::max(most, value); }

// Fall times of the rig's groups, each by itself; false where it was told to stop.
bool AddFalls(const Problem& problem, const model::Rig& rig, const Stop& stop, Cycle& cycle) {
  const std::vector<Unit> units = UnitsOf(problem);
  const std::vector<model::FullStroke> strokes =
      model::FullStrokes(rig, OptionsOf(problem, 1.0 / problem.frequency_hz, stop));
  for (std::size_t u = 0; u < units.size(); ++u) {
    if (strokes[u].status == model::SimulateStatus::kCancelled) return false;
    Raise(cycle.fall_s[units[u].group], strokes[u].fall_time_s);
  }
  return true;
}

// Whether a command only says how a window of the period before left the valve.
bool CarriedOver(const std::vector<Unit>& units, const model::Stroke& stroke) {
  return stroke.command_s == 0.0 && units[stroke.group].begins.front() > 0.0;
}

// What pumps that hold on take for a stroke once it is filled.
void HoldOn(const Problem& problem, const Assembly& assembly, const std::vector<Unit>& units,
            const model::Stroke& stroke, Cycle& cycle) {
  const Unit& unit = units[stroke.group];
  const double held_s =
      RunFor(problem, units, unit, stroke.command_s * problem.frequency_hz) - stroke.to_operating_s;
  if (!std::isfinite(held_s)) return;  // it is never full
  cycle.pump_on_s += held_s;
  cycle.pump_j += held_s * HoldingWatts(problem, assembly, unit.group);
}

// The last period out of an open tank, its strokes to their ends.
std::optional<Cycle> SimulatedLast(const Problem& problem, const Settings& settings,
                                   const Assembly& assembly, const Stop& stop) {
  const State start{LastStart(problem, settings, assembly), RestingUnits(problem)};
  const model::Rig rig = MakeRig(problem, settings, assembly, start, 1, 0.0);
  const double period_s = 1.0 / problem.frequency_hz;
  const model::Response response = model::Simulate(rig, OptionsOf(problem, 2.0 * period_s, stop));
  if (response.status != model::SimulateStatus::kDone) return std::nullopt;
  Cycle cycle = EmptyCycle(problem);
  const std::vector<Unit> units = UnitsOf(problem);
  for (const model::Stroke& stroke : response.strokes) {
    if (stroke.state != model::ValveState::kInflate || CarriedOver(units, stroke)) continue;
    const int g = units[stroke.group].group;
    Raise(cycle.rise_s[g], stroke.to_target_s);
    Raise(cycle.inflate_s[g], stroke.to_operating_s);
  }
  if (!AddFalls(problem, rig, stop, cycle)) return std::nullopt;
  AddNeeds(problem, assembly, cycle);
  return cycle;
}

std::optional<Cycle> Simulated(const Problem& problem, const Settings& settings,
                               const Assembly& assembly, double rising_m3, const Stop& stop) {
  if (IsOpen(assembly)) return SimulatedLast(problem, settings, assembly, stop);
  const std::optional<State> state = Repeating(problem, settings, assembly, rising_m3, stop);
  if (!state) return std::nullopt;
  const double period_s = 1.0 / problem.frequency_hz;
  const model::Rig rig = MakeRig(problem, settings, assembly, *state, 2, rising_m3);
  model::Rig emptied = rig;
  EmptyBeforeNext(problem, settings, assembly, emptied);
  const model::Response response =
      model::Simulate(emptied, OptionsOf(problem, 2.0 * period_s, stop));
  if (response.status != model::SimulateStatus::kDone) return std::nullopt;
  Cycle cycle = EmptyCycle(problem);
  cycle.pump_on_s = 0.5 * response.compressor_on_s;
  cycle.pump_j = 0.5 * response.compressor_energy_j;
  cycle.pump_air_m3 = 0.5 * response.compressor_air_m3;
  const std::vector<Unit> units = UnitsOf(problem);
  for (const model::Stroke& stroke : response.strokes) {
    if (CarriedOver(units, stroke)) continue;
    const int g = units[stroke.group].group;
    const bool holds = model::Holds(assembly.lines[g].valve->kind);
    if (stroke.state == model::ValveState::kDeflate && !holds)
      Raise(cycle.filled_pa[g], stroke.start_pressure_pa);
    if (stroke.state != model::ValveState::kInflate || stroke.command_s >= period_s) continue;
    Raise(cycle.rise_s[g], stroke.to_target_s);
    Raise(cycle.inflate_s[g], stroke.to_operating_s);
    if (assembly.direct() && PumpsHoldOn(problem)) HoldOn(problem, assembly, units, stroke, cycle);
  }
  if (!AddFalls(problem, rig, stop, cycle)) return std::nullopt;
  if (assembly.direct())
    cycle.node_pa = HighestNode(assembly, rig.groups, FactorOf(problem, assembly.configuration));
  FillOpenOnes(problem, settings, assembly, cycle);
  AddNeeds(problem, assembly, cycle);
  return cycle;
}

// So far on the way to the operating pressure, from ambient pressure or from where it rests.
double Target(const ActuatorGroup& group, double from_pa, double fraction) {
  return from_pa + fraction * (group.chamber.operating_pressure_pa - from_pa);
}

}  // namespace

std::optional<Cycle> SimulateCycle(const Problem& problem, const Settings& settings,
                                   const Assembly& assembly, const Stop& stop) {
  const bool own_pumps = problem.pump_feed != PumpFeed::kShared;
  if (assembly.owns() || own_pumps) {
    std::vector<std::optional<Cycle>> cycles;
    std::vector<int> feeds;
    for (int g = 0; g < static_cast<int>(assembly.lines.size()); ++g) {
      const Alone alone = AloneOf(problem, assembly, g);
      cycles.push_back(
          Simulated(alone.problem, AloneAt(PressureAt(settings, g)), alone.assembly, 0.0, stop));
      feeds.push_back(alone.feeds);
    }
    return Joined(cycles, feeds);
  }
  return Simulated(problem, settings, assembly,
                   settings.reservoir_volume_m3.value_or(0.0) + assembly.ReservoirSpread(), stop);
}

QuickCycles::QuickCycles(const Problem& problem, const Assembly& assembly, Stop stop,
                         DirectFills* fills)
    : problem_(problem),
      assembly_(assembly),
      stop_(std::move(stop)),
      units_(UnitsOf(problem)),
      direct_fills_(fills) {
  const double temperature_k = problem.ambient.temperature_k;
  const double factor = FactorOf(problem, assembly.configuration);
  fall_s_.assign(problem.groups.size(), 0.0);
  for (const Unit& unit : units_) {
    const int g = unit.group;
    const model::GroupRig rig = MakeGroup(problem, assembly, unit, 0.0, 0);
    std::vector<model::FlowElement> elements = rig.fill;
    if (!assembly.regulators.empty()) {  // each of equal lines has an equal share of it
      elements.insert(elements.begin(), assembly.regulators.front()->flow);
      elements.front().sonic_conductance_m3_per_s_pa /= rig.count;
    }
    fills_.push_back(model::MakeSeries(elements, factor));
    fall_s_[g] = model::EmptyTime(
        model::MakeSeries(rig.exhaust, factor), rig.chamber, rig.chamber.operating_pressure_pa,
        Target(problem.groups[g], model::RestPa(rig.chamber), problem.fall_fraction),
        temperature_k);
    rigs_.push_back(rig);
  }
  if (assembly.pump())
    for (std::size_t u = 0; u < fills_.size(); ++u)
      fill_tables_.emplace_back(fills_[u], model::MirrorPa(rigs_[u].chamber));
}

double QuickCycles::FillFromRegulator(const Settings& settings, int unit, Cycle& cycle) const {
  const model::GroupRig& rig = rigs_[unit];
  const int g = units_[unit].group;
  double flow_max = assembly_.regulators.front()->flow_max_m3_per_s;
  if (assembly_.configuration == Configuration::kMains)
    flow_max = std::min(flow_max, problem_.mains.flow_max_m3_per_s);
  const auto seconds = [&](double to_pa) {
    return model::FillTime(fills_[unit], rig.chamber, settings.source_pressure_pa,
                           model::RestPa(rig.chamber), to_pa, problem_.ambient.temperature_k,
                           flow_max / rig.count);
  };
  Raise(cycle.rise_s[g],
        seconds(Target(problem_.groups[g], problem_.ambient.pressure_pa, problem_.rise_fraction)));
  const double inflate_s = seconds(rig.chamber.operating_pressure_pa);
  Raise(cycle.inflate_s[g], inflate_s);
  const double open_s = FillWindow(problem_, g);
  if (rig.close_at_operating || inflate_s >= open_s) return inflate_s;
  double low_pa = rig.chamber.operating_pressure_pa, high_pa = settings.source_pressure_pa;
  const double full_s = seconds(high_pa);
  if (full_s <= open_s) low_pa = high_pa;
  while (high_pa - low_pa > kFilled * high_pa) {
    const double middle_pa = 0.5 * (low_pa + high_pa);
    (seconds(middle_pa) <= open_s ? low_pa : high_pa) = middle_pa;
  }
  Raise(cycle.filled_pa[g], low_pa);
  return std::min(full_s, open_s);
}

// A unit out of a reservoir that is full when its stroke begins; how long until it is full again.
// Where pumps cannot fill it up again before the next stroke the running time of an only unit
// passes the period, which no duty allows.
double QuickCycles::FillFromReservoir(const Settings& settings, double rising_m3, int unit,
                                      Cycle& cycle) const {
  const model::GroupRig& rig = rigs_[unit];
  const int g = units_[unit].group;
  const double strokes = problem_.groups[g].gait.strokes_per_period;
  const model::CompressorCurve& curve = assembly_.pump()->curve;
  const double temperature_k = problem_.ambient.temperature_k;
  const double source_pa = settings.source_pressure_pa;
  model::ReservoirStrokeInput input;
  input.fill = &fill_tables_[unit];
  input.chamber = &rig.chamber;
  input.count = rig.count;
  input.compressor = &curve;
  input.compressors = assembly_.compressors;
  input.stop_pa = source_pa;
  input.volume_falling_m3 = settings.reservoir_volume_m3.value_or(0.0);
  input.volume_rising_m3 = rising_m3;
  input.from_pa = problem_.ambient.pressure_pa;
  input.target_pa =
      Target(problem_.groups[g], problem_.ambient.pressure_pa, problem_.rise_fraction);
  input.operating_pa = rig.chamber.operating_pressure_pa;
  if (!rig.close_at_operating) input.open_s = FillWindow(problem_, g);
  input.temperature_k = temperature_k;
  const model::ReservoirStroke stroke = model::FillFromReservoir(input);
  if (!stroke.reached) {
    cycle.rise_s[g] = cycle.inflate_s[g] = model::kNever;
    return model::kNever;
  }
  Raise(cycle.rise_s[g], stroke.rise_s);
  Raise(cycle.inflate_s[g], stroke.inflate_s);
  Raise(cycle.filled_pa[g], stroke.chamber_end_pa);
  const double refill_s = model::PumpUpTime(curve, input.compressors, rising_m3,
                                            stroke.reservoir_end_pa, source_pa, temperature_k);
  cycle.pump_on_s += strokes * (stroke.pump_on_s + refill_s);
  cycle.pump_j += strokes * (stroke.pump_energy_j + model::EnergyToFill(curve, rising_m3,
                                                                        stroke.reservoir_end_pa,
                                                                        source_pa, temperature_k));
  cycle.pump_air_m3 +=
      strokes *
      (stroke.pump_air_m3 +
       model::StandardVolume(rising_m3 * (source_pa - stroke.reservoir_end_pa), temperature_k));
  return std::max(stroke.inflate_s, input.open_s) + refill_s;
}

// What it takes lowers the tank for the groups after it.
double QuickCycles::FillFromTank(double& tank_pa, int unit, Cycle& cycle) const {
  const model::GroupRig& rig = rigs_[unit];
  const int g = units_[unit].group;
  const auto seconds = [&](double to_pa) {
    return model::FillTimeFromReservoir(fills_[unit], rig.chamber, rig.count, TankVolume(assembly_),
                                        tank_pa, problem_.ambient.pressure_pa, to_pa,
                                        problem_.ambient.temperature_k);
  };
  const double inflate_s = seconds(rig.chamber.operating_pressure_pa);
  Raise(cycle.rise_s[g],
        seconds(Target(problem_.groups[g], problem_.ambient.pressure_pa, problem_.rise_fraction)));
  Raise(cycle.inflate_s[g], inflate_s);
  tank_pa -= StrokeAir(problem_, assembly_, g) /
             model::StandardVolume(TankVolume(assembly_), problem_.ambient.temperature_k);
  return inflate_s;
}

double QuickCycles::AddHolding(const Unit& unit, double filling_s, Cycle& cycle) const {
  const double run_s = RunSeconds(problem_, units_, unit);
  if (std::isfinite(filling_s))
    cycle.pump_j +=
        unit.feeds * (run_s - filling_s) * HoldingWatts(problem_, assembly_, unit.group);
  return run_s;
}

std::optional<Cycle> QuickCycles::EachAlone(const Settings& settings, double rising_m3) const {
  if (units_.size() < 2 || !assembly_.pump() || assembly_.direct()) return std::nullopt;
  Cycle cycle = EmptyCycle(problem_);
  cycle.fall_s = fall_s_;
  for (int u = 0; u < static_cast<int>(units_.size()); ++u)
    FillFromReservoir(settings, rising_m3, u, cycle);
  return cycle;
}

std::optional<Cycle> QuickCycles::At(const Settings& settings, double rising_m3) const {
  if (Stopped(stop_)) return std::nullopt;
  // A valve that cannot hold lets its actuators draw while others do.
  const bool open_ones = assembly_.pump() && !Holding(assembly_);
  if (units_.size() > 1 && (SomeAtOnce(problem_) || open_ones))
    return Simulated(problem_, settings, assembly_, rising_m3, stop_);
  // Each stroke out of an open tank finds less than the one before, in the order of the period.
  if (IsOpen(assembly_) &&
      !std::all_of(problem_.groups.begin(), problem_.groups.end(), [](const ActuatorGroup& group) {
        return group.gait.phases.empty() && group.gait.strokes_per_period == 1;
      }))
    return Simulated(problem_, settings, assembly_, rising_m3, stop_);
  Cycle cycle = EmptyCycle(problem_);
  cycle.fall_s = fall_s_;
  double tank_pa = IsOpen(assembly_) ? LastStart(problem_, settings, assembly_) : 0.0;
  const bool own_pumps = problem_.pump_feed != PumpFeed::kShared;
  std::vector<double> on_s(problem_.groups.size(), 0.0);  // of each feed of pumps
  for (int u = 0; u < static_cast<int>(units_.size()); ++u) {
    if (assembly_.direct()) {  // what is not over when its turn is over is refused (verify_size.h)
      const double filling_s = (direct_fills_ ? *direct_fills_ : own_fills_)
                                   .Add(problem_, assembly_, units_[u], fills_[u], cycle);
      double& feed_s = on_s[own_pumps ? units_[u].group : 0];
      feed_s += PumpsHoldOn(problem_) ? AddHolding(units_[u], filling_s, cycle) : filling_s;
      continue;
    }
    const double over_s = assembly_.pump()    ? FillFromReservoir(settings, rising_m3, u, cycle)
                          : IsOpen(assembly_) ? FillFromTank(tank_pa, u, cycle)
                                              : FillFromRegulator(settings, u, cycle);
    if (units_.size() > 1 && !(over_s <= UntilNext(problem_, units_, units_[u])))
      return Simulated(problem_, settings, assembly_, rising_m3, stop_);
  }
  if (assembly_.direct()) cycle.pump_on_s = *std::max_element(on_s.begin(), on_s.end());
  FillOpenOnes(problem_, settings, assembly_, cycle);
  AddNeeds(problem_, assembly_, cycle);
  return cycle;
}

}  // namespace plenum::verify
