#include "calibration/fit/run_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/values/effect_sets.h"
#include "calibration/values/parallel.h"
#include "calibration/values/symmetric.h"

namespace plenum::calibration {
namespace {

constexpr double kToleranceTightest = 1e-9;
// By how much more derivatives may be off, and those of what rings, up to a share of the operating
// pressure.
constexpr double kLooser = 30.0, kRingingLooser = 10.0, kLoosest = 1e-3;

double LooserOf(const ModelState& state) {
  const bool rings = std::any_of(state.effects.begin(), state.effects.end(),
                                 [](const model::Effect& effect) { return Rings(*effect.spec); });
  return rings ? kRingingLooser : kLooser;
}

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const Eigen::VectorXd> Column(const std::vector<std::vector<double>>& columns,
                                         Eigen::Index j) {
  const std::vector<double>& column = columns[static_cast<std::size_t>(j)];
  return {column.data(), static_cast<Eigen::Index>(column.size())};
}

// Infinite of none.
double Norm(const std::vector<double>& e) {
  if (e.empty()) return std::numeric_limits<double>::infinity();
  return Eigen::Map<const Eigen::VectorXd>(e.data(), static_cast<Eigen::Index>(e.size())).norm();
}

}  // namespace

PredictOptions OptionsOf(const FitData& data, std::size_t run, const FitOptions& options) {
  const ObservedSignal& pressure = (*data.observed)[run].signals.front();
  const double size_pa = data.forward->dataset().runs[run].chamber.operating_pressure_pa;
  PredictOptions predict;
  predict.relative_tolerance = std::clamp(options.noise_share * pressure.sigma / size_pa,
                                          kToleranceTightest, options.tolerance_loosest);
  predict.steps_max = options.steps_max;
  predict.cancelled = options.cancelled;
  predict.recorded_alone = true;
  return predict;
}

ModelState StateAt(const ModelState& start, const std::vector<Coordinate>& coordinates,
                   const double* u) {
  ModelState state = start;
  for (std::size_t j = 0; j < coordinates.size(); ++j) {
    double& number = NumberOf(state, coordinates[j].parameter);
    number = coordinates[j].Number(u[j]);
    if (coordinates[j].parameter.kind != Parameter::Kind::kEffect) continue;
    const Parameter& parameter = coordinates[j].parameter;
    const model::ParameterSpec& spec =
        state.effects[parameter.effect].spec->parameters[parameter.number];
    number = std::clamp(number, spec.low, spec.high);
  }
  return state;
}

RunCost::RunCost(const FitData& data, std::size_t run, const ModelState& start,
                 const std::vector<Coordinate>& coordinates, const PredictOptions& options,
                 double weight, const StepsLeft* steps)
    : data_(data),
      run_(run),
      start_(start),
      coordinates_(coordinates),
      steps_(steps),
      options_(options),
      scale_(std::sqrt(weight)) {
  for (const Coordinate& coordinate : coordinates) parameters_.push_back(coordinate.parameter);
  mutable_parameter_block_sizes()->push_back(static_cast<int>(coordinates.size()));
  set_num_residuals(static_cast<int>(coordinates.size()) + 1);
}

void RunCost::Prepare(const double* at, bool derive) const {
  const Eigen::Map<const Eigen::VectorXd> u(at, size());
  if (root_.At(u)) return;
  const bool unused = steps_ && steps_->Last() && root_.value.size() > 0;
  if (!residuals_.At(u)) residuals_ = {u, ResidualsAt(at)};
  if (derive && !unused) root_ = {u, RootAt(at)};
}

bool RunCost::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  const bool derive = jacobians && jacobians[0];
  Prepare(blocks[0], derive);
  Eigen::Map<Eigen::VectorXd> rows(residuals, num_residuals());
  if (root_.At({blocks[0], size()})) {
    if (root_.value.size() == 0) return false;
    rows = root_.value.rightCols<1>();
  } else {
    rows.setZero();
    rows[0] = scale_ * Norm(residuals_.value);
  }
  if (derive)
    Eigen::Map<Matrix>(jacobians[0], num_residuals(), size()) = root_.value.leftCols(size());
  return std::isfinite(rows[0]);
}

