// Warnings of what a record holds and how it was read.
#ifndef PLENUM_CALIBRATION_NAMES_RECORD_WARNINGS_H_
#define PLENUM_CALIBRATION_NAMES_RECORD_WARNINGS_H_

#include "calibration/judge/errors.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

// On readings and clocks, and on what the found effects are hard to tell from. Wild readings are
// told by run and time, with the error of all readings beside the stated one.
void AddWarnings(const Bench& bench, Diagnosis& diagnosis);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NAMES_RECORD_WARNINGS_H_
