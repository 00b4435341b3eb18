// Laws that hold a narrower one as a limit: heat to a wall that warms is heat to one that stays as
// it is where the wall's capacity is endless.
//
// No data refute the wider law there. It is left out where it fits no better than the narrower one
// and each of its usual sizes is refuted: then the data would have shown it, and it says what the
// narrower law says with more numbers.
#ifndef PLENUM_CALIBRATION_JUDGE_WIDER_LAWS_H_
#define PLENUM_CALIBRATION_JUDGE_WIDER_LAWS_H_

#include "calibration/judge/errors.h"
#include "calibration/search/contenders.h"

namespace plenum::calibration {

// The effect of `wide` that widens one of `narrow`, which has the same beside it: in the same
// equation all its numbers, by name, and more. None where that is not so.
const model::EffectSpec* WiderIn(const EffectSet& wide, const EffectSet& narrow);

// Whether `wide` is `narrow` at the limit of a wider law alone: with residuals worth 1/memory of
// their number n, n·ln(χ²/n) + χ²_prior is no lower than kSameOptimum below that of `narrow`, and
// above it by more than kAccept wherever a further number has one of the sizes at which fits start.
bool StandsAtLimitAlone(const Bench& bench, const Contender& wide, const Contender& narrow,
                        double memory);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_WIDER_LAWS_H_