Prediction RunCost::Predict(const double* u, std::span<const Parameter> parameters) const {
  PredictOptions options = options_;
  double& tolerance = options.relative_tolerance;
  if (!parameters.empty() && !strict_)
    tolerance = std::max(tolerance, std::min(LooserOf(start_) * tolerance, kLoosest));
  const ModelState state = StateAt(start_, coordinates_, u);
  Prediction prediction = data_.forward->Predict(run_, state, parameters, options);
  if (prediction.stiff) options_.stiff = true;
  const bool spent = prediction.status == model::SimulateStatus::kTooManySteps;
  if (!spent || !(tolerance > options_.relative_tolerance)) return prediction;
  // A small volume between pump and hose holds the steps down where they are rough.
  strict_ = true;
  return data_.forward->Predict(run_, state, parameters, options_);
}

// Empty where the run cannot be simulated.
std::vector<double> RunCost::ResidualsAt(const double* u) const {
  const Prediction prediction = Predict(u, {});
  if (prediction.status != model::SimulateStatus::kDone) return {};
  std::vector<double> e(Observed().rows());
  Residuals(data_.forward->dataset().runs[run_], Observed(), prediction.reading, e);
  return e;
}

// R, its last column that of the residuals there; empty where the run cannot be simulated.
Eigen::MatrixXd RunCost::RootAt(const double* u) const {
  if (residuals_.value.empty()) return {};
  Prediction prediction = Predict(u, parameters_);
  if (prediction.status != model::SimulateStatus::kDone) return {};
  const std::vector<double> slopes =
      GridSlopes(data_.forward->dataset().runs[run_], Observed(), prediction.reading);
  std::vector<std::vector<double>> columns;
  for (Reading& derivative : prediction.derivatives) {
    Whitened(Observed(), derivative, slopes, columns.emplace_back(Observed().rows()));
    derivative = {};  // a long run's take much memory
  }
  columns.push_back(residuals_.value);
  Eigen::MatrixXd products(size() + 1, size() + 1);
  for (Eigen::Index j = 0; j <= size(); ++j)
    for (Eigen::Index i = 0; i <= j; ++i)
      products(j, i) = scale_ * scale_ * SlopeOf(i, u) * SlopeOf(j, u) *
                       Column(columns, i).dot(Column(columns, j));
  if (!products.triangularView<Eigen::Lower>().toDenseMatrix().allFinite()) return {};
  return RootOf(products);
}

// Of the coordinate's number by u; the residuals' column has none.
double RunCost::SlopeOf(Eigen::Index j, const double* u) const {
  return j == size() ? 1.0 : coordinates_[static_cast<std::size_t>(j)].Slope(u[j]);
}

void RunsAtOnce::PrepareForEvaluation(bool derive, bool) {
  using Clock = std::chrono::steady_clock;
  ForAll(runs_.size(), threads_, [&](std::size_t i) {
    const Clock::time_point start = Clock::now();
    runs_[i].cost->Prepare(u_, derive);
    runs_[i].longest = std::max(runs_[i].longest, Clock::now() - start);
  });
  std::stable_sort(runs_.begin(), runs_.end(),
                   [](const Timed& a, const Timed& b) { return a.longest > b.longest; });
}

PriorCost::PriorCost(const std::vector<Coordinate>& coordinates) : size_(coordinates.size()) {
  for (std::size_t j = 0; j < size_; ++j)
    if (coordinates[j].prior) with_prior_.push_back(j);
  mutable_parameter_block_sizes()->push_back(static_cast<int>(size_));
  set_num_residuals(static_cast<int>(with_prior_.size()));
}
bool PriorCost::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  for (std::size_t k = 0; k < with_prior_.size(); ++k) residuals[k] = blocks[0][with_prior_[k]];
  if (!jacobians || !jacobians[0]) return true;
  std::fill_n(jacobians[0], with_prior_.size() * size_, 0.0);
  for (std::size_t k = 0; k < with_prior_.size(); ++k)
    jacobians[0][k * size_ + with_prior_[k]] = 1.0;
  return true;
}

}  // namespace plenum::calibration
