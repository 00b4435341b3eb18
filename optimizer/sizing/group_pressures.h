// The pressures behind regulators of their own (own_regulators.h).
//
// A group whose valve holds takes the same air at any pressure, and its coils are on for less time
// at a higher one; one whose valve cannot hold takes less air at a lower one, and its coils do not
// depend on it. What a bottle or a tank must keep is the highest pressure of all. So of all
// settings with the same highest pressure none is better than that with each holding group as near
// to it as its parts stand, and each other group at the least at which its strokes are in time:
// one number, the highest pressure, is left to be chosen.
#ifndef PLENUM_OPTIMIZER_SIZING_GROUP_PRESSURES_H_
#define PLENUM_OPTIMIZER_SIZING_GROUP_PRESSURES_H_

#include <optional>
#include <vector>

#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {

// Share by which the strokes of a group behind its own regulator are too slow at a pressure there;
// at most 0: they are in time. None where the simulator failed.
std::optional<double> GroupExcess(const Problem& problem, const Candidate& candidate, int group,
                                  double group_pa);

// Per group from the least pressure at which its strokes are in time, within 1e-9 of it, to the
// highest that its parts stand. kInfeasible: a group has none;
// kUndecided: the simulator failed.
struct GroupPressures {
  LeafStatus status = LeafStatus::kUndecided;
  std::vector<Window> windows;
  double least_pa() const;  // of the highest pressure of all groups
  double most_pa() const;
};
GroupPressures NeededGroupPressures(const Problem& problem, const Candidate& candidate);

// The settings described above with this highest pressure, and those with each group at such a
// share of the way through its window.
OperatingPoint PointAtHighest(const Candidate& candidate, const GroupPressures& pressures,
                              double highest_pa, double tank_m3);
OperatingPoint PointAtShare(const std::vector<Window>& windows, double share, double tank_m3);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SIZING_GROUP_PRESSURES_H_
