#include <algorithm>

#include "model/storage.h"
#include "optimizer/needs.h"

namespace plenum::optimizer {
namespace {

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

}  // namespace plenum::optimizer
