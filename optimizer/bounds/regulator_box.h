// The regulators of a box: one for all groups, or one of each (own_regulators.h).
#ifndef PLENUM_OPTIMIZER_BOUNDS_REGULATOR_BOX_H_
#define PLENUM_OPTIMIZER_BOUNDS_REGULATOR_BOX_H_

#include "optimizer/bounds/box.h"

namespace plenum::optimizer {

// The corner of the regulators that a group may have.
const RegulatorCorner& RegulatorAt(const Plan& plan, const Box& box, int group);

// All of them together: their share of the objective, what they ask in front of them and stand
// there, and their power, at least.
struct Inlet {
  double objective = 0.0, min_pa = 0.0, max_pa = kUnlimited, electrical_power_w = 0.0;
  bool some_none = false, all_none = false;  // of a tank
};
Inlet InletOf(const Plan& plan, const Box& box);
// Whether mains or a bottle of CO2 have what they ask and stand; of other sources it is not known.
bool InletsSuit(const Problem& problem, const Plan& plan, const Box& box);

// Pressures at the lines of a group that all of the box may have: of the source, or behind the
// group's own regulator.
Window WindowAt(const Problem& problem, const Plan& plan, const Box& box, int group);

// The box's window of all lines narrowed by what regulators and mains give; with regulators of
// their own that of the highest of the groups' pressures. False: no pressure suits all parts.
bool NarrowWindow(const Problem& problem, const Plan& plan, Box& box);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_REGULATOR_BOX_H_
