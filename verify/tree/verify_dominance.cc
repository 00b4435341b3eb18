#include "verify/tree/verify_dominance.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "verify/design/verify_families.h"
#include "verify/design/verify_finding.h"

namespace plenum::verify {
namespace {

using model::FlowElement;

// Numbers of two choices are compared with room for rounding alone.
bool Least(double a, double b) { return a <= b || Near(a, b, 1e-12); }
bool Most(double a, double b) { return Least(b, a); }

bool Flows(const FlowElement& a, const FlowElement& b, bool equal) {
  if (equal) return a == b;
  return a.sonic_conductance_m3_per_s_pa >= b.sonic_conductance_m3_per_s_pa &&
         a.critical_ratio >= b.critical_ratio && a.subsonic_index <= b.subsonic_index;
}

bool Better(const model::Tubing& a, const model::Tubing& b, bool fittings) {
  return (!fittings || a.outer_diameter_m == b.outer_diameter_m) &&
         a.inner_diameter_m == b.inner_diameter_m && a.pressure_max_pa >= b.pressure_max_pa;
}

bool Better(const model::Fitting& a, const model::Fitting& b, bool equal) {
  return a.tube_outer_diameter_m == b.tube_outer_diameter_m && a.thread == b.thread &&
         Flows(a.flow, b.flow, equal) && a.pressure_max_pa >= b.pressure_max_pa;
}

bool Better(const model::Valve& a, const model::Valve& b, bool fittings, bool equal) {
  return (!fittings || a.port == b.port) && model::Holds(a.kind) == model::Holds(b.kind) &&
         Flows(a.fill, b.fill, equal) && Flows(a.exhaust, b.exhaust, equal) &&
         a.coil_power_w <= b.coil_power_w && a.pressure_max_pa >= b.pressure_max_pa &&
         a.pressure_min_pa <= b.pressure_min_pa;
}

bool Better(const model::Regulator& a, const model::Regulator& b) {
  return Flows(a.flow, b.flow, false) && a.flow_max_m3_per_s >= b.flow_max_m3_per_s &&
         a.inlet_pressure_max_pa >= b.inlet_pressure_max_pa &&
         a.outlet_pressure_max_pa >= b.outlet_pressure_max_pa &&
         a.inlet_pressure_min_pa <= b.inlet_pressure_min_pa &&
         a.outlet_pressure_min_pa <= b.outlet_pressure_min_pa &&
         a.electrical_power_w <= b.electrical_power_w;
}

// Inlet pressures that a regulator of the catalogue may ask of a bottle: lowest and highest.
std::pair<double, double> InletPressures(const Problem& problem) {
  const double low_pa = problem.ambient.pressure_pa;
  double inlet_pa = low_pa, outlet_pa = low_pa;
  for (const model::Regulator& regulator : problem.parts.regulators) {
    inlet_pa = std::max(inlet_pa, regulator.inlet_pressure_min_pa);
    outlet_pa = std::max(outlet_pa, regulator.outlet_pressure_max_pa);
  }
  return {low_pa, std::max(inlet_pa, std::min(outlet_pa, problem.source_pressure_max_pa))};
}

// Gas down to an inlet pressure; below nothing where the bottle is emptier than that, so that what
// it holds back counts in the comparison.
double Gas(const Problem& problem, const model::Cylinder& bottle, int quantity, double inlet_pa) {
  const auto held = [&](double p) { return p / model::CompressibilityOfAir(p); };
  return quantity * bottle.water_volume_m3 *
         model::StandardVolume(held(bottle.fill_pressure_pa) - held(inlet_pa),
                               problem.ambient.temperature_k);
}

double Gas(const Problem& problem, const model::Co2Bottle& bottle, int quantity, double inlet_pa) {
  return quantity *
         (bottle.co2_mass_kg / model::kReferenceDensityCo2KgPerM3 -
          bottle.water_volume_m3 * model::StandardVolume(inlet_pa, problem.ambient.temperature_k));
}

template <typename Bottle>
bool GivesMore(const Problem& problem, const Bottle& a, int count_a, const Bottle& b, int count_b) {
  const auto [low_pa, high_pa] = InletPressures(problem);
  return Most(Gas(problem, a, count_a, low_pa), Gas(problem, b, count_b, low_pa)) &&
         Most(Gas(problem, a, count_a, high_pa), Gas(problem, b, count_b, high_pa));
}

bool Drives(const Problem& problem, const model::Battery& a, const model::Battery& b) {
  return std::all_of(problem.parts.compressors.begin(), problem.parts.compressors.end(),
                     [&](const model::Compressor& pump) {
                       return !model::VoltageMatches(b.nominal_voltage_v, pump.curve.voltage_v) ||
                              model::VoltageMatches(a.nominal_voltage_v, pump.curve.voltage_v);
                     });
}

// Everything but amounts.
bool NoWorse(const Problem& problem, const ProofPlan& plan, const ProofSlot& slot,
             const ProofItem& a, const ProofItem& b) {
  const model::Parts& parts = problem.parts;
  const int i = a.part, j = b.part, n = a.quantity, m = b.quantity;
  if (i < 0 || j < 0) return false;  // no other choice stands for these
  const bool fittings = slot.group >= 0 && problem.groups[slot.group].fittings_per_line > 0;
  switch (slot.family) {
    case Family::kTubing:
      return Better(parts.tubing[i], parts.tubing[j], fittings);
    case Family::kFitting:
      return Better(parts.fittings[i], parts.fittings[j], plan.equal_flow);
    case Family::kValve:
      return Better(parts.valves[i], parts.valves[j], fittings, plan.equal_flow);
    case Family::kRegulator:
      return Better(parts.regulators[i], parts.regulators[j]);
    case Family::kCylinder:
      return parts.cylinders[i].fill_pressure_pa <= parts.cylinders[j].fill_pressure_pa &&
             GivesMore(problem, parts.cylinders[i], n, parts.cylinders[j], m);
    case Family::kCo2:
      return Most(n * parts.co2[i].flow_sustained_m3_per_s,
                  m * parts.co2[j].flow_sustained_m3_per_s) &&
             GivesMore(problem, parts.co2[i], n, parts.co2[j], m);
    case Family::kCompressor:
      return n == m && parts.compressors[i].curve == parts.compressors[j].curve &&
             parts.compressors[i].duty_max >= parts.compressors[j].duty_max;
    case Family::kBattery: {
      const model::Battery &x = parts.batteries[i], &y = parts.batteries[j];
      return (plan.configuration != Configuration::kCompressor || Drives(problem, x, y)) &&
             Most(n * x.capacity_ah * x.nominal_voltage_v,
                  m * y.capacity_ah * y.nominal_voltage_v) &&
             Most(n * x.current_max_a, m * y.current_max_a) &&
             x.nominal_voltage_v >= y.nominal_voltage_v;
    }
    case Family::kReservoir:
      return n * parts.reservoirs[i].volume_m3 == m * parts.reservoirs[j].volume_m3 &&
             parts.reservoirs[i].pressure_max_pa >= parts.reservoirs[j].pressure_max_pa;
  }
  return false;
}

}  // namespace

ItemAmounts ChoiceAmounts(const Problem& problem, const ProofSlot& slot, const ProofItem& item) {
  if (item.part == -1) return {};
  ItemAmounts sum;
  double energy_j = 0.0;  // whatever the strokes
  if (item.part == -2) {
    const double rating_pa = std::min(problem.source_pressure_max_pa - problem.ambient.pressure_pa,
                                      model::kMadeReservoirPressureMaxGaugePa);
    const model::MadeReservoir made =
        model::MakeReservoir(model::kMadeReservoirSmallestM3, rating_pa);
    sum = {made.mass_kg, made.body_volume_m3, 0.0, 0.0};
  } else {
    const model::PartBasics& basics = *BasicsOf(problem, slot.family, item.part);
    double pieces = item.quantity, gas_kg = 0.0;
    if (slot.group >= 0) {
      const ActuatorGroup& group = problem.groups[slot.group];
      pieces = group.count *
               (slot.family == Family::kTubing ? group.tube_length_m : group.fittings_per_line);
      if (slot.family == Family::kValve) {
        const model::Valve& valve = problem.parts.valves[item.part];
        pieces = std::ceil(static_cast<double>(group.count) / valve.channels);
        energy_j = problem.actuations * group.count * valve.coil_power_w / problem.frequency_hz / 2;
      }
    }
    if (slot.family == Family::kRegulator)
      energy_j = problem.actuations / problem.frequency_hz *
                 problem.parts.regulators[item.part].electrical_power_w;
    if (slot.family == Family::kCylinder) {
      const model::Cylinder& cylinder = problem.parts.cylinders[item.part];
      gas_kg = model::CylinderCharge(cylinder.water_volume_m3, cylinder.fill_pressure_pa,
                                     problem.ambient.temperature_k);
    }
    if (slot.family == Family::kCo2) gas_kg = problem.parts.co2[item.part].co2_mass_kg;
    sum = {pieces * (basics.mass_kg + gas_kg), pieces * basics.body_volume_m3,
           pieces * basics.cost_eur.value_or(0.0), 0.0};
  }
  const Objective& weight = problem.objective;
  sum.objective = weight.mass_kg * sum.mass_kg + weight.volume_l * sum.volume_m3 * 1e3 +
                  weight.cost_eur * sum.cost_eur + weight.energy_wh * energy_j / 3600.0;
  return sum;
}

bool Dominates(const Problem& problem, const ProofPlan& plan, const ProofSlot& slot,
               const ProofItem& better, const ProofItem& worse) {
  if (better.part < 0 || worse.part < 0 || better == worse) return false;
  const ItemAmounts a = ChoiceAmounts(problem, slot, better),
                    b = ChoiceAmounts(problem, slot, worse);
  if ((std::isfinite(problem.mass_max_kg) && !Least(a.mass_kg, b.mass_kg)) ||
      (std::isfinite(problem.volume_max_l) && !Least(a.volume_m3, b.volume_m3)) ||
      (std::isfinite(problem.cost_max_eur) && !Least(a.cost_eur, b.cost_eur)))
    return false;
  const std::string& id = BasicsOf(problem, slot.family, better.part)->id;
  const std::string& other = BasicsOf(problem, slot.family, worse.part)->id;
  const bool first = id != other ? id < other : better.quantity < worse.quantity;
  return (a.objective < b.objective - plan.tie || (first && Least(a.objective, b.objective))) &&
         NoWorse(problem, plan, slot, better, worse);
}

}  // namespace plenum::verify
