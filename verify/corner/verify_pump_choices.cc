#include "verify/corner/verify_pump_choices.h"

namespace plenum::verify {
namespace {

constexpr std::size_t kFineCells = kPumpCells * kFinePerCell;

double LeastPower(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  double least_w =
      std::min(model::ElectricalPower(curve, low_pa), model::ElectricalPower(curve, high_pa));
  for (double knot : curve.current_a.x())  // in between the table is monotone
    if (knot > low_pa && knot < high_pa)
      least_w = std::min(least_w, model::ElectricalPower(curve, knot));
  return least_w;
}

// Of one pump, at the lower ends of the cells. It may stand at its highest pressure, whatever
// flows: where it takes less there than while it holds nothing is known.
std::vector<double> BeyondHolding(const model::CompressorCurve& curve, double holding_w,
                                  const std::vector<double>& pressures_pa) {
  const double highest_pa = model::HighestPressure(curve);
  std::vector<double> beyond(kPumpCells, kUnlimited);
  double least = model::ElectricalPower(curve, highest_pa) < holding_w ? -kUnlimited : kUnlimited;
  for (std::size_t i = kPumpCells; i-- > 0;) {
    const double low_pa = pressures_pa[i], high_pa = std::min(pressures_pa[i + 1], highest_pa);
    if (low_pa <= highest_pa) {
      const double more_w = LeastPower(curve, low_pa, high_pa) - holding_w;
      const model::MonotoneCurve& flow = curve.free_air_m3_per_s;
      // Less power counts the more the longer it lasts, more power the less.
      const double flows = flow(std::max(flow.front(), more_w < 0.0 ? high_pa : low_pa));
      if (more_w < 0.0 || flows > 0.0)
        least = std::min(least, flows > 0.0 ? more_w / flows : -kUnlimited);
    }
    beyond[i] = least;
  }
  return beyond;
}

}  // namespace

double ContentPerVolume(const Problem& problem) {
  return model::kReferencePressurePa * problem.ambient.temperature_k /
         model::kReferenceTemperatureK;
}

PumpChoices::PumpChoices(const Problem& problem, const ProofPlan& plan)
    : problem_(problem),
      pumps_(PumpsOf(problem, plan.configuration)),
      compressor_(SlotOf(plan, PumpFamily(plan.configuration), -1)),
      highest_pa_(1.01 * problem.ambient.pressure_pa) {
  for (const model::Compressor& compressor : pumps_)
    highest_pa_ = std::max(highest_pa_, model::HighestPressure(compressor.curve));
  const double ambient_pa = problem.ambient.pressure_pa;
  for (std::size_t cell = 0; cell <= kPumpCells; ++cell)
    pressures_pa_.push_back(ambient_pa +
                            (highest_pa_ - ambient_pa) * static_cast<double>(cell) / kPumpCells);
  for (const ProofItem& item : plan.slots[compressor_].choices) items_.push_back(CellsOf(item));
}

// Delivery falls with pressure: a cell's lower end has the most.
PumpCells PumpChoices::CellsOf(const ProofItem& item) const {
  const model::Compressor& compressor = pumps_[item.part];
  const model::CompressorCurve& curve = compressor.curve;
  PumpCells cells;
  for (std::size_t i = 0; i < kPumpCells; ++i) {
    const double delivery = model::FreeAirDelivery(curve, PressureOf(i));
    cells.delivery_m3_per_s.push_back(item.quantity * delivery);
    cells.energy_j_per_m3.push_back(
        delivery > 0.0 ? LeastPower(curve, PressureOf(i), PressureOf(i + 1)) / delivery
                       : kUnlimited);
  }
  const double width_pa = (highest_pa_ - problem_.ambient.pressure_pa) / kFineCells;
  for (std::size_t i = 0; i < kFineCells; ++i)
    cells.fine_m3_per_s.push_back(
        item.quantity * model::FreeAirDelivery(curve, problem_.ambient.pressure_pa +
                                                          width_pa * static_cast<double>(i)));
  double operating_pa = problem_.ambient.pressure_pa;
  for (const ActuatorGroup& group : problem_.groups)
    operating_pa = std::max(operating_pa, group.chamber.operating_pressure_pa);
  for (const ActuatorGroup& group : problem_.groups) {
    if (!group.held_by_pumps) break;
    const double one_w = model::ElectricalPower(curve, group.chamber.operating_pressure_pa);
    cells.holding_w.push_back(item.quantity * one_w);
    cells.beyond_j_per_m3.push_back(BeyondHolding(curve, one_w, pressures_pa_));
  }
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
    for (std::size_t i = 0; i < kFineCells; ++i)
      best.fine_m3_per_s[i] = std::max(best.fine_m3_per_s[i], cells.fine_m3_per_s[i]);
    best.highest_pa = std::max(best.highest_pa, cells.highest_pa);
    best.duty_max = std::max(best.duty_max, cells.duty_max);
    best.current_a = std::min(best.current_a, cells.current_a);
    for (std::size_t g = 0; g < best.holding_w.size(); ++g) {
      best.holding_w[g] = std::min(best.holding_w[g], cells.holding_w[g]);
      for (std::size_t i = 0; i < kPumpCells; ++i)
        best.beyond_j_per_m3[g][i] =
            std::min(best.beyond_j_per_m3[g][i], cells.beyond_j_per_m3[g][i]);
    }
  }
  for (std::size_t i = kPumpCells - 1; i-- > 0;)
    best.energy_j_per_m3[i] = std::min(best.energy_j_per_m3[i], best.energy_j_per_m3[i + 1]);
  best.filling_j_per_m3.assign(1, 0.0);
  for (std::size_t i = 0; i < kPumpCells; ++i)
    best.filling_j_per_m3.push_back(best.filling_j_per_m3[i] +
                                    best.energy_j_per_m3[i] *
                                        model::StandardVolume(PressureOf(i + 1) - PressureOf(i),
                                                              problem_.ambient.temperature_k));
  return best;
}

std::size_t PumpChoices::CellOf(double pressure_pa) const {
  const double ambient_pa = problem_.ambient.pressure_pa;
  const double cell = (pressure_pa - ambient_pa) / (highest_pa_ - ambient_pa) * kPumpCells;
  return std::min(static_cast<std::size_t>(std::max(cell, 0.0)), kPumpCells - 1);
}

double PumpChoices::DeliveryAt(const PumpCells& pumps, double pressure_pa) const {
  const double ambient_pa = problem_.ambient.pressure_pa;
  const double cell = (pressure_pa - ambient_pa) / (highest_pa_ - ambient_pa) * kFineCells;
  return pumps
      .fine_m3_per_s[std::min(static_cast<std::size_t>(std::max(cell, 0.0)), kFineCells - 1)];
}

}  // namespace plenum::verify
