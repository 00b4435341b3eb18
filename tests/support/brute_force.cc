#include "tests/support/brute_force.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "model/physics/storage.h"
#include "tests/support/packs/packs_by_hand.h"
#include "tests/support/pumps/direct_sizing.h"
#include "tests/support/scan_sizing.h"
#include "tests/support/small_catalogue.h"
#include "tests/support/tank_sizing.h"

namespace plenum::test {
namespace {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Family;
using optimizer::Line;
using optimizer::Option;
using optimizer::Problem;

bool NeedsPrice(const Problem& problem) {
  return problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur);
}

bool CustomAllowed(const Problem& problem) {
  if (Evacuated(problem)) return false;
  const auto required = problem.require.find(Family::kReservoir);
  return problem.exclude.count("custom") == 0 &&
         (required == problem.require.end() || required->second.count("custom") > 0);
}

std::vector<Line> Lines(const Problem& problem, int group, model::Gas gas) {
  const model::Parts& parts = problem.parts;
  const bool fittings = problem.groups[group].fittings_per_line > 0;
  std::vector<Line> lines;
  for (int t = 0; t < static_cast<int>(parts.tubing.size()); ++t)
    for (int f = fittings ? 0 : -1; f < (fittings ? static_cast<int>(parts.fittings.size()) : 0);
         ++f)
      for (int v = 0; v < static_cast<int>(parts.valves.size()); ++v) {
        const bool priced = parts.tubing[t].per_metre.cost_eur && parts.valves[v].basics.cost_eur &&
                            (f < 0 || parts.fittings[f].basics.cost_eur);
        if (Mates(problem, t, f, v) && (priced || !NeedsPrice(problem)))
          lines.push_back(AssembleLine(problem, group, t, f, v, gas));
      }
  return lines;
}

template <typename Part>
std::vector<Option> Options(const Problem& problem, Family family, const std::vector<Part>& parts,
                            int quantity_max) {
  std::vector<Option> options;
  for (int i = 0; i < static_cast<int>(parts.size()); ++i)
    for (int quantity = 1; quantity <= quantity_max; ++quantity)
      if (parts[i].basics.cost_eur || !NeedsPrice(problem))
        options.push_back(MakeOption(problem, family, i, quantity));
  return options;
}

std::vector<Option> Reservoirs(const Problem& problem) {
  std::vector<Option> options =
      Options(problem, Family::kReservoir, problem.parts.reservoirs, problem.limits.reservoirs);
  if (CustomAllowed(problem) && !NeedsPrice(problem)) {
    Option custom;
    custom.index = optimizer::kCustom;
    custom.quantity = 1;
    options.push_back(custom);
  }
  return options;
}

bool RegulatorStands(const Problem& problem, const Candidate& candidate) {
  if (HasTank(candidate.configuration)) return true;  // its fill is a setting
  const model::Regulator& regulator = problem.parts.regulators[candidate.regulator.index];
  double inlet_pa = 0.0;
  if (candidate.configuration == Configuration::kCylinder)
    return regulator.inlet_pressure_max_pa >=
           problem.parts.cylinders[candidate.bottle.index].fill_pressure_pa;
  inlet_pa = candidate.configuration == Configuration::kCo2
                 ? model::Co2SaturationPressure(problem.ambient.temperature_k)
                 : problem.mains.pressure_pa;
  return regulator.inlet_pressure_min_pa <= inlet_pa && inlet_pa <= regulator.inlet_pressure_max_pa;
}

bool VoltagesMatch(const Problem& problem, const Candidate& candidate) {
  const double pack_v = problem.parts.batteries[candidate.battery.index].nominal_voltage_v;
  const model::Compressor& pump = ChosenPump(problem, candidate);
  if (IsEjector(candidate.configuration))
    return candidate.compressor.quantity * FeedsByHand(problem) * pump.air_consumption_m3_per_s <=
           problem.compressed_air.flow_max_m3_per_s;
  const double pump_v = pump.curve.voltage_v;
  return std::abs(pack_v - pump_v) <= 0.15 * pump_v * (1.0 + 1e-9);
}

using Visit = std::function<void(const Candidate&)>;

// With every vacuum beside the source, where there is one, that the battery drives.
void ForEachRail(const Problem& problem, Candidate& candidate, const Visit& visit) {
  if (!PumpsRail(problem)) return visit(candidate);
  const auto drives = [&](const Option& pump) {
    if (candidate.battery.index < 0) return true;
    const double pack_v = problem.parts.batteries[candidate.battery.index].nominal_voltage_v;
    const double pump_v = problem.parts.vacuum_pumps[pump.index].curve.voltage_v;
    return std::abs(pack_v - pump_v) <= 0.15 * pump_v * (1.0 + 1e-9);
  };
  for (const Option& pump : Options(problem, Family::kVacuumPump, problem.parts.vacuum_pumps,
                                    problem.limits.compressors))
    for (const Option& reservoir : Options(problem, Family::kVacuumReservoir,
                                           problem.parts.reservoirs, problem.limits.reservoirs)) {
      candidate.rail.pump = pump;
      candidate.rail.reservoir = reservoir;
      if (drives(pump)) visit(candidate);
    }
}

void ForEachSource(const Problem& problem, Candidate& candidate, const Visit& visit) {
  const model::Parts& parts = problem.parts;
  const std::vector<Option> batteries =
      Options(problem, Family::kBattery, parts.batteries, problem.limits.batteries);
  const auto pumps = [&] {
    return Options(problem, PumpFamily(candidate.configuration),
                   PumpsOf(problem, candidate.configuration), problem.limits.compressors);
  };
  if (IsDirect(candidate.configuration)) {
    for (const Option& compressor : pumps())
      for (const Option& battery : batteries) {
        candidate.compressor = compressor;
        candidate.battery = battery;
        if (VoltagesMatch(problem, candidate)) visit(candidate);
      }
    return;
  }
  if (KeepsReservoir(candidate.configuration)) {
    for (const Option& compressor : pumps())
      for (const Option& battery : batteries)
        for (const Option& reservoir : Reservoirs(problem)) {
          candidate.compressor = compressor;
          candidate.battery = battery;
          candidate.reservoir = reservoir;
          if (VoltagesMatch(problem, candidate)) visit(candidate);
        }
    return;
  }
  std::vector<Option> regulators = Options(problem, Family::kRegulator, parts.regulators, 1);
  if (candidate.configuration == Configuration::kTank) regulators.emplace_back();  // or none
  std::vector<Option> bottles{{}};
  if (candidate.configuration == Configuration::kCylinder)
    bottles = Options(problem, Family::kCylinder, parts.cylinders, problem.limits.cylinders);
  if (candidate.configuration == Configuration::kCo2)
    bottles = Options(problem, Family::kCo2, parts.co2, problem.limits.co2);
  if (HasTank(candidate.configuration))
    bottles = Options(problem, Family::kTank, parts.tanks, problem.limits.reservoirs);
  const bool mains = candidate.configuration == Configuration::kMains;
  const bool fills = candidate.configuration == Configuration::kTankAndPump;
  for (const Option& regulator : regulators)
    for (const Option& bottle : bottles)
      for (const Option& pump : fills ? pumps() : std::vector<Option>{{}})
        for (const Option& battery : mains ? std::vector<Option>{{}} : batteries) {
          candidate.regulator = regulator;
          candidate.bottle = bottle;
          candidate.compressor = pump;
          candidate.battery = battery;
          if (RegulatorStands(problem, candidate) && (!fills || VoltagesMatch(problem, candidate)))
            ForEachRail(problem, candidate, visit);
        }
}

void ForEachLine(const Problem& problem, const std::vector<std::vector<Line>>& lines,
                 Candidate& candidate, const Visit& visit) {
  const std::size_t group = candidate.lines.size();
  if (group == lines.size()) {
    ForEachSource(problem, candidate, visit);
    return;
  }
  for (const Line& line : lines[group]) {
    candidate.lines.push_back(&line);
    ForEachLine(problem, lines, candidate, visit);
    candidate.lines.pop_back();
  }
}

// The contract's product for one configuration.
long long Combinations(const Problem& problem, Configuration configuration) {
  const model::Parts& parts = problem.parts;
  const auto count = [](const auto& family, int quantity_max) {
    return static_cast<long long>(family.size()) * quantity_max;
  };
  long long product = 1;
  for (const optimizer::ActuatorGroup& group : problem.groups)
    product *= count(parts.tubing, 1) * count(parts.valves, 1) *
               (group.fittings_per_line > 0 ? count(parts.fittings, 1) : 1);
  const optimizer::Limits& limits = problem.limits;
  if (IsDirect(configuration))
    return product * count(PumpsOf(problem, configuration), limits.compressors) *
           count(parts.batteries, limits.batteries);
  if (KeepsReservoir(configuration))
    return product * count(PumpsOf(problem, configuration), limits.compressors) *
           count(parts.batteries, limits.batteries) *
           (count(parts.reservoirs, limits.reservoirs) + (CustomAllowed(problem) ? 1 : 0));
  if (configuration == Configuration::kTank)
    return product * (count(parts.regulators, 1) + 1) * count(parts.tanks, limits.reservoirs) *
           count(parts.batteries, limits.batteries);
  product *= count(parts.regulators, 1);
  if (PumpsRail(problem))
    product *=
        count(parts.vacuum_pumps, limits.compressors) * count(parts.reservoirs, limits.reservoirs);
  if (configuration == Configuration::kMains) return product;
  if (configuration == Configuration::kTankAndPump)
    return product * count(parts.tanks, limits.reservoirs) *
           count(PumpsOf(problem, configuration), limits.compressors) *
           count(parts.batteries, limits.batteries);
  return product * count(parts.batteries, limits.batteries) *
         (configuration == Configuration::kCylinder ? count(parts.cylinders, limits.cylinders)
                                                    : count(parts.co2, limits.co2));
}

}  // namespace

