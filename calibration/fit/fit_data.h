// What a fit is given: the observed runs and its options.
#ifndef PLENUM_CALIBRATION_FIT_FIT_DATA_H_
#define PLENUM_CALIBRATION_FIT_FIT_DATA_H_

#include <functional>
#include <optional>
#include <vector>

#include "calibration/fit/coordinates.h"
#include "calibration/fit/observations.h"

namespace plenum::calibration {

// What fits of one data set share. Values below must outlive it.
struct FitData {
  const ForwardModel* forward = nullptr;
  const std::vector<ObservedRun>* observed = nullptr;
  std::vector<std::size_t> runs;  // that the fit may see
  TypicalSizes sizes = {};
  bool clocks = false;  // the runs' clocks may be off by a part of a sample
};

// Several gauges of one recording count once.
inline bool IsOneRecording(const FitData& data) {
  return RecordingsOf(data.forward->dataset(), data.runs) == 1u;
}

struct FitOptions {
  double noise_share = 1e-2;         // integration error allowed, as a share of the noise
  double tolerance_loosest = 1e-5;   // and of the operating pressure
  double function_tolerance = 1e-6;  // relative change of χ² that ends the search
  int iterations_max = 40;
  std::size_t steps_max = 3'000;        // of one run's integration; beyond, a step is not taken
  bool nuisance_only = false;           // only what each run has of its own moves
  bool declared_stay = false;           // declared numbers with a prior stay where they start
  bool own_pairs = false;               // with nuisance_only: and the declared pairs (C, b)
  bool own_piece = false;               // with nuisance_only: and what each specimen has of its own
  std::optional<Parameter> fixed = {};  // stays where it starts
  double weight = 1.0;  // of Σ e² beside the priors, in the search for the optimum
  int threads = 1;
  std::function<bool()> cancelled;  // may be empty
};

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_FIT_DATA_H_
