// Numbers of parts that runs measure (dataset.h), in the rig of a run.
#ifndef PLENUM_CALIBRATION_VALUES_MEASURED_PLACE_H_
#define PLENUM_CALIBRATION_VALUES_MEASURED_PLACE_H_

#include <span>
#include <vector>

#include "calibration/values/dataset.h"

namespace plenum::calibration {

// The number at a place of a rig of one group with the run's line.
double& NumberAt(model::Rig& rig, const MeasuredPlace& place);

// A pump's delivery, m³/s ANR, at the points of its table: of the falls from each to the next.
std::vector<double> DeliveryOfFalls(std::span<const double> falls);

// The numbers by Dataset::measured, with a pump's delivery at each point in place of its falls.
std::vector<double> ValuesOf(const Dataset& dataset, const std::vector<double>& measured);

// Puts the measured numbers of a model, by Dataset::measured, into the rig of a run.
void PutMeasured(const Run& run, const std::vector<double>& measured, model::Rig& rig);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_VALUES_MEASURED_PLACE_H_
