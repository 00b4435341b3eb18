// Frequencies at which a residual swings, to start fits of swinging terms from
// (model/effects/learned/learned.h).
//
// By least squares of each run's residual on the two quadratures of a template, frequency by
// frequency; the gains of all runs add, since each has a phase of its own. Of a sensor that swings
// the template is e^(iωt). Of a source it is the response y of the pressure to p_s·e^(iωt): while a
// valve stays as it is, a small change goes on in proportion to the model's own rate, so that from
// sample to sample
//   y' = κ·y + (D' − κ·D)·e^(iωt),  κ = ṗ'/ṗ,  D = p_s·∂p/∂p_s,
// D of a source that is higher throughout; κ = 1 in a hold. Source: periodogram by least squares
// (Lomb, Astrophys. Space Sci. 39 (1976) 447).
#ifndef PLENUM_CALIBRATION_FIT_TONES_H_
#define PLENUM_CALIBRATION_FIT_TONES_H_

#include <vector>

#include "calibration/fit/fit.h"

namespace plenum::calibration {

enum class Swinging { kSupply, kSensor };

struct Tone {
  double frequency_hz = 0.0;
  double amplitude = 0.0;         // of a supply a share, of a sensor Pa; the runs' RMS
  std::vector<double> phase_rad;  // by run of the data set; 0 where not fitted
};

// At most `count`, the strongest first; none where the model cannot be run.
std::vector<Tone> TonesOf(const FitData& data, const ModelState& state, Swinging what,
                          std::size_t count, const FitOptions& options);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_TONES_H_
