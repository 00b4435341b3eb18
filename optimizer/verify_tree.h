// The record of a search, replayed. Internal to verify*.cc.
#ifndef PLENUM_OPTIMIZER_VERIFY_TREE_H_
#define PLENUM_OPTIMIZER_VERIFY_TREE_H_

#include <utility>
#include <vector>

#include "optimizer/families.h"
#include "optimizer/verify.h"

namespace plenum::optimizer {

using Ranges = std::vector<std::pair<int, int>>;  // of choices per slot, half-open

struct ClosedBox {
  ProofBox end;
  Ranges ranges;
};

// The closed boxes of a plan. A tree that does not divide the choices, with every box closed
// exactly once, is a finding.
std::vector<ClosedBox> Replay(const ProofPlan& plan, Findings& findings);

BigCount CountOf(const Ranges& ranges);

// What a slot can be filled with: every part in every number, priced ones alone where cost matters.
std::vector<ProofItem> EntriesOf(const Problem& problem, const ProofSlot& slot);

// A plan of a configuration with a slot for each family that it needs, without choices: of each
// group, then of the source.
ProofPlan EmptyPlan(const Problem& problem, Configuration configuration);

// By the contract: of one configuration, from the catalogue alone.
BigCount Combinations(const Problem& problem, Configuration configuration);

// Whether choices, dominated and unpriced ones make up each family, and dominators dominate by the
// rule of proof.h. Adds to the counts.
void CheckSlots(const Problem& problem, const ProofPlan& plan, Pruned& counts, Findings& findings);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_TREE_H_
