#include "calibration/fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "calibration/whiteness.h"
#include "model/effects/learned.h"

namespace plenum::calibration {
namespace {

constexpr double kTwoSided95 = 1.96;
constexpr double kToleranceTightest = 1e-9;
constexpr double kParameterTolerance = 1e-7;
constexpr double kLeastCurvature = 1e-12;
constexpr int kPhases = 8;  // in a round

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

// One run over all k coordinates as one block of k + 1 rows. The search needs of the residuals e
// and their derivatives J only JᵀJ, Jᵀe and eᵀe, so that the rows are R of [J e] = Q·R, which has
// the same products and none of the readings' number; without derivatives the one row |e|. A step
// is asked for thrice at one point — by the search along it, for its cost, and for the derivatives
// there — and simulated once, or once without derivatives and once with them. A run that turned out
// stiff is taken to stay so: the explicit method is not tried again.
class RunCost : public ceres::CostFunction {
 public:
  RunCost(const FitData& data, std::size_t run, const ModelState& start,
          const std::vector<Coordinate>& coordinates, const PredictOptions& options,
          double weight = 1.0)
      : data_(data),
        run_(run),
        start_(start),
        coordinates_(coordinates),
        options_(options),
        scale_(std::sqrt(weight)) {
    for (const Coordinate& coordinate : coordinates) parameters_.push_back(coordinate.parameter);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(coordinates.size()));
    set_num_residuals(static_cast<int>(coordinates.size()) + 1);
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Eigen::Map<const Eigen::VectorXd> u(blocks[0], size());
    const bool derive = jacobians && jacobians[0];
    if (known_.u.size() != size() || known_.u != u) known_ = {u, {}, {}};
    if (derive && !known_.root) known_.root = RootAt(blocks[0]);
    if (!derive && !known_.root && !known_.norm) known_.norm = NormAt(blocks[0]);
    Eigen::Map<Eigen::VectorXd> rows(residuals, num_residuals());
    if (!known_.root) {
      rows.setZero();
      rows[0] = *known_.norm;
      return std::isfinite(rows[0]);
    }
    if (known_.root->size() == 0) return false;
    rows = known_.root->rightCols<1>();
    if (derive)
      Eigen::Map<Matrix>(jacobians[0], num_residuals(), size()) = known_.root->leftCols(size());
    return true;
  }

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Eigen::Index size() const { return static_cast<Eigen::Index>(coordinates_.size()); }
  const ObservedRun& Observed() const { return (*data_.observed)[run_]; }

  Prediction Predict(const double* u, std::span<const Parameter> parameters) const {
    Prediction prediction =
        data_.forward->Predict(run_, StateAt(start_, coordinates_, u), parameters, options_);
    if (prediction.stiff) options_.stiff = true;
    return prediction;
  }

  std::vector<double> ResidualsOf(const Prediction& prediction) const {
    std::vector<double> e(Observed().rows());
    Residuals(data_.forward->dataset().runs[run_], Observed(), prediction.reading, e);
    return e;
  }

  // |e|; infinite where the run cannot be simulated.
  double NormAt(const double* u) const {
    const Prediction prediction = Predict(u, {});
    if (prediction.status != model::SimulateStatus::kDone)
      return std::numeric_limits<double>::infinity();
    double squares = 0.0;
    for (const double e : ResidualsOf(prediction)) squares += e * e;
    return scale_ * std::sqrt(squares);
  }

  // R, its last column that of the residuals; empty where the run cannot be simulated.
  Eigen::MatrixXd RootAt(const double* u) const {
    Prediction prediction = Predict(u, parameters_);
    if (prediction.status != model::SimulateStatus::kDone) return {};
    const std::vector<double> slopes =
        GridSlopes(data_.forward->dataset().runs[run_], Observed(), prediction.reading);
    std::vector<std::vector<double>> columns;
    for (Reading& derivative : prediction.derivatives) {
      Whitened(Observed(), derivative, slopes, columns.emplace_back(Observed().rows()));
      derivative = {};  // a long run's take much memory
    }
    columns.push_back(ResidualsOf(prediction));
    Eigen::MatrixXd products(size() + 1, size() + 1);
    for (Eigen::Index j = 0; j <= size(); ++j)
      for (Eigen::Index i = 0; i <= j; ++i)
        products(j, i) = scale_ * scale_ * SlopeOf(i, u) * SlopeOf(j, u) *
                         Column(columns, i).dot(Column(columns, j));
    if (!products.triangularView<Eigen::Lower>().toDenseMatrix().allFinite()) return {};
    const Eigen::LDLT<Eigen::MatrixXd> factors(products);
    const Eigen::MatrixXd half = Eigen::MatrixXd(factors.matrixL()) *
                                 factors.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
    return (factors.transpositionsP().transpose() * half).transpose();
  }

