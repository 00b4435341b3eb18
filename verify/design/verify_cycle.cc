// The strokes of a design in its periodic state, by the simulator or by what it comes to where one
// group is alone on the source.
#include "verify/design/verify_cycle.h"

#include "model/flow/tube.h"
#include "model/simulate/simulate.h"
#include "model/strokes/reservoir_stroke.h"
#include "model/strokes/stroke.h"
#include "verify/design/verify_open_valves.h"
#include "verify/design/verify_tank.h"

namespace plenum::verify {
namespace {

constexpr int kCyclesMax = 2000;
constexpr double kFilled = 1e-9;    // of the pressure at which an actuator begins to vent
constexpr double kPeriodic = 1e-8;  // relative change of the source from cycle to cycle
// A source at the operating pressure fills up to it, much closer to equal pressures than by
// default: a straight line from 1 − 1e-7 on would still delay the end of such a stroke by a
// thousandth.
constexpr double kLinear = 1.0 - 1e-9;

model::GroupRig MakeGroup(const Problem& problem, const Assembly& assembly, int g,
                          double pressure_pa, int cycles) {
  const ActuatorGroup& group = problem.groups[g];
  const LineParts& line = assembly.lines[g];
  model::GroupRig rig;
  rig.name = group.name;
  rig.count = group.count;
  rig.chamber = ChamberOf(group, line);
  std::vector<model::FlowElement> between;  // from valve to actuator
  const model::FlowElement tube =
      model::TubeElement(line.tube->inner_diameter_m, group.tube_length_m);
  for (int i = 0; i < group.fittings_per_line; ++i) {
    if (i == (group.fittings_per_line + 1) / 2) between.push_back(tube);
    between.push_back(line.fitting->flow);
  }
  if (group.fittings_per_line < 2) between.push_back(tube);
  rig.fill = between;
  rig.fill.insert(rig.fill.begin(), line.valve->fill);
  rig.exhaust.assign(between.rbegin(), between.rend());
  rig.exhaust.push_back(line.valve->exhaust);
  rig.close_at_operating = model::Holds(line.valve->kind);
  rig.initial_pressure_pa = pressure_pa;
  const double period_s = 1.0 / problem.frequency_hz;
  const double start_s =
      problem.simultaneous ? 0.0 : period_s * g / static_cast<double>(problem.groups.size());
  if (start_s >= 0.5 * period_s) {  // the half period of the cycle before reaches into this one
    rig.schedule.push_back(
        {0.0, rig.close_at_operating ? model::ValveState::kHold : model::ValveState::kInflate});
    rig.schedule.push_back({start_s - 0.5 * period_s, model::ValveState::kDeflate});
  } else if (start_s > 0.0) {
    rig.schedule.push_back({0.0, model::ValveState::kDeflate});
  }
  for (int i = 0; i < cycles; ++i) {
    rig.schedule.push_back({start_s + i * period_s, model::ValveState::kInflate});
    rig.schedule.push_back({start_s + (i + 0.5) * period_s, model::ValveState::kDeflate});
  }
  return rig;
}

struct State {
  double source_pa = 0.0;
  std::vector<double> group_pa;
};

model::Rig MakeRig(const Problem& problem, const Settings& settings, const Assembly& assembly,
                   const State& state, int cycles, double rising_m3) {
  model::Rig rig;
  rig.ambient = problem.ambient;
  if (assembly.co2) rig.gas = model::Gas::kCo2;
  if (assembly.direct()) {
    rig.source = model::PumpSource{assembly.compressor->curve, assembly.compressors};
  } else if (assembly.compressor) {
    model::ReservoirSource source;
    source.volume_m3 = settings.reservoir_volume_m3.value_or(0.0);
    source.volume_rising_m3 = rising_m3;
    source.initial_pressure_pa = state.source_pa;
    source.compressor = assembly.compressor->curve;
    source.compressor_count = assembly.compressors;
    source.stop_pressure_pa = settings.source_pressure_pa;
    rig.source = source;
  } else if (IsOpen(assembly)) {
    model::ReservoirSource source;
    source.volume_m3 = TankVolume(assembly);
    source.initial_pressure_pa = state.source_pa;
    rig.source = source;
  } else {
    double flow_max = assembly.regulator->flow_max_m3_per_s;
    if (assembly.configuration == Configuration::kMains)
      flow_max = std::min(flow_max, problem.mains.flow_max_m3_per_s);
    rig.source =
        model::RegulatedSource{settings.source_pressure_pa, assembly.regulator->flow, flow_max};
  }
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    rig.groups.push_back(MakeGroup(problem, assembly, g, state.group_pa[g], cycles));
  return rig;
}

model::SimulateOptions OptionsOf(const Problem& problem, double end_s, const Stop& stop) {
  model::SimulateOptions options;
  options.end_s = end_s;
  options.rise_fraction = problem.rise_fraction;
  options.fall_fraction = problem.fall_fraction;
  options.linear_ratio = kLinear;
  options.cancelled = stop;
  return options;
}

double FactorOf(const Problem& problem, const Assembly& assembly) {
  return model::FlowFactor(assembly.co2 ? model::Gas::kCo2 : model::Gas::kAir) *
         std::sqrt(model::kReferenceTemperatureK / problem.ambient.temperature_k);
}

// Strokes count from ambient: an actuator that would still hold air at its next one gets a wider
// exhaust. How fast it empties is nothing to the source.
void EmptyBeforeNext(const Problem& problem, const Settings& settings, const Assembly& assembly,
                     model::Rig& rig) {
  constexpr double kShare = 0.45;  // of the period
  const double factor = FactorOf(problem, assembly);
  for (model::GroupRig& group : rig.groups) {
    const double full_pa = group.close_at_operating ? group.chamber.operating_pressure_pa
                                                    : settings.source_pressure_pa;
    const double seconds =
        model::EmptyTime(model::MakeSeries(group.exhaust, factor), group.chamber, full_pa,
                         problem.ambient.pressure_pa, problem.ambient.temperature_k);
    for (model::FlowElement& element : group.exhaust)
      element.sonic_conductance_m3_per_s_pa *=
          std::max(1.0, seconds * problem.frequency_hz / kShare);
  }
}

// Pressure of an open tank when the last period of the mission begins.
double LastStart(const Problem& problem, const Settings& settings, const Assembly& assembly) {
  return settings.source_pressure_pa - FallPa(problem, assembly, problem.actuations - 1.0);
}

// The state at the start of a cycle that repeats; none where the simulator does not get there.
std::optional<State> Repeating(const Problem& problem, const Settings& settings,
                               const Assembly& assembly, double rising_m3, const Stop& stop) {
  State state{settings.source_pressure_pa,
              std::vector<double>(problem.groups.size(), problem.ambient.pressure_pa)};
  const model::SimulateOptions options = OptionsOf(problem, 1.0 / problem.frequency_hz, stop);
  for (int cycle = 0; cycle < kCyclesMax; ++cycle) {
    model::Rig rig = MakeRig(problem, settings, assembly, state, 1, rising_m3);
    EmptyBeforeNext(problem, settings, assembly, rig);
    const model::Response response = model::Simulate(rig, options);
    if (response.status != model::SimulateStatus::kDone) return std::nullopt;
    State next = state;
    bool same = cycle > 0;
    if (assembly.compressor) next.source_pa = response.source_final_pressure_pa;
    same = same && Near(next.source_pa, state.source_pa, kPeriodic);
    for (std::size_t g = 0; g < next.group_pa.size(); ++g) {
      next.group_pa[g] = response.groups[g].final_pressure_pa;
      same = same && Near(next.group_pa[g], state.group_pa[g], kPeriodic);
    }
    state = std::move(next);
    if (same) return state;
  }
  return std::nullopt;
}

// What is the same for every way to the strokes: air, coils and regulator.
void AddNeeds(const Problem& problem, const Assembly& assembly, Cycle& cycle) {
  const double period_s = 1.0 / problem.frequency_hz;
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const model::Valve& valve = *assembly.lines[g].valve;
    const model::Chamber chamber = ChamberOf(problem.groups[g], assembly.lines[g]);
    const bool holds = model::Holds(valve.kind);
    const double full_pa = holds ? chamber.operating_pressure_pa : cycle.filled_pa[g];
    cycle.air_m3 += problem.groups[g].count *
                    model::StandardVolume(model::Content(chamber, full_pa) -
                                              model::Content(chamber, problem.ambient.pressure_pa),
                                          problem.ambient.temperature_k);
    const double coil_w = problem.groups[g].count * valve.coil_power_w;
    cycle.coil_w += coil_w;
    cycle.steady_j += coil_w * 0.5 * period_s;
    if (holds) cycle.inflating_j += coil_w * cycle.inflate_s[g];
  }
  if (assembly.regulator) {
    cycle.coil_w += assembly.regulator->electrical_power_w;
    cycle.steady_j += assembly.regulator->electrical_power_w * period_s;
  }
}

// Times without end and no air, for the groups of a problem.
Cycle EmptyCycle(const Problem& problem) {
  Cycle cycle;
  cycle.rise_s.assign(problem.groups.size(), model::kNever);
  cycle.inflate_s = cycle.rise_s;
  for (const ActuatorGroup& group : problem.groups)
    cycle.filled_pa.push_back(group.chamber.operating_pressure_pa);
  return cycle;
}

// Fall times of the rig's groups, each by itself; false where it was told to stop.
bool AddFalls(const Problem& problem, const model::Rig& rig, const Stop& stop, Cycle& cycle) {
  for (const model::FullStroke& stroke :
       model::FullStrokes(rig, OptionsOf(problem, 1.0 / problem.frequency_hz, stop))) {
    if (stroke.status == model::SimulateStatus::kCancelled) return false;
    cycle.fall_s.push_back(stroke.fall_time_s);
  }
  return true;
}

// The last period out of an open tank, its strokes to their ends.
std::optional<Cycle> SimulatedLast(const Problem& problem, const Settings& settings,
                                   const Assembly& assembly, const Stop& stop) {
  const State start{LastStart(problem, settings, assembly),
                    std::vector<double>(problem.groups.size(), problem.ambient.pressure_pa)};
  const model::Rig rig = MakeRig(problem, settings, assembly, start, 1, 0.0);
  const double period_s = 1.0 / problem.frequency_hz;
  const model::Response response = model::Simulate(rig, OptionsOf(problem, 1.5 * period_s, stop));
  if (response.status != model::SimulateStatus::kDone) return std::nullopt;
  Cycle cycle = EmptyCycle(problem);
  for (const model::Stroke& stroke : response.strokes) {
    if (stroke.state != model::ValveState::kInflate) continue;
    cycle.rise_s[stroke.group] = stroke.to_target_s;
    cycle.inflate_s[stroke.group] = stroke.to_operating_s;
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
  for (const model::Stroke& stroke : response.strokes) {
    const bool carried_over = stroke.command_s == 0.0 && !problem.simultaneous && stroke.group > 0;
    if (stroke.state == model::ValveState::kDeflate && !carried_over)  // the last one counts
      cycle.filled_pa[stroke.group] = stroke.start_pressure_pa;
    if (stroke.state != model::ValveState::kInflate || stroke.command_s >= period_s || carried_over)
      continue;
    cycle.rise_s[stroke.group] = stroke.to_target_s;
    cycle.inflate_s[stroke.group] = stroke.to_operating_s;
  }
  if (!AddFalls(problem, rig, stop, cycle)) return std::nullopt;
  cycle.pump_on_s = 0.5 * response.compressor_on_s;
  cycle.pump_j = 0.5 * response.compressor_energy_j;
  cycle.pump_air_m3 = 0.5 * response.compressor_air_m3;
  if (assembly.direct())
    cycle.node_pa = HighestNode(assembly, rig.groups, FactorOf(problem, assembly));
  FillOpenOnes(problem, settings, assembly, cycle);
  AddNeeds(problem, assembly, cycle);
  return cycle;
}

double Target(const Problem& problem, const ActuatorGroup& group, double fraction) {
  const double ambient_pa = problem.ambient.pressure_pa;
  return ambient_pa + fraction * (group.chamber.operating_pressure_pa - ambient_pa);
}

}  // namespace

std::optional<Cycle> SimulateCycle(const Problem& problem, const Settings& settings,
                                   const Assembly& assembly, const Stop& stop) {
  return Simulated(problem, settings, assembly,
                   settings.reservoir_volume_m3.value_or(0.0) + assembly.ReservoirSpread(), stop);
}

QuickCycles::QuickCycles(const Problem& problem, const Assembly& assembly, Stop stop,
                         DirectFills* fills)
    : problem_(problem), assembly_(assembly), stop_(std::move(stop)), direct_fills_(fills) {
  const double temperature_k = problem.ambient.temperature_k;
  const double factor = FactorOf(problem, assembly);
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const model::GroupRig rig = MakeGroup(problem, assembly, g, 0.0, 0);
    std::vector<model::FlowElement> elements = rig.fill;
    if (assembly.regulator) {  // each of equal lines has an equal share of it
      elements.insert(elements.begin(), assembly.regulator->flow);
      elements.front().sonic_conductance_m3_per_s_pa /= rig.count;
    }
    fills_.push_back(model::MakeSeries(elements, factor));
    fall_s_.push_back(model::EmptyTime(
        model::MakeSeries(rig.exhaust, factor), rig.chamber, rig.chamber.operating_pressure_pa,
        Target(problem, problem.groups[g], problem.fall_fraction), temperature_k));
    rigs_.push_back(rig);
  }
  if (assembly.compressor)
    for (const model::Series& fill : fills_) fill_tables_.emplace_back(fill);
}