bool GoesBefore(const Enumerated& a, const Enumerated& b) {
  if (std::abs(a.mass_kg - b.mass_kg) > 1e-10) return a.mass_kg < b.mass_kg;
  if (std::abs(a.cost_eur - b.cost_eur) > 1e-7) return a.cost_eur < b.cost_eur;
  return a.key < b.key;
}

void Rank(std::vector<Enumerated>& designs) {
  const auto by_objective = [](const Enumerated& a, const Enumerated& b) {
    return a.leaf.objective < b.leaf.objective;
  };
  std::sort(designs.begin(), designs.end(), by_objective);
  for (auto first = designs.begin(); first != designs.end();) {
    const double limit = first->leaf.objective * (1.0 + 1e-6);
    auto last = first;
    while (last != designs.end() && last->leaf.objective <= limit) ++last;
    std::sort(first, last, GoesBefore);
    first = last;
  }
}

PartsKey KeyOf(const Problem& problem, const Candidate& candidate) {
  PartsKey key;
  const model::Parts& parts = problem.parts;
  for (std::size_t g = 0; g < candidate.lines.size(); ++g) {
    const Line& line = *candidate.lines[g];
    const optimizer::ActuatorGroup& group = problem.groups[g];
    const model::Valve& valve = parts.valves[line.valve];
    key.emplace_back(valve.basics.id, static_cast<int>(std::ceil(static_cast<double>(group.count) /
                                                                 valve.channels)));
    if (line.fitting >= 0)
      key.emplace_back(parts.fittings[line.fitting].basics.id,
                       group.count * group.fittings_per_line);
    key.emplace_back(parts.tubing[line.tubing].per_metre.id, 1);
  }
  const auto add = [&](const auto& family, const Option& option) {
    if (option.index >= 0) key.emplace_back(family[option.index].basics.id, option.quantity);
  };
  add(parts.regulators, candidate.regulator);
  if (candidate.configuration == Configuration::kCylinder) add(parts.cylinders, candidate.bottle);
  if (candidate.configuration == Configuration::kCo2) add(parts.co2, candidate.bottle);
  if (HasTank(candidate.configuration)) add(parts.tanks, candidate.bottle);
  optimizer::Option pumps = candidate.compressor;
  pumps.quantity *= FeedsByHand(problem);
  add(PumpsOf(problem, candidate.configuration), pumps);
  add(parts.vacuum_pumps, candidate.rail.pump);
  add(parts.batteries, candidate.battery);
  add(parts.reservoirs, candidate.rail.reservoir);
  add(parts.reservoirs, candidate.reservoir);
  if (candidate.reservoir.index == optimizer::kCustom) key.emplace_back("custom", 1);
  return key;
}

