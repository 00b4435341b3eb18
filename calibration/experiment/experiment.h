// The run that would tell tied sets of effects apart.
//
// T-optimality with re-fitting (Atkinson & Fedorov, Biometrika 62 (1975) 57): if A is true, a
// proposed run shows A's prediction, and the rival B answers by moving its numbers as far as the
// runs at hand and the priors let it. To first order what is left is
//   Δχ² = min_δ |r − J·δ|² + δᵀ·H·δ = rᵀr − (Jᵀr)ᵀ(H + JᵀJ)⁻¹(Jᵀr),
// r the difference of the whitened predictions, J the rival's whitened Jacobian in the proposed
// run, H its curvature over all data so far with priors. A run is worth the least Δχ² over the
// pairs and over which of a pair is true. The best runs are then rehearsed: the rivals that come
// nearest are fitted in full to the data and the proposed run with A's readings in it, from where
// they are and from their usual starts. The least by which A is then ahead counts, with what it is
// ahead or behind by now. Bounds on parameters are not seen by the first order, which makes it err
// to the low side; other optima make it err to the high side. Where no run is decisive for all
// pairs, the one that parts most of them is taken: two sets may be all but one.
//
// Faster sampling is asked for only if the pressure (and the channels that the data have) does not
// decide as it was sampled, and a second channel only if that does not either. A channel's σ is 1 %
// of its range in the run, a temperature's at least 0.5 K, a volume's at least 1 % of what the
// actuator takes up.
#ifndef PLENUM_CALIBRATION_EXPERIMENT_EXPERIMENT_H_
#define PLENUM_CALIBRATION_EXPERIMENT_EXPERIMENT_H_

#include <optional>
#include <vector>

#include "calibration/fit/fit.h"
#include "calibration/fit/run_worth.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

// ΔBIC from which a run counts as decisive: three times what a diagnosis asks for to prefer a set,
// so that noise and wrong constants leave enough.
inline constexpr double kDecisiveDeltaBic = 30.0;

// The shortest run that reaches half of what the best one does, and is decisive if any is. Empty
// with fewer than two fits, where no run can be simulated, or when cancelled.
std::optional<Experiment> DesignExperiment(const FitData& data, const std::vector<TiedFit>& tied,
                                           const FitOptions& options);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_EXPERIMENT_EXPERIMENT_H_
