#include "calibration/fit/forward.h"

#include <algorithm>
#include <cmath>

#include "calibration/fit/recorded/gauge.h"
#include "calibration/fit/rig/direction.h"
#include "calibration/fit/rig/run_rig.h"
#include "calibration/values/crossing.h"
#include "calibration/values/specimens.h"
#include "model/simulate/sensitivity.h"

namespace plenum::calibration {
namespace {

// Less the shift of the ambient pressure: readings are gauge plus the declared one. Of several
// chambers those of the one with the gauge, and of the line of the first.
Reading ReadingOf(model::Response response, std::size_t gauge, double shift_pa) {
  Reading reading;
  if (response.groups.empty()) return reading;  // refused
  model::GroupResponse& group = response.groups[gauge];
  model::GroupResponse& valved = response.groups.front();
  reading.pressure_pa = std::move(group.reading_pa.empty() ? group.pressure_pa : group.reading_pa);
  for (double& pa : reading.pressure_pa) pa -= shift_pa;
  reading.channels = {.source_pressure_pa = std::move(response.source_pressure_pa),
                      .inlet_pressure_pa = std::move(valved.inlet_pressure_pa),
                      .temperature_k = std::move(group.temperature_k),
                      .volume_m3 = std::move(group.volume_m3),
                      .flow_m3_per_s = std::move(valved.flow_m3_per_s),
                      .valve_opening = {},
                      .source_setpoint_pa = {}};
  return reading;
}

// Without heat_transfer the gas has the ambient's temperature.
void FillTemperature(const Run& run, Reading& reading) {
  if (reading.channels.temperature_k.empty())
    reading.channels.temperature_k.assign(reading.pressure_pa.size(), run.ambient.temperature_k);
}

}  // namespace

ForwardModel::ForwardModel(const Dataset& dataset) : dataset_(&dataset) {
  for (const Run& run : dataset.runs) driving_.push_back(DrivingRecordsOf(run));
}

ModelState ForwardModel::Declared() const {
  ModelState state;
  for (const MeasuredNumber& number : dataset_->measured) state.measured.push_back(number.declared);
  for (const Run& run : dataset_->runs) {
    state.initial_pressure_pa.push_back(run.initial_pressure_pa.value_or(FirstReading(run)));
    state.initial_temperature_k.push_back(
        run.initial_temperature_k.value_or(run.ambient.temperature_k));
  }
  state.specimen_factor = DeclaredFactors(*dataset_);
  state.clock_s.assign(dataset_->runs.size(), 0.0);
  state.phase_rad.assign(dataset_->runs.size(), 0.0);
  state.late_s.resize(dataset_->runs.size());
  for (const Run& run : dataset_->runs)
    state.moved_s.emplace_back(run.valve_uncertainty_s.size(), 0.0);
  return state;
}

model::Rig ForwardModel::RigOf(std::size_t index, const ModelState& state) const {
  return RigOfRun(dataset_->runs[index], index, state, driving_[index]);
}

Prediction ForwardModel::Predict(std::size_t index, const ModelState& state,
                                 std::span<const Parameter> parameters,
                                 const PredictOptions& options) const {
  const Run& run = dataset_->runs[index];
  model::Rig rig = RigOf(index, state);
  model::SimulateOptions simulate;
  simulate.relative_tolerance = options.relative_tolerance;
  simulate.absolute_tolerance_pa = 1e4 * options.relative_tolerance;
  simulate.steps_max = options.steps_max;
  simulate.integrator = options.stiff ? model::Integrator::kImplicit : model::Integrator::kDamped;
  simulate.cancelled = options.cancelled;
  const bool all = !options.recorded_alone || RecordsMore(run.channels) || RecordsNode(run);
  simulate.record = all ? model::Record::kSamples : model::Record::kPressures;
  for (const double t_s : run.t_s) simulate.sample_times_s.push_back(t_s - StartOf(run));
  simulate.end_s = simulate.sample_times_s.back();

  std::vector<model::Direction> directions;
  std::vector<std::size_t> moved;  // parameter of each direction
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    model::Direction direction = DirectionOf(parameters[j], run, index, state, rig);
    if (direction.empty()) continue;
    directions.push_back(std::move(direction));
    moved.push_back(j);
  }
  model::SensitivityResponse result;
  if (!directions.empty()) result = model::SimulateAlongDirections(rig, simulate, directions);
  if (directions.empty()) result.response = model::Simulate(rig, simulate);
  Prediction prediction{
      result.response.status, result.response.detail, result.response.stiff, {}, {}};
  prediction.reading =
      ReadingOf(std::move(result.response), run.several.gauge, AmbientShift(run, state));
  FillTemperature(run, prediction.reading);
  prediction.derivatives.resize(parameters.size());
  for (std::size_t j = 0; j < result.derivatives.size(); ++j) {
    const bool ambient = parameters[moved[j]] == Parameter{.declared = Declared::kAmbientPressure};
    prediction.derivatives[moved[j]] =
        ReadingOf(std::move(result.derivatives[j]), run.several.gauge,
                  ambient ? run.ambient.pressure_pa : 0.0);
  }
  const auto slope = [&](std::size_t j) { return &prediction.derivatives[j].pressure_pa; };
  TakeGauge(run, state, parameters, slope, prediction.reading.pressure_pa);
  AddTableSlopes(*this, index, state, parameters, options, prediction);
  return prediction;
}

}  // namespace plenum::calibration
