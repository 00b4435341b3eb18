#include "verify/corner/verify_corner.h"

#include <functional>

#include "model/physics/storage.h"
#include "model/strokes/stroke.h"
#include "verify/corner/verify_least_line.h"
#include "verify/corner/verify_node.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/cycle/verify_rig.h"
#include "verify/design/verify_design.h"

namespace plenum::verify {
namespace {

constexpr double kSlack = 1.0 + kSumTolerance;

int RegulatorCount(const Problem& problem, const ProofPlan& plan) {
  return plan.own_regulators ? static_cast<int>(problem.groups.size()) : 1;
}

}  // namespace

Corners::Corners(const Problem& problem, const ProofPlan& plan, KnownStrokes& strokes)
    : problem_(problem),
      plan_(plan),
      strokes_(strokes),
      shared_(AllAtOnce(problem) && !Evacuated(problem) && !plan.own_regulators),
      amounts_(AmountsOfAll(problem, plan)),
      least_(plan.slots.size()),
      least_lines_(
          [this](const Ranges& ranges, int slot) {
            const LeastAmounts& amounts = Least(ranges, slot);
            return std::pair(amounts.least.objective, amounts.objective_most);
          },
          strokes),
      rails_(problem, plan) {
  if (plan.configuration == Configuration::kTankAndPump) fillers_.emplace(problem, plan);
  if (KeepsReservoir(plan.configuration)) pumps_.emplace(problem, plan, amounts_, strokes);
  if (IsDirect(plan.configuration)) direct_.emplace(problem, plan, amounts_, strokes);
}

const LeastAmounts& Corners::Least(const Ranges& ranges, int slot) {
  const auto [first, last] = ranges[slot];
  const std::uint64_t range =
      static_cast<std::uint64_t>(first) << 32 | static_cast<std::uint32_t>(last);
  const auto [entry, fresh] = least_[slot].try_emplace(range);
  LeastAmounts& found = entry->second;
  if (!fresh) return found;
  ItemAmounts& least = found.least;
  for (int i = first; i < last; ++i) {
    const ItemAmounts& amounts = amounts_[slot][i];
    least.mass_kg = std::min(least.mass_kg, amounts.mass_kg);
    least.volume_m3 = std::min(least.volume_m3, amounts.volume_m3);
    least.cost_eur = std::min(least.cost_eur, amounts.cost_eur);
    least.objective = std::min(least.objective, amounts.objective);
    found.objective_most = std::max(found.objective_most, amounts.objective);
  }
  return found;
}

bool Corners::SourceMates(const Ranges& ranges, const ProofItem& item) const {
  const model::Parts& parts = problem_.parts;
  Assembly source;
  source.configuration = plan_.configuration;
  if (HasPump(plan_.configuration)) {
    source.compressor = &PumpsOf(problem_, plan_.configuration)[item.part];
    source.compressors = item.quantity;
    return Any(plan_, ranges, SlotOf(plan_, Family::kBattery, -1), [&](const ProofItem& pack) {
      source.battery = &parts.batteries[pack.part];
      return Fit(problem_, source);
    });
  }
  if (plan_.configuration == Configuration::kTank) return true;  // its fill is a setting
  source.regulators = {&parts.regulators[item.part]};
  if (plan_.configuration == Configuration::kCylinder)
    return Any(plan_, ranges, SlotOf(plan_, Family::kCylinder, -1), [&](const ProofItem& bottle) {
      source.cylinder = &parts.cylinders[bottle.part];
      return Fit(problem_, source);
    });
  if (plan_.configuration == Configuration::kCo2) source.co2 = &parts.co2.front();
  return Fit(problem_, source);
}

bool Corners::SourceMates(const Ranges& ranges) const {
  if (!rails_.Mates(ranges)) return false;
  const auto some_mates = [&](int slot) {
    return Any(plan_, ranges, slot,
               [&](const ProofItem& item) { return SourceMates(ranges, item); });
  };
  if (HasPump(plan_.configuration))
    return some_mates(SlotOf(plan_, PumpFamily(plan_.configuration), -1));
  for (int g = 0; g < RegulatorCount(problem_, plan_); ++g)
    if (!some_mates(RegulatorSlot(g))) return false;
  return true;
}

int Corners::RegulatorSlot(int group) const {
  return SlotOf(plan_, Family::kRegulator, plan_.own_regulators ? group : -1);
}

bool Corners::CannotMate(const Ranges& ranges) {
  for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g)
    if (!strokes_.Line(ranges, g).mates) return true;
  return !SourceMates(ranges);
}

