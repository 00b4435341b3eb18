// From a run and a model to what the sensors should have read, with exact derivatives.
//
// A model is the declared rig with a factor on each declared number (gauge pressures keep the
// ambient pressure as their zero, and move with it where it is another), a list of effects, the
// pressures and temperatures at which the runs began, by how much each run's clock lags behind the
// rig's — commands act that much later than recorded, and a compressor began that much later to
// fill its reservoir —, and what a learned term leaves to each run: the phase of what swings, and
// how late each stroke comes (model/effects/learned/learned.h). Where a tube's bore moves, its pair
// (C, b) and its volume move with it (model/flow/tube.h). A factor on C or b acts on the declared
// pairs, not on those that follow from a tube's size; b stays in [0, kCriticalRatioMax] and ε in
// ExpansionRange.
#ifndef PLENUM_CALIBRATION_FIT_FORWARD_H_
#define PLENUM_CALIBRATION_FIT_FORWARD_H_

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "calibration/fit/recorded/driving.h"
#include "calibration/values/dataset.h"
#include "calibration/values/model_state.h"
#include "model/effects/effect.h"
#include "model/simulate/simulate.h"

namespace plenum::calibration {

// At the run's sample times. Channels that the model does not give are empty: the source without a
// source, the inlet without a tube in the line.
struct Reading {
  std::vector<double> pressure_pa;  // of the sensor, absolute
  Channels channels;
};

struct Prediction {
  model::SimulateStatus status = model::SimulateStatus::kNotRun;
  std::string detail;                // for any status but kDone
  bool stiff = false;                // an implicit method was needed
  Reading reading;                   // as far as it came
  std::vector<Reading> derivatives;  // by parameter: ∂reading/∂number; empty where it is 0
};

struct PredictOptions {
  double relative_tolerance = 1e-6;
  std::function<bool()> cancelled = {};
  std::size_t steps_max = 200'000;
  bool recorded_alone = false;  // of the channels only those that the run itself has
  bool stiff = false;           // known to be: the implicit method from the start
};

// Holds what the runs of a data set need again and again: the records that drive their models,
// condensed to few points. The data set must outlive it. Calls may run side by side.
class ForwardModel {
 public:
  explicit ForwardModel(const Dataset& dataset);

  const Dataset& dataset() const { return *dataset_; }

  // The declared model: no effects, declared initial pressures, else the first reading; declared
  // initial temperatures, else the ambient's.
  ModelState Declared() const;

  // The rig of a run as the model has it, on the run's own clock shifted to start at 0.
  model::Rig RigOf(std::size_t run, const ModelState& state) const;

  Prediction Predict(std::size_t run, const ModelState& state,
                     std::span<const Parameter> parameters, const PredictOptions& options) const;

 private:
  const Dataset* dataset_;
  std::vector<DrivingRecords> driving_;  // by run
};

// Adds the derivative to the factor on an actuator's table of volumes, which the simulator does not
// give: a one-sided difference (measured.cc).
void AddTableSlopes(const ForwardModel& forward, std::size_t run, const ModelState& state,
                    std::span<const Parameter> parameters, const PredictOptions& options,
                    Prediction& prediction);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_FORWARD_H_
