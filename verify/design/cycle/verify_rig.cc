#include "verify/design/cycle/verify_rig.h"

#include <algorithm>
#include <cmath>

#include "model/flow/tube.h"
#include "model/strokes/stroke.h"
#include "verify/design/verify_tank.h"

namespace plenum::verify {
namespace {

// A source at the operating pressure fills up to it, much closer to equal pressures than by
// default: a straight line from 1 − 1e-7 on would still delay the end of such a stroke by a
// thousandth.
constexpr double kLinear = 1.0 - 1e-9;

constexpr double kFull = 1.0 - 1e-6;  // of the operating pressure

// Commands of so many periods from 0 on, at which a window of the period before may be open;
// `done`: what it fills is full, or was never begun, and its valve is shut.
std::vector<model::ValveCommand> Commands(const Problem& problem, const Unit& unit, bool done,
                                          int periods) {
  const double period_s = 1.0 / problem.frequency_hz;
  const double window_s = FillWindow(problem, unit.group);
  std::vector<model::ValveCommand> commands;
  const double reach_s = unit.begins.back() * period_s + window_s - period_s;
  if (reach_s > 0.0) {
    commands.push_back({0.0, done ? model::ValveState::kHold : model::ValveState::kInflate});
    commands.push_back({reach_s, model::ValveState::kDeflate});
  } else if (unit.begins.front() > 0.0) {
    commands.push_back({0.0, model::ValveState::kDeflate});
  }
  for (int i = 0; i < periods; ++i)
    for (const double begin : unit.begins) {
      commands.push_back({(begin + i) * period_s, model::ValveState::kInflate});
      commands.push_back({(begin + i) * period_s + window_s, model::ValveState::kDeflate});
    }
  return commands;
}

}  // namespace

model::GroupRig MakeGroup(const Problem& problem, const Assembly& assembly, const Unit& unit,
                          double pressure_pa, int cycles) {
  const ActuatorGroup& group = problem.groups[unit.group];
  const LineParts& line = assembly.lines[unit.group];
  model::GroupRig rig;
  rig.name = group.name;
  rig.count = unit.count;
  rig.chamber = ChamberOf(group, line);
  if (rig.chamber.low_pressure_pa > 0.0 && assembly.rail.weakest_pa > 0.0)
    rig.chamber.exhaust_pressure_pa = assembly.rail.weakest_pa;
  std::vector<model::FlowElement> between;  // from valve to actuator
  const model::FlowElement tube =
      model::TubeElement(line.tube->inner_diameter_m, group.tube_length_m);
  for (int i = 0; i < group.fittings_per_line; ++i) {
    if (i == (group.fittings_per_line + 1) / 2) between.push_back(tube);
    between.push_back(line.fitting->flow);
  }
  if (group.fittings_per_line < 2) between.push_back(tube);
  std::vector<model::FlowElement>&inward = rig.chamber.evacuated ? rig.exhaust : rig.fill,
  &outward = rig.chamber.evacuated ? rig.fill : rig.exhaust;
  inward = between;
  // A valve that only vents is not on the way from the pumps.
  const auto clear = [&](bool fills) { return fills && group.fed_past_valve; };
  if (!clear(!rig.chamber.evacuated))
    inward.insert(inward.begin(), rig.chamber.evacuated ? line.valve->exhaust : line.valve->fill);
  outward.assign(between.rbegin(), between.rend());
  if (!clear(rig.chamber.evacuated))
    outward.push_back(rig.chamber.evacuated ? line.valve->fill : line.valve->exhaust);
  rig.close_at_operating = model::Holds(line.valve->kind);
  rig.close_at_low = rig.chamber.low_pressure_pa > 0.0;
  rig.initial_pressure_pa = pressure_pa;
  const bool midway = pressure_pa > model::RestPa(rig.chamber) &&
                      pressure_pa < kFull * rig.chamber.operating_pressure_pa;
  rig.schedule = Commands(problem, unit, rig.close_at_operating && !midway, cycles);
  return rig;
}

model::Rig MakeRig(const Problem& problem, const Settings& settings, const Assembly& assembly,
                   const State& state, int cycles, double rising_m3) {
  model::Rig rig;
  rig.ambient = problem.ambient;
  if (assembly.co2) rig.gas = model::Gas::kCo2;
  if (assembly.direct()) {
    rig.source = model::PumpSource{assembly.pump()->curve, assembly.compressors};
  } else if (assembly.pump()) {
    model::ReservoirSource source;
    source.volume_m3 = settings.reservoir_volume_m3.value_or(0.0);
    source.volume_rising_m3 = rising_m3;
    source.initial_pressure_pa = state.source_pa;
    source.compressor = assembly.pump()->curve;
    source.compressor_count = assembly.compressors;
    source.stop_pressure_pa = settings.source_pressure_pa;
    rig.source = source;
  } else if (IsOpen(assembly)) {
    model::ReservoirSource source;
    source.volume_m3 = TankVolume(assembly);
    source.initial_pressure_pa = state.source_pa;
    rig.source = source;
  } else {
    double flow_max = assembly.regulators.front()->flow_max_m3_per_s;
    if (assembly.configuration == Configuration::kMains)
      flow_max = std::min(flow_max, problem.mains.flow_max_m3_per_s);
    rig.source = model::RegulatedSource{settings.source_pressure_pa,
                                        assembly.regulators.front()->flow, flow_max};
  }
  const std::vector<Unit> units = UnitsOf(problem);
  for (std::size_t u = 0; u < units.size(); ++u)
    rig.groups.push_back(MakeGroup(problem, assembly, units[u], state.unit_pa[u], cycles));
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

double FactorOf(const Problem& problem, Configuration configuration) {
  const bool co2 = configuration == Configuration::kCo2;
  return model::FlowFactor(co2 ? model::Gas::kCo2 : model::Gas::kAir) *
         std::sqrt(model::kReferenceTemperatureK / problem.ambient.temperature_k);
}

void EmptyBeforeNext(const Problem& problem, const Settings& settings, const Assembly& assembly,
                     model::Rig& rig) {
  constexpr double kShare = 0.9;  // of the window
  const double factor = FactorOf(problem, assembly.configuration);
  const std::vector<Unit> units = UnitsOf(problem);
  for (std::size_t u = 0; u < units.size(); ++u) {
    model::GroupRig& group = rig.groups[u];
    const double full_pa = group.close_at_operating ? group.chamber.operating_pressure_pa
                                                    : settings.source_pressure_pa;
    const double seconds =
        model::EmptyTime(model::MakeSeries(group.exhaust, factor), group.chamber, full_pa,
                         model::RestPa(group.chamber), problem.ambient.temperature_k);
    for (model::FlowElement& element : group.exhaust)
      element.sonic_conductance_m3_per_s_pa *=
          std::max(1.0, seconds / (kShare * VentWindow(problem, units[u].group)));
  }
}

}  // namespace plenum::verify
