// Re-checks an answer from scratch: shares the model and the plain values with the search, and no
// code.
//
// Every listed design is put together again from the parts of its list and simulated to its
// periodic state. The record of the search, where the answer has one, is replayed: its boxes must
// divide all combinations, and each closed box must be refuted or bounded by what this room
// computes itself from the raw parts. What cannot be decided this way is named and counted.
#ifndef PLENUM_VERIFY_VERIFY_H_
#define PLENUM_VERIFY_VERIFY_H_

#include <optional>
#include <vector>

#include "verify/design/verify_finding.h"
#include "verify/design/verify_values.h"
#include "verify/tree/verify_brute_force.h"

namespace plenum::verify {

struct Verification {
  std::vector<Check> checks;
  std::vector<NotRechecked> not_rechecked;
  std::optional<BruteForceCounts> brute_force;
};

struct VerifyOptions {
  Stop stop;
  // Whether every combination is looked at, too, CombinationsOf(problem) of them
  // (verify_brute_force.h).
  bool brute_force = false;
  std::function<void(const BigCount& looked)> progress;  // of these, now and then; may be empty
};
Verification Verify(const Problem& problem, const Answer& answer,
                    const VerifyOptions& options = {});

// Of a front its points are checked, and that none is missing as far as verify_front.h looks.
Verification VerifyFront(const Problem& problem, const Front& front, const Stop& stop = {});

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_VERIFY_H_
