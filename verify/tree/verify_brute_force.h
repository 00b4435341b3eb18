// Every combination of the catalogue, one after the other, against an answer. Shares the model and
// no code with the search.
#ifndef PLENUM_VERIFY_TREE_VERIFY_BRUTE_FORCE_H_
#define PLENUM_VERIFY_TREE_VERIFY_BRUTE_FORCE_H_

#include <functional>

#include "verify/design/verify_finding.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

struct BruteForceOptions {
  Stop stop;
  std::function<void(const BigCount& looked)> progress;  // now and then; may be empty
};

struct BruteForceCounts {
  bool cancelled = false;  // then the rest counts what was looked at
  BigCount combinations;   // those below together
  BigCount incompatible;   // parts that do not fit together
  BigCount unpriced;       // without a price where cost matters
  BigCount beyond;         // compatible, but they come to more than the last design whatever else
  BigCount infeasible;     // of the rest, sized one by one: no setting meets the requirements
  BigCount feasible;
  BigCount undecided;  // within 1e-6 of a requirement, or not sized
};

inline constexpr long long kBruteForceMax = 100'000'000;  // what is reasonable to ask for
BigCount CombinationsOf(const Problem& problem);

// A combination that belongs on the list and is not there, a listed one that is not feasible or has
// another objective, and counts that cannot be are findings, under "brute_force".
BruteForceCounts CheckByBruteForce(const Problem& problem, const Answer& answer,
                                   const BruteForceOptions& options, Findings& findings);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_TREE_VERIFY_BRUTE_FORCE_H_
