#include "verify/design/verify_families.h"

#include <cmath>

namespace plenum::verify {

bool AsksForPrices(const Problem& problem) {
  return !problem.unpriced_allowed &&
         (problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur));
}

namespace {

// A regulator that is one group's is there.
bool MayBeNone(const Layout& layout, const ProofSlot& slot) {
  return slot.group < 0 && MayLack(layout.configuration, slot.family);
}

}  // namespace

std::vector<ProofItem> EntriesOf(const Problem& problem, const Layout& layout,
                                 const ProofSlot& slot) {
  const Family family = slot.family;
  if (family == Family::kFitting && problem.groups[slot.group].fittings_per_line == 0)
    return {{-1, 0}};
  const bool cost = AsksForPrices(problem);
  std::vector<ProofItem> entries;
  for (int part = 0; part < ChoicesIn(problem, layout.configuration, family); ++part)
    for (int quantity = 1; quantity <= QuantityMax(problem, family); ++quantity)
      if (!cost || BasicsOf(problem.parts, family, part).cost_eur)
        entries.push_back({part, quantity});
  if (MadeToMeasureAllowed(problem, family) && !cost) entries.push_back({-2, 1});
  if (MayBeNone(layout, slot)) entries.push_back({-1, 0});
  return entries;
}

ProofPlan EmptyPlan(const Problem& problem, const Layout& layout) {
  ProofPlan plan;
  plan.configuration = layout.configuration;
  plan.own_regulators = layout.own_regulators;
  const int groups = static_cast<int>(problem.groups.size());
  for (int group = 0; group < groups; ++group)
    for (const Family family : LineFamilies()) plan.slots.push_back({family, group, {}, {}});
  for (const Family family : SourceFamilies(problem, layout.configuration)) {
    const bool own = layout.own_regulators && family == Family::kRegulator;
    for (int group = own ? 0 : -1; group < (own ? groups : 0); ++group)
      plan.slots.push_back({family, group, {}, {}});
  }
  return plan;
}

BigCount Combinations(const Problem& problem, const Layout& layout) {
  BigCount count = 1;
  for (const ProofSlot& slot : EmptyPlan(problem, layout).slots) {
    if (slot.family == Family::kFitting && problem.groups[slot.group].fittings_per_line == 0)
      continue;
    count *=
        ChoicesIn(problem, layout.configuration, slot.family) * QuantityMax(problem, slot.family) +
        (MadeToMeasureAllowed(problem, slot.family) ? 1 : 0) + (MayBeNone(layout, slot) ? 1 : 0);
  }
  return count;
}

}  // namespace plenum::verify
