#include "verify/design/verify_choice.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_families.h"
#include "verify/design/verify_joints.h"
#include "verify/design/verify_tank.h"

namespace plenum::verify {
namespace {

void AddOpenPacks(double pieces, const model::PartBasics& basics, ItemAmounts& sum) {
  const auto [more_eur, less_eur] = OpenPacksEur(pieces, basics);
  sum.pack_more_eur += more_eur;
  sum.pack_less_eur += less_eur;
}

// `open`: how many there are depends on the choice.
void Add(const Problem& problem, const JointRows& rows, double share, bool open, ItemAmounts& sum) {
  for (const auto& [row, pieces] : rows) {
    const model::PartBasics& basics = BasicsOf(problem.parts, row.first, row.second);
    sum.mass_kg += share * pieces * basics.mass_kg;
    sum.volume_m3 += share * pieces * basics.body_volume_m3;
    sum.cost_eur += share * pieces * basics.cost_eur.value_or(0.0);
    sum.mass_slack_kg += share * pieces * basics.mass_slack_kg;
    sum.volume_slack_m3 += share * pieces * basics.body_volume_slack_m3;
    if (open) AddOpenPacks(pieces, basics, sum);
  }
}

// What joins the pieces; a tube has its group's share, by number, of what joins all lines. Where
// groups have regulators of their own it has what joins the group's lines, and the source, or the
// first regulator at the mains, what joins the regulators. Pumps of their own have what joins each
// feed.
void AddJoints(const Problem& problem, const Layout& layout, const ProofSlot& slot,
               const ProofItem& item, ItemAmounts& sum) {
  if (slot.family == Family::kTubing) {
    if (problem.pump_feed == PumpFeed::kPerActuator) return;  // with the pumps
    if (problem.pump_feed == PumpFeed::kPerGroup)
      return Add(problem, JointOfGroup(problem, slot.group), 1.0, false, sum);
    const double share = static_cast<double>(problem.groups[slot.group].count) / Lines(problem);
    return layout.own_regulators ? Add(problem, JointOfGroup(problem, slot.group), 1.0, false, sum)
                                 : Add(problem, JointOfLines(problem), share, false, sum);
  }
  if (problem.pump_feed != PumpFeed::kShared) {
    if (slot.family == PumpFamily(layout.configuration))
      Add(problem, JointsOfFeeds(problem, slot.family, item.part, item.quantity), 1.0, true, sum);
    return;
  }
  Add(problem, JointOfPieces(problem, slot.family, item.part, item.quantity), 1.0, true, sum);
  if (!layout.own_regulators) return;
  Add(problem, JointOfRegulators(problem, slot.family, item.part), 1.0, true, sum);
  if (layout.configuration == Configuration::kMains && slot.family == Family::kRegulator &&
      slot.group == 0)
    Add(problem, JointOfRegulatorsAtMains(problem), 1.0, false, sum);
}

}  // namespace

ItemAmounts& operator+=(ItemAmounts& sum, const ItemAmounts& more) {
  sum.mass_kg += more.mass_kg;
  sum.volume_m3 += more.volume_m3;
  sum.cost_eur += more.cost_eur;
  sum.objective += more.objective;
  return sum;
}

bool TooMuch(const Problem& problem, const ItemAmounts& least, double room) {
  const double slack = 1.0 + room;
  return least.mass_kg > problem.mass_max_kg * slack ||
         least.volume_m3 * 1e3 > problem.volume_max_l * slack ||
         least.cost_eur > problem.cost_max_eur * slack;
}

ItemAmounts ChoiceAmounts(const Problem& problem, const Layout& layout, const ProofSlot& slot,
                          const ProofItem& item) {
  if (item.part == -1) return {};
  ItemAmounts sum;
  double energy_j = 0.0;  // whatever the strokes
  if (item.part == -2) {
    double least_pa = problem.ambient.pressure_pa;  // that any source stops at
    for (const ActuatorGroup& group : problem.groups)
      least_pa = std::max(least_pa, group.chamber.operating_pressure_pa);
    const model::MadeReservoir made = model::MakeReservoir(model::kMadeReservoirSmallestM3,
                                                           least_pa - problem.ambient.pressure_pa);
    const double share = problem.guarantee ? problem.guarantee->made_share : 0.0;
    sum.mass_kg = made.mass_kg;
    sum.volume_m3 = made.body_volume_m3;
    sum.mass_slack_kg = share * made.mass_kg;
    sum.volume_slack_m3 = share * made.body_volume_m3;
  } else {
    const model::PartBasics& basics = BasicsOf(problem.parts, slot.family, item.part);
    double pieces = item.quantity * TimesBought(problem, slot.family), gas_kg = 0.0;
    if (slot.group >= 0 && slot.family != Family::kRegulator) {
      const ActuatorGroup& group = problem.groups[slot.group];
      pieces = group.count *
               (slot.family == Family::kTubing ? group.tube_length_m : group.fittings_per_line);
      if (slot.family == Family::kValve) {
        const model::Valve& valve = problem.parts.valves[item.part];
        pieces = std::ceil(static_cast<double>(group.count) / valve.channels);
        energy_j = problem.actuations * group.count * valve.coil_power_w *
                   CoilSeconds(problem, slot.group, model::Holds(valve.kind));
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
    if (slot.family == Family::kTank)
      gas_kg = ChargeKg(problem, problem.parts.tanks[item.part], LeastLeftPa(problem));
    if (slot.family == Family::kCo2) gas_kg = problem.parts.co2[item.part].co2_mass_kg;
    const bool shared = MaySharePacks(problem, slot.group);
    sum.mass_kg = pieces * (basics.mass_kg + gas_kg);
    sum.volume_m3 = pieces * basics.body_volume_m3;
    sum.cost_eur = shared ? pieces * basics.cost_eur.value_or(0.0) : CostInPacks(pieces, basics);
    sum.mass_slack_kg = pieces * basics.mass_slack_kg;
    sum.volume_slack_m3 = pieces * basics.body_volume_slack_m3;
    if (shared) AddOpenPacks(pieces, basics, sum);
    AddJoints(problem, layout, slot, item, sum);
  }
  const Objective& weight = problem.objective;
  sum.objective = weight.mass_kg * sum.mass_kg + weight.volume_l * sum.volume_m3 * 1e3 +
                  weight.cost_eur * sum.cost_eur +
                  weight.energy_wh * energy_j / optimizer::kJoulePerWattHour;
  return sum;
}

double GasOf(const Problem& problem, Family family, const ProofItem& item, double inlet_pa) {
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

SlotAmounts AmountsOfAll(const Problem& problem, const ProofPlan& plan) {
  SlotAmounts all;
  for (const ProofSlot& slot : plan.slots) {
    all.emplace_back();
    for (const ProofItem& item : slot.choices)
      all.back().push_back(ChoiceAmounts(problem, LayoutOf(plan), slot, item));
  }
  return all;
}

}  // namespace plenum::verify
