// Models of a data set's runs with every number that their curves follow from, and how far those
// curves are from the readings.
#ifndef PLENUM_CALIBRATION_JUDGE_STATED_H_
#define PLENUM_CALIBRATION_JUDGE_STATED_H_

#include <vector>

#include "calibration/judge/errors.h"
#include "calibration/values/model_state.h"

namespace plenum::calibration {

// The state, with what each run held out has of its own fitted to that run (fit.h, Aligned).
StatedModel Stated(const Bench& bench, const ModelState& state);

// Of all runs.
ErrorReport ErrorOf(const Bench& bench, const StatedModel& model);

// The model as declared with its error, and how errors are got; until something is fitted `before`
// and `after` are the same.
void StateDeclared(const Bench& bench, Diagnosis& diagnosis);

// `before` and `after`, which may be one fit, with their errors.
void StateModels(const Bench& bench, const Fit& before, const Fit& after, Diagnosis& diagnosis);

// The fit with the learned term of the diagnosis' discrepancy, its error and its numbers.
void StateLearned(const Bench& bench, const Fit& fit, Diagnosis& diagnosis);

// A learned term that predicts runs which no fit saw worse than `after` does is no gain: the answer
// does without it and says so.
void WithdrawLearned(Diagnosis& diagnosis);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_STATED_H_
