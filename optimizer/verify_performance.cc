// Strokes, air, energy and margins of a design from a simulation of its periodic state.
#include <map>

#include "model/simulate.h"
#include "model/storage.h"
#include "model/tube.h"
#include "optimizer/verify_design.h"

namespace plenum::optimizer {
namespace {

constexpr int kCyclesMax = 2000;
constexpr double kPeriodic = 1e-8;  // relative change of the source from cycle to cycle
// A source at the operating pressure fills up to it: closer to equal pressures than by default.
constexpr double kLinear = 1.0 - 1e-5;

// What a design does in one cycle of its periodic state.
struct Cycle {
  std::vector<double> rise_s, inflate_s, fall_s;
  double air_m3 = 0.0;                                     // ANR, by the contents at rest and full
  double pump_on_s = 0.0, pump_j = 0.0, electric_j = 0.0;  // electric: coils and regulator
  double coil_w = 0.0;                                     // all on at once, with the regulator
};

model::Chamber ChamberOf(const ActuatorGroup& group, const LineParts& line) {
  model::Chamber chamber = group.chamber;
  chamber.dead_volume_m3 += model::BoreVolume(line.tube->inner_diameter_m, group.tube_length_m);
  return chamber;
}

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
                   const State& state, int cycles) {
  model::Rig rig;
  rig.ambient = problem.ambient;
  if (assembly.co2) rig.gas = model::Gas::kCo2;
  if (assembly.compressor) {
    model::ReservoirSource source;
    source.volume_m3 = assembly.reservoir ? assembly.reservoirs * assembly.reservoir->volume_m3
                                          : settings.reservoir_volume_m3.value_or(0.0);
    source.initial_pressure_pa = state.source_pa;
    source.compressor = assembly.compressor->curve;
    source.compressor_count = assembly.compressors;
    source.stop_pressure_pa = settings.source_pressure_pa;
    rig.source = source;
  } else {
    double flow_max = assembly.regulator->flow_max_m3_per_s;
    if (assembly.configuration == Configuration::kMains)
      flow_max = std::min(flow_max, problem.mains_flow_max_m3_per_s);
    rig.source =
        model::RegulatedSource{settings.source_pressure_pa, assembly.regulator->flow, flow_max};
  }
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    rig.groups.push_back(MakeGroup(problem, assembly, g, state.group_pa[g], cycles));
  return rig;
}

model::SimulateOptions OptionsOf(const Problem& problem, double end_s) {
  model::SimulateOptions options;
  options.end_s = end_s;
  options.rise_fraction = problem.rise_fraction;
  options.fall_fraction = problem.fall_fraction;
  options.linear_ratio = kLinear;
  return options;
}

// The state at the start of a cycle that repeats; none where the simulator does not get there.
std::optional<State> Repeating(const Problem& problem, const Settings& settings,
                               const Assembly& assembly) {
  State state{settings.source_pressure_pa,
              std::vector<double>(problem.groups.size(), problem.ambient.pressure_pa)};
  const model::SimulateOptions options = OptionsOf(problem, 1.0 / problem.frequency_hz);
  for (int cycle = 0; cycle < kCyclesMax; ++cycle) {
    const model::Response response =
        model::Simulate(MakeRig(problem, settings, assembly, state, 1), options);
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

std::optional<Cycle> SimulateCycle(const Problem& problem, const Settings& settings,
                                   const Assembly& assembly) {
  const std::optional<State> state = Repeating(problem, settings, assembly);
  if (!state) return std::nullopt;
  const double period_s = 1.0 / problem.frequency_hz;
  const model::Rig rig = MakeRig(problem, settings, assembly, *state, 2);
  const model::Response response = model::Simulate(rig, OptionsOf(problem, 2.0 * period_s));
  if (response.status != model::SimulateStatus::kDone) return std::nullopt;
  const std::size_t groups = problem.groups.size();
  Cycle cycle;
  cycle.rise_s.assign(groups, 0.0);
  cycle.inflate_s.assign(groups, 0.0);
  for (const model::Stroke& stroke : response.strokes) {
    const bool carried_over = stroke.command_s == 0.0 && !problem.simultaneous && stroke.group > 0;
    if (stroke.state != model::ValveState::kInflate || stroke.command_s >= period_s || carried_over)
      continue;
    cycle.rise_s[stroke.group] = stroke.to_target_s;
    cycle.inflate_s[stroke.group] = stroke.to_operating_s;
  }
  for (const model::FullStroke& stroke : model::FullStrokes(rig, OptionsOf(problem, period_s)))
    cycle.fall_s.push_back(stroke.fall_time_s);
  cycle.pump_on_s = 0.5 * response.compressor_on_s;
  cycle.pump_j = 0.5 * response.compressor_energy_j;

  for (std::size_t g = 0; g < groups; ++g) {
    const model::Valve& valve = *assembly.lines[g].valve;
    const model::Chamber& chamber = rig.groups[g].chamber;
    const bool holds = model::Holds(valve.kind);
    const double full_pa = holds ? chamber.operating_pressure_pa : settings.source_pressure_pa;
    cycle.air_m3 += problem.groups[g].count *
                    model::StandardVolume(model::Content(chamber, full_pa) -
                                              model::Content(chamber, problem.ambient.pressure_pa),
                                          problem.ambient.temperature_k);
    const double coil_w = problem.groups[g].count * valve.coil_power_w;
    cycle.coil_w += coil_w;
    cycle.electric_j += coil_w * (0.5 * period_s + (holds ? cycle.inflate_s[g] : 0.0));
  }
  if (assembly.regulator) {
    cycle.coil_w += assembly.regulator->electrical_power_w;
    cycle.electric_j += assembly.regulator->electrical_power_w * period_s;
  }
  return cycle;
}

std::string Numbers(const std::string& what, double claimed, double found) {
  return what + " is given as " + std::to_string(claimed) + ", found " + std::to_string(found);
}

// Range of source pressures that every part stands.
void CheckSourcePressure(const Problem& problem, const Design& design, const Assembly& a,
                         Findings& findings) {
  double low_pa = problem.ambient.pressure_pa, high_pa = problem.source_pressure_max_pa;
  for (std::size_t g = 0; g < a.lines.size(); ++g) {
    const LineParts& line = a.lines[g];
    low_pa = std::max(
        {low_pa, line.valve->pressure_min_pa, problem.groups[g].chamber.operating_pressure_pa});
    high_pa = std::min({high_pa, line.valve->pressure_max_pa, line.tube->pressure_max_pa});
    if (line.fitting) high_pa = std::min(high_pa, line.fitting->pressure_max_pa);
    if (!model::Holds(line.valve->kind))
      high_pa = std::min(high_pa, problem.groups[g].pressure_max_pa);
  }
  if (a.regulator) {
    low_pa = std::max(low_pa, a.regulator->outlet_pressure_min_pa);
    high_pa = std::min(high_pa, a.regulator->outlet_pressure_max_pa);
  }
  if (a.configuration == Configuration::kMains)
    high_pa = std::min(high_pa, problem.mains_pressure_pa);
  if (a.compressor) high_pa = std::min(high_pa, model::HighestPressure(a.compressor->curve));
  if (a.reservoir) high_pa = std::min(high_pa, a.reservoir->pressure_max_pa);
  if (a.compressor && !a.reservoir)
    high_pa =
        std::min(high_pa, problem.ambient.pressure_pa + model::kMadeReservoirPressureMaxGaugePa);
  const double source_pa = design.settings.source_pressure_pa;
  if (source_pa < low_pa * (1.0 - kSumTolerance) || source_pa > high_pa * (1.0 + kSumTolerance))
    findings.push_back({"supply", "the source pressure is outside what the parts stand"});
}

// Energy for all cycles, and what is on board.
struct Supply {
  double gas_m3 = kUnlimited, energy_j = kUnlimited;  // on board
  double first_fill_j = 0.0, first_fill_m3 = 0.0;
  double current_a = 0.0, frequency_hz = 0.0;
};

Supply SupplyOf(const Problem& problem, const Design& design, const Assembly& a,
                const Cycle& cycle) {
  Supply supply;
  const double temperature_k = problem.ambient.temperature_k;
  const double source_pa = design.settings.source_pressure_pa;
  const double inlet_pa =
      a.regulator ? std::max(source_pa, a.regulator->inlet_pressure_min_pa) : 0.0;
  double slowest_s = 0.0;
  for (std::size_t g = 0; g < a.lines.size(); ++g)
    slowest_s = std::max({slowest_s, cycle.inflate_s[g], cycle.fall_s[g]});
  supply.frequency_hz = 0.5 / slowest_s;
  if (a.cylinder)
    supply.gas_m3 = a.bottles * model::CylinderUsableVolume(a.cylinder->water_volume_m3,
                                                            a.cylinder->fill_pressure_pa, inlet_pa,
                                                            temperature_k);
  if (a.co2) {
    supply.gas_m3 = a.bottles * model::Co2UsableVolume(a.co2->co2_mass_kg, a.co2->water_volume_m3,
                                                       inlet_pa, temperature_k);
    supply.frequency_hz =
        std::min(supply.frequency_hz, a.bottles * a.co2->flow_sustained_m3_per_s / cycle.air_m3);
  }
  if (a.compressor) {
    const double ambient_pa = problem.ambient.pressure_pa;
    const double volume_m3 = design.settings.reservoir_volume_m3.value_or(0.0);
    supply.first_fill_j =
        model::EnergyToFill(a.compressor->curve, volume_m3, ambient_pa, source_pa, temperature_k);
    supply.first_fill_m3 =
        model::StandardVolume(volume_m3 * (source_pa - ambient_pa), temperature_k);
    supply.current_a =
        a.compressors * model::LargestCurrent(a.compressor->curve, ambient_pa, source_pa);
    supply.frequency_hz = std::min(supply.frequency_hz, a.compressor->duty_max / cycle.pump_on_s);
  }
  if (a.battery) {
    supply.energy_j =
        a.batteries * model::UsableEnergy(a.battery->capacity_ah, a.battery->nominal_voltage_v);
    supply.current_a += cycle.coil_w / a.battery->nominal_voltage_v;
  }
  return supply;
}

// Every requirement in the units of its field, with what the design reaches.
struct Reached {
  double required, achieved;
  bool at_most;
  double tolerance;
};
std::map<std::string, Reached> Requirements(const Problem& problem, const Design& design,
                                            const Assembly& a, const Cycle& cycle,
                                            const Supply& supply) {
  std::map<std::string, Reached> all;
  const auto at_most = [&](const std::string& pointer, double limit, double value, double tol) {
    if (std::isfinite(limit)) all[pointer] = {limit, value, true, tol};
  };
  const double ambient_pa = problem.ambient.pressure_pa;
  const auto gauge = [&](double pa) { return (pa - ambient_pa) / 1e3; };
  const double source_pa = design.settings.source_pressure_pa;
  for (std::size_t g = 0; g < a.lines.size(); ++g) {
    const ActuatorGroup& group = problem.groups[g];
    const std::string at = "/actuators/" + std::to_string(g) + "/";
    at_most(at + "rise_time_s_max", group.rise_time_max_s, cycle.rise_s[g], kTimeTolerance);
    at_most(at + "fall_time_s_max", group.fall_time_max_s, cycle.fall_s[g], kTimeTolerance);
    at_most(at + "pressure_kpa_gauge_max", gauge(group.pressure_max_pa),
            gauge(model::Holds(a.lines[g].valve->kind) ? group.chamber.operating_pressure_pa
                                                       : source_pa),
            kSumTolerance);
  }
  all["/duty/frequency_hz"] = {problem.frequency_hz, supply.frequency_hz, false, kEnergyTolerance};
  const double per_cycle_j = cycle.pump_j + cycle.electric_j;
  const double actuations = std::min(
      supply.gas_m3 / cycle.air_m3,
      per_cycle_j > 0.0 ? (supply.energy_j - supply.first_fill_j) / per_cycle_j : kUnlimited);
  if (std::isfinite(actuations))
    all["/duty/actuations"] = {problem.actuations, actuations, false, kEnergyTolerance};
  at_most("/supply/source_pressure_kpa_gauge_max", gauge(problem.source_pressure_max_pa),
          gauge(source_pa), kSumTolerance);
  at_most("/supply/mass_kg_max", problem.mass_max_kg, design.totals.mass_kg, kSumTolerance);
  at_most("/supply/volume_l_max", problem.volume_max_l, design.totals.volume_m3 * 1e3,
          kSumTolerance);
  at_most("/supply/cost_eur_max", problem.cost_max_eur, design.totals.cost_eur.value_or(kUnlimited),
          kSumTolerance);
  return all;
}

void CheckMargins(const std::map<std::string, Reached>& requirements, const Design& design,
                  bool held_air, Findings& findings) {
  std::map<std::string, const Margin*> given;
  for (const Margin& margin : design.margins) given[margin.requirement] = &margin;
  if (given.size() != design.margins.size() || given.size() != requirements.size())
    findings.push_back({"margins", "there must be one margin for each requirement"});
  for (const auto& [pointer, reached] : requirements) {
    const double margin = reached.at_most ? 1.0 - reached.achieved / reached.required
                                          : reached.achieved / reached.required - 1.0;
    if (margin < -reached.tolerance)
      findings.push_back({"supply", pointer + " is not met: " + std::to_string(reached.achieved) +
                                        " for " + std::to_string(reached.required)});
    const auto found = given.find(pointer);
    if (found == given.end()) {
      findings.push_back({"margins", pointer + " has no margin"});
      continue;
    }
    const Margin& claimed = *found->second;
    const double claimed_margin = reached.at_most ? 1.0 - claimed.achieved / claimed.required
                                                  : claimed.achieved / claimed.required - 1.0;
    // Air that a pump adds while a valve that cannot hold stands open is counted by its most.
    const bool cautious =
        held_air && pointer.starts_with("/duty") && claimed.achieved <= reached.achieved;
    if (!Near(claimed.required, reached.required, kSumTolerance) ||
        (!Near(claimed.achieved, reached.achieved, reached.tolerance) && !cautious))
      findings.push_back({"margins", Numbers(pointer, claimed.achieved, reached.achieved)});
    else if (std::abs(claimed.relative_margin - claimed_margin) > kSumTolerance)
      findings.push_back({"margins", pointer + ": the margin is not that of its two numbers"});
  }
}

}  // namespace

bool CheckPerformance(const Problem& problem, const Design& design, const Assembly& assembly,
                      Findings& findings) {
  CheckSourcePressure(problem, design, assembly, findings);
  if (assembly.reservoir &&
      !Near(design.settings.reservoir_volume_m3.value_or(0.0),
            assembly.reservoirs * assembly.reservoir->volume_m3, kSumTolerance))
    findings.push_back({"supply", "the reservoir's volume is not that of the part"});
  const std::optional<Cycle> cycle = SimulateCycle(problem, design.settings, assembly);
  if (!cycle) return false;

  bool held_air = false;  // pumped into actuators that stay open to the reservoir
  const Performance& claimed = design.performance;
  const auto expect = [&](const std::string& what, double given, double found, double tolerance) {
    if (!Near(given, found, tolerance))
      findings.push_back({"strokes", Numbers(what, given, found)});
  };
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const std::string name = problem.groups[g].name + ": ";
    const GroupPerformance& group = claimed.groups[g];
    held_air |= assembly.compressor && !model::Holds(assembly.lines[g].valve->kind);
    expect(name + "rise_time_s", group.rise_time_s, cycle->rise_s[g], kTimeTolerance);
    expect(name + "fall_time_s", group.fall_time_s, cycle->fall_s[g], kTimeTolerance);
    expect(name + "inflate_time_s", group.inflate_time_s, cycle->inflate_s[g], kTimeTolerance);
    expect(name + "frequency_hz_max", group.frequency_max_hz,
           1.0 / (cycle->rise_s[g] + cycle->fall_s[g]), kTimeTolerance);
    expect(name + "valve_duty", design.settings.valve_duty[g],
           cycle->inflate_s[g] * problem.frequency_hz, kTimeTolerance);
    if (cycle->inflate_s[g] > 0.5 / problem.frequency_hz * (1.0 + kTimeTolerance) ||
        cycle->fall_s[g] > 0.5 / problem.frequency_hz * (1.0 + kTimeTolerance))
      findings.push_back({"strokes", name + "a stroke takes longer than half of the period"});
  }
  const Supply supply = SupplyOf(problem, design, assembly, *cycle);
  int actuators = 0;
  for (const ActuatorGroup& group : problem.groups) actuators += group.count;
  expect("air_per_actuation", claimed.air_per_actuation_m3, cycle->air_m3 / actuators,
         kTimeTolerance);
  expect("air_total", claimed.air_total_m3,
         problem.actuations * cycle->air_m3 + supply.first_fill_m3, kTimeTolerance);
  expect("run_time_s", claimed.run_time_s, problem.actuations / problem.frequency_hz,
         kSumTolerance);
  const double energy_j =
      supply.first_fill_j + problem.actuations * (cycle->pump_j + cycle->electric_j);
  if (!(held_air && design.totals.energy_j >= energy_j))
    expect("energy", design.totals.energy_j, energy_j, kEnergyTolerance);
  if (assembly.compressor && !held_air)
    expect("compressor_duty", design.settings.compressor_duty.value_or(0.0),
           cycle->pump_on_s * problem.frequency_hz, kEnergyTolerance);
  if (assembly.battery && supply.current_a > assembly.batteries * assembly.battery->current_max_a *
                                                 (1.0 + kEnergyTolerance))
    findings.push_back({"supply", "the batteries do not give the current"});
  CheckMargins(Requirements(problem, design, assembly, *cycle, supply), design, held_air, findings);
  return true;
}

}  // namespace plenum::optimizer
