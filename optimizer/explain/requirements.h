// The requirements of a problem that can be loosened or tightened, one number each.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_REQUIREMENTS_H_
#define PLENUM_OPTIMIZER_EXPLAIN_REQUIREMENTS_H_

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

struct Requirement {
  std::string pointer;
  double required;                            // in the units of the field
  double loosest;                             // at this it no longer binds
  std::function<void(Problem&, double)> set;  // to a value in those units
  // For mass, volume and cost: the objective that finds the best at once.
  std::optional<Objective> objective;
  bool whole = false;  // a number of something of which at least so many are required
};

// The groups that have their requirements in common with one: the sides of a double-acting cylinder
// (ActuatorGroup::entry).
std::vector<std::size_t> GroupsOfEntry(const Problem& problem, std::size_t group);

// Rise and fall times, limits on mass, volume and cost, actuations, frequency, source pressure:
// those that the problem has.
std::vector<Requirement> Requirements(const Problem& problem);

// The value that is easier (share > 0) or harder (share < 0) by a share of the required one. Of
// pressures under vacuum, which are below 0, the sizes count.
inline double Loosened(const Requirement& requirement, double share) {
  const bool more_is_easier = std::abs(requirement.loosest) > std::abs(requirement.required);
  return requirement.required * (more_is_easier ? 1.0 + share : 1.0 - share);
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_REQUIREMENTS_H_