double QuickCycles::FillFromRegulator(const Settings& settings, int g, Cycle& cycle) const {
  const model::GroupRig& rig = rigs_[g];
  double flow_max = assembly_.regulator->flow_max_m3_per_s;
  if (assembly_.configuration == Configuration::kMains)
    flow_max = std::min(flow_max, problem_.mains.flow_max_m3_per_s);
  const auto seconds = [&](double to_pa) {
    return model::FillTime(fills_[g], rig.chamber, settings.source_pressure_pa,
                           problem_.ambient.pressure_pa, to_pa, problem_.ambient.temperature_k,
                           flow_max / rig.count);
  };
  cycle.rise_s[g] = seconds(Target(problem_, problem_.groups[g], problem_.rise_fraction));
  cycle.inflate_s[g] = seconds(rig.chamber.operating_pressure_pa);
  const double half_s = 0.5 / problem_.frequency_hz;
  if (rig.close_at_operating || cycle.inflate_s[g] >= half_s) return cycle.inflate_s[g];
  double low_pa = rig.chamber.operating_pressure_pa, high_pa = settings.source_pressure_pa;
  const double full_s = seconds(high_pa);
  if (full_s <= half_s) low_pa = high_pa;
  while (high_pa - low_pa > kFilled * high_pa) {
    const double middle_pa = 0.5 * (low_pa + high_pa);
    (seconds(middle_pa) <= half_s ? low_pa : high_pa) = middle_pa;
  }
  cycle.filled_pa[g] = low_pa;
  return std::min(full_s, half_s);
}

