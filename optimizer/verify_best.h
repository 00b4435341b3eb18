// The best of each number over the choices of a slot in a box, as the table of the family says
// which is best. Internal to verify*.cc.
#ifndef PLENUM_OPTIMIZER_VERIFY_BEST_H_
#define PLENUM_OPTIMIZER_VERIFY_BEST_H_

#include <string_view>
#include <vector>

#include "optimizer/verify_tree.h"

namespace plenum::optimizer {

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

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_BEST_H_
