#include "optimizer/expand.h"

#include <algorithm>
#include <cmath>

#include "model/storage.h"
#include "optimizer/sizing.h"

namespace plenum::optimizer {
namespace {

constexpr double kJoulePerWattHour = 3600.0;

double EnergyObjective(const Problem& problem, double energy_per_cycle_j) {
  return problem.objective.energy_wh * problem.actuations * energy_per_cycle_j / kJoulePerWattHour;
}

double LineObjective(const Problem& problem, const Line& line) {
  return ObjectiveOf(problem.objective, line.amounts) +
         EnergyObjective(problem, CoilEnergyPerCycle(problem, line, line.inflate_time_least_s));
}

Amounts Least(const Amounts& a, const Amounts& b) {
  return {std::min(a.mass_kg, b.mass_kg), std::min(a.volume_m3, b.volume_m3),
          std::min(a.cost_eur, b.cost_eur)};
}

constexpr Amounts kNothingFits{kUnlimited, kUnlimited, kUnlimited};

Amounts LeastAmounts(const Problem& problem, const OptionSet& set) {
  Amounts least = kNothingFits;
  for (const Option& option : set.options)
    least = Least(least, option.index == kCustom
                             ? CustomReservoir(problem, model::kMadeReservoirSmallestM3)
                             : option.amounts);
  return least;
}

bool WithinLimits(const Problem& problem, const Amounts& amounts) {
  return amounts.mass_kg <= problem.mass_max_kg &&
         amounts.volume_m3 * 1e3 <= problem.volume_max_l &&
         amounts.cost_eur <= problem.cost_max_eur;
}

// Needs of what is chosen so far, with the least of what is not, per cycle.
struct Need {
  double air_m3 = 0.0;
  double air_to_target_m3 = 0.0;
  double source_min_pa = 0.0;
  double coil_j = 0.0;
  double coil_power_w = 0.0;
  PumpNeed pump;
  double energy_j = 0.0;  // coils, regulator and pumps
};

Need LeastNeed(const Problem& problem, const Tree& tree, const Candidate& candidate,
               const Line* next = nullptr) {
  Need need;
  const double floor_pa = problem.ambient.pressure_pa;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const int chosen = static_cast<int>(candidate.lines.size());
    const Line* line = g < chosen ? candidate.lines[g] : g == chosen ? next : nullptr;
    if (line == nullptr) {
      need.air_m3 += tree.air_least_m3[g];
      need.air_to_target_m3 += AirToTarget(problem, g, problem.groups[g].chamber);
      need.coil_j += tree.coil_least_j[g];
      continue;
    }
    need.air_m3 += AirPerStroke(problem, g, *line, std::max(floor_pa, line->source_min_pa));
    need.air_to_target_m3 += AirToTarget(problem, g, line->chamber);
    need.source_min_pa = std::max(need.source_min_pa, line->source_min_pa);
    need.coil_j += CoilEnergyPerCycle(problem, *line, line->inflate_time_least_s);
    need.coil_power_w += line->coil_power_w;
  }
  need.energy_j = need.coil_j;
  if (candidate.regulator.index != kNone) {
    const double power_w = problem.parts.regulators[candidate.regulator.index].electrical_power_w;
    need.coil_power_w += power_w;
    need.energy_j += power_w / problem.frequency_hz;
  }
  if (candidate.compressor.index != kNone) {
    need.pump = LeastPumpNeed(problem, tree.pumps[candidate.compressor.index],
                              candidate.compressor.quantity, need.air_m3, need.air_to_target_m3,
                              need.source_min_pa);
    need.energy_j += need.pump.energy_j;
  }
  return need;
}

bool PumpBears(const Problem& problem, const Candidate& candidate, const Need& need) {
  const double duty_max = problem.parts.compressors[candidate.compressor.index].duty_max;
  return need.pump.on_s * problem.frequency_hz <= duty_max;
}

// What a battery must bear.
struct BatteryNeed {
  double energy_j;  // whole mission
  double coil_power_w;
  double pump_current_a;
};

// Current of the pumps at the lowest useful source pressure.
double PumpCurrent(const Problem& problem, const Candidate& candidate) {
  if (candidate.compressor.index == kNone) return 0.0;
  double low_pa = std::max(problem.ambient.pressure_pa, candidate.source_floor_pa);
  for (const Line* line : candidate.lines) low_pa = std::max(low_pa, line->source_min_pa);
  return candidate.compressor.quantity *
         model::LargestCurrent(problem.parts.compressors[candidate.compressor.index].curve,
                               problem.ambient.pressure_pa, low_pa);
}

double UsableEnergy(const Problem& problem, const Option& option) {
  const model::Battery& battery = problem.parts.batteries[option.index];
  return option.quantity * model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v);
}

