// What this side can say of a closed box from the raw parts alone. Internal to verify*.cc.
#ifndef PLENUM_OPTIMIZER_VERIFY_CORNER_H_
#define PLENUM_OPTIMIZER_VERIFY_CORNER_H_

#include "optimizer/verify_tree.h"

namespace plenum::optimizer {

// Sum of the least objectives of the choices: every design in the box has at least this.
double LeastObjective(const Problem& problem, const ProofPlan& plan, const Ranges& ranges);

// No choices in the box fit together.
bool CannotMate(const Problem& problem, const ProofPlan& plan, const Ranges& ranges);

// The best corner of the box misses a requirement: pressures, the exact march of a line alone on an
// unlimited source (rise and fall), least amounts, gas, coil energy.
bool CannotWork(const Problem& problem, const ProofPlan& plan, const Ranges& ranges);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_VERIFY_CORNER_H_