  // Of the coordinate's number by u; the residuals' column has none.
  double SlopeOf(Eigen::Index j, const double* u) const {
    return j == size() ? 1.0 : coordinates_[static_cast<std::size_t>(j)].Slope(u[j]);
  }
  static Eigen::Map<const Eigen::VectorXd> Column(const std::vector<std::vector<double>>& columns,
                                                  Eigen::Index j) {
    const std::vector<double>& column = columns[static_cast<std::size_t>(j)];
    return {column.data(), static_cast<Eigen::Index>(column.size())};
  }

  struct Known {
    Eigen::VectorXd u;
    std::optional<double> norm;
    std::optional<Eigen::MatrixXd> root;
  };

  const FitData& data_;
  std::size_t run_;
  const ModelState& start_;
  const std::vector<Coordinate>& coordinates_;
  std::vector<Parameter> parameters_;
  mutable PredictOptions options_;
  double scale_;         // of the residuals
  mutable Known known_;  // the last point
};

// u of every coordinate that has a prior.
class PriorCost : public ceres::CostFunction {
 public:
  explicit PriorCost(const std::vector<Coordinate>& coordinates) : size_(coordinates.size()) {
    for (std::size_t j = 0; j < size_; ++j)
      if (coordinates[j].prior) with_prior_.push_back(j);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(size_));
    set_num_residuals(static_cast<int>(with_prior_.size()));
  }
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    for (std::size_t k = 0; k < with_prior_.size(); ++k) residuals[k] = blocks[0][with_prior_[k]];
    if (!jacobians || !jacobians[0]) return true;
    std::fill_n(jacobians[0], with_prior_.size() * size_, 0.0);
    for (std::size_t k = 0; k < with_prior_.size(); ++k)
      jacobians[0][k * size_ + with_prior_[k]] = 1.0;
    return true;
  }

 private:
  std::size_t size_;
  std::vector<std::size_t> with_prior_;
};

class StopWhenCancelled : public ceres::IterationCallback {
 public:
  explicit StopWhenCancelled(const std::function<bool()>& cancelled) : cancelled_(cancelled) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return cancelled_ && cancelled_() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::function<bool()>& cancelled_;
};

bool HasPrior(const std::vector<Coordinate>& coordinates) {
  return std::any_of(coordinates.begin(), coordinates.end(),
                     [](const Coordinate& coordinate) { return coordinate.prior; });
}

std::vector<Coordinate> CoordinatesOf(const FitData& data, const ModelState& start,
                                      const FitOptions& options) {
  std::vector<Coordinate> coordinates = BaseCoordinates(*data.forward, data.runs, data.clocks);
  const bool heated =
      std::any_of(start.effects.begin(), start.effects.end(), [](const model::Effect& effect) {
        return effect.spec->place == model::EffectPlace::kEnergy;
      });
  if (heated)
    for (const Coordinate& coordinate : TemperatureCoordinates(*data.forward, data.runs))
      coordinates.push_back(coordinate);
  for (const Coordinate& coordinate :
       RunCoordinates(*data.forward, data.runs, start.effects, data.sizes))
    coordinates.push_back(coordinate);
  if (options.nuisance_only) {
    std::erase_if(coordinates, [&](const Coordinate& coordinate) {
      const Declared number = coordinate.parameter.declared;
      const bool of_line =
          number == Declared::kSonicConductance || number == Declared::kCriticalRatio;
      return coordinate.parameter.kind == Parameter::Kind::kDeclared &&
             !(options.own_pairs && of_line);
    });
    return coordinates;
  }
  for (std::size_t i = 0; i < start.effects.size(); ++i)
    for (const Coordinate& coordinate : EffectCoordinates(*start.effects[i].spec, i, data.sizes))
      coordinates.push_back(coordinate);
  if (options.fixed)
    std::erase_if(coordinates, [&](const Coordinate& coordinate) {
      return coordinate.parameter == *options.fixed;
    });
  return coordinates;
}

void AddCosts(const FitData& data, const ModelState& start, const FitOptions& options,
              const std::vector<Coordinate>& coordinates, double* u, ceres::Problem& problem) {
  for (const std::size_t run : data.runs)
    problem.AddResidualBlock(
        new RunCost(data, run, start, coordinates, OptionsOf(data, run, options), options.weight),
        nullptr, u);
  if (HasPrior(coordinates)) problem.AddResidualBlock(new PriorCost(coordinates), nullptr, u);
}