bool BatteryBears(const Problem& problem, const Option& option, const BatteryNeed& need) {
  const model::Battery& battery = problem.parts.batteries[option.index];
  return need.energy_j <= option.quantity *
                              model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v) &&
         need.pump_current_a + need.coil_power_w / battery.nominal_voltage_v <=
             option.quantity * battery.current_max_a;
}

// Whether bottles hold enough gas, and CO2 evaporates fast enough, at a source pressure that is at
// least needed (less gas is left to use at a higher one).
bool BottleBears(const Problem& problem, const Candidate& candidate, const Option& option,
                 const Need& need, double source_pa) {
  const model::Regulator& regulator = problem.parts.regulators[candidate.regulator.index];
  const double inlet_pa = std::max(source_pa, regulator.inlet_pressure_min_pa);
  const double temperature_k = problem.ambient.temperature_k;
  const double air_m3 = problem.actuations * need.air_m3;
  if (candidate.configuration == Configuration::kCylinder) {
    const model::Cylinder& cylinder = problem.parts.cylinders[option.index];
    return option.quantity * model::CylinderUsableVolume(cylinder.water_volume_m3,
                                                         cylinder.fill_pressure_pa, inlet_pa,
                                                         temperature_k) >=
           air_m3;
  }
  const model::Co2Bottle& bottle = problem.parts.co2[option.index];
  return option.quantity * model::Co2UsableVolume(bottle.co2_mass_kg, bottle.water_volume_m3,
                                                  inlet_pa, temperature_k) >=
             air_m3 &&
         option.quantity * bottle.flow_sustained_m3_per_s >= need.air_m3 * problem.frequency_hz;
}

bool Mates(const Problem& problem, const Candidate& candidate, Stage stage, const Option& option) {
  switch (stage) {
    case Stage::kRegulator:
      return RegulatorFits(problem, candidate.configuration, option.index);
    case Stage::kBottle:
      return candidate.configuration != Configuration::kCylinder ||
             RegulatorFitsCylinder(problem, candidate.regulator.index, option.index);
    case Stage::kBattery:
      return candidate.compressor.index == kNone ||
             BatteryFitsCompressor(problem, option.index, candidate.compressor.index);
    default:
      return true;
  }
}

// Objective of the lightest option that mates and bears the need; +∞ if none does.
template <typename Bears>
double LeastThatBears(const Problem& problem, const Candidate& candidate, Stage stage,
                      const OptionSet& set, Bears&& bears) {
  for (const Option& option : set.options)
    if (Mates(problem, candidate, stage, option) && bears(option)) return option.objective;
  return kUnlimited;
}

const OptionSet& Options(const Tree& tree, Stage stage) {
  switch (stage) {
    case Stage::kRegulator:
      return tree.regulators;
    case Stage::kCompressor:
      return tree.compressors;
    case Stage::kBottle:
      return tree.bottles;
    case Stage::kBattery:
      return tree.batteries;
    default:
      return tree.reservoirs;
  }
}

Option& Slot(Candidate& candidate, Stage stage) {
  switch (stage) {
    case Stage::kRegulator:
      return candidate.regulator;
    case Stage::kCompressor:
      return candidate.compressor;
    case Stage::kBottle:
      return candidate.bottle;
    case Stage::kBattery:
      return candidate.battery;
    default:
      return candidate.reservoir;
  }
}

bool Has(const Tree& tree, Stage stage) {
  return std::any_of(tree.stages.begin(), tree.stages.end(),
                     [stage](const StageInfo& info) { return info.stage == stage; });
}

double LeastBattery(const Problem& problem, const Tree& tree, const Candidate& candidate,
                    const BatteryNeed& need) {
  const std::vector<Option>& batteries = candidate.compressor.index == kNone
                                             ? tree.batteries.options
                                             : tree.pump_batteries[candidate.compressor.index];
  for (const Option& option : batteries)
    if (BatteryBears(problem, option, need)) return option.objective;
  return kUnlimited;
}

