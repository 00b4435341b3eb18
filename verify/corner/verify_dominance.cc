#include "verify/corner/verify_dominance.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "verify/design/verify_families.h"
#include "verify/design/verify_finding.h"
#include "verify/design/verify_ids.h"
#include "verify/design/verify_tank.h"

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

// Whether a choice of a family is no worse in a field than another.
bool NoWorse(const FieldValue& a, const FieldValue& b, const PartField& field, bool equal_flow) {
  if (field.use == Use::kMate) return a == b;
  if (const auto* flow = std::get_if<FlowElement>(&a))
    return Flows(*flow, std::get<FlowElement>(b), equal_flow);
  const double x = std::get<double>(a), y = std::get<double>(b);
  switch (field.use) {
    case Use::kMore:
    case Use::kRating:
      return x >= y;
    case Use::kLess:
      return x <= y;
    default:
      return x == y;
  }
}

// The same of so many pieces whose numbers add up.
bool NoWorse(double a, double b, const PartField& field) {
  if (field.use == Use::kBoth) return a == b;
  return field.use == Use::kLess ? Least(a, b) : Most(a, b);
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

bool Drives(const std::vector<model::Compressor>& pumps, const model::Battery& a,
            const model::Battery& b) {
  return std::all_of(pumps.begin(), pumps.end(), [&](const model::Compressor& pump) {
    return !model::VoltageMatches(b.nominal_voltage_v, pump.curve.voltage_v) ||
           model::VoltageMatches(a.nominal_voltage_v, pump.curve.voltage_v);
  });
}

// What no table says: gas of bottles, pumps in parallel, which pumps a battery drives.
bool RuleNoWorse(const Problem& problem, const ProofPlan& plan, Family family, const ProofItem& a,
                 const ProofItem& b) {
  const model::Parts& parts = problem.parts;
  const int i = a.part, j = b.part, n = a.quantity, m = b.quantity;
  if (family == Family::kCylinder)
    return GivesMore(problem, parts.cylinders[i], n, parts.cylinders[j], m);
  if (family == Family::kCo2) return GivesMore(problem, parts.co2[i], n, parts.co2[j], m);
  if (optimizer::IsPump(family))
    return n == m && PumpsIn(parts, family)[i].curve == PumpsIn(parts, family)[j].curve;
  const auto drives = [&](const std::vector<model::Compressor>& pumps) {
    return Drives(pumps, parts.batteries[i], parts.batteries[j]);
  };
  if (family == Family::kBattery)
    return (!HasPump(plan.configuration) || drives(PumpsOf(problem, plan.configuration))) &&
           (!PumpsRail(problem) || drives(parts.vacuum_pumps));
  return true;
}

bool ClosesLate(const model::Valve& valve) {
  return model::Holds(valve.kind) && valve.closing_scatter_s > 0.0;
}

// Whether a valve that stands open for half of the period takes more air through a choice that
// passes more, or one that closes late lets the pressure rise further.
bool FillsFurther(const Problem& problem, const ProofPlan& plan, Family family,
                  const ProofItem& item) {
  const std::vector<model::Valve>& valves = problem.parts.valves;
  if (family == Family::kFitting && !IsDirect(plan.configuration) &&
      std::any_of(valves.begin(), valves.end(), ClosesLate))
    return true;
  if (plan.configuration == Configuration::kMains) return false;
  if (family == Family::kValve) return !model::Holds(valves[item.part].kind);
  return std::any_of(valves.begin(), valves.end(),
                     [](const model::Valve& valve) { return !model::Holds(valve.kind); });
}

// Everything but amounts, field by field.
bool NoWorse(const Problem& problem, const ProofPlan& plan, const ProofSlot& slot,
             const ProofItem& a, const ProofItem& b) {
  if (a.part < 0 || b.part < 0) return false;  // no other choice stands for these
  const FamilySpec& spec = SpecOf(slot.family);
  const bool further = FillsFurther(problem, plan, slot.family, b);
  const bool mates = !spec.in_line || problem.groups[slot.group].fittings_per_line > 0;
  for (const PartField& field : spec.fields) {
    if (field.use == Use::kRule || (field.use == Use::kMate && !mates)) continue;
    const FieldValue x = field.of(problem.parts, a.part), y = field.of(problem.parts, b.part);
    const bool sum = field.pieces == Pieces::kSum && !spec.in_line;
    if (sum ? !NoWorse(a.quantity * std::get<double>(x), b.quantity * std::get<double>(y), field)
            : !NoWorse(x, y, field, further || (plan.equal_flow && field.use == Use::kSharedFlow)))
      return false;
  }
  return RuleNoWorse(problem, plan, slot.family, a, b);
}

// What a tank keeps at most: the more the larger it is, so that a larger one takes the place of
// another only if it weighs no more then.
void AddMostLeft(const Problem& problem, const ProofItem& item, ItemAmounts& amounts) {
  double left_pa = InletPressures(problem).second;
  for (const model::Reservoir& tank : problem.parts.tanks)
    left_pa = std::max(left_pa, std::min(tank.pressure_max_pa, problem.tank_fill_max_pa));
  const model::Reservoir& tank = problem.parts.tanks[item.part];
  const double more_kg = item.quantity * (ChargeKg(problem, tank, left_pa) -
                                          ChargeKg(problem, tank, LeastLeftPa(problem)));
  amounts.mass_kg += more_kg;
  amounts.objective += problem.objective.mass_kg * more_kg;
}

}  // namespace

bool Dominates(const Problem& problem, const ProofPlan& plan, const ProofSlot& slot,
               const ProofItem& better, const ProofItem& worse) {
  if (better.part < 0 || worse.part < 0 || better == worse) return false;
  ItemAmounts a = ChoiceAmounts(problem, LayoutOf(plan), slot, better);
  ItemAmounts b = ChoiceAmounts(problem, LayoutOf(plan), slot, worse);
  // At the most and the least that they cost with packs that others share.
  a.cost_eur += a.pack_more_eur;
  a.objective += problem.objective.cost_eur * a.pack_more_eur;
  b.cost_eur -= b.pack_less_eur;
  b.objective -= problem.objective.cost_eur * b.pack_less_eur;
  const TieShare share = ShareOfTies(problem, a), other_share = ShareOfTies(problem, b);
  if (slot.family == Family::kTank) {
    AddMostLeft(problem, better, a);
    AddMostLeft(problem, worse, b);
  }
  if ((std::isfinite(problem.mass_max_kg) &&
       !Least(a.mass_kg + a.mass_slack_kg, b.mass_kg + b.mass_slack_kg)) ||
      (std::isfinite(problem.volume_max_l) &&
       !Least(a.volume_m3 + a.volume_slack_m3, b.volume_m3 + b.volume_slack_m3)) ||
      (std::isfinite(problem.cost_max_eur) && !Least(a.cost_eur, b.cost_eur)))
    return false;
  const std::string& id = BasicsOf(problem.parts, slot.family, better.part).id;
  const std::string& other = BasicsOf(problem.parts, slot.family, worse.part).id;
  const bool first = share != other_share ? share < other_share
                     : id != other        ? id < other
                                          : better.quantity < worse.quantity;
  return (a.objective < b.objective - plan.tie || (first && Least(a.objective, b.objective))) &&
         NoWorse(problem, plan, slot, better, worse);
}

}  // namespace plenum::verify
