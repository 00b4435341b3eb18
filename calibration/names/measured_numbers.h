// Whether the numbers of parts that runs measure may go into the catalogue.
//
// They may where the model that stands leaves noise alone (adequate, explained, or a tie, whose
// sets add what they disagree in to the deviations) and nothing else could have taken their place:
//   * what trades with it was declared with an uncertainty: the volume behind a conductance or a
//     pump's delivery, the conductance before a volume. One pressure alone fixes no more than their
//     ratio;
//   * no declared number is named as wrong, nor is one more than kFarSigmas of its standard
//     deviations off;
//   * at most kLeftOutShare of a run's readings were left out as wild or beyond the sensor's range.
// Of these numbers each may that is fixed by the readings to kMostUncertain of itself and is not
// where its search ends.
#ifndef PLENUM_CALIBRATION_NAMES_MEASURED_NUMBERS_H_
#define PLENUM_CALIBRATION_NAMES_MEASURED_NUMBERS_H_

#include <span>
#include <string>
#include <vector>

#include "calibration/search/contenders.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

inline constexpr double kMostUncertain = 0.25;
inline constexpr double kLeftOutShare = 0.05;

// Widens intervals and deviations of numbers by the most that a tied set is off the first one.
void WidenByTied(const Dataset& dataset, std::span<const Contender* const> tied,
                 std::vector<MeasuredEstimate>& measured);

// Every reason against all of them; empty: they may.
std::vector<std::string> WhyNoRevision(const Dataset& dataset, const Diagnosis& diagnosis);
// The reason against one of them, or "".
std::string WhyNotKept(const Dataset& dataset, const MeasuredEstimate& estimate);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NAMES_MEASURED_NUMBERS_H_