// Least objective of a reservoir of at least `volume_m3`.
double LeastReservoir(const Problem& problem, const Tree& tree, double volume_m3) {
  double least = kUnlimited;
  const auto stock = std::lower_bound(
      tree.reservoir_by_volume.begin(), tree.reservoir_by_volume.end(), volume_m3,
      [](const std::pair<double, double>& entry, double volume) { return entry.first < volume; });
  if (stock != tree.reservoir_by_volume.end()) least = stock->second;
  if (tree.custom_allowed && volume_m3 <= model::kMadeReservoirLargestM3)
    least = std::min(
        least, ObjectiveOf(
                   problem.objective,
                   CustomReservoir(problem, std::max(volume_m3, model::kMadeReservoirSmallestM3))));
  return least;
}

// Bound from below on the objective of the families after the lines.
double SourceRest(const Problem& problem, const Tree& tree, const Candidate& candidate,
                  const Need& need, const Window& window) {
  double rest = 0.0;
  if (Has(tree, Stage::kBottle) && candidate.bottle.index == kNone)
    rest += LeastThatBears(problem, candidate, Stage::kBottle, tree.bottles, [&](const Option& o) {
      return BottleBears(problem, candidate, o, need, window.low_pa);
    });
  if (Has(tree, Stage::kBattery) && candidate.battery.index == kNone)
    rest += LeastBattery(
        problem, tree, candidate,
        {problem.actuations * need.energy_j, need.coil_power_w, PumpCurrent(problem, candidate)});
  if (Has(tree, Stage::kReservoir))
    rest += LeastReservoir(
        problem, tree,
        LeastReservoirVolume(problem, tree.pumps[candidate.compressor.index],
                             candidate.compressor.quantity, need.air_to_target_m3, window.high_pa));
  return rest;
}

// Objective of what the parent has chosen, coils included.
double ChosenObjective(const Problem& problem, const Candidate& parent) {
  double chosen = parent.regulator.objective + parent.compressor.objective +
                  parent.bottle.objective + parent.battery.objective;
  if (parent.reservoir.index >= 0) chosen += parent.reservoir.objective;
  for (const Line* line : parent.lines) chosen += LineObjective(problem, *line);
  return chosen;
}

// Energy of a mission beyond the coils, which LineObjective counts, as a share of the objective.
double PumpObjective(const Problem& problem, const Need& need, double energy_j) {
  return EnergyObjective(problem, energy_j / problem.actuations - need.coil_j);
}

double StockVolume(const Problem& problem, const Option& reservoir) {
  return reservoir.quantity * problem.parts.reservoirs[reservoir.index].volume_m3;
}

const std::vector<ReservoirNeed>& AloneNeeds(const Tree& tree, const Candidate& candidate,
                                             std::size_t g) {
  const Option& compressor = candidate.compressor;
  const auto [entry, fresh] =
      tree.alone_needs.try_emplace({compressor.index, compressor.quantity, candidate.lines[g]});
  if (fresh) {
    Candidate alone = candidate;
    alone.lines = {candidate.lines[g]};
    entry->second = ReservoirNeeds(tree.alone[g], tree.alone_pumps[g][compressor.index], alone,
                                   tree.pump_energy_max_j[compressor.index],
                                   tree.smallest_reservoir_m3, tree.largest_reservoir_m3);
  }
  return entry->second;
}

// ReservoirNeeds of several groups on one compressor: at each volume the stop pressure of the most
// demanding group that is chosen, and duty and energy for the air of all.
std::vector<ReservoirNeed> SharedReservoirNeeds(const Problem& problem, const Tree& tree,
                                                const Candidate& candidate, const Need& need) {
  const Option& compressor = candidate.compressor;
  const model::Compressor& part = problem.parts.compressors[compressor.index];
  const Window window = SourceWindow(problem, candidate);
  std::vector<ReservoirNeed> shared;
  for (ReservoirNeed volume : AloneNeeds(tree, candidate, 0)) {
    bool possible = true;
    for (std::size_t g = 1; g < candidate.lines.size() && possible; ++g) {
      const std::vector<ReservoirNeed>& other = AloneNeeds(tree, candidate, g);
      const auto same = std::find_if(other.begin(), other.end(), [&](const ReservoirNeed& o) {
        return o.low_m3 == volume.low_m3;
      });
      possible = same != other.end();
      if (!possible) break;
      volume.source_pa = std::max(volume.source_pa, same->source_pa);
      volume.source_max_pa = std::min(volume.source_max_pa, same->source_max_pa);
    }
    volume.source_pa = std::max(volume.source_pa, window.low_pa);
    volume.source_max_pa = std::min(volume.source_max_pa, window.high_pa);
    if (!possible || volume.source_pa > volume.source_max_pa) continue;
    double first_fill_j = 0.0;
    const PumpNeed pump =
        LeastPumpNeed(problem, tree.pumps[compressor.index], compressor.quantity, need.air_m3,
                      volume.source_pa, volume.low_m3, &first_fill_j);
    volume.energy_j = first_fill_j + problem.actuations * (pump.energy_j + need.coil_j);
    if (pump.on_s * problem.frequency_hz <= part.duty_max &&
        volume.energy_j <= tree.pump_energy_max_j[compressor.index])
      shared.push_back(volume);
  }
  return shared;
}