ItemAmounts Corners::LeastAmountsBut(const Ranges& ranges, int slot) {
  ItemAmounts sum;
  for (int s = 0; s < static_cast<int>(plan_.slots.size()); ++s)
    if (s != slot) sum += Least(ranges, s).least;
  return sum;
}

// Of the best regulator and its lines.
Corners::SourceBounds Corners::SourceOf(const Ranges& ranges, int group) {
  const int slot = RegulatorSlot(group);
  const auto is_none = [](const ProofItem& item) { return item.part < 0; };
  SourceBounds source{.regulator = {problem_, plan_, ranges, slot}};
  const BestNumbers& regulator = source.regulator;
  source.low_pa = problem_.ambient.pressure_pa;
  source.high_pa = problem_.source_pressure_max_pa;
  source.some_open = Any(plan_, ranges, slot, is_none);
  source.all_open = !Any(plan_, ranges, slot, std::not_fn(is_none));
  if (!source.some_open) {
    source.low_pa = std::max(source.low_pa, regulator.Number("outlet_pressure_min_kpa_gauge"));
    source.high_pa = std::min(source.high_pa, regulator.Number("outlet_pressure_max_kpa_gauge"));
    source.flow_max = regulator.Number("flow_max_l_per_min_anr");
  }
  if (plan_.configuration == Configuration::kMains) {
    source.high_pa = std::min(source.high_pa, problem_.mains.pressure_pa);
    source.flow_max = std::min(source.flow_max, problem_.mains.flow_max_m3_per_s);
  }
  for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
    if (plan_.own_regulators && g != group) continue;
    const BestLine& line = strokes_.Line(ranges, g);
    source.low_pa = std::max(source.low_pa, line.source_low_pa);
    source.high_pa = std::min(source.high_pa, line.source_high_pa);
    if (source.all_open && !line.some_hold) source.high_pa = 0.0;
  }
  return source;
}

Corners::Inlets Corners::InletsOf(const std::vector<SourceBounds>& sources) {
  Inlets inlets;
  for (const SourceBounds& source : sources) {
    inlets.low_pa = std::max(inlets.low_pa, source.low_pa);
    if (source.some_open) continue;
    const BestNumbers& regulator = source.regulator;
    inlets.min_pa = std::max(inlets.min_pa, regulator.Number("inlet_pressure_min_kpa_gauge"));
    inlets.max_pa = std::min(inlets.max_pa, regulator.Number("inlet_pressure_max_kpa_gauge"));
    inlets.electrical_w += regulator.Number("electrical_power_w");
  }
  return inlets;
}

