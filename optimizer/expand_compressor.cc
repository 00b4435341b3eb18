#include "optimizer/expand_compressor.h"

#include <algorithm>
#include <cmath>

#include "model/storage.h"
#include "optimizer/needs.h"
#include "optimizer/sizing.h"

namespace plenum::optimizer {
namespace {

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

}  // namespace

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

}  // namespace plenum::optimizer
