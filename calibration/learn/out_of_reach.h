// Readings that nothing in the rig as it is declared could come to.
#ifndef PLENUM_CALIBRATION_LEARN_OUT_OF_REACH_H_
#define PLENUM_CALIBRATION_LEARN_OUT_OF_REACH_H_

#include <string>
#include <vector>

#include "calibration/values/dataset.h"

namespace plenum::calibration {

// One sentence for each run that falls below the lowest of its first reading, its ambient, its
// source and what its line opens into, by more than kBelow of the operating pressure in at least
// kReadingsBelow readings. What is said to help is a declaration that the record lacks, not an
// effect. Not of a run whose volume is imposed, which may suck.
inline constexpr double kBelow = 0.05;
inline constexpr int kReadingsBelow = 3;
std::vector<std::string> OutOfReach(const Dataset& dataset);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_LEARN_OUT_OF_REACH_H_
