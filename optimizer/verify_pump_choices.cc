#include "optimizer/verify_pump_choices.h"

#include "model/storage.h"

namespace plenum::optimizer {
namespace {

constexpr double kSlack = 1.0 + kSumTolerance;

double LeastPower(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  double least_w =
      std::min(model::ElectricalPower(curve, low_pa), model::ElectricalPower(curve, high_pa));
  for (double knot : curve.current_a.x())  // in between the table is monotone
    if (knot > low_pa && knot < high_pa)
      least_w = std::min(least_w, model::ElectricalPower(curve, knot));
  return least_w;
}

}  // namespace

Packs::Packs(std::vector<Pack> packs) : packs_(std::move(packs)) {
  std::sort(packs_.begin(), packs_.end(),
            [](const Pack& a, const Pack& b) { return a.energy_j < b.energy_j; });
  for (std::size_t i = packs_.size(); i-- > 1;)
    packs_[i - 1].objective = std::min(packs_[i - 1].objective, packs_[i].objective);
}

double Packs::Least(double energy_j) const {
  const auto found =
      std::lower_bound(packs_.begin(), packs_.end(), energy_j / kSlack,
                       [](const Pack& pack, double energy) { return pack.energy_j < energy; });
  return found == packs_.end() ? kUnlimited : found->objective;
}

PumpChoices::PumpChoices(const Problem& problem, const ProofPlan& plan, const SlotAmounts& amounts)
    : problem_(problem),
      plan_(plan),
      amounts_(amounts),
      compressor_(SlotOf(plan, Family::kCompressor, -1)),
      battery_(SlotOf(plan, Family::kBattery, -1)),
      highest_pa_(1.01 * problem.ambient.pressure_pa) {
  for (const model::Compressor& compressor : problem.parts.compressors)
    highest_pa_ = std::max(highest_pa_, model::HighestPressure(compressor.curve));
  for (const ProofItem& item : plan.slots[compressor_].choices) items_.push_back(CellsOf(item));
}

double PumpChoices::PressureOf(std::size_t cell) const {
  const double ambient_pa = problem_.ambient.pressure_pa;
  return ambient_pa + (highest_pa_ - ambient_pa) * static_cast<double>(cell) / kPumpCells;
}

// Delivery falls with pressure: a cell's lower end has the most.
PumpCells PumpChoices::CellsOf(const ProofItem& item) const {
  const model::Compressor& compressor = problem_.parts.compressors[item.part];
  const model::CompressorCurve& curve = compressor.curve;
  PumpCells cells;
  for (std::size_t i = 0; i < kPumpCells; ++i) {
    const double delivery = model::FreeAirDelivery(curve, PressureOf(i));
    cells.delivery_m3_per_s.push_back(item.quantity * delivery);
    cells.energy_j_per_m3.push_back(
        delivery > 0.0 ? LeastPower(curve, PressureOf(i), PressureOf(i + 1)) / delivery
                       : kUnlimited);
  }
  double operating_pa = problem_.ambient.pressure_pa;
  for (const ActuatorGroup& group : problem_.groups)
    operating_pa = std::max(operating_pa, group.chamber.operating_pressure_pa);
  cells.highest_pa = model::HighestPressure(curve);
  cells.duty_max = compressor.duty_max;
  cells.current_a =
      item.quantity * model::LargestCurrent(curve, problem_.ambient.pressure_pa, operating_pa);
  return cells;
}

const PumpCells& PumpChoices::CellsIn(Range range) {
  const auto [entry, fresh] = ranges_.try_emplace(range);
  PumpCells& best = entry->second;
  if (!fresh) return best;
  best = items_[range.first];
  for (int item = range.first + 1; item < range.second; ++item) {
    const PumpCells& cells = items_[item];
    for (std::size_t i = 0; i < kPumpCells; ++i) {
      best.delivery_m3_per_s[i] = std::max(best.delivery_m3_per_s[i], cells.delivery_m3_per_s[i]);
      best.energy_j_per_m3[i] = std::min(best.energy_j_per_m3[i], cells.energy_j_per_m3[i]);
    }
    best.highest_pa = std::max(best.highest_pa, cells.highest_pa);
    best.duty_max = std::max(best.duty_max, cells.duty_max);
    best.current_a = std::min(best.current_a, cells.current_a);
  }
  for (std::size_t i = kPumpCells - 1; i-- > 0;)
    best.energy_j_per_m3[i] = std::min(best.energy_j_per_m3[i], best.energy_j_per_m3[i + 1]);
  return best;
}

const Packs& PumpChoices::PacksIn(Range compressors, Range batteries) {
  const std::array<int, 4> key{compressors.first, compressors.second, batteries.first,
                               batteries.second};
  if (const auto found = packs_.find(key); found != packs_.end()) return found->second;
  const double current_a = CellsIn(compressors).current_a;
  std::vector<Packs::Pack> packs;
  for (int i = batteries.first; i < batteries.second; ++i) {
    const ProofItem& item = plan_.slots[battery_].choices[i];
    const model::Battery& battery = problem_.parts.batteries[item.part];
    bool drives = false;
    for (int c = compressors.first; c < compressors.second && !drives; ++c)
      drives = model::VoltageMatches(
          battery.nominal_voltage_v,
          problem_.parts.compressors[plan_.slots[compressor_].choices[c].part].curve.voltage_v);
    if (drives && item.quantity * battery.current_max_a * kSlack >= current_a)
      packs.push_back(
          {item.quantity * model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v),
           amounts_[battery_][i].objective});
  }
  return packs_.emplace(key, Packs(std::move(packs))).first->second;
}

double PumpChoices::DeliveryAt(const PumpCells& pumps, double pressure_pa) const {
  const double ambient_pa = problem_.ambient.pressure_pa;
  const double cell = (pressure_pa - ambient_pa) / (highest_pa_ - ambient_pa) * kPumpCells;
  return pumps
      .delivery_m3_per_s[std::min(static_cast<std::size_t>(std::max(cell, 0.0)), kPumpCells - 1)];
}

}  // namespace plenum::optimizer
