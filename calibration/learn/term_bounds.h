// Whether the numbers of a learned term, the last effect of a fit, were found at all.
//
// One that ended at an end of what is searched, or whose interval is all that is searched, follows
// the readings and tells nothing. That a strength ended at 0 is its absence; that a number that
// only shapes a term is not fixed is no fault of the term; and of a curve some knots may lie where
// no reading is: it is not found where that is so of all.
#ifndef PLENUM_CALIBRATION_LEARN_TERM_BOUNDS_H_
#define PLENUM_CALIBRATION_LEARN_TERM_BOUNDS_H_

#include <cstddef>
#include <vector>

#include "calibration/fit/fit.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

// The coordinates of the term.
std::vector<std::size_t> NumbersOfTerm(const Fit& fit);

// The term with its intervals.
FittedEffect LearnedOf(const FitData& data, const Fit& fit, const FitOptions& options);

// By their ends alone.
bool IsWithin(const Fit& fit);
// By their intervals, too.
bool IsFound(const FitData& data, const Fit& fit, const FitOptions& options);

// A curve of the sensor is its offset and its gain, too: that it fits as well is no doubt of them.
bool OfOnePlace(const std::vector<model::Effect>& effects, const model::Effect& term);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_LEARN_TERM_BOUNDS_H_
