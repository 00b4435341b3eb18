#include "calibration/experiment/test_precision.h"

#include <numeric>
#include <utility>

#include "calibration/fit/fit.h"

namespace plenum::calibration {
namespace {

constexpr double kNoiseShare = 1e-2;

// Every reading, each with the same white noise.
std::vector<ObservedRun> ObservedWith(const Dataset& dataset, double noise_pa) {
  std::vector<ObservedRun> observed(dataset.runs.size());
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const std::vector<double>& t_s = dataset.runs[i].t_s;
    ObservedSignal& pressure = observed[i].signals.emplace_back();
    pressure.samples.resize(t_s.size());
    std::iota(pressure.samples.begin(), pressure.samples.end(), std::size_t{0});
    pressure.steps = StepsOf(t_s, pressure.memory);
    pressure.sigma = noise_pa;
  }
  return observed;
}

// The readings that the model itself gives; false where it cannot be simulated.
bool TakeReadings(Dataset& dataset, const std::vector<model::Effect>& effects) {
  const ForwardModel forward(dataset);
  ModelState state = forward.Declared();
  state.effects = effects;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Prediction prediction = forward.Predict(i, state, {}, {});
    if (prediction.status != model::SimulateStatus::kDone) return false;
    dataset.runs[i].pressure_pa = prediction.reading.pressure_pa;
  }
  return true;
}

// At the declared numbers, which fit their own readings.
std::vector<MeasuredEstimate> Estimated(const FitData& data,
                                        const std::vector<model::Effect>& effects,
                                        bool declared_stay) {
  FitOptions options;
  options.noise_share = kNoiseShare;
  options.iterations_max = 1;
  options.declared_stay = declared_stay;
  ModelState state = data.forward->Declared();
  state.effects = effects;
  const Fit fit = FitModel(data, state, options);
  if (!fit.Usable()) return {};
  return MeasuredEstimates(data.forward->dataset(), fit, Covariance(data, fit, options));
}

}  // namespace

std::optional<TestPrecision> PrecisionOf(Dataset dataset, const std::vector<model::Effect>& effects,
                                         double noise_pa) {
  if (!TakeReadings(dataset, effects)) return {};
  const ForwardModel forward(dataset);
  const std::vector<ObservedRun> observed = ObservedWith(dataset, noise_pa);
  FitData data;
  data.forward = &forward;
  data.observed = &observed;
  data.runs.resize(dataset.runs.size());
  std::iota(data.runs.begin(), data.runs.end(), std::size_t{0});
  data.sizes = SizesOf(dataset);
  TestPrecision precision;
  precision.numbers = Estimated(data, effects, false);
  WidenByRoom(dataset, precision.numbers);
  for (const MeasuredEstimate& estimate : Estimated(data, effects, true))
    precision.from_noise.push_back(estimate.deviation);
  if (precision.numbers.empty() || precision.from_noise.size() != precision.numbers.size())
    return {};
  return precision;
}

}  // namespace plenum::calibration
