// The best of each number over the choices of a slot in a box, as the table of the family says
// which is best. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_BEST_H_
#define PLENUM_VERIFY_CORNER_VERIFY_BEST_H_

#include <algorithm>
#include <string_view>
#include <vector>

#include "verify/corner/verify_ranges.h"
#include "verify/design/verify_families.h"

namespace plenum::verify {

class BestNumbers {
 public:
  // Of one piece each. Choices of no part are passed over.
  BestNumbers(const Problem& problem, const ProofPlan& plan, const Ranges& ranges, int slot);

  // By the name of a field. Of no choice at all: the worst there is.
  double Number(std::string_view name) const;  // kMore, kLess, kRating
  double Low(std::string_view name) const;     // kBoth
  double High(std::string_view name) const;
  const model::FlowElement& Flow(std::string_view name) const;

 private:
  struct Best {
    double low = kUnlimited, high = -kUnlimited;
    model::FlowElement flow{0.0, 0.0, 1.0};
  };
  void Look(const FieldValue& value, Best& best) const;
  std::size_t IndexOf(std::string_view name) const;

  std::span<const PartField> fields_;
  std::vector<Best> best_;  // per field
};

inline BestNumbers::BestNumbers(const Problem& problem, const ProofPlan& plan, const Ranges& ranges,
                                int slot)
    : fields_(SpecOf(plan.slots[slot].family).fields), best_(fields_.size()) {
  for (int i = ranges[slot].first; i < ranges[slot].second; ++i) {
    const int part = plan.slots[slot].choices[i].part;
    if (part < 0) continue;
    for (std::size_t f = 0; f < fields_.size(); ++f)
      Look(fields_[f].of(problem.parts, part), best_[f]);
  }
}

inline void BestNumbers::Look(const FieldValue& value, Best& best) const {
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

inline std::size_t BestNumbers::IndexOf(std::string_view name) const {
  std::size_t f = 0;
  while (fields_[f].name != name) ++f;
  return f;
}

inline double BestNumbers::Number(std::string_view name) const {
  const std::size_t f = IndexOf(name);
  return fields_[f].use == Use::kLess ? best_[f].low : best_[f].high;
}

inline double BestNumbers::Low(std::string_view name) const { return best_[IndexOf(name)].low; }
inline double BestNumbers::High(std::string_view name) const { return best_[IndexOf(name)].high; }
inline const model::FlowElement& BestNumbers::Flow(std::string_view name) const {
  return best_[IndexOf(name)].flow;
}

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_BEST_H_
