#include "optimizer/choices/tie_key.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::optimizer {
namespace {

constexpr double kPerKg = 1e9, kPerEur = 1e6;

bool IsMassAlone(const Objective& objective) {
  return objective == Objective{objective.mass_kg, 0.0, 0.0, 0.0};
}

bool IsCostAlone(const Objective& objective) {
  return objective == Objective{0.0, 0.0, objective.cost_eur, 0.0};
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
    ids.emplace_back(choice.id, choice.group < 0 ? static_cast<int>(choice.quantity) : 1);
  return ids;
}

TieKey TieKeyOf(const Problem& problem, const Design& design) {
  TieKey key{{}, IdsOf(design)};
  for (const Choice& row : design.parts) {
    const bool made = SpecOf(row.family).made_to_measure && row.id == "custom";
    key.share += TieShareOf(
        problem.objective,
        made ? CustomReservoir(problem, model::kMadeReservoirSmallestM3, LeastSourcePa(problem))
             : Amounts{row.mass_kg, row.volume_m3, row.cost_eur.value_or(0.0)});
  }
  return key;
}

}  // namespace plenum::optimizer