PartsKey KeyOf(const optimizer::Design& design) {
  PartsKey key;
  for (const optimizer::Choice& choice : design.parts)
    if (choice.family != Family::kManifold && choice.family != Family::kCheckValve)  // no choices
      key.emplace_back(choice.id, choice.family == Family::kTubing
                                      ? 1
                                      : static_cast<int>(std::lround(choice.quantity)));
  return key;
}

void ForEachCombination(const Problem& problem, const Visit& visit) {
  for (Configuration configuration : problem.configurations) {
    const model::Gas gas =
        configuration == Configuration::kCo2 ? model::Gas::kCo2 : model::Gas::kAir;
    std::vector<std::vector<Line>> lines;
    lines.reserve(problem.groups.size());
    for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
      lines.push_back(Lines(problem, g, gas));
    Candidate candidate;
    candidate.configuration = configuration;
    ForEachLine(problem, lines, candidate, visit);
  }
}

double StockVolume(const Problem& problem, const Candidate& candidate) {
  if (HasTank(candidate.configuration) && candidate.bottle.index >= 0)
    return candidate.bottle.quantity * problem.parts.tanks[candidate.bottle.index].volume_m3;
  if (candidate.reservoir.index < 0) return 0.0;
  return candidate.reservoir.quantity *
         problem.parts.reservoirs[candidate.reservoir.index].volume_m3;
}