double Chi2Prior(const Fit& fit) {
  double sum = 0.0;
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j)
    if (fit.coordinates[j].prior) sum += std::pow(fit.u[static_cast<Eigen::Index>(j)], 2);
  return sum;
}

// n·ln(χ²/n) + χ²_prior + the penalty.
double Bic(const Fit& fit) {
  const double n = static_cast<double>(fit.rows);
  return n * std::log(fit.chi2_data / n) + fit.chi2_prior + Penalty(fit, 1.0);
}

std::size_t RowsOf(const FitData& data) {
  std::size_t rows = 0;
  for (const std::size_t run : data.runs) rows += (*data.observed)[run].rows();
  return rows;
}

// No coordinate can move: the χ² of the start.
void EvaluateStart(const FitData& data, const FitOptions& options, Fit& fit) {
  for (const std::size_t run : data.runs) {
    const Prediction prediction =
        data.forward->Predict(run, fit.state, {}, OptionsOf(data, run, options));
    if (prediction.status != model::SimulateStatus::kDone) {
      fit.detail = prediction.detail;
      return;
    }
    std::vector<double> rows((*data.observed)[run].rows());
    Residuals(data.forward->dataset().runs[run], (*data.observed)[run], prediction.reading, rows);
    for (const double e : rows) fit.chi2_data += e * e;
  }
  fit.status = FitStatus::kConverged;
  fit.bic = Bic(fit);
}

FitStatus StatusOf(const ceres::Solver::Summary& summary) {
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
    case ceres::USER_SUCCESS:
      return FitStatus::kConverged;
    case ceres::NO_CONVERGENCE:
      return FitStatus::kIterationsSpent;
    case ceres::USER_FAILURE:
      return FitStatus::kCancelled;
    case ceres::FAILURE:
      break;
  }
  return FitStatus::kFailed;
}

bool Fits(const std::vector<Coordinate>& coordinates, Parameter::Kind kind) {
  return std::any_of(coordinates.begin(), coordinates.end(), [&](const Coordinate& coordinate) {
    return coordinate.parameter.kind == kind;
  });
}

double* LatenessOf(ModelState& state) {
  for (model::Effect& effect : state.effects)
    for (std::size_t i = 0; i < effect.parameters.size(); ++i)
      if (effect.spec->parameters[i].name == model::kLatenessName) return &effect.parameters[i];
  return nullptr;
}

// Every command that may be late gets a lateness of its own.
void SplitLateness(const FitData& data, const std::vector<Coordinate>& coordinates,
                   ModelState& state) {
  std::vector<std::size_t> split;
  for (const std::size_t run : data.runs)
    if (state.late_s[run].empty()) {
      state.late_s[run].assign(data.forward->dataset().runs[run].valve.size(), 0.0);
      split.push_back(run);
    }
  for (const Coordinate& coordinate : coordinates)
    if (coordinate.parameter.kind == Parameter::Kind::kLateness &&
        std::find(split.begin(), split.end(), coordinate.parameter.run) != split.end())
      NumberOf(state, coordinate.parameter) = *LatenessOf(state);
}

// What is to be expected of a run that is not recorded yet.
void MeanLateness(const std::vector<Coordinate>& coordinates, ModelState& state) {
  double sum_s = 0.0, count = 0.0;
  for (const Coordinate& coordinate : coordinates) {
    if (coordinate.parameter.kind != Parameter::Kind::kLateness) continue;
    sum_s += NumberOf(state, coordinate.parameter);
    ++count;
  }
  *LatenessOf(state) = sum_s / count;
}

// χ² falls and rises as a phase turns: each run starts from the best of a round.
void TurnPhases(const FitData& data, const FitOptions& options, ModelState& state) {
  for (const std::size_t run : data.runs) {
    double least = std::numeric_limits<double>::infinity(), best_rad = 0.0;
    for (int k = 0; k < kPhases; ++k) {
      state.phase_rad[run] = 2.0 * std::numbers::pi * k / kPhases;
      Fit fit;
      fit.state = state;
      FitData alone = data;
      alone.runs = {run};
      EvaluateStart(alone, options, fit);
      if (!fit.Usable() || !(fit.chi2_data < least)) continue;
      least = fit.chi2_data;
      best_rad = state.phase_rad[run];
    }
    state.phase_rad[run] = best_rad;
  }
}

