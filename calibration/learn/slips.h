// Slips of the pen in a record, which would account for more than any missing physics: units,
// exchanged commands, exchanged runs.
//
// Of each run E = Σ(m − y)²/Σ(m² + y²), m the model exactly as declared, y the readings, both
// gauge: 0 where they agree, about 1 where they have nothing in common. A slip is suspected where E
// is above kAstray and undoing the slip leaves less than kUndone of it, in all such runs or in
// some.
#ifndef PLENUM_CALIBRATION_LEARN_SLIPS_H_
#define PLENUM_CALIBRATION_LEARN_SLIPS_H_

#include <functional>
#include <string>
#include <vector>

#include "calibration/values/dataset.h"

namespace plenum::calibration {

inline constexpr double kAstray = 0.05;
inline constexpr double kUndone = 0.1;

// One sentence each for Diagnosis::warnings: of the slips of single runs the likeliest, and runs
// whose readings seem to be exchanged. A few simulations of each run.
std::vector<std::string> SuspectedSlips(const Dataset& dataset,
                                        const std::function<bool()>& cancelled);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_LEARN_SLIPS_H_
