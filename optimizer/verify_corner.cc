#include "optimizer/verify_corner.h"

#include "model/series.h"
#include "model/storage.h"
#include "model/stroke.h"
#include "model/tube.h"
#include "optimizer/verify_design.h"
#include "optimizer/verify_dominance.h"

namespace plenum::optimizer {
namespace {

int SlotOf(const ProofPlan& plan, Family family, int group) {
  for (std::size_t s = 0; s < plan.slots.size(); ++s)
    if (plan.slots[s].family == family && plan.slots[s].group == group) return static_cast<int>(s);
  return -1;
}

// Calls `visit(item)` for the choices of a slot in the box until one gives true.
template <typename Visit>
bool Any(const ProofPlan& plan, const Ranges& ranges, int slot, const Visit& visit) {
  for (int i = ranges[slot].first; i < ranges[slot].second; ++i)
    if (visit(plan.slots[slot].choices[i])) return true;
  return false;
}

bool LineMates(const Problem& problem, const ProofPlan& plan, const Ranges& ranges, int g) {
  if (problem.groups[g].fittings_per_line == 0) return true;
  const model::Parts& parts = problem.parts;
  const int tubes = SlotOf(plan, Family::kTubing, g), valves = SlotOf(plan, Family::kValve, g);
  return Any(plan, ranges, SlotOf(plan, Family::kFitting, g), [&](const ProofItem& f) {
    const model::Fitting& fitting = parts.fittings[f.part];
    return Any(plan, ranges, tubes,
               [&](const ProofItem& t) { return Fit(parts.tubing[t.part], fitting); }) &&
           Any(plan, ranges, valves,
               [&](const ProofItem& v) { return Fit(fitting, parts.valves[v.part]); });
  });
}

bool SourceMates(const Problem& problem, const ProofPlan& plan, const Ranges& ranges) {
  const model::Parts& parts = problem.parts;
  Assembly source;
  source.configuration = plan.configuration;
  if (plan.configuration == Configuration::kCompressor)
    return Any(plan, ranges, SlotOf(plan, Family::kCompressor, -1), [&](const ProofItem& pump) {
      return Any(plan, ranges, SlotOf(plan, Family::kBattery, -1), [&](const ProofItem& pack) {
        source.compressor = &parts.compressors[pump.part];
        source.battery = &parts.batteries[pack.part];
        return Fit(problem, source);
      });
    });
  return Any(plan, ranges, SlotOf(plan, Family::kRegulator, -1), [&](const ProofItem& item) {
    source.regulator = &parts.regulators[item.part];
    if (plan.configuration == Configuration::kCylinder)
      return Any(plan, ranges, SlotOf(plan, Family::kCylinder, -1), [&](const ProofItem& bottle) {
        source.cylinder = &parts.cylinders[bottle.part];
        return Fit(problem, source);
      });
    if (plan.configuration == Configuration::kCo2) source.co2 = &parts.co2.front();
    return Fit(problem, source);
  });
}

// The best of every number of a group's choices.
struct BestLine {
  model::FlowElement fill{0, 0, 1}, exhaust{0, 0, 1}, fitting{0, 0, 1};
  double narrowest_m = kUnlimited, widest_m = 0.0;
  double source_pa = kUnlimited;  // the highest that it stands
  double switches_pa = kUnlimited, coil_w = kUnlimited;
  bool some_hold = false;
};

void Raise(const model::FlowElement& flow, model::FlowElement& best) {
  best.sonic_conductance_m3_per_s_pa =
      std::max(best.sonic_conductance_m3_per_s_pa, flow.sonic_conductance_m3_per_s_pa);
  best.critical_ratio = std::max(best.critical_ratio, flow.critical_ratio);
  best.subsonic_index = std::min(best.subsonic_index, flow.subsonic_index);
}

BestLine BestOf(const Problem& problem, const ProofPlan& plan, const Ranges& ranges, int g) {
  const model::Parts& parts = problem.parts;
  BestLine best;
  double tube_pa = 0.0, fitting_pa = 0.0, valve_pa = 0.0;
  Any(plan, ranges, SlotOf(plan, Family::kTubing, g), [&](const ProofItem& item) {
    const model::Tubing& tube = parts.tubing[item.part];
    best.narrowest_m = std::min(best.narrowest_m, tube.inner_diameter_m);
    best.widest_m = std::max(best.widest_m, tube.inner_diameter_m);
    tube_pa = std::max(tube_pa, tube.pressure_max_pa);
    return false;
  });
  Any(plan, ranges, SlotOf(plan, Family::kFitting, g), [&](const ProofItem& item) {
    if (item.part < 0) {
      fitting_pa = kUnlimited;
      return false;
    }
    Raise(parts.fittings[item.part].flow, best.fitting);
    fitting_pa = std::max(fitting_pa, parts.fittings[item.part].pressure_max_pa);
    return false;
  });
  Any(plan, ranges, SlotOf(plan, Family::kValve, g), [&](const ProofItem& item) {
    const model::Valve& valve = parts.valves[item.part];
    Raise(valve.fill, best.fill);
    Raise(valve.exhaust, best.exhaust);
    valve_pa = std::max(valve_pa, valve.pressure_max_pa);
    best.switches_pa = std::min(best.switches_pa, valve.pressure_min_pa);
    best.coil_w = std::min(best.coil_w, valve.coil_power_w * problem.groups[g].count);
    best.some_hold |= model::Holds(valve.kind);
    return false;
  });
  best.source_pa = std::min({tube_pa, fitting_pa, valve_pa, problem.source_pressure_max_pa});
  if (!best.some_hold) best.source_pa = std::min(best.source_pa, problem.groups[g].pressure_max_pa);
  return best;
}

// The highest source pressure of any choice of source in the box.
double HighestSource(const Problem& problem, const ProofPlan& plan, const Ranges& ranges) {
  const model::Parts& parts = problem.parts;
  double highest_pa = 0.0;
  const auto raise = [&](double pa) {
    highest_pa = std::max(highest_pa, pa);
    return false;
  };
  if (plan.configuration == Configuration::kCompressor)
    Any(plan, ranges, SlotOf(plan, Family::kCompressor, -1), [&](const ProofItem& item) {
      return raise(model::HighestPressure(parts.compressors[item.part].curve));
    });
  else
    Any(plan, ranges, SlotOf(plan, Family::kRegulator, -1), [&](const ProofItem& item) {
      return raise(parts.regulators[item.part].outlet_pressure_max_pa);
    });
  if (plan.configuration == Configuration::kMains)
    highest_pa = std::min(highest_pa, problem.mains_pressure_pa);
  return highest_pa;
}

// One line alone on an unlimited source at its highest pressure: no source is faster.
bool TooSlow(const Problem& problem, const ProofPlan& plan, int g, const BestLine& line,
             double source_pa) {
  const ActuatorGroup& group = problem.groups[g];
  const double ambient_pa = problem.ambient.pressure_pa;
  const double temperature_k = problem.ambient.temperature_k;
  const double operating_pa = group.chamber.operating_pressure_pa;
  if (source_pa < std::max(operating_pa, line.switches_pa)) return true;
  std::vector<model::FlowElement> fill{line.fill};
  const int near_valve = (group.fittings_per_line + 1) / 2;
  fill.insert(fill.end(), near_valve, line.fitting);
  fill.push_back(model::TubeElement(line.widest_m, group.tube_length_m));
  fill.insert(fill.end(), group.fittings_per_line - near_valve, line.fitting);
  std::vector<model::FlowElement> exhaust(fill.rbegin(), fill.rend());
  exhaust.back() = line.exhaust;
  model::Chamber chamber = group.chamber;
  chamber.dead_volume_m3 += model::BoreVolume(line.narrowest_m, group.tube_length_m);
  const model::Gas gas =
      plan.configuration == Configuration::kCo2 ? model::Gas::kCo2 : model::Gas::kAir;
  const double factor =
      model::FlowFactor(gas) * std::sqrt(model::kReferenceTemperatureK / temperature_k);
  const double half_s = 0.5 / problem.frequency_hz;
  const auto target = [&](double fraction) {
    return ambient_pa + fraction * (operating_pa - ambient_pa);
  };
  const model::Series in = model::MakeSeries(fill, factor),
                      out = model::MakeSeries(exhaust, factor);
  return model::EmptyTime(out, chamber, operating_pa, target(problem.fall_fraction),
                          temperature_k) > std::min(group.fall_time_max_s, half_s) ||
         model::FillTime(in, chamber, source_pa, ambient_pa, operating_pa, temperature_k) >
             half_s ||
         model::FillTime(in, chamber, source_pa, ambient_pa, target(problem.rise_fraction),
                         temperature_k) > group.rise_time_max_s;
}

bool TooMuch(const Problem& problem, const ProofPlan& plan, const Ranges& ranges) {
  ItemAmounts sum;
  for (std::size_t s = 0; s < plan.slots.size(); ++s) {
    ItemAmounts least{kUnlimited, kUnlimited, kUnlimited, 0.0};
    Any(plan, ranges, static_cast<int>(s), [&](const ProofItem& item) {
      const ItemAmounts amounts = AmountsOf(problem, plan.slots[s], item);
      least.mass_kg = std::min(least.mass_kg, amounts.mass_kg);
      least.volume_m3 = std::min(least.volume_m3, amounts.volume_m3);
      least.cost_eur = std::min(least.cost_eur, amounts.cost_eur);
      return false;
    });
    sum.mass_kg += least.mass_kg;
    sum.volume_m3 += least.volume_m3;
    sum.cost_eur += least.cost_eur;
  }
  return sum.mass_kg > problem.mass_max_kg * (1.0 + kSumTolerance) ||
         sum.volume_m3 * 1e3 > problem.volume_max_l * (1.0 + kSumTolerance) ||
         sum.cost_eur > problem.cost_max_eur * (1.0 + kSumTolerance);
}

// Air of all cycles into the narrowest tubes, and coils for half of each period.
struct Need {
  double air_m3 = 0.0, energy_j = 0.0;
};

Need LeastNeed(const Problem& problem, const std::vector<BestLine>& lines) {
  Need need;
  for (std::size_t g = 0; g < lines.size(); ++g) {
    const ActuatorGroup& group = problem.groups[g];
    model::Chamber chamber = group.chamber;
    chamber.dead_volume_m3 += model::BoreVolume(lines[g].narrowest_m, group.tube_length_m);
    const double content = model::Content(chamber, chamber.operating_pressure_pa) -
                           model::Content(chamber, problem.ambient.pressure_pa);
    need.air_m3 += problem.actuations * group.count *
                   model::StandardVolume(content, problem.ambient.temperature_k);
    need.energy_j += problem.actuations * lines[g].coil_w * 0.5 / problem.frequency_hz;
  }
  return need;
}

// Gas that a bottle gives down to the operating pressure, at most.
double MostGas(const Problem& problem, Family family, const ProofItem& item, double inlet_pa) {
  const double temperature_k = problem.ambient.temperature_k;
  if (family == Family::kCylinder) {
    const model::Cylinder& bottle = problem.parts.cylinders[item.part];
    return item.quantity * model::CylinderUsableVolume(bottle.water_volume_m3,
                                                       bottle.fill_pressure_pa, inlet_pa,
                                                       temperature_k);
  }
  const model::Co2Bottle& bottle = problem.parts.co2[item.part];
  return item.quantity * model::Co2UsableVolume(bottle.co2_mass_kg, bottle.water_volume_m3,
                                                inlet_pa, temperature_k);
}

// Energy of the pump and its coils at least: every litre drawn is pumped at the pressure at which
// that takes least.
double LeastPumpEnergy(const Problem& problem, const ProofPlan& plan, const Ranges& ranges,
                       double air_m3) {
  double least_j_per_m3 = kUnlimited;
  const double ambient_pa = problem.ambient.pressure_pa;
  double operating_pa = ambient_pa;
  for (const ActuatorGroup& group : problem.groups)
    operating_pa = std::max(operating_pa, group.chamber.operating_pressure_pa);
  Any(plan, ranges, SlotOf(plan, Family::kCompressor, -1), [&](const ProofItem& item) {
    const model::CompressorCurve& curve = problem.parts.compressors[item.part].curve;
    constexpr int kSteps = 64;
    for (int i = 0; i <= kSteps; ++i) {
      // Between two pressures at least the power of the cheaper end over the flow of the lower.
      const auto at = [&](int k) {
        return ambient_pa + (model::HighestPressure(curve) - ambient_pa) * k / kSteps;
      };
      const double low_pa = at(i), high_pa = at(std::min(i + 1, kSteps));
      const double power_w =
          std::min(model::ElectricalPower(curve, low_pa), model::ElectricalPower(curve, high_pa));
      const double flow = model::FreeAirDelivery(curve, low_pa);
      if (flow > 0.0) least_j_per_m3 = std::min(least_j_per_m3, power_w / flow);
    }
    return false;
  });
  return air_m3 * least_j_per_m3;
}

// What a choice must bear: gas for a bottle, energy for a battery.
struct Needs {
  double air_m3, energy_j, inlet_pa;
};

Needs NeedsOf(const Problem& problem, const ProofPlan& plan, const Ranges& ranges) {
  std::vector<BestLine> lines;
  double inlet_pa = 0.0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    lines.push_back(BestOf(problem, plan, ranges, g));
    inlet_pa = std::max(inlet_pa, problem.groups[g].chamber.operating_pressure_pa);
  }
  const Need need = LeastNeed(problem, lines);
  Needs needs{need.air_m3, need.energy_j, inlet_pa};
  if (plan.configuration == Configuration::kCompressor)
    needs.energy_j += LeastPumpEnergy(problem, plan, ranges, need.air_m3);
  return needs;
}

bool Bears(const Problem& problem, const ProofSlot& slot, const ProofItem& item,
           const Needs& needs) {
  if (slot.family == Family::kCylinder || slot.family == Family::kCo2)
    return MostGas(problem, slot.family, item, needs.inlet_pa) >= needs.air_m3;
  if (slot.family != Family::kBattery) return true;
  const model::Battery& pack = problem.parts.batteries[item.part];
  return item.quantity * model::UsableEnergy(pack.capacity_ah, pack.nominal_voltage_v) >=
         needs.energy_j;
}

}  // namespace

