// The record of a search, replayed. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_TREE_VERIFY_TREE_H_
#define PLENUM_VERIFY_TREE_VERIFY_TREE_H_

#include <vector>

#include "verify/corner/verify_ranges.h"
#include "verify/design/verify_finding.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

struct ClosedBox {
  ProofBox end;
  Ranges ranges;
};

// The closed boxes of a plan. A tree that does not divide the choices, with every box closed
// exactly once, is a finding.
std::vector<ClosedBox> Replay(const ProofPlan& plan, Findings& findings);

BigCount CountOf(const Ranges& ranges);

// Whether choices, dominated and unpriced ones make up each family, and dominators dominate by the
// rule of proof.h. Adds to the counts.
void CheckSlots(const Problem& problem, const ProofPlan& plan, Pruned& counts, Findings& findings);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_TREE_VERIFY_TREE_H_
