// Where fits of an effect that rings are to start.
//
// A line rings at ω = a/L and keeps its phase over many periods, so that χ² has an optimum at every
// length at which model and readings ring in step: a few percent apart, and a fit ends in the
// nearest. Lengths and bores are therefore tried on a grid beside a fit without the line, each with
// that fit's numbers at their best to first order,
//   χ²(θ) = |e|² − gᵀ·(JᵀJ)⁻¹·g,  g = Jᵀe,
// e the whitened residuals with the line θ, J their derivatives without it, both with the priors.
// The grid: lengths from kShortest to kLongest, and the tubes as declared; the whole of it on
// some of the runs, and what does best there on all. Beside several effects it is coarser.
#ifndef PLENUM_CALIBRATION_FIT_START_SCAN_H_
#define PLENUM_CALIBRATION_FIT_START_SCAN_H_

#include <vector>

#include "calibration/fit/fit.h"

namespace plenum::calibration {

// Of an effect that rings the best few points of its grid, apart by more than neighbours are, that
// explain about as much as the best of them does; of any other, and where neither can be
// simulated, its usual starts.
std::vector<model::Effect> ScannedStarts(const FitData& data, const Fit& without,
                                         const model::EffectSpec& spec, const FitOptions& options);

// Of a fit with an effect that rings, from where to fit again: its state with other lengths, up to
// kAbout times longer and shorter with bores about its own, and all of the grid with the bores that
// keep the volume of its gas, which strokes fix whatever the length. Beside numbers that were
// fitted without the line the best length may rank low; beside those that were fitted with one near
// it, or of its volume, it does not. Empty where no effect of the fit rings.
std::vector<ModelState> ScannedAgain(const FitData& data, const Fit& with,
                                     const FitOptions& options);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_START_SCAN_H_
