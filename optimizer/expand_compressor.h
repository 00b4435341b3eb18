// The two last families of the compressor configuration, whose choices share a source pressure.
#ifndef PLENUM_OPTIMIZER_EXPAND_COMPRESSOR_H_
#define PLENUM_OPTIMIZER_EXPAND_COMPRESSOR_H_

#include "optimizer/expand.h"

namespace plenum::optimizer {

// `amounts`: of all that the parent has chosen.
// Reservoirs behind a chosen compressor and lines: each interval of volumes has a least energy and
// so a lightest battery; a reservoir is bounded by the interval that its volume lies in.
void ExpandReservoirs(const Problem& problem, const Tree& tree, const Candidate& parent,
                      const StageInfo& info, const Amounts& amounts, Children& children);

// Batteries of the compressor configuration, the last family there.
void ExpandPumpBatteries(const Problem& problem, const Tree& tree, const Candidate& parent,
                         const Amounts& amounts, Children& children);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPAND_COMPRESSOR_H_
