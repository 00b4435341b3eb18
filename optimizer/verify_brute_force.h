// Every combination of the catalogue, one after the other, against an answer. Shares the model and
// no code with the search. Internal to verify*.cc.
#ifndef PLENUM_OPTIMIZER_VERIFY_BRUTE_FORCE_H_
#define PLENUM_OPTIMIZER_VERIFY_BRUTE_FORCE_H_

#include "optimizer/verify.h"

namespace plenum::optimizer {

// A combination that belongs on the list and is not there, a listed one that is not feasible or has
// another objective, and counts that cannot be are findings, under "brute_force".
BruteForceCounts CheckByBruteForce(const Problem& problem, const Answer& answer,
                                   const BruteForceOptions& options, Findings& findings);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_BRUTE_FORCE_H_