// Each group alone on the best regulator, then the least bottle and battery that bear the needs.
double Corners::LeastRegulated(const Ranges& ranges, double chosen) {
  std::vector<SourceBounds> sources;
  for (int g = 0; g < RegulatorCount(problem_, plan_); ++g) {
    sources.push_back(SourceOf(ranges, g));
    if (!(sources.back().low_pa <= sources.back().high_pa)) return kUnlimited;
  }
  const SourceBounds& first = sources.front();
  const double temperature_k = problem_.ambient.temperature_k;
  const double factor = FactorOf(problem_, plan_.configuration);
  const auto lines = [&] {
    std::vector<const BestLine*> best;
    best.reserve(problem_.groups.size());
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g)
      best.push_back(&strokes_.Line(ranges, g));
    return best;
  };
  if (shared_ && !first.some_open &&
      TooSlowTogether(problem_,
                      {first.regulator.Flow("sonic_conductance_dm3_per_s_bar"), factor,
                       first.high_pa, first.flow_max},
                      lines()))
    return kUnlimited;
  for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g)
    chosen += ExcessBehind(ranges, g, plan_.own_regulators ? sources[g] : first);
  if (std::isinf(chosen)) return kUnlimited;
  const double rail_j = PumpsRail(problem_) ? rails_.Energy(ranges, lines()) : 0.0;
  if (std::isinf(rail_j)) return kUnlimited;
  double air_m3 = 0.0, coil_j = 0.0, inflating_j = 0.0;  // per cycle
  for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
    const BestLine& line = strokes_.Line(ranges, g);
    const ActuatorGroup& group = problem_.groups[g];
    const SourceBounds& source = plan_.own_regulators ? sources[g] : first;
    const double strokes = group.gait.strokes_per_period;
    const double inflate_s = InflateSeconds(line, g, source, ranges[RegulatorSlot(g)]);
    if (std::isinf(inflate_s)) return kUnlimited;
    // At least: a valve that cannot hold may be open for no longer than that takes.
    air_m3 += strokes * model::StandardVolume(
                            Drawn(problem_, g, line.chamber, group.chamber.operating_pressure_pa),
                            temperature_k);
    coil_j += line.coil_w * line.coil_s;
    if (line.all_hold) inflating_j += strokes * line.coil_w * inflate_s;
  }
  const double beyond_j = problem_.actuations * inflating_j + rail_j;
  double sum = chosen + problem_.objective.energy_wh * beyond_j / optimizer::kJoulePerWattHour;
  if (plan_.configuration == Configuration::kMains) return sum;

  const Inlets inlets = InletsOf(sources);
  const double energy_j = beyond_j + problem_.actuations * coil_j +
                          inlets.electrical_w * problem_.actuations / problem_.frequency_hz;
  if (fillers_) return sum + LeastRefilled(ranges, inlets, air_m3, energy_j);
  if (plan_.configuration == Configuration::kTank)
    return sum + LeastTank(ranges, inlets, first, air_m3) + LeastBattery(ranges, energy_j);
  return LeastStores(ranges, inlets, {air_m3, energy_j}, sum);
}

double Corners::ExcessBehind(const Ranges& ranges, int g, const SourceBounds& source) {
  const auto& regulators = ranges[RegulatorSlot(g)];
  return least_lines_.Excess(ranges, g,
                             {{0.0, source.high_pa}, regulators, [&](const BestLine& line) {
                                return std::isinf(InflateSeconds(line, g, source, regulators));
                              }});
}

double Corners::ExcessOnPumps(const Ranges& ranges, const std::vector<const BestLine*>& lines) {
  std::pair<double, double> window{0.0, pumps_->HighestPa(ranges)};
  for (const BestLine* line : lines)
    window = {std::max(window.first, line->source_low_pa),
              std::min(window.second, line->source_high_pa)};
  double excess = 0.0;
  for (int g = 0; g < static_cast<int>(lines.size()); ++g)
    excess += least_lines_.Excess(ranges, g, {window, {}, [&](const BestLine& line) {
                                                return line.source_low_pa > window.second ||
                                                       line.source_high_pa < window.first;
                                              }});
  return excess;
}

double Corners::InflateSeconds(const BestLine& line, int g, const SourceBounds& source,
                               const std::pair<int, int>& regulators) {
  const auto [entry, fresh] =
      inflate_s_.try_emplace({&line, regulators.first, regulators.second, source.high_pa}, 0.0);
  if (!fresh) return entry->second;
  const ActuatorGroup& group = problem_.groups[g];
  const double count = MostAtOnce(problem_, g);
  std::vector<model::FlowElement> elements = line.fill;
  if (!source.some_open) {
    model::FlowElement share = source.regulator.Flow("sonic_conductance_dm3_per_s_bar");
    share.sonic_conductance_m3_per_s_pa /= count;
    elements.insert(elements.begin(), share);
  }
  const model::Series fill = model::MakeSeries(elements, FactorOf(problem_, plan_.configuration));
  const auto seconds = [&](double to_pa) {
    return model::FillTime(fill, line.chamber, source.high_pa, model::RestPa(line.chamber), to_pa,
                           problem_.ambient.temperature_k, source.flow_max / count);
  };
  const double inflate_s = seconds(group.chamber.operating_pressure_pa);
  const bool late =
      inflate_s > FillWindow(problem_, g) * kSlack ||
      (inflate_s > group.rise_time_max_s &&
       seconds(PressureAt(problem_, g, problem_.rise_fraction)) > group.rise_time_max_s * kSlack);
  return entry->second = late ? kUnlimited : inflate_s;
}

