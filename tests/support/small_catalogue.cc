#include "tests/support/small_catalogue.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "model/flow/tube.h"
#include "model/physics/storage.h"
#include "model/strokes/stroke.h"
#include "tests/support/late_closing.h"
#include "tests/support/pumps/check_valves.h"

namespace plenum::test {
namespace {

using optimizer::Configuration;
using optimizer::Family;
using optimizer::Problem;

constexpr double kLitrePerMinute = 1e-3 / 60.0;

optimizer::ActuatorGroup RandomGroup(Random& random, int index, double severity) {
  optimizer::ActuatorGroup group;
  group.name = "group" + std::to_string(index);
  group.count = Pick(random, 1, 4);
  group.chamber.rest_volume_m3 = LogUniform(random, 8e-6, 80e-6);
  group.chamber.expansion_ratio = Chance(random, 0.2) ? 1.0 : Uniform(random, 1.0, 2.5);
  group.chamber.operating_pressure_pa = kAmbientPa + Uniform(random, 0.3, 1.2) * kBar;
  group.chamber.ambient_pressure_pa = kAmbientPa;
  group.tube_length_m = Uniform(random, 0.2, 1.2);
  group.fittings_per_line = Pick(random, 0, 3);
  const double slowest_s = 4.0 * std::pow(0.04, severity);
  if (!Chance(random, 0.15)) group.rise_time_max_s = slowest_s * LogUniform(random, 0.5, 2.0);
  if (!Chance(random, 0.15)) group.fall_time_max_s = 2.0 * slowest_s * LogUniform(random, 0.5, 2.0);
  group.pressure_max_pa =
      kAmbientPa + (group.chamber.operating_pressure_pa - kAmbientPa) *
                       (Chance(random, 0.7) ? 1.05 : Uniform(random, 1.05, 1.6));
  return group;
}

// A tee and two manifolds, one of them for bottles; what lines ask is near what they pass.
void AddManifolds(std::uint64_t seed, Problem& problem) {
  Random random(seed * 0x9e3779b97f4a7c15ULL + 2);
  const auto add = [&](const char* id, int stations, double mass_kg, double max_pa) {
    model::Manifold row;
    row.basics.id = id;
    row.basics.mass_kg = mass_kg * LogUniform(random, 0.5, 2.0);
    row.basics.body_volume_m3 = 1e-5;
    row.stations = stations;
    row.pressure_max_pa = max_pa;
    if (Chance(random, 0.8)) row.basics.cost_eur = Uniform(random, 1.0, 30.0);
    row.sonic_conductance_m3_per_s_pa = LogUniform(random, 0.2e-8, 20e-8);
    problem.parts.manifolds.push_back(row);
  };
  add("tee", 2, 8e-3, kAmbientPa + 10.0 * kBar);
  add("block", Pick(random, 3, 8), 40e-3, kAmbientPa + Uniform(random, 0.5, 10.0) * kBar);
  add("bottles", Pick(random, 2, 4), 0.2, kAmbientPa + 350.0 * kBar);
  for (optimizer::ActuatorGroup& group : problem.groups)
    group.joint_conductance_m3_per_s_pa = LogUniform(random, 0.2e-8, 5e-8);
}

}  // namespace

Problem RandomProblem(const Draw& draw) {
  Random random(draw.seed * 0x9e3779b97f4a7c15ULL + 1);
  Problem problem;
  problem.parts = RandomParts(random, draw.size);
  problem.configurations = draw.configurations;
  problem.simultaneous = draw.simultaneous;
  problem.ambient.temperature_k = Chance(random, 0.7) ? 293.15 : Uniform(random, 280.0, 303.0);
  for (int g = 0; g < draw.groups; ++g)
    problem.groups.push_back(RandomGroup(random, g, draw.severity));
  problem.frequency_hz = 0.03 * std::pow(20.0, draw.severity) * LogUniform(random, 0.5, 2.0);
  problem.actuations =
      std::round(40.0 * std::pow(20.0, draw.severity) * LogUniform(random, 0.5, 2.0));
  problem.rise_fraction = Chance(random, 0.7) ? 0.95 : Uniform(random, 0.5, 1.0);
  problem.fall_fraction = Chance(random, 0.7) ? 0.05 : Uniform(random, 0.02, 0.5);
  problem.mains.pressure_pa = kAmbientPa + Uniform(random, 3.0, 7.0) * kBar;
  if (Chance(random, 0.5))
    problem.mains.flow_max_m3_per_s = LogUniform(random, 30.0, 300.0) * kLitrePerMinute;
  if (Chance(random, 0.5))
    problem.source_pressure_max_pa = kAmbientPa + Uniform(random, 2.0, 6.0) * kBar;
  problem.objective.mass_kg = 1.0;
  problem.limits = {Pick(random, 1, 2), Pick(random, 1, 2), Pick(random, 1, 3), Pick(random, 1, 3),
                    1};
  problem.count = Pick(random, 1, 20);
  AddManifolds(draw.seed, problem);
  return problem;
}

Problem EasyProblem(std::uint64_t seed, std::set<Configuration> configurations) {
  Draw draw;
  draw.seed = seed;
  draw.configurations = std::move(configurations);
  draw.severity = 0.2;
  draw.size = {3, 3, 4, 3, 3, 3, 3, 3, 1};
  Problem problem = RandomProblem(draw);
  for (std::size_t i = 0; i < problem.parts.tubing.size(); ++i)
    problem.parts.tubing[i].outer_diameter_m = kOuterDiameterM[1];
  for (std::size_t i = 0; i < problem.parts.tubing.size(); ++i)
    problem.parts.tubing[i].inner_diameter_m = 2e-3 + 0.4e-3 * static_cast<double>(i);
  for (model::Fitting& fitting : problem.parts.fittings) {
    fitting.tube_outer_diameter_m = kOuterDiameterM[1];
    fitting.thread = kThreads[0];
  }
  for (model::Valve& valve : problem.parts.valves) {
    valve.port = kThreads[0];
    valve.pressure_max_pa = kAmbientPa + 8.0 * kBar;
    valve.kind = model::ValveKind::kPair;
  }
  for (model::Regulator& regulator : problem.parts.regulators) {
    regulator.inlet_pressure_max_pa = kAmbientPa + 310.0 * kBar;
    regulator.inlet_pressure_min_pa = kAmbientPa + 2.0 * kBar;
    regulator.outlet_pressure_min_pa = kAmbientPa;
    regulator.outlet_pressure_max_pa = kAmbientPa + 8.0 * kBar;
  }
  for (model::Compressor& compressor : problem.parts.compressors) compressor.curve.voltage_v = 12.0;
  for (model::Battery& battery : problem.parts.batteries) battery.nominal_voltage_v = 11.1;
  problem.groups[0].fittings_per_line = 2;
  problem.groups[0].rise_time_max_s = 2.0;
  problem.groups[0].fall_time_max_s = 3.0;
  problem.source_pressure_max_pa = optimizer::kUnlimited;
  problem.frequency_hz = 0.05;
  problem.actuations = 30.0;
  problem.rise_fraction = 0.95;
  problem.fall_fraction = 0.05;
  problem.limits = {};
  return problem;
}

bool Mates(const Problem& problem, int tubing, int fitting, int valve) {
  if (fitting < 0) return true;
  const model::Fitting& part = problem.parts.fittings[fitting];
  return std::abs(problem.parts.tubing[tubing].outer_diameter_m - part.tube_outer_diameter_m) <=
             0.05e-3 &&
         problem.parts.valves[valve].port == part.thread;
}

namespace {

// Manifolds and tees, by adding pieces until all ends are there.
// What joins so many ends at this pressure; nothing where they are fewer than two.
optimizer::Amounts Joined(const optimizer::Problem& problem, int ends, double pressure_pa,
                          double asked_m3_per_s_pa) {
  if (ends < 2) return {};
  std::tuple<bool, double, double, double, std::string> best;  // unpriced, −flow, mass, cost, id
  optimizer::Amounts amounts;
  for (const model::Manifold& row : problem.parts.manifolds) {
    const bool priced = row.basics.cost_eur.has_value();
    const bool needed = problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur);
    if (row.stations < 2 || row.pressure_max_pa < pressure_pa || (needed && !priced)) continue;
    int pieces = 0;
    for (int reached = 1; reached < ends; reached += row.stations - 1) ++pieces;
    const double mass_kg = pieces * row.basics.mass_kg;
    const double cost_eur = pieces * row.basics.cost_eur.value_or(0.0);
    const std::tuple key(!priced, -std::min(row.sonic_conductance_m3_per_s_pa, asked_m3_per_s_pa),
                         mass_kg, cost_eur, row.basics.id);
    if (!std::get<4>(best).empty() && !(key < best)) continue;
    best = key;
    amounts = {mass_kg, pieces * row.basics.body_volume_m3, cost_eur};
  }
  return amounts;
}

double HighestOperatingPa(const optimizer::Problem& problem) {
  double highest_pa = 0.0;
  for (const optimizer::ActuatorGroup& group : problem.groups)
    highest_pa = std::max(highest_pa, group.chamber.operating_pressure_pa);
  return highest_pa;
}

double Asked(const optimizer::Problem& problem) {
  double sum = 0.0;
  for (const optimizer::ActuatorGroup& group : problem.groups)
    sum += group.joint_conductance_m3_per_s_pa;
  return sum;
}

// Of all lines together.
optimizer::Amounts JoinedLines(const optimizer::Problem& problem) {
  int lines = 0;
  for (const optimizer::ActuatorGroup& group : problem.groups) lines += group.count;
  return Joined(problem, lines, HighestOperatingPa(problem), Asked(problem));
}

// Of the lines of one group, as pumps of its own feed them.
optimizer::Amounts JoinedLinesOf(const optimizer::Problem& problem,
                                 const optimizer::ActuatorGroup& group) {
  return Joined(problem, group.count, group.chamber.operating_pressure_pa,
                group.joint_conductance_m3_per_s_pa);
}

optimizer::Amounts Share(double share, const optimizer::Amounts& whole) {
  return {share * whole.mass_kg, share * whole.volume_m3, share * whole.cost_eur};
}

// Of pumps of their own, so many for each group or actuator: what joins them.
optimizer::Amounts JoinedFeeds(const optimizer::Problem& problem, int pumps, double stands_pa) {
  optimizer::Amounts sum;
  for (const optimizer::ActuatorGroup& group : problem.groups)
    if (problem.pump_feed == optimizer::PumpFeed::kPerGroup)
      sum += Joined(problem, pumps, stands_pa, 0.0);
    else
      sum += Share(group.count, Joined(problem, pumps + 1, group.chamber.operating_pressure_pa,
                                       group.joint_conductance_m3_per_s_pa / group.count));
  return sum;
}

// From the valve to the actuator.
std::vector<model::FlowElement> Inward(const optimizer::ActuatorGroup& group,
                                       const model::FlowElement& valve,
                                       const model::FlowElement& fitting,
                                       const model::FlowElement& tube) {
  std::vector<model::FlowElement> elements{valve};
  elements.insert(elements.end(), (group.fittings_per_line + 1) / 2, fitting);
  elements.push_back(tube);
  elements.insert(elements.end(), group.fittings_per_line / 2, fitting);
  return elements;
}

// The highest source pressure that a line that closes late stands.
double MostForPeak(const Problem& problem, const optimizer::Line& line, int group_index,
                   double gas_factor) {
  const optimizer::ActuatorGroup& group = problem.groups[group_index];
  const model::Valve& valve = problem.parts.valves[line.valve];
  if (!line.holds || !(valve.closing_scatter_s > 0.0)) return line.source_max_pa;
  const model::Tubing& tubing = problem.parts.tubing[line.tubing];
  model::FlowElement connection;
  if (line.fitting >= 0) {
    const model::Fitting& fitting = problem.parts.fittings[line.fitting];
    connection = fitting.flow_most.value_or(fitting.flow);
  }
  LateLine late{Inward(group, valve.fill_most.value_or(valve.fill), connection,
                       model::TubeElement(tubing.inner_diameter_m, group.tube_length_m)),
                line.chamber, valve.closing_scatter_s, gas_factor, problem.ambient.temperature_k};
  if (group.chamber.evacuated) std::reverse(late.fill.begin(), late.fill.end());
  return MostForPeakPa(late, group.pressure_max_pa, line.source_max_pa);
}

}  // namespace

