// What a check of an answer finds, and how near two numbers must be to count as equal.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_FINDING_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_FINDING_H_

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "verify/design/verify_values.h"

namespace plenum::verify {

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

// Tolerances, relative. Sums of printed numbers (12 digits); times and duties of the simulator
// against those of the answer.
inline constexpr double kSumTolerance = 1e-9;
inline constexpr double kTimeTolerance = 1e-4;
inline constexpr double kEnergyTolerance = 1e-3;
inline constexpr double kPeakTolerance = 1e-7;  // of pressures while valves close
inline constexpr double kSettled = 0.5;  // of a tie, that settings may cost which it leaves free
inline constexpr double kTieTolerance = 1e-6;  // objectives this close are ties (verify_ids.h)

inline bool Near(double a, double b, double relative) {
  return a == b || std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_FINDING_H_
