#include "verify/design/verify_families.h"

#include <cmath>

namespace plenum::verify {

bool PricesNeeded(const Problem& problem) {
  return !problem.unpriced_allowed &&
         (problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur));
}

std::vector<ProofItem> EntriesOf(const Problem& problem, Configuration configuration,
                                 const ProofSlot& slot) {
  const Family family = slot.family;
  if (family == Family::kFitting && problem.groups[slot.group].fittings_per_line == 0)
    return {{-1, 0}};
  const bool cost = PricesNeeded(problem);
  std::vector<ProofItem> entries;
  for (int part = 0; part < FamilySize(problem.parts, family); ++part)
    for (int quantity = 1; quantity <= QuantityMax(problem, family); ++quantity)
      if (!cost || BasicsOf(problem.parts, family, part).cost_eur)
        entries.push_back({part, quantity});
  if (MadeToMeasureAllowed(problem, family) && !cost) entries.push_back({-2, 1});
  if (MayLack(configuration, family)) entries.push_back({-1, 0});
  return entries;
}

ProofPlan EmptyPlan(const Problem& problem, Configuration configuration) {
  ProofPlan plan;
  plan.configuration = configuration;
  for (int group = 0; group < static_cast<int>(problem.groups.size()); ++group)
    for (const Family family : LineFamilies()) plan.slots.push_back({family, group, {}, {}});
  for (const Family family : SourceFamilies(configuration))
    plan.slots.push_back({family, -1, {}, {}});
  return plan;
}

BigCount Combinations(const Problem& problem, Configuration configuration) {
  BigCount count = 1;
  for (const ProofSlot& slot : EmptyPlan(problem, configuration).slots) {
    if (slot.family == Family::kFitting && problem.groups[slot.group].fittings_per_line == 0)
      continue;
    count *= FamilySize(problem.parts, slot.family) * QuantityMax(problem, slot.family) +
             (MadeToMeasureAllowed(problem, slot.family) ? 1 : 0) +
             (MayLack(configuration, slot.family) ? 1 : 0);
  }
  return count;
}

}  // namespace plenum::verify
