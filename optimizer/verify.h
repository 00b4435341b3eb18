// Re-checks an answer from scratch: shares the model and the plain values with the search, and no
// code.
//
// Every listed design is put together again from the parts of its list and simulated to its
// periodic state. The record of the search, where the answer has one, is replayed: its boxes must
// divide all combinations, and each closed box must be refuted or bounded by what this room
// computes itself from the raw parts. What cannot be decided this way is named and counted.
#ifndef PLENUM_OPTIMIZER_VERIFY_H_
#define PLENUM_OPTIMIZER_VERIFY_H_

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "optimizer/big_count.h"
#include "optimizer/problem.h"

namespace plenum::optimizer {

// One thing that does not hold, under the name of its check.
struct Finding {
  std::string check;
  std::string detail;
};
using Findings = std::vector<Finding>;

struct Check {
  std::string name;
  bool ok = true;
  std::string detail;  // why not, for the first few findings; else what was checked
};

struct NotRechecked {
  std::string what;
  BigCount combinations;
};

struct BruteForceOptions {
  std::function<bool()> cancelled;                       // may be empty
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

struct Verification {
  std::vector<Check> checks;
  std::vector<NotRechecked> not_rechecked;
  std::optional<BruteForceCounts> brute_force;
};

// With `brute_force` every combination is looked at, too, CombinationsOf(problem) of them.
inline constexpr long long kBruteForceMax = 100'000'000;  // what is reasonable to ask for
BigCount CombinationsOf(const Problem& problem);
Verification Verify(const Problem& problem, const Answer& answer,
                    const BruteForceOptions* brute_force = nullptr);

// Of a front its points are checked, and that none is missing as far as verify_front.h looks.
struct Front;
Verification VerifyFront(const Problem& problem, const Front& front);

// Tolerances, relative. Sums of printed numbers (12 digits); times and duties of the simulator
// against those of the answer.
inline constexpr double kSumTolerance = 1e-9;
inline constexpr double kTimeTolerance = 1e-4;
inline constexpr double kEnergyTolerance = 1e-3;
inline constexpr double kTieTolerance = 1e-6;  // objectives this close go by part ids

inline bool Near(double a, double b, double relative) {
  return a == b || std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_H_