// Reservoirs behind a chosen compressor and lines: each interval of volumes has a least energy and
// so a lightest battery; a reservoir is bounded by the interval that its volume lies in.
void ExpandReservoirs(const Problem& problem, const Tree& tree, const Candidate& parent,
                      const StageInfo& info, const Amounts& amounts, Children& children) {
  const Need need = LeastNeed(problem, tree, parent);
  const std::vector<ReservoirNeed> volumes =
      ReservoirNeeds(problem, tree.pumps[parent.compressor.index], parent,
                     tree.pump_energy_max_j[parent.compressor.index], tree.smallest_reservoir_m3,
                     tree.largest_reservoir_m3);
  std::vector<double> rest;  // battery and energy, per interval
  for (const ReservoirNeed& volume : volumes) {
    Candidate candidate = parent;
    candidate.source_floor_pa = volume.source_pa;
    rest.push_back(
        LeastBattery(problem, tree, candidate,
                     {volume.energy_j, need.coil_power_w, PumpCurrent(problem, candidate)}) +
        PumpObjective(problem, need, volume.energy_j));
  }
  const double chosen = ChosenObjective(problem, parent);
  for (const Option& option : tree.reservoirs.options) {
    const bool custom = option.index == kCustom;
    Candidate candidate = parent;
    candidate.reservoir = option;
    const Window window = SourceWindow(problem, candidate);
    Amounts total = amounts;
    total += custom ? CustomReservoir(problem, model::kMadeReservoirSmallestM3) : option.amounts;
    total += info.least;
    double bound = kUnlimited;
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      if (volumes[i].source_pa > window.high_pa) continue;
      if (custom) {
        if (volumes[i].low_m3 >= model::kMadeReservoirLargestM3) continue;
        bound = std::min(
            bound, chosen + rest[i] +
                       ObjectiveOf(problem.objective, CustomReservoir(problem, volumes[i].low_m3)));
      } else if (const double volume_m3 = StockVolume(problem, option);
                 volumes[i].low_m3 <= volume_m3 && volume_m3 <= volumes[i].high_m3) {
        bound = std::min(bound, chosen + rest[i] + option.objective);
      }
    }
    if (std::isfinite(bound) && !window.empty() && WithinLimits(problem, total))
      children.list.push_back({bound, option, nullptr});
    else
      ++children.infeasible;
  }
}

// Raises the need of a stock reservoir to what the lowest useful source pressure takes, where that
// is the least (the pump's power rises with pressure); false if the strokes or the pump cannot do
// it.
bool KnowStock(const Problem& problem, const Candidate& candidate, double volume_m3,
               ReservoirNeed& need) {
  OperatingPoint point{0.0, volume_m3, volume_m3};
  Candidate bounded = candidate;
  bounded.source_floor_pa = need.source_pa;
  bounded.source_cap_pa = need.source_max_pa;
  const std::optional<double> needed = NeededSourcePressure(problem, bounded, point);
  if (!needed) return false;
  need.source_pa = point.source_pa = *needed;
  if (!PumpPowerRises(problem, candidate)) return true;
  const Evaluation least = Evaluate(problem, candidate, point, {.least_coil_energy = true});
  need.energy_j = std::max(need.energy_j, least.energy_total_j);
  return least.frequency_sustained_hz >= problem.frequency_hz;
}

