// A record that drives the model, such as that of a sensor at the source, as a course of few
// points.
//
// The curve is the continuous piecewise straight line nearest to all samples (least squares), with
// points where fewer would leave more than white noise of the given size: noise averages out, and
// steps and bends stay. Method: linear splines by least squares, refined at the largest cumulative
// sum of the residual.
#ifndef PLENUM_CALIBRATION_FIT_SOURCE_RECORD_H_
#define PLENUM_CALIBRATION_FIT_SOURCE_RECORD_H_

#include <span>

#include "model/simulate/told/time_course.h"

namespace plenum::calibration {

// `t_s` must not fall; samples of one instant count together and missing ones (NaN) not at all.
// Without points if every sample is missing. `noise` is one standard deviation; 0 keeps every
// sample that is not on a straight line.
model::TimeCourse CondenseRecord(std::span<const double> t_s, std::span<const double> value,
                                 double noise);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_SOURCE_RECORD_H_
