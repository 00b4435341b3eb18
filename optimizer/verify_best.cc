#include "optimizer/verify_best.h"

#include <algorithm>

namespace plenum::optimizer {

BestNumbers::BestNumbers(const Problem& problem, const ProofPlan& plan, const Ranges& ranges,
                         int slot)
    : fields_(SpecOf(plan.slots[slot].family).fields), best_(fields_.size()) {
  for (int i = ranges[slot].first; i < ranges[slot].second; ++i) {
    const int part = plan.slots[slot].choices[i].part;
    if (part < 0) continue;
    for (std::size_t f = 0; f < fields_.size(); ++f)
      Look(fields_[f].of(problem.parts, part), best_[f]);
  }
}

void BestNumbers::Look(const FieldValue& value, Best& best) const {
  if (const auto* number = std::get_if<double>(&value)) {
    best.low = std::min(best.low, *number);
    best.high = std::max(best.high, *number);
  } else if (const auto* flow = std::get_if<model::FlowElement>(&value)) {
    best.flow.sonic_conductance_m3_per_s_pa =
        std::max(best.flow.sonic_conductance_m3_per_s_pa, flow->sonic_conductance_m3_per_s_pa);
    best.flow.critical_ratio = std::max(best.flow.critical_ratio, flow->critical_ratio);
    best.flow.subsonic_index = std::min(best.flow.subsonic_index, flow->subsonic_index);
  }
}

std::size_t BestNumbers::IndexOf(std::string_view name) const {
  std::size_t f = 0;
  while (fields_[f].name != name) ++f;
  return f;
}

double BestNumbers::Number(std::string_view name) const {
  const std::size_t f = IndexOf(name);
  return fields_[f].use == Use::kLess ? best_[f].low : best_[f].high;
}

double BestNumbers::Low(std::string_view name) const { return best_[IndexOf(name)].low; }
double BestNumbers::High(std::string_view name) const { return best_[IndexOf(name)].high; }
const model::FlowElement& BestNumbers::Flow(std::string_view name) const {
  return best_[IndexOf(name)].flow;
}

}  // namespace plenum::optimizer
