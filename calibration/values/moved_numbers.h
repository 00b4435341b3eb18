// The numbers of a run's rig that a measured number moves.
#ifndef PLENUM_CALIBRATION_VALUES_MOVED_NUMBERS_H_
#define PLENUM_CALIBRATION_VALUES_MOVED_NUMBERS_H_

#include <cstddef>
#include <vector>

#include "calibration/values/dataset.h"

namespace plenum::calibration {

// As many per unit of `number` of Dataset::measured, as addresses in the rig: what a pump's
// delivery falls by behind a point moves that point of its table and all before it.
std::vector<const double*> NumbersMovedBy(const Run& run, std::size_t number, model::Rig& rig);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_MOVED_NUMBERS_H_
