#include "optimizer/choices/tie_key.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/packs.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

constexpr double kPerKg = 1e9, kPerEur = 1e6;

bool IsMassAlone(const Objective& objective) {
  return objective == Objective{objective.mass_kg, 0.0, 0.0, 0.0};
}

bool IsCostAlone(const Objective& objective) {
  return objective == Objective{0.0, 0.0, objective.cost_eur, 0.0};
}

// The row as a choice of the search: joints count with what they join, a tank with the air that any
// fill leaves in it.
Amounts ChoiceAmounts(const Problem& problem, const Design& design, const Choice& row) {
  const bool own_regulators = HasOwnRegulators(design.parts);
  if (SpecOf(row.family).made_to_measure && row.id == "custom")
    return CustomReservoir(problem, model::kMadeReservoirSmallestM3, LeastSourcePa(problem));
  Amounts amounts{row.mass_kg, row.volume_m3, row.cost_eur.value_or(0.0)};
  const int part = FindPart(problem.parts, row.family, row.id);
  if (part < 0) return amounts;
  amounts.cost_eur = Counted(row.quantity, BasicsOf(problem.parts, row.family, part),
                             SharesPacks(problem, row.group))
                         .cost_eur;
  if (row.family == Family::kTank)
    amounts.mass_kg = row.quantity * problem.parts.tanks[part].basics.mass_kg +
                      row.quantity * LeastTankCharge(problem, part);
  if (row.family == Family::kTubing)
    amounts += LineJointShare(problem, row.group, own_regulators);
  else if (row.group < 0)
    amounts +=
        SourceJoint(problem, row.family, part,
                    static_cast<int>(row.quantity) / FeedsOf(problem, row.family), own_regulators);
  if (row.family == Family::kRegulator && row.group >= 0)
    amounts += OwnRegulatorJointAtMains(problem, design.configuration, row.group);
  return amounts;
}

}  // namespace

TieShare& TieShare::operator+=(const TieShare& other) {
  mass += other.mass;
  cost += other.cost;
  return *this;
}

TieShare TieShareOf(const Objective& objective, const Amounts& amounts) {
  return {IsMassAlone(objective) ? 0 : std::llround(amounts.mass_kg * kPerKg),
          IsCostAlone(objective) ? 0 : std::llround(amounts.cost_eur * kPerEur)};
}

TieShare Least(const TieShare& a, const TieShare& b) {
  return {std::min(a.mass, b.mass), std::min(a.cost, b.cost)};
}

PartIds IdsOf(const Design& design) {
  PartIds ids;
  ids.reserve(design.parts.size());
  for (const Choice& choice : design.parts)
    if (!SpecOf(choice.family).joins)
      ids.emplace_back(choice.id, choice.group < 0 ? static_cast<int>(choice.quantity) : 1);
  return ids;
}

TieKey TieKeyOf(const Problem& problem, const Design& design) {
  TieKey key{{}, IdsOf(design)};
  for (const Choice& row : design.parts)
    if (!SpecOf(row.family).joins)
      key.share += TieShareOf(problem.objective, ChoiceAmounts(problem, design, row));
  key.share += TieShareOf(problem.objective, {0.0, 0.0, PackSurplus(problem, design.parts)});
  return key;
}

}  // namespace plenum::optimizer