// The air of the mission is in any fill, above what stays; without a regulator the last stroke may
// take the tank below what it asks.
double Corners::LeastTank(const Ranges& ranges, const Inlets& inlets, const SourceBounds& source,
                          double air_m3) {
  const double inlet_pa = std::max(inlets.low_pa, inlets.min_pa);
  const double most_pa = source.all_open ? source.high_pa : inlets.max_pa;
  const int slot = SlotOf(plan_, Family::kTank, -1);
  const double mission_m3 = problem_.actuations * air_m3;
  const double above_m3 = source.some_open ? mission_m3 - air_m3 : mission_m3;
  double objective = kUnlimited,
         left_pa = 0.0;  // of all that hold the air, and for the last period
  for (int i = ranges[slot].first; i < ranges[slot].second; ++i) {
    const ProofItem& item = plan_.slots[slot].choices[i];
    const model::Reservoir& tank = problem_.parts.tanks[item.part];
    const double fill_pa = std::min({tank.pressure_max_pa, problem_.tank_fill_max_pa, most_pa});
    const double capacity_m3_per_pa =
        model::StandardVolume(item.quantity * tank.volume_m3, problem_.ambient.temperature_k);
    if (capacity_m3_per_pa * (fill_pa - inlet_pa) * kSlack < above_m3) continue;
    objective = std::min(objective, amounts_[slot][i].objective);
    left_pa = std::max(left_pa, fill_pa - (mission_m3 - air_m3) / capacity_m3_per_pa);
  }
  if (source.all_open && std::isfinite(objective)) {
    SourceBounds last = source;
    last.high_pa = std::min(last.high_pa, left_pa * kSlack);
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g)
      if (std::isinf(InflateSeconds(strokes_.Line(ranges, g), g, last, ranges[RegulatorSlot(g)])))
        return kUnlimited;
  }
  return objective +
         problem_.objective.mass_kg * mission_m3 / kSlack * model::kReferenceDensityKgPerM3;
}

// What the fullest tank of the box does not hold pumps must deliver, above the pressure at which it
// keeps the air of the last period; and what the strongest pumps do not deliver a tank must hold,
// at least that air.
double Corners::LeastRefilled(const Ranges& ranges, const Inlets& inlets, double air_m3,
                              double energy_j) {
  const double inlet_pa = std::max(inlets.low_pa, inlets.min_pa);
  const int slot = SlotOf(plan_, Family::kTank, -1);
  const double per_m3_pa = model::StandardVolume(1.0, problem_.ambient.temperature_k);
  std::vector<double> given_m3;
  double largest_m3 = 0.0, most_m3 = 0.0;
  const auto [first, last] = ranges[slot];
  for (int i = first; i < last; ++i) {
    const ProofItem& item = plan_.slots[slot].choices[i];
    const model::Reservoir& tank = problem_.parts.tanks[item.part];
    const double volume_m3 = item.quantity * tank.volume_m3;
    largest_m3 = std::max(largest_m3, volume_m3);
    const double fill_pa =
        std::min({tank.pressure_max_pa, problem_.tank_fill_max_pa, inlets.max_pa});
    given_m3.push_back(volume_m3 * per_m3_pa * (fill_pa - inlet_pa));
    most_m3 = std::max(most_m3, given_m3.back());
  }
  const double kept_pa = inlet_pa + air_m3 / (largest_m3 * per_m3_pa) / kSlack;
  const PumpCells& pumps =
      fillers_->CellsIn(ranges[SlotOf(plan_, PumpFamily(plan_.configuration), -1)]);
  const double seconds = (problem_.actuations - 1.0) / problem_.frequency_hz;
  const bool reach = kept_pa <= pumps.highest_pa * kSlack;
  const double pumped_m3 =
      reach ? pumps.duty_max * fillers_->DeliveryAt(pumps, kept_pa) * seconds : 0.0;
  const double mission_m3 = problem_.actuations * air_m3 / kSlack;
  const double held_m3 = std::max(mission_m3 - pumped_m3, air_m3 / kSlack);
  double objective = kUnlimited;
  for (std::size_t i = 0; i < given_m3.size(); ++i)
    if (given_m3[i] * kSlack >= held_m3)
      objective = std::min(objective, amounts_[slot][first + i].objective);
  const double lacking_m3 = mission_m3 - most_m3;
  const double pump_j =
      lacking_m3 > 0.0 ? lacking_m3 * pumps.energy_j_per_m3[fillers_->CellOf(kept_pa)] : 0.0;
  return objective + problem_.objective.mass_kg * held_m3 * model::kReferenceDensityKgPerM3 +
         problem_.objective.energy_wh * pump_j / optimizer::kJoulePerWattHour +
         LeastBattery(ranges, energy_j + pump_j);
}

