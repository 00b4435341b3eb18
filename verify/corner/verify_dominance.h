// The rule of proof.h by which one choice makes another superfluous. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_DOMINANCE_H_
#define PLENUM_VERIFY_CORNER_VERIFY_DOMINANCE_H_

#include "verify/design/verify_values.h"

namespace plenum::verify {

bool Dominates(const Problem& problem, const ProofPlan& plan, const ProofSlot& slot,
               const ProofItem& better, const ProofItem& worse);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_DOMINANCE_H_