// The number at u, held within the bounds.
double Edge(const Coordinate& coordinate, double u) {
  return coordinate.Number(std::clamp(u, coordinate.low, coordinate.high));
}

// The declared pairs of a line: what a tube adds follows from its size.
std::vector<model::FlowElement> PairsOf(const Run& run) {
  std::vector<model::FlowElement> pairs;
  for (const LinePiece& piece : run.line)
    if (!piece.tube) pairs.insert(pairs.end(), {piece.fill, piece.exhaust});
  return pairs;
}

}  // namespace

bool HasOwnPairs(const FitData& data, std::size_t run) {
  const std::vector<Run>& runs = data.forward->dataset().runs;
  return std::none_of(data.runs.begin(), data.runs.end(), [&](std::size_t fitted) {
    return PairsOf(runs[fitted]) == PairsOf(runs[run]);
  });
}

Fit FitModel(const FitData& data, const ModelState& from, const FitOptions& options) {
  FLAGS_minloglevel = google::GLOG_FATAL;  // what Ceres says is in the status
  Fit fit;
  fit.state = from;
  fit.coordinates = CoordinatesOf(data, from, options);
  const bool late = Fits(fit.coordinates, Parameter::Kind::kLateness);
  if (late) SplitLateness(data, fit.coordinates, fit.state);
  if (options.nuisance_only && Fits(fit.coordinates, Parameter::Kind::kPhase))
    TurnPhases(data, options, fit.state);
  const ModelState start = fit.state;
  fit.rows = RowsOf(data);
  const auto size = static_cast<Eigen::Index>(fit.coordinates.size());
  fit.u.resize(size);
  if (size == 0) {
    EvaluateStart(data, options, fit);
    return fit;
  }
  for (Eigen::Index j = 0; j < size; ++j) {
    const Coordinate& coordinate = fit.coordinates[static_cast<std::size_t>(j)];
    fit.u[j] = std::clamp(coordinate.At(NumberOf(start, coordinate.parameter)), coordinate.low,
                          coordinate.high);
  }
  ceres::Problem problem;
  problem.AddParameterBlock(fit.u.data(), static_cast<int>(size));
  for (Eigen::Index j = 0; j < size; ++j) {
    const Coordinate& coordinate = fit.coordinates[static_cast<std::size_t>(j)];
    problem.SetParameterLowerBound(fit.u.data(), static_cast<int>(j), coordinate.low);
    problem.SetParameterUpperBound(fit.u.data(), static_cast<int>(j), coordinate.high);
  }
  AddCosts(data, start, options, fit.coordinates, fit.u.data(), problem);

  StopWhenCancelled stop(options.cancelled);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options.iterations_max;
  solver.function_tolerance = options.function_tolerance;
  solver.parameter_tolerance = kParameterTolerance;
  solver.gradient_tolerance = 0.0;
  solver.initial_trust_region_radius = 1e3;
  solver.num_threads = options.threads;
  solver.logging_type = ceres::SILENT;
  solver.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);

  fit.status = options.cancelled && options.cancelled() ? FitStatus::kCancelled : StatusOf(summary);
  if (fit.status == FitStatus::kFailed) fit.detail = summary.message;
  fit.state = StateAt(start, fit.coordinates, fit.u.data());
  if (late && !options.nuisance_only) MeanLateness(fit.coordinates, fit.state);
  fit.chi2_prior = Chi2Prior(fit);
  fit.chi2_data = (2.0 * summary.final_cost - fit.chi2_prior) / options.weight;
  fit.bic = Bic(fit);
  return fit;
}

// Numbers with a prior are the same in every model and do not count.
double Penalty(const Fit& fit, double memory) {
  const double most = std::log(std::max(1.0, static_cast<double>(fit.rows) / memory));
  const auto free = std::count_if(fit.coordinates.begin(), fit.coordinates.end(),
                                  [](const Coordinate& coordinate) { return !coordinate.prior; });
  double penalty = (static_cast<double>(free) - static_cast<double>(fit.narrowed.size())) * most;
  for (const double nats : fit.narrowed) penalty += std::clamp(nats - std::log(memory), 0.0, most);
  return penalty;
}