int FeedsByHand(const Problem& problem) {
  switch (problem.pump_feed) {
    case optimizer::PumpFeed::kShared:
      return 1;
    case optimizer::PumpFeed::kPerGroup:
      return static_cast<int>(problem.groups.size());
    case optimizer::PumpFeed::kPerActuator:
      break;
  }
  int actuators = 0;
  for (const optimizer::ActuatorGroup& group : problem.groups) actuators += group.count;
  return actuators;
}

optimizer::Line AssembleLine(const Problem& problem, int group_index, int tubing_index,
                             int fitting_index, int valve_index, model::Gas gas) {
  const optimizer::ActuatorGroup& group = problem.groups[group_index];
  const model::Tubing& tubing = problem.parts.tubing[tubing_index];
  const model::Valve& valve = problem.parts.valves[valve_index];
  const model::Fitting* fitting =
      fitting_index < 0 ? nullptr : &problem.parts.fittings[fitting_index];
  const double metres = group.count * group.tube_length_m;
  const double valves = std::ceil(static_cast<double>(group.count) / valve.channels);
  const double fittings = fitting == nullptr ? 0.0 : group.count * group.fittings_per_line;

  optimizer::Line line;
  line.tubing = tubing_index;
  line.fitting = fitting_index;
  line.valve = valve_index;
  const auto add = [&](double quantity, const model::PartBasics& basics) {
    line.amounts.mass_kg += quantity * basics.mass_kg;
    line.amounts.volume_m3 += quantity * basics.body_volume_m3;
    line.amounts.cost_eur += quantity * basics.cost_eur.value_or(0.0);
  };
  add(metres, tubing.per_metre);
  add(valves, valve.basics);
  if (fitting != nullptr) add(fittings, fitting->basics);
  int lines = 0;
  for (const optimizer::ActuatorGroup& other : problem.groups) lines += other.count;
  if (problem.pump_feed == optimizer::PumpFeed::kShared)
    line.amounts += Share(static_cast<double>(group.count) / lines, JoinedLines(problem));
  if (problem.pump_feed == optimizer::PumpFeed::kPerGroup)
    line.amounts += JoinedLinesOf(problem, group);

  const model::FlowElement tube = model::TubeElement(tubing.inner_diameter_m, group.tube_length_m);
  const model::FlowElement connection = fitting == nullptr ? model::FlowElement{} : fitting->flow;
  line.fill = Inward(group, valve.fill, connection, tube);
  line.exhaust = Inward(group, valve.exhaust, connection, tube);
  // A pump of each actuator feeds it past the valve.
  if (problem.pump_feed == optimizer::PumpFeed::kPerActuator) line.fill.erase(line.fill.begin());
  // Evacuated ones are crossed the other way round.
  auto& outward = group.chamber.evacuated ? line.fill : line.exhaust;
  std::reverse(outward.begin(), outward.end());

  line.holds = line.all_hold = valve.kind != model::ValveKind::kThreeWay;
  line.source_max_pa =
      std::min({tubing.pressure_max_pa, valve.pressure_max_pa, problem.source_pressure_max_pa});
  if (fitting != nullptr)
    line.source_max_pa = std::min(line.source_max_pa, fitting->pressure_max_pa);
  if (!line.holds) line.source_max_pa = std::min(line.source_max_pa, group.pressure_max_pa);
  line.source_min_pa = group.chamber.operating_pressure_pa;
  line.coil_power_w = valve.coil_power_w * group.count;

  line.chamber = group.chamber;
  line.chamber.dead_volume_m3 += std::numbers::pi / 4.0 * tubing.inner_diameter_m *
                                 tubing.inner_diameter_m * group.tube_length_m;
  const double temperature_k = problem.ambient.temperature_k;
  const double factor = (gas == model::Gas::kCo2 ? 0.79 : 1.0) * std::sqrt(293.15 / temperature_k);
  line.source_max_pa = MostForPeak(problem, line, group_index, factor);
  const model::Series fill_series = model::MakeSeries(line.fill, factor);
  line.curve = std::make_shared<const optimizer::FillCurve>(
      optimizer::FillCurve{model::FlowTable(fill_series, model::MirrorPa(group.chamber)),
                           optimizer::MakeStrokePanels(problem, group_index, line.chamber)});
  const double low_pa = group.chamber.low_pressure_pa;
  const double rest_pa = low_pa > 0.0 ? low_pa : problem.ambient.pressure_pa;
  const double operating_pa = group.chamber.operating_pressure_pa;
  line.fall_time_s =
      model::EmptyTime(model::MakeSeries(line.exhaust, factor), line.chamber, operating_pa,
                       rest_pa + problem.fall_fraction * (operating_pa - rest_pa), temperature_k);
  line.inflate_time_least_s = model::FillTime(fill_series, line.chamber, line.source_max_pa,
                                              rest_pa, operating_pa, temperature_k);
  return line;
}