// A group out of a reservoir that is full when its stroke begins; how long until it is full again.
// Where pumps cannot fill it up again within a period the running time of an only group passes the
// period, which no duty allows.
double QuickCycles::FillFromReservoir(const Settings& settings, double rising_m3, int g,
                                      Cycle& cycle) const {
  const model::GroupRig& rig = rigs_[g];
  const model::CompressorCurve& curve = assembly_.compressor->curve;
  const double temperature_k = problem_.ambient.temperature_k;
  const double source_pa = settings.source_pressure_pa;
  model::ReservoirStrokeInput input;
  input.fill = &fill_tables_[g];
  input.chamber = &rig.chamber;
  input.count = rig.count;
  input.compressor = &curve;
  input.compressors = assembly_.compressors;
  input.stop_pa = source_pa;
  input.volume_falling_m3 = settings.reservoir_volume_m3.value_or(0.0);
  input.volume_rising_m3 = rising_m3;
  input.from_pa = problem_.ambient.pressure_pa;
  input.target_pa = Target(problem_, problem_.groups[g], problem_.rise_fraction);
  input.operating_pa = rig.chamber.operating_pressure_pa;
  if (!rig.close_at_operating) input.open_s = 0.5 / problem_.frequency_hz;
  input.temperature_k = temperature_k;
  const model::ReservoirStroke stroke = model::FillFromReservoir(input);
  if (!stroke.reached) return model::kNever;
  cycle.rise_s[g] = stroke.rise_s;
  cycle.inflate_s[g] = stroke.inflate_s;
  cycle.filled_pa[g] = stroke.chamber_end_pa;
  const double refill_s = model::PumpUpTime(curve, input.compressors, rising_m3,
                                            stroke.reservoir_end_pa, source_pa, temperature_k);
  cycle.pump_on_s += stroke.pump_on_s + refill_s;
  cycle.pump_j +=
      stroke.pump_energy_j +
      model::EnergyToFill(curve, rising_m3, stroke.reservoir_end_pa, source_pa, temperature_k);
  cycle.pump_air_m3 +=
      stroke.pump_air_m3 +
      model::StandardVolume(rising_m3 * (source_pa - stroke.reservoir_end_pa), temperature_k);
  return std::max(stroke.inflate_s, input.open_s) + refill_s;
}

