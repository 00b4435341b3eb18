// The source of a candidate, family by family.
#ifndef PLENUM_OPTIMIZER_EVALUATE_SOURCE_OPTIONS_H_
#define PLENUM_OPTIMIZER_EVALUATE_SOURCE_OPTIONS_H_

#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {

// Where a candidate keeps its choice of a family of the source; cylinders and CO2 bottles share
// one.
Option& OptionOf(Candidate& candidate, Family family);
const Option& OptionOf(const Candidate& candidate, Family family);

// Gas that one piece holds when it is full, kg; 0 but for bottles.
double ChargeKg(const Problem& problem, Family family, int part);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_SOURCE_OPTIONS_H_