double LeastObjective(const Problem& problem, const ProofPlan& plan, const Ranges& ranges) {
  const Needs needs = NeedsOf(problem, plan, ranges);
  double sum = 0.0;
  for (std::size_t s = 0; s < plan.slots.size(); ++s) {
    double least = kUnlimited;
    Any(plan, ranges, static_cast<int>(s), [&](const ProofItem& item) {
      if (Bears(problem, plan.slots[s], item, needs))
        least = std::min(least, AmountsOf(problem, plan.slots[s], item).objective);
      return false;
    });
    sum += least;
  }
  return sum;
}

bool CannotMate(const Problem& problem, const ProofPlan& plan, const Ranges& ranges) {
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    if (!LineMates(problem, plan, ranges, g)) return true;
  return !SourceMates(problem, plan, ranges);
}

bool CannotWork(const Problem& problem, const ProofPlan& plan, const Ranges& ranges) {
  if (TooMuch(problem, plan, ranges)) return true;
  const double source_pa = HighestSource(problem, plan, ranges);
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const BestLine line = BestOf(problem, plan, ranges, g);
    if (TooSlow(problem, plan, g, line, std::min(line.source_pa, source_pa))) return true;
  }
  return std::isinf(LeastObjective(problem, plan, ranges));  // nothing bears the needs
}

}  // namespace plenum::optimizer