// Batteries of the compressor configuration, the last family there.
void ExpandPumpBatteries(const Problem& problem, const Tree& tree, const Candidate& parent,
                         const Amounts& amounts, Children& children) {
  Candidate candidate = parent;
  const bool custom = parent.reservoir.index == kCustom;
  const Need need = LeastNeed(problem, tree, parent);
  const double chosen = ChosenObjective(problem, parent);
  const double stock_m3 = custom ? 0.0 : StockVolume(problem, parent.reservoir);
  std::vector<ReservoirNeed> volumes =
      ReservoirNeeds(problem, tree.pumps[parent.compressor.index], parent,
                     tree.pump_energy_max_j[parent.compressor.index],
                     custom ? model::kMadeReservoirSmallestM3 : stock_m3,
                     custom ? model::kMadeReservoirLargestM3 : stock_m3);
  if (!custom && !volumes.empty()) {
    // No battery changes the strokes: find the source pressure once for all of them.
    if (KnowStock(problem, parent, stock_m3, volumes.front()))
      children.source_floor_pa = volumes.front().source_pa,
      children.source_cap_pa = volumes.front().source_max_pa;
    else
      volumes.clear();
  }
  for (const Option& option : tree.batteries.options) {
    if (!BatteryFitsCompressor(problem, option.index, parent.compressor.index)) {
      ++children.incompatible;
      continue;
    }
    Amounts total = amounts;
    total += option.amounts;
    double bound = kUnlimited;
    for (const ReservoirNeed& volume : volumes) {
      candidate.source_floor_pa = volume.source_pa;
      if (BatteryBears(problem, option,
                       {volume.energy_j, need.coil_power_w, PumpCurrent(problem, candidate)}))
        bound = std::min(
            bound,
            chosen + option.objective + PumpObjective(problem, need, volume.energy_j) +
                (custom ? ObjectiveOf(problem.objective, CustomReservoir(problem, volume.low_m3))
                        : 0.0));
    }
    if (std::isfinite(bound) && WithinLimits(problem, total))
      children.list.push_back({bound, option, nullptr});
    else
      ++children.infeasible;
  }
}

void ExpandLines(const Problem& problem, const Tree& tree, const Candidate& parent,
                 const StageInfo& info, const Amounts& amounts, Children& children) {
  const LineSet& set = *tree.lines[info.group];
  children.incompatible = set.incompatible;
  children.infeasible = set.infeasible;
  const Window window = SourceWindow(problem, parent);
  double chosen = ChosenObjective(problem, parent);
  for (std::size_t g = info.group + 1; g < problem.groups.size(); ++g)
    chosen += tree.line_objective_least[g];

  for (const Line& line : set.lines) {
    const double low_pa = std::max(window.low_pa, line.source_min_pa);
    const double high_pa = std::min(window.high_pa, line.source_max_pa);
    Amounts total = amounts;
    total += line.amounts;
    total += info.least;
    bool possible = low_pa <= high_pa && WithinLimits(problem, total);
    double bound = kUnlimited;
    if (possible) {
      const Need need = LeastNeed(problem, tree, parent, &line);
      possible = parent.compressor.index == kNone || PumpBears(problem, parent, need);
      if (possible)
        bound = chosen + LineObjective(problem, line) +
                EnergyObjective(problem, need.pump.energy_j) +
                SourceRest(problem, tree, parent, need, {low_pa, high_pa});
    }
    if (std::isfinite(bound))
      children.list.push_back({bound, {}, &line});
    else
      ++children.infeasible;
  }
}

