// Whether names hold when the readings are others.
//
// What is named, and the sets that come nearest to it, are fitted again from their optima, without
// a new search, to changed readings: every second one, all runs but one, all readings shifted by
// kShiftShare of their range, and with noise of their own size added. Under a change the named sets
// hold while no set that is neither a part of one of them nor has one as its part is better by more
// than kTie than the best of them, of their parts (the base model is one), or than the best set
// that has one of them as its part: that they lose significance, as where the runs that show them
// are left out, or need company, is no failure. Under the shift every set may take it up as an
// offset of the sensor, free of charge: a zero that is a little off must not speak for the sets
// that happen to hold an offset.
#ifndef PLENUM_CALIBRATION_NAMES_STABILITY_H_
#define PLENUM_CALIBRATION_NAMES_STABILITY_H_

#include <span>
#include <vector>

#include "calibration/judge/errors.h"
#include "calibration/search/contenders.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

inline constexpr double kShiftShare = 1e-3;

struct Stability {
  std::vector<StabilityChange> changes;     // fewer when the time is over
  std::vector<const Contender*> beaten_by;  // the best set of each change that the names fail
  bool Holds() const;
};

// `named` are one set, or those of a tie; residuals are worth 1/memory of their number.
Stability StabilityOf(const Bench& bench, std::span<const Contender> contenders,
                      const std::vector<const Contender*>& named, double memory);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NAMES_STABILITY_H_
