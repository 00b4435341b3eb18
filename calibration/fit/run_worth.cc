#include "calibration/fit/run_worth.h"

#include <algorithm>
#include <cmath>

#include "calibration/values/symmetric.h"

namespace plenum::calibration {
namespace {

constexpr double kTemperatureErrorK = 0.5;
constexpr double kLeastCurvature = 1e-10;  // of the largest

constexpr NamedChannel kChannels[] = {{&Channels::source_pressure_pa, "source_pressure_kpa_gauge"},
                                      {&Channels::flow_m3_per_s, "flow_l_per_min_anr"},
                                      {&Channels::temperature_k, "temperature_k"},
                                      {&Channels::volume_m3, "volume_ml"},
                                      {&Channels::inlet_pressure_pa, "inlet_pressure_kpa_gauge"}};

std::vector<Parameter> ParametersOf(const Fit& fit) {
  std::vector<Parameter> parameters;
  for (const Coordinate& coordinate : fit.coordinates) parameters.push_back(coordinate.parameter);
  return parameters;
}

PredictOptions OptionsOf(const FitOptions& options) {
  PredictOptions predict;
  predict.cancelled = options.cancelled;
  return predict;
}

// d(whitened readings)/du of a run, by rows of the observed signals.
Eigen::MatrixXd Jacobian(const Prediction& prediction, const ObservedRun& observed,
                         const Fit& fit) {
  const auto size = static_cast<Eigen::Index>(fit.coordinates.size());
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(observed.rows()), size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const auto k = static_cast<std::size_t>(j);
    Whitened(observed, prediction.derivatives[k], {}, {jacobian.col(j).data(), observed.rows()});
    jacobian.col(j) *= fit.coordinates[k].Slope(fit.u[j]);
  }
  return jacobian;
}

double RangeOf(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

// Of a sensor that is right for the rig: a volume that all but stands still is not read finer.
double FullScale(const Run& run, std::vector<double> Channels::*channel, double range) {
  if (channel != &Channels::volume_m3) return range;
  return std::max(range, run.chamber.rest_volume_m3 * std::abs(run.chamber.expansion_ratio - 1.0));
}

// A signal's share of Δχ²: rᵀr, Jᵀr, JᵀJ. Signals add.
struct Pieces {
  double rr = 0.0;
  Eigen::VectorXd jr;
  Eigen::MatrixXd jj;
};

double Left(const std::vector<Pieces>& pieces, const Eigen::MatrixXd& curvature,
            const std::vector<std::size_t>& signals) {
  Eigen::MatrixXd sum = curvature;
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(curvature.rows());
  double rest = 0.0;
  for (const std::size_t s : signals) {
    rest += pieces[s].rr;
    pull += pieces[s].jr;
    sum += pieces[s].jj;
  }
  if (sum.rows() == 0) return rest;
  sum.diagonal().array() += kLeastCurvature * std::max(sum.diagonal().maxCoeff(), 1.0);
  return std::max(0.0, rest - pull.dot(SolvedSymmetric(sum, pull)));
}

}  // namespace

std::span<const NamedChannel> NamedChannels() { return kChannels; }

bool InData(const FitData& data, const std::string& name) {
  for (const NamedChannel& channel : kChannels)
    if (name == channel.name)
      return std::any_of(data.runs.begin(), data.runs.end(), [&](std::size_t i) {
        return !(data.forward->dataset().runs[i].channels.*channel.values).empty();
      });
  return false;
}

ExtendedData::ExtendedData(const Dataset& data, const Run& added, bool readings) {
  if (readings) {
    dataset = data;
  } else {
    dataset.runs.resize(data.runs.size());
  }
  dataset.runs.push_back(added);
}

ModelState ExtendedData::With(ModelState state) const {
  const Run& added = dataset.runs.back();
  state.initial_pressure_pa.push_back(
      added.initial_pressure_pa.value_or(added.ambient.pressure_pa));
  state.initial_temperature_k.push_back(
      added.initial_temperature_k.value_or(added.ambient.temperature_k));
  state.clock_s.push_back(0.0);
  state.phase_rad.push_back(0.0);
  state.late_s.emplace_back();
  state.moved_s.emplace_back(added.valve_uncertainty_s.size(), 0.0);
  return state;
}

ObservedRun WouldObserve(const ObservedRun& pattern, const Run& run,
                         std::span<const Prediction> predictions, std::vector<std::string>& names) {
  ObservedRun observed;
  observed.noise = pattern.noise;
  ObservedSignal pressure;
  pressure.sigma = pattern.signals.front().sigma;
  for (std::size_t i = 0; i < run.t_s.size(); ++i) pressure.samples.push_back(i);
  pressure.steps = StepsOf(run.t_s, pattern.noise.memory);
  observed.signals = {pressure};
  names = {"pressure_kpa_gauge"};
  for (const NamedChannel& channel : kChannels) {
    double range = 0.0;
    bool given = true;
    for (const Prediction& prediction : predictions) {
      const std::vector<double>& values = prediction.reading.channels.*channel.values;
      given = given && !values.empty();
      if (!values.empty()) range = std::max(range, RangeOf(values));
    }
    if (!given || !(range > 0.0)) continue;
    ObservedSignal signal = pressure;
    signal.channel = channel.values;
    signal.steps.assign(run.t_s.size(), {});
    signal.sigma = kChannelAccuracy * FullScale(run, channel.values, range);
    if (channel.values == &Channels::temperature_k)
      signal.sigma = std::max(signal.sigma, kTemperatureErrorK);
    if (channel.values == &Channels::source_pressure_pa ||
        channel.values == &Channels::inlet_pressure_pa)
      signal.sigma = std::max(signal.sigma, pressure.sigma);
    observed.signals.push_back(std::move(signal));
    names.emplace_back(channel.name);
  }
  return observed;
}

std::optional<Eigen::MatrixXd> Curvature(const FitData& data, const Fit& fit,
                                         const FitOptions& options) {
  const auto size = static_cast<Eigen::Index>(fit.coordinates.size());
  Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index j = 0; j < size; ++j)
    if (fit.coordinates[static_cast<std::size_t>(j)].prior) curvature(j, j) = 1.0;
  const std::vector<Parameter> parameters = ParametersOf(fit);
  for (const std::size_t run : data.runs) {
    const Prediction prediction =
        data.forward->Predict(run, fit.state, parameters, OptionsOf(options));
    if (prediction.status != model::SimulateStatus::kDone) return {};
    const Eigen::MatrixXd jacobian = Jacobian(prediction, (*data.observed)[run], fit);
    curvature += jacobian.transpose() * jacobian;
  }
  return curvature;
}

