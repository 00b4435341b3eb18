// Structure that no known effect accounts for: where it lives, and a term inside one equation that
// is learned from it.
//
// The effects established stay, and are fitted again together with each learned term in turn
// (model/effects/learned/learned.h): leak, line conductance, volume law, supply, valve or sensor.
// Where the established fit stretches the declared numbers beyond their uncertainties, these start
// as declared. Each family of terms is tried from coarse to fine, the curve on more knots from the
// one found on fewer; the finer one stays if the BIC says so. The families with the best BIC then
// compete on whole runs that the fit does not see: each run is left out once, the term is learned
// from the others, and the family with the least
//   Σ n·ln max(χ²/n, 1) + k·ln n   over the runs left out, n readings each,
// is the answer, if it beats the model without a term there; of those within kGain the one that
// fits better. With one run only, the BIC decides. A term one of whose numbers ended at an end of
// what is searched, or may be anything there, is not offered: it follows the readings and tells
// nothing.
// A run left out has its initial pressure, its clock, the phase of what swings and the times of
// late strokes from its own readings: k counts the last two, which the term brings. The error that
// is reported of held-out runs is got in the same way. What swings or sticks at random is predicted
// only as far as these numbers of a run are known.
// Sources: discrepancies inside equations keep the physics identifiable (Kennedy & O'Hagan 2001;
// Brynjarsdóttir & O'Hagan 2014); leave-one-out over runs.
//
// discrepancy_places.cc: where the residual lives.
#ifndef PLENUM_CALIBRATION_LEARN_DISCREPANCY_H_
#define PLENUM_CALIBRATION_LEARN_DISCREPANCY_H_

#include <algorithm>
#include <vector>

#include "calibration/fit/fit.h"
#include "calibration/values/diagnosis.h"
#include "calibration/values/effect_sets.h"

namespace plenum::calibration {

struct LearnedModel {
  Discrepancy discrepancy;
  Fit fit;  // of all fitted runs with the term; the established one without a term
};

// `established` is a usable fit of data.runs; `holdout` are runs that no fit sees, for the report
// alone: where there are none, the errors of the runs left out in turn take their place.
LearnedModel LearnDiscrepancy(const FitData& data, const Fit& established,
                              const std::vector<std::size_t>& holdout, const FitOptions& options);

// Whether the learned term is in the equation that all the effects are in: a leak that takes any
// course is a leak, and that it fits as well is no doubt of one.
inline bool HoldsAll(const Discrepancy& discrepancy, const EffectSet& effects) {
  return discrepancy.learned &&
         std::all_of(effects.begin(), effects.end(), [&](const model::EffectSpec* spec) {
           return spec->place == discrepancy.equation;
         });
}

// What one learned term beside the base model does in the place of a set of effects.
//
// Effects may be names for what is not in the list, one as well as several (a line that kinks
// passes for a bent volume law): they are not named where a term of fewer numbers, or any in the
// place of three effects, comes within kAccept of their score (thresholds.h), or where a term is
// better by as much. A term with as many numbers that does as well as two effects is no reason
// against them: whatever goes on slowly in the chamber can be said of a sensor that drifts. It is
// said beside them. A curve of the sensor holds all effects of the sensor and must be better than
// they by kAccept, whatever its numbers.
struct Rival {
  bool instead = false;                        // of the set
  const model::EffectSpec* as_good = nullptr;  // a term within kAccept of it, the best of them
};
Rival RivalOf(const FitData& data, const Fit& base, const Fit& set, const FitOptions& options);

// RMS of the pressure residual over all usable readings of the runs; NaN where a run fails.
double PressureRms(const FitData& data, const ModelState& state,
                   const std::vector<std::size_t>& runs, const FitOptions& options);

// The same of runs that no fit saw, after their own initial pressures and clocks are fitted.
double UnseenRms(const FitData& data, const ModelState& state, const std::vector<std::size_t>& runs,
                 const FitOptions& options);

// The shares of the residual's energy above the noise by phase, pressure, rate, time and cycle: for
// each the part that holds most of it, where that is more than its part of the readings.
std::vector<Discrepancy::Place> PlacesOf(const FitData& data, const ModelState& state,
                                         const FitOptions& options);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_LEARN_DISCREPANCY_H_