double Corners::LeastBattery(const Ranges& ranges, double energy_j) {
  const int slot = SlotOf(plan_, Family::kBattery, -1);
  const auto [first, last] = ranges[slot];
  const SlotRange key{slot, first, last};
  auto known = packs_.find(key);
  if (known == packs_.end()) {
    std::vector<Packs::Pack> packs;
    for (int i = first; i < last; ++i) {
      const ProofItem& item = plan_.slots[slot].choices[i];
      const model::Battery& pack = problem_.parts.batteries[item.part];
      packs.push_back(
          {item.quantity * model::UsableEnergy(pack.capacity_ah, pack.nominal_voltage_v),
           amounts_[slot][i].objective});
    }
    known = packs_.emplace(key, Packs(std::move(packs))).first;
  }
  return known->second.Least(energy_j);
}

double Corners::LeastStores(const Ranges& ranges, const Inlets& inlets, const Stored& stored,
                            double sum) {
  const double inlet_pa = std::max(inlets.low_pa, inlets.min_pa);
  const bool cylinder = plan_.configuration == Configuration::kCylinder;
  const Family family = cylinder ? Family::kCylinder : Family::kCo2;
  const int slot = SlotOf(plan_, family, -1);
  double bottle = kUnlimited;
  for (int i = ranges[slot].first; i < ranges[slot].second; ++i) {
    const ProofItem& item = plan_.slots[slot].choices[i];
    const model::Parts& parts = problem_.parts;
    const bool fits = cylinder
                          ? parts.cylinders[item.part].fill_pressure_pa +
                                    parts.cylinders[item.part].fill_pressure_spread_pa <=
                                inlets.max_pa
                          : item.quantity * parts.co2[item.part].flow_sustained_m3_per_s * kSlack >=
                                stored.air_m3 * problem_.frequency_hz;
    if (fits &&
        GasOf(problem_, family, item, inlet_pa) * kSlack >= problem_.actuations * stored.air_m3)
      bottle = std::min(bottle, amounts_[slot][i].objective);
  }
  return sum + bottle + LeastBattery(ranges, stored.energy_j);
}

double Corners::LeastObjective(const Ranges& ranges, double enough) {
  double sum = 0.0, chosen = 0.0;
  for (int s = 0; s < static_cast<int>(plan_.slots.size()); ++s) {
    const double least = Least(ranges, s).least.objective;
    sum += least;
    if (!SpecOf(plan_.slots[s].family).by_need) chosen += least;
  }
  if (sum > enough) return sum;
  if (TooMuch(problem_, LeastAmountsBut(ranges, -1), kSumTolerance)) return kUnlimited;
  std::vector<const BestLine*> lines;
  for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
    lines.push_back(&strokes_.Line(ranges, g));
    if (!lines.back()->works) return kUnlimited;
  }
  if (!SourceMates(ranges)) return kUnlimited;
  if (direct_) return direct_->Least(ranges, lines, chosen);
  if (!pumps_) return LeastRegulated(ranges, chosen);
  const double excess = ExcessOnPumps(ranges, lines);
  if (sum + excess > enough) return sum + excess;
  const ItemAmounts others = LeastAmountsBut(ranges, SlotOf(plan_, Family::kReservoir, -1));
  return pumps_->Least(ranges, lines, others, {chosen + excess, sum + excess, enough});
}

}  // namespace plenum::verify