void Narrow(const FitData& data, const FitOptions& options, Fit& fit) {
  if (!fit.Usable()) return;
  std::vector<Eigen::Index> ratios;
  std::vector<double> ranges;
  for (Eigen::Index j = 0; j < fit.u.size(); ++j) {
    const Coordinate& coordinate = fit.coordinates[static_cast<std::size_t>(j)];
    const Parameter& parameter = coordinate.parameter;
    if (parameter.kind != Parameter::Kind::kEffect) continue;
    const model::EffectSpec& spec = *fit.state.effects[parameter.effect].spec;
    if (!spec.parameters[parameter.number].name.ends_with("_ratio")) continue;
    ratios.push_back(j);
    ranges.push_back(coordinate.high - coordinate.low);
  }
  fit.narrowed.clear();
  if (!ratios.empty()) {
    const Eigen::MatrixXd covariance = Covariance(data, fit, options);
    for (std::size_t k = 0; k < ratios.size(); ++k) {
      const double share = covariance(ratios[k], ratios[k]) / (ranges[k] * ranges[k]);
      fit.narrowed.push_back(-std::log(2.0 * std::numbers::pi * std::max(share, kLeastCurvature)));
    }
  }
  fit.bic = Bic(fit);
}

bool PriorsHold(const Fit& fit) {
  const auto count = std::count_if(fit.coordinates.begin(), fit.coordinates.end(),
                                   [](const Coordinate& coordinate) { return coordinate.prior; });
  if (count == 0) return true;
  const boost::math::chi_squared law(static_cast<double>(count));
  return fit.chi2_prior <= boost::math::quantile(boost::math::complement(law, kFalseAlarm));
}

double Inflation(const Fit& fit, double memory) {
  const double freedom =
      static_cast<double>(fit.rows) - static_cast<double>(fit.coordinates.size());
  return memory * std::max(1.0, fit.chi2_data / std::max(1.0, freedom));
}

Eigen::MatrixXd Covariance(const FitData& data, const Fit& fit, const FitOptions& options,
                           double memory) {
  const auto size = static_cast<Eigen::Index>(fit.coordinates.size());
  Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(size, size);
  for (const std::size_t run : data.runs) {
    const RunCost cost(data, run, fit.state, fit.coordinates, OptionsOf(data, run, options));
    const Eigen::Index rows = cost.num_residuals();
    Eigen::VectorXd residuals(rows);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows, size);
    const double* blocks[] = {fit.u.data()};
    double* jacobians[] = {jacobian.data()};
    if (cost.Evaluate(blocks, residuals.data(), jacobians))
      curvature += jacobian.transpose() * jacobian;
  }
  curvature /= Inflation(fit, memory);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Coordinate& coordinate = fit.coordinates[static_cast<std::size_t>(j)];
    if (coordinate.prior) curvature(j, j) += 1.0;
  }
  // By eigenvalues of the scaled curvature: directions without any leave their parameters unknown.
  const Eigen::VectorXd scale = curvature.diagonal().cwiseMax(kLeastCurvature).cwiseSqrt();
  const Eigen::MatrixXd scaled =
      scale.cwiseInverse().asDiagonal() * curvature * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  const Eigen::VectorXd spread = eigen.eigenvalues().cwiseMax(kLeastCurvature).cwiseInverse();
  const Eigen::VectorXd unit = scale.cwiseInverse();
  return unit.asDiagonal() * eigen.eigenvectors() * spread.asDiagonal() *
         eigen.eigenvectors().transpose() * unit.asDiagonal();
}

std::vector<Estimate> Intervals(const Fit& fit, const Eigen::MatrixXd& covariance) {
  std::vector<Estimate> estimates;
  for (Eigen::Index j = 0; j < fit.u.size(); ++j) {
    const Coordinate& coordinate = fit.coordinates[static_cast<std::size_t>(j)];
    const double variance = covariance(j, j);
    const double half = kTwoSided95 * std::sqrt(variance);
    const double one = Edge(coordinate, fit.u[j] - half), other = Edge(coordinate, fit.u[j] + half);
    const double range = coordinate.kind == Coordinate::Kind::kLinear && !coordinate.prior
                             ? coordinate.high - coordinate.low
                             : 1.0;
    estimates.push_back({.value = coordinate.Number(fit.u[j]),
                         .low = std::min(one, other),
                         .high = std::max(one, other),
                         .identified = std::sqrt(variance) < kUnidentified * range});
  }
  return estimates;
}

Reading Predicted(const FitData& data, const ModelState& state, std::size_t run,
                  const FitOptions& options) {
  Prediction prediction = data.forward->Predict(run, state, {}, OptionsOf(data, run, options));
  if (prediction.status != model::SimulateStatus::kDone) return {};
  return std::move(prediction.reading);
}

}  // namespace plenum::calibration