// What it takes lowers the tank for the groups after it.
double QuickCycles::FillFromTank(double& tank_pa, int g, Cycle& cycle) const {
  const model::GroupRig& rig = rigs_[g];
  const auto seconds = [&](double to_pa) {
    return model::FillTimeFromReservoir(fills_[g], rig.chamber, rig.count, TankVolume(assembly_),
                                        tank_pa, problem_.ambient.pressure_pa, to_pa,
                                        problem_.ambient.temperature_k);
  };
  cycle.rise_s[g] = seconds(Target(problem_, problem_.groups[g], problem_.rise_fraction));
  cycle.inflate_s[g] = seconds(rig.chamber.operating_pressure_pa);
  tank_pa -= StrokeAir(problem_, assembly_, g) /
             model::StandardVolume(TankVolume(assembly_), problem_.ambient.temperature_k);
  return cycle.inflate_s[g];
}

std::optional<Cycle> QuickCycles::At(const Settings& settings, double rising_m3) const {
  if (Stopped(stop_)) return std::nullopt;
  const std::size_t groups = problem_.groups.size();
  // A valve that cannot hold lets its actuators draw while others do.
  if (groups > 1 && (problem_.simultaneous || (assembly_.compressor && !Holding(assembly_))))
    return Simulated(problem_, settings, assembly_, rising_m3, stop_);
  const double turn_s = 1.0 / problem_.frequency_hz / static_cast<double>(groups);
  Cycle cycle = EmptyCycle(problem_);
  cycle.fall_s = fall_s_;
  double tank_pa = IsOpen(assembly_) ? LastStart(problem_, settings, assembly_) : 0.0;
  for (int g = 0; g < static_cast<int>(groups); ++g) {
    if (assembly_.direct()) {  // what is not over when its turn is over is refused (verify_size.h)
      (direct_fills_ ? *direct_fills_ : own_fills_).Add(problem_, assembly_, g, fills_[g], cycle);
      continue;
    }
    const double over_s = assembly_.compressor ? FillFromReservoir(settings, rising_m3, g, cycle)
                          : IsOpen(assembly_)  ? FillFromTank(tank_pa, g, cycle)
                                               : FillFromRegulator(settings, g, cycle);
    if (groups > 1 && !(over_s <= turn_s))
      return Simulated(problem_, settings, assembly_, rising_m3, stop_);
  }
  FillOpenOnes(problem_, settings, assembly_, cycle);
  AddNeeds(problem_, assembly_, cycle);
  return cycle;
}

}  // namespace plenum::verify
