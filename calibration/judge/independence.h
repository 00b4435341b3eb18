// Whether a residual goes with the inputs: the test that counts for a simulated model, whose
// residual need not be white but must not depend on what was done to the rig.
//
// Each input u gives a few functions φ: normalised Legendre polynomials of its rank, or the
// indicator of a phase. Residual and functions pass the filter that turns the run's noise white
// (noise_memory.h), and
//   S = Σ φ̃_i·ẽ_i / √(Σ φ̃_i²·Σ ẽ_i²/n)
// is standard normal for a residual that is noise of that correlation, whatever the input looks
// like. The statistic is the largest |S|, the limit the normal quantile with the false-alarm rate
// shared among all functions (Bonferroni). Source: Ljung, System Identification (1999), 16.6; with
// the functions of the input instead of its lags, because the runs are transients.
#ifndef PLENUM_CALIBRATION_JUDGE_INDEPENDENCE_H_
#define PLENUM_CALIBRATION_JUDGE_INDEPENDENCE_H_

#include <functional>
#include <string>
#include <vector>

#include "calibration/noise/noise_memory.h"
#include "calibration/values/dataset.h"

namespace plenum::calibration {

// One run's residual with what the independence of it is judged by.
struct ResidualSeries {
  const Run* run = nullptr;
  std::vector<double> residual;  // in units of its noise; NaN where left out
  std::vector<double> model_pa;
  NoiseMemory memory;
};

struct InputCorrelation {
  std::string input;       // "mean", "pressure", "rate", "valve", "time", "since_command", "cycle"
  double statistic = 0.0;  // largest |S| of its functions
};

struct Independence {
  double statistic = 0.0, limit = 0.0;
  std::vector<InputCorrelation> inputs;  // largest first
};

// Without inputs where `cancelled` says that nobody wants to know.
Independence TestIndependence(const std::vector<ResidualSeries>& series,
                              const std::function<bool()>& cancelled = {});

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_INDEPENDENCE_H_
