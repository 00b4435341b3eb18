// What a run that is not yet made would be worth for telling fitted models apart, to first order
// (experiment.h has the equation).
#ifndef PLENUM_CALIBRATION_FIT_RUN_WORTH_H_
#define PLENUM_CALIBRATION_FIT_RUN_WORTH_H_

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/fit/fit.h"

namespace plenum::calibration {

struct TiedFit {
  std::vector<std::string> effects;  // as in Candidate
  const Fit* fit = nullptr;          // at its optimum
};

// A channel of a run and its name in the contract.
struct NamedChannel {
  std::vector<double> Channels::*values;
  const char* name;
};
std::span<const NamedChannel> NamedChannels();

// The data with one run more, which is the last. Without `readings` the other runs keep no samples:
// enough to simulate the added one.
struct ExtendedData {
  ExtendedData(const Dataset& data, const Run& added, bool readings);
  std::size_t run() const { return dataset.runs.size() - 1; }
  ModelState With(ModelState state) const;  // with the added run's initial pressure
  Dataset dataset;
};

// How a run would be observed: its pressure with the noise of `pattern`, then each channel that all
// of the readings have and any of them sees move. `names` are those of the signals in the contract.
ObservedRun WouldObserve(const ObservedRun& pattern, const Run& run,
                         std::span<const Prediction> predictions, std::vector<std::string>& names);

// H: the curvature of χ² over the data at hand, priors included; none where a simulation failed.
std::optional<Eigen::MatrixXd> Curvature(const FitData& data, const Fit& fit,
                                         const FitOptions& options);

struct PairWorth {
  std::size_t truth = 0, rival = 0;
  double delta_chi2 = 0.0;
};

struct RunWorth {
  std::vector<std::string> names;  // of the signals, the pressure first
  // By signal: Δχ² with it, the pressure and the channels that the data have, of every pair, the
  // least first.
  std::vector<std::vector<PairWorth>> pairs;
};

// `curvatures` by tied fit. None where a simulation failed.
std::optional<RunWorth> WorthOf(const FitData& data, std::span<const TiedFit> tied,
                                std::span<const Eigen::MatrixXd> curvatures, const Run& run,
                                const FitOptions& options);

// Whether a fitted run has that channel.
bool InData(const FitData& data, const std::string& name);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_RUN_WORTH_H_
