#include "verify/corner/verify_least_rail.h"

#include <algorithm>

#include "model/physics/storage.h"
#include "verify/corner/verify_ranges.h"

namespace plenum::verify {

namespace {

constexpr double kRoom = 1e-7;  // more than pressures of the vacuum are found to

}  // namespace

LeastRails::LeastRails(const Problem& problem, const ProofPlan& plan)
    : problem_(problem),
      plan_(plan),
      pumps_(PumpsRail(problem) ? SlotOf(plan, Family::kVacuumPump, -1) : -1),
      reservoirs_(SlotOf(plan, Family::kVacuumReservoir, -1)),
      batteries_(SlotOf(plan, Family::kBattery, -1)) {}

bool LeastRails::Mates(const Ranges& ranges) const {
  if (pumps_ < 0 || batteries_ < 0) return true;
  return Any(plan_, ranges, pumps_, [&](const ProofItem& pump) {
    return Any(plan_, ranges, batteries_, [&](const ProofItem& pack) {
      return model::VoltageMatches(problem_.parts.batteries[pack.part].nominal_voltage_v,
                                   problem_.parts.vacuum_pumps[pump.part].curve.voltage_v);
    });
  });
}

double LeastRails::Energy(const Ranges& ranges, const std::vector<const BestLine*>& lines) {
  if (pumps_ < 0 || ranges[pumps_].second - ranges[pumps_].first > 1) return 0.0;
  const auto choice = [&](int slot, int index) { return &plan_.slots[slot].choices[index]; };
  std::vector<const void*> key{choice(pumps_, ranges[pumps_].first),
                               choice(reservoirs_, ranges[reservoirs_].first),
                               choice(reservoirs_, ranges[reservoirs_].second - 1)};
  key.insert(key.end(), lines.begin(), lines.end());
  const auto [entry, fresh] = known_.try_emplace(std::move(key), 0.0);
  if (fresh) entry->second = EnergyOf(ranges, lines);
  return entry->second;
}

double LeastRails::EnergyOf(const Ranges& ranges, const std::vector<const BestLine*>& lines) const {
  const ProofItem& item = plan_.slots[pumps_].choices[ranges[pumps_].first];
  RailPumps pumps{&problem_.parts.vacuum_pumps[item.part], item.quantity, 0.0};
  const auto [first, last] = ranges[reservoirs_];
  for (int i = first; i < last; ++i) {
    const ProofItem& reservoir = plan_.slots[reservoirs_].choices[i];
    pumps.volume_m3 = std::max(
        pumps.volume_m3, reservoir.quantity * problem_.parts.reservoirs[reservoir.part].volume_m3);
  }
  std::vector<RailLine> emptied;
  for (int g = 0; g < static_cast<int>(lines.size()); ++g)
    if (lines[g]->chamber.low_pressure_pa > 0.0)
      emptied.push_back({g, lines[g]->series.exhaust, lines[g]->chamber});
  const std::optional<double> rail_pa = WeakestRail(problem_, pumps, emptied, kRoom);
  if (!rail_pa) return kUnlimited;
  const RailBorne borne = BorneAt(problem_, pumps, emptied, *rail_pa);
  const double first_fill_j = last - first > 1 ? 0.0 : borne.first_fill_j;
  return (first_fill_j + problem_.actuations * borne.per_cycle_j) / (1.0 + kRoom);
}

}  // namespace plenum::verify
