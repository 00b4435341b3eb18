#include "verify/design/verify_ids.h"

#include <algorithm>
#include <cmath>

#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_families.h"

namespace plenum::verify {

Ids IdsOf(const Design& design) {
  Ids ids;
  for (const Choice& choice : design.parts)
    if (!SpecOf(choice.family).joins)  // it follows from the others
      ids.emplace_back(choice.id, choice.group < 0 ? static_cast<int>(choice.quantity) : 1);
  return ids;
}

std::string Text(const Ids& ids) {
  std::string text;
  for (const auto& [id, quantity] : ids) {
    if (!text.empty()) text += ", ";
    if (quantity > 1) text += std::to_string(quantity) + " × ";
    text += id;
  }
  return text;
}

TieShare& TieShare::operator+=(const TieShare& other) {
  mass += other.mass;
  cost += other.cost;
  return *this;
}

TieShare ShareOfTies(const Problem& problem, const ItemAmounts& amounts) {
  const Objective& weight = problem.objective;
  const bool others = weight.volume_l > 0.0 || weight.energy_wh > 0.0;
  const bool mass_alone = !others && !(weight.cost_eur > 0.0);
  const bool cost_alone = !others && !(weight.mass_kg > 0.0);
  return {mass_alone ? 0 : std::llround(amounts.mass_kg * 1e9),
          cost_alone ? 0 : std::llround(amounts.cost_eur * 1e6)};
}

TieShare SurplusOfTies(const Problem& problem, double cost_eur, double counted_eur) {
  ItemAmounts surplus;
  surplus.cost_eur = std::max(0.0, cost_eur - counted_eur);
  return ShareOfTies(problem, surplus);
}

TieKey TieKeyOf(const Problem& problem, const Design& design) {
  TieKey key{{}, IdsOf(design)};
  double counted_eur = 0.0;
  for (const Choice& row : design.parts) {
    if (SpecOf(row.family).joins) continue;  // it counts with what it joins
    const bool made = row.family == Family::kReservoir && row.id == "custom";
    const ProofItem item{
        made ? -2 : FindPart(problem.parts, row.family, row.id),
        row.group < 0 ? static_cast<int>(row.quantity) / TimesBought(problem, row.family) : 1};
    if (item.part == -1) continue;  // no part of the catalogue, which another check tells
    const ItemAmounts amounts =
        ChoiceAmounts(problem, LayoutOf(design), {row.family, row.group, {}, {}}, item);
    counted_eur += amounts.cost_eur;
    key.share += ShareOfTies(problem, amounts);
  }
  double cost_eur = 0.0;
  for (const auto& row_eur : RowCosts(problem, design)) cost_eur += row_eur.value_or(0.0);
  key.share += SurplusOfTies(problem, cost_eur, counted_eur);
  return key;
}

}  // namespace plenum::verify