void ExpandOptions(const Problem& problem, const Tree& tree, const Candidate& parent,
                   const StageInfo& info, const Amounts& amounts, Children& children) {
  const OptionSet& set = Options(tree, info.stage);
  const bool lines_chosen = parent.lines.size() == problem.groups.size();
  Candidate candidate = parent;
  // With all lines and the regulator known the lowest useful source pressure is, too.
  if (info.stage == Stage::kBottle) {
    const std::optional<double> needed = NeededSourcePressure(problem, parent, {});
    if (!needed) {
      children.infeasible = static_cast<long long>(set.options.size());
      return;
    }
    candidate.source_floor_pa = children.source_floor_pa = *needed;
  }
  double chosen = ChosenObjective(problem, parent);
  if (!lines_chosen)
    for (double least : tree.line_objective_least) chosen += least;
  const Need shared = LeastNeed(problem, tree, parent);

  for (const Option& option : set.options) {
    if (!Mates(problem, candidate, info.stage, option)) {
      ++children.incompatible;
      continue;
    }
    Slot(candidate, info.stage) = option;
    Amounts total = amounts;
    total += option.amounts;
    total += info.least;
    bool possible = WithinLimits(problem, total);
    if (info.stage == Stage::kBottle)
      possible =
          possible && BottleBears(problem, candidate, option, shared, candidate.source_floor_pa);
    if (info.stage == Stage::kBattery)
      possible = possible &&
                 BatteryBears(problem, option,
                              {problem.actuations * shared.energy_j, shared.coil_power_w, 0.0});
    const Window window = SourceWindow(problem, candidate);
    possible = possible && !window.empty();
    double bound = kUnlimited;
    if (possible) {
      Need need = shared;
      if (info.stage == Stage::kCompressor || info.stage == Stage::kRegulator)
        need = LeastNeed(problem, tree, candidate);
      possible = info.stage != Stage::kCompressor || PumpBears(problem, candidate, need);
      const double rest = info.stage == Stage::kReservoir
                              ? 0.0
                              : SourceRest(problem, tree, candidate, need, window);
      if (possible)
        bound = chosen + option.objective + EnergyObjective(problem, need.pump.energy_j) + rest;
    }
    if (std::isfinite(bound))
      children.list.push_back({bound, option, nullptr});
    else
      ++children.infeasible;
  }
}

}  // namespace

Tree MakeTree(const Problem& problem, Configuration configuration,
              std::vector<std::shared_ptr<const LineSet>> lines) {
  Tree tree;
  tree.configuration = configuration;
  tree.lines = std::move(lines);
  const int groups = static_cast<int>(problem.groups.size());
  std::vector<Amounts> least;  // of each stage itself
  const auto add = [&](Stage stage, const OptionSet& set) {
    tree.stages.push_back({stage, -1, set.total, 1, {}});
    least.push_back(LeastAmounts(problem, set));
  };
  if (configuration == Configuration::kCompressor) {
    add(Stage::kCompressor, tree.compressors = CompressorOptions(problem));
    for (const model::Compressor& compressor : problem.parts.compressors)
      tree.pumps.push_back(MakePumpFacts(problem, compressor.curve));
  } else {
    add(Stage::kRegulator, tree.regulators = RegulatorOptions(problem));
  }
  for (int g = 0; g < groups; ++g) {
    tree.stages.push_back({Stage::kLine, g, tree.lines[g]->total, 1, {}});
    Amounts line_least = kNothingFits;
    double objective = kUnlimited, air_m3 = kUnlimited, coil_j = kUnlimited;
    for (const Line& line : tree.lines[g]->lines) {
      line_least = Least(line_least, line.amounts);
      objective = std::min(objective, LineObjective(problem, line));
      air_m3 = std::min(air_m3, AirPerStroke(problem, g, line, line.source_min_pa));
      coil_j = std::min(coil_j, CoilEnergyPerCycle(problem, line, line.inflate_time_least_s));
    }
    least.push_back(line_least);
    tree.line_objective_least.push_back(objective);
    tree.air_least_m3.push_back(air_m3);
    tree.coil_least_j.push_back(coil_j);
  }
  if (configuration == Configuration::kCylinder)
    add(Stage::kBottle, tree.bottles = CylinderOptions(problem));
  if (configuration == Configuration::kCo2) add(Stage::kBottle, tree.bottles = Co2Options(problem));
  if (configuration == Configuration::kCompressor)
    add(Stage::kReservoir, tree.reservoirs = ReservoirOptions(problem));
  if (configuration == Configuration::kCompressor && groups > 1)
    for (int g = 0; g < groups; ++g) {
      tree.alone.push_back(problem);
      tree.alone.back().groups = {problem.groups[g]};
      tree.alone_pumps.emplace_back();
      for (const model::Compressor& compressor : problem.parts.compressors)
        tree.alone_pumps.back().push_back(MakePumpFacts(tree.alone.back(), compressor.curve));
    }
  for (const Option& option : tree.reservoirs.options)
    if (option.index == kCustom)
      tree.custom_allowed = true;
    else
      tree.reservoir_by_volume.push_back({StockVolume(problem, option), option.objective});
  std::sort(tree.reservoir_by_volume.begin(), tree.reservoir_by_volume.end());
  tree.largest_reservoir_m3 = model::kMadeReservoirLargestM3;
  tree.smallest_reservoir_m3 = model::kMadeReservoirSmallestM3;
  for (const auto& [volume_m3, objective] : tree.reservoir_by_volume) {
    tree.largest_reservoir_m3 = std::max(tree.largest_reservoir_m3, volume_m3);
    tree.smallest_reservoir_m3 = std::min(tree.smallest_reservoir_m3, volume_m3);
  }
  for (std::size_t i = tree.reservoir_by_volume.size(); i-- > 1;)
    tree.reservoir_by_volume[i - 1].second =
        std::min(tree.reservoir_by_volume[i - 1].second, tree.reservoir_by_volume[i].second);
  if (configuration != Configuration::kMains)
    add(Stage::kBattery, tree.batteries = BatteryOptions(problem));
  if (configuration == Configuration::kCompressor)
    for (int c = 0; c < static_cast<int>(problem.parts.compressors.size()); ++c) {
      tree.pump_batteries.emplace_back();
      tree.pump_energy_max_j.push_back(0.0);
      for (const Option& option : tree.batteries.options) {
        if (!BatteryFitsCompressor(problem, option.index, c)) continue;
        tree.pump_batteries.back().push_back(option);
        tree.pump_energy_max_j.back() =
            std::max(tree.pump_energy_max_j.back(), UsableEnergy(problem, option));
      }
    }

  for (int s = static_cast<int>(tree.stages.size()) - 2; s >= 0; --s) {
    tree.stages[s].below = tree.stages[s + 1].below * tree.stages[s + 1].total;
    tree.stages[s].least = tree.stages[s + 1].least;
    tree.stages[s].least += least[s + 1];
  }
  tree.combinations = tree.stages.front().below * tree.stages.front().total;
  return tree;
}

