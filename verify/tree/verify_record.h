// The record of a search against the answer. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_TREE_VERIFY_RECORD_H_
#define PLENUM_VERIFY_TREE_VERIFY_RECORD_H_

#include "verify/design/verify_finding.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Whether dominance may compare only equal flows (proof.h).
bool FlowMustBeEqual(const Problem& problem, const Layout& layout);

// Replays the boxes of an answer that has a record, recounts them, looks at each closed one again,
// and finds the box of each listed design.
void CheckRecord(const Problem& problem, const Answer& answer, const Stop& stop, Findings& findings,
                 std::vector<NotRechecked>& open);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_TREE_VERIFY_RECORD_H_