std::optional<RunWorth> WorthOf(const FitData& data, std::span<const TiedFit> tied,
                                std::span<const Eigen::MatrixXd> curvatures, const Run& run,
                                const FitOptions& options) {
  const ExtendedData extended(data.forward->dataset(), run, false);
  const ForwardModel forward(extended.dataset);
  std::vector<Prediction> predictions;
  for (const TiedFit& one : tied) {
    predictions.push_back(forward.Predict(extended.run(), extended.With(one.fit->state),
                                          ParametersOf(*one.fit), OptionsOf(options)));
    if (predictions.back().status != model::SimulateStatus::kDone) return {};
  }
  RunWorth worth;
  const ObservedRun observed =
      WouldObserve((*data.observed)[data.runs.front()], run, predictions, worth.names);
  const std::size_t count = observed.signals.size();
  const auto samples = static_cast<Eigen::Index>(run.t_s.size());
  std::vector<Eigen::VectorXd> readings;
  std::vector<Eigen::MatrixXd> jacobians;
  for (std::size_t m = 0; m < tied.size(); ++m) {
    readings.emplace_back(static_cast<Eigen::Index>(observed.rows()));
    Whitened(observed, predictions[m].reading, {}, {readings.back().data(), observed.rows()});
    jacobians.push_back(Jacobian(predictions[m], observed, *tied[m].fit));
  }
  std::vector<std::size_t> always = {0};
  for (std::size_t s = 1; s < count; ++s)
    if (InData(data, worth.names[s])) always.push_back(s);
  worth.pairs.resize(count);
  for (std::size_t truth = 0; truth < tied.size(); ++truth) {
    for (std::size_t rival = 0; rival < tied.size(); ++rival) {
      if (truth == rival) continue;
      const Eigen::VectorXd r = readings[truth] - readings[rival];
      std::vector<Pieces> pieces;
      for (Eigen::Index s = 0; s < static_cast<Eigen::Index>(count); ++s) {
        const auto part = r.segment(s * samples, samples);
        const auto j = jacobians[rival].middleRows(s * samples, samples);
        pieces.push_back({part.squaredNorm(), j.transpose() * part, j.transpose() * j});
      }
      for (std::size_t s = 0; s < count; ++s) {
        std::vector<std::size_t> signals = always;
        if (std::find(always.begin(), always.end(), s) == always.end()) signals.push_back(s);
        worth.pairs[s].push_back({truth, rival, Left(pieces, curvatures[rival], signals)});
      }
    }
  }
  for (std::vector<PairWorth>& pairs : worth.pairs)
    std::stable_sort(pairs.begin(), pairs.end(), [](const PairWorth& a, const PairWorth& b) {
      return a.delta_chi2 < b.delta_chi2;
    });
  return worth;
}

}  // namespace plenum::calibration