optimizer::Option MakeOption(const Problem& problem, Family family, int index, int quantity) {
  optimizer::Option option;
  option.index = index;
  option.quantity = quantity;
  const auto take = [&](const model::PartBasics& basics, double charge_kg) {
    option.amounts.mass_kg = quantity * (basics.mass_kg + charge_kg);
    option.amounts.volume_m3 = quantity * basics.body_volume_m3;
    option.amounts.cost_eur = quantity * basics.cost_eur.value_or(0.0);
  };
  const model::Parts& parts = problem.parts;
  const double lines_ask = Asked(problem);
  double stands_pa = HighestOperatingPa(problem), asked = 0.0;
  switch (family) {
    case Family::kRegulator:
      take(parts.regulators[index].basics, 0.0);
      break;
    case Family::kCylinder:
      take(parts.cylinders[index].basics,
           model::CylinderCharge(parts.cylinders[index].water_volume_m3,
                                 parts.cylinders[index].fill_pressure_pa,
                                 problem.ambient.temperature_k));
      stands_pa = parts.cylinders[index].fill_pressure_pa;
      break;
    case Family::kCo2:
      take(parts.co2[index].basics, parts.co2[index].co2_mass_kg);
      stands_pa = model::Co2SaturationPressure(problem.ambient.temperature_k);
      break;
    case Family::kCompressor:
    case Family::kVacuumPump:
    case Family::kEjector:
      take(PumpsIn(parts, family)[index].basics, 0.0);
      break;
    case Family::kBattery:
      take(parts.batteries[index].basics, 0.0);
      break;
    case Family::kTank: {
      // What every fill leaves in it: air at the highest operating pressure.
      double left_pa = 0.0;
      for (const optimizer::ActuatorGroup& group : problem.groups)
        left_pa = std::max(left_pa, group.chamber.operating_pressure_pa);
      take(parts.tanks[index].basics,
           parts.tanks[index].volume_m3 * left_pa / (287.05 * problem.ambient.temperature_k));
      stands_pa = std::min(parts.tanks[index].pressure_max_pa, problem.tank_fill_max_pa);
      asked = lines_ask;
      break;
    }
    default:
      take(parts.reservoirs[index].basics, 0.0);
      asked = lines_ask;
  }
  const bool pump = family == Family::kCompressor || family == Family::kVacuumPump;
  if (pump && problem.pump_feed != optimizer::PumpFeed::kShared) {
    const double feeds = FeedsByHand(problem);
    option.amounts = Share(feeds, option.amounts);
    option.amounts += JoinedFeeds(problem, quantity, stands_pa);
    if (PumpsIn(parts, family)[index].check_valve_cracking_pa)
      option.amounts += CheckValvesByHand(problem);
  } else if (family != Family::kBattery) {
    option.amounts += Joined(problem, quantity, stands_pa, asked);
  }
  return option;
}

}  // namespace plenum::test
