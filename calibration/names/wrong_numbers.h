// Declared numbers that an explanation takes to be wrong.
//
// A set that holds a declared number frees it (effect_sets.h): without a prior it costs ln n of
// BIC, as an effect of one number does, and must gain as much as one to be named. Its deviation
// counts in standard deviations of what was declared, those of an exact number being
// kExactUncertainty.
#ifndef PLENUM_CALIBRATION_NAMES_WRONG_NUMBERS_H_
#define PLENUM_CALIBRATION_NAMES_WRONG_NUMBERS_H_

#include <span>
#include <string>
#include <vector>

#include "calibration/judge/errors.h"
#include "calibration/judge/evidence.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

// Those of the named set; `instead_of` is what would stand if all declared numbers were right.
std::vector<WrongNumber> WrongNumbersOf(const Dataset& dataset, const Contender& named,
                                        std::span<const Contender> contenders, double memory);

// One sentence for each declared number, and each of an effect, that ended at an end of what was
// searched, a strength of 0 apart, by which an effect is absent, or, with a prior, more than
// kFarSigmas of its standard deviations off.
inline constexpr double kFarSigmas = 3.0;
std::vector<std::string> FarNumbers(const Dataset& dataset, const Fit& fit);

// Warns of those, of numbers that the readings do not fix, and of a stop before the end.
void AddLimits(const Bench& bench, const Fit& shown, Diagnosis& diagnosis);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NAMES_WRONG_NUMBERS_H_