optimizer::Leaf SizeAlone(const Problem& problem, const Candidate& candidate) {
  if (CanSizeTank(problem, candidate)) return SizeTank(problem, candidate);
  if (IsDirect(candidate.configuration)) return SizeDirectPump(problem, candidate);
  if (candidate.reservoir.index != optimizer::kCustom)
    return optimizer::SizeAtVolume(problem, candidate, StockVolume(problem, candidate));
  optimizer::CustomSizing sizing(problem, candidate);
  while (!sizing.Refine()) {
  }
  return sizing.leaf();
}

namespace {

optimizer::Leaf SizeByScan(const Problem& problem, const Candidate& candidate) {
  const Scanned scanned = ScanMadeReservoir(problem, candidate);
  optimizer::Leaf leaf;
  leaf.status = scanned.feasible ? optimizer::LeafStatus::kFeasible
                : scanned.failed ? optimizer::LeafStatus::kUndecided
                                 : optimizer::LeafStatus::kInfeasible;
  leaf.point = scanned.point;
  leaf.objective = leaf.lower_bound = scanned.objective;
  return leaf;
}

}  // namespace

BruteForce Enumerate(const Problem& problem) {
  BruteForce result;
  for (Configuration configuration : problem.configurations)
    result.combinations += Combinations(problem, configuration);
  ForEachCombination(problem, [&](const Candidate& counted) {
    Candidate candidate = counted;
    candidate.pack_surplus_eur = SurplusByHand(problem, counted);
    const bool made = candidate.reservoir.index == optimizer::kCustom;
    const optimizer::Leaf leaf =
        made ? SizeByScan(problem, candidate) : SizeAlone(problem, candidate);
    ++result.sized;
    if (leaf.status == optimizer::LeafStatus::kUndecided) ++result.undecided;
    if (leaf.status != optimizer::LeafStatus::kFeasible) return;
    const optimizer::Amounts parts = optimizer::TotalAmounts(
        problem, candidate, optimizer::LeastPoint(problem, model::kMadeReservoirSmallestM3));
    const optimizer::Objective& goal = problem.objective;
    const bool others = goal.volume_l > 0.0 || goal.energy_wh > 0.0;
    const bool mass_counts = others || goal.cost_eur > 0.0;
    const bool cost_counts = others || goal.mass_kg > 0.0;
    result.designs.push_back({KeyOf(problem, candidate), mass_counts ? parts.mass_kg : 0.0,
                              cost_counts ? parts.cost_eur : 0.0, candidate.configuration, leaf});
  });
  Rank(result.designs);
  return result;
}

optimizer::SearchOptions Within(double seconds) {
  optimizer::SearchOptions options;
  options.time_limit_s = seconds;
  return options;
}

}  // namespace plenum::test