Children Expand(const Problem& problem, const Tree& tree, const Candidate& parent, int stage) {
  const StageInfo& info = tree.stages[stage];
  Children children;
  children.source_floor_pa = parent.source_floor_pa;
  children.source_cap_pa = parent.source_cap_pa;
  Amounts amounts;
  for (const Line* line : parent.lines) amounts += line->amounts;
  for (const Option* option :
       {&parent.regulator, &parent.bottle, &parent.compressor, &parent.reservoir, &parent.battery})
    amounts += option->amounts;
  children.unpriced = info.stage == Stage::kLine ? tree.lines[info.group]->unpriced
                                                 : Options(tree, info.stage).unpriced;
  if (info.stage == Stage::kLine)
    ExpandLines(problem, tree, parent, info, amounts, children);
  else if (info.stage == Stage::kReservoir)
    ExpandReservoirs(problem, tree, parent, info, amounts, children);
  else if (info.stage == Stage::kBattery && parent.compressor.index != kNone)
    ExpandPumpBatteries(problem, tree, parent, amounts, children);
  else
    ExpandOptions(problem, tree, parent, info, amounts, children);
  std::stable_sort(children.list.begin(), children.list.end(),
                   [](const Child& a, const Child& b) { return a.bound < b.bound; });
  return children;
}

double SharedSourceBound(const Problem& problem, const Tree& tree, const Candidate& candidate) {
  if (tree.alone.empty() || candidate.lines.empty() || candidate.reservoir.index != kNone)
    return -kUnlimited;
  const Need need = LeastNeed(problem, tree, candidate);
  double rest = kUnlimited;
  for (const ReservoirNeed& volume : SharedReservoirNeeds(problem, tree, candidate, need)) {
    Candidate at_volume = candidate;
    at_volume.source_floor_pa = volume.source_pa;
    rest = std::min(rest, LeastReservoir(problem, tree, volume.low_m3) +
                              LeastBattery(problem, tree, at_volume,
                                           {volume.energy_j, need.coil_power_w,
                                            PumpCurrent(problem, at_volume)}) +
                              PumpObjective(problem, need, volume.energy_j));
  }
  double bound = ChosenObjective(problem, candidate) + rest;
  for (std::size_t g = candidate.lines.size(); g < problem.groups.size(); ++g)
    bound += tree.line_objective_least[g];
  return bound;
}

Candidate Chosen(const Tree& tree, const Candidate& parent, int stage, const Children& children,
                 const Child& child) {
  Candidate candidate = parent;
  candidate.source_floor_pa = children.source_floor_pa;
  candidate.source_cap_pa = children.source_cap_pa;
  if (child.line != nullptr)
    candidate.lines.push_back(child.line);
  else
    Slot(candidate, tree.stages[stage].stage) = child.option;
  return candidate;
}

}  // namespace plenum::optimizer
