#include "calibration/fit/fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "calibration/fit/recorded/instants.h"
#include "calibration/fit/run_cost.h"
#include "calibration/fit/within_bounds.h"
#include "calibration/values/specimens.h"
#include "model/effects/learned/learned.h"

namespace plenum::calibration {
namespace {

constexpr double kParameterTolerance = 1e-7;
constexpr int kPhases = 8;  // in a round

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
  std::vector<Coordinate> coordinates =
      BaseCoordinates(*data.forward, data.runs, data.clocks, start.freed);
  std::erase_if(coordinates, [&](const Coordinate& coordinate) {
    return coordinate.parameter.kind == Parameter::Kind::kClock &&
           NoInstantIsExact(data.forward->dataset().runs[coordinate.parameter.run]);
  });
  if (!options.nuisance_only)
    for (const Coordinate& coordinate : MeasuredCoordinates(data.forward->dataset(), data.runs))
      coordinates.push_back(coordinate);
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
  for (const Coordinate& coordinate : InstantCoordinates(data.forward->dataset(), data.runs))
    coordinates.push_back(coordinate);
  if (options.nuisance_only) {
    std::erase_if(coordinates, [&](const Coordinate& coordinate) {
      const Declared number = coordinate.parameter.declared;
      const bool of_line =
          number == Declared::kSonicConductance || number == Declared::kCriticalRatio;
      return coordinate.parameter.kind == Parameter::Kind::kDeclared &&
             !(options.own_pairs && of_line) &&
             !(options.own_piece && OfEachSpecimen(start, number));
    });
    return coordinates;
  }
  for (const Coordinate& coordinate : SharedInstantCoordinates(data.forward->dataset(), data.runs))
    coordinates.push_back(coordinate);
  for (std::size_t i = 0; i < start.effects.size(); ++i)
    for (const Coordinate& coordinate : EffectCoordinates(*start.effects[i].spec, i, data.sizes))
      coordinates.push_back(coordinate);
  if (options.declared_stay)
    std::erase_if(coordinates, [](const Coordinate& coordinate) {
      return coordinate.parameter.kind == Parameter::Kind::kDeclared && coordinate.prior;
    });
  if (options.fixed)
    std::erase_if(coordinates, [&](const Coordinate& coordinate) {
      return coordinate.parameter == *options.fixed;
    });
  return coordinates;
}

void AddCosts(const FitData& data, const ModelState& start, const FitOptions& options,
              const std::vector<Coordinate>& coordinates, const StepsLeft& steps, double* u,
              RunsAtOnce& runs, ceres::Problem& problem) {
  for (const std::size_t run : data.runs) {
    auto* cost = new RunCost(data, run, start, coordinates, OptionsOf(data, run, options),
                             options.weight, &steps);
    runs.Add(cost);
    problem.AddResidualBlock(cost, nullptr, u);
  }
  if (HasPrior(coordinates)) problem.AddResidualBlock(new PriorCost(coordinates), nullptr, u);
}

double Chi2Prior(const Fit& fit) {
  double sum = 0.0;
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j)
    if (fit.coordinates[j].prior) sum += std::pow(fit.u[static_cast<Eigen::Index>(j)], 2);
  return sum;
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

FitStatus StatusOf(ceres::TerminationType termination) {
  switch (termination) {
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
void ExpectUnseen(const FitData& data, const std::vector<Coordinate>& coordinates,
                  ModelState& state) {
  TakeMeans(data.forward->dataset(), data.runs, state);
  if (!Fits(coordinates, Parameter::Kind::kLateness)) return;
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

// The declared pairs of a line: what a tube adds follows from its size.
std::vector<model::FlowElement> PairsOf(const Run& run) {
  std::vector<model::FlowElement> pairs;
  for (const LinePiece& piece : run.line)
    if (!piece.tube) pairs.insert(pairs.end(), {piece.fill, piece.exhaust});
  return pairs;
}

}  // namespace

// Whether the data have the run, and no other of its specimen.
static bool IsAloneOfItsPiece(const FitData& data, std::size_t run) {
  const std::vector<Run>& runs = data.forward->dataset().runs;
  if (data.forward->dataset().several) return false;  // each run is of all
  std::size_t others = 0;
  for (const std::size_t fitted : data.runs)
    if (fitted != run && runs[fitted].specimen == runs[run].specimen) ++others;
  return others == 0 && std::count(data.runs.begin(), data.runs.end(), run) > 0;
}

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
  RunsAtOnce runs(fit.u.data(), options.threads);
  ceres::Problem::Options shared;
  shared.evaluation_callback = &runs;
  ceres::Problem problem(shared);
  problem.AddParameterBlock(fit.u.data(), static_cast<int>(size));
  for (Eigen::Index j = 0; j < size; ++j) {
    const Coordinate& coordinate = fit.coordinates[static_cast<std::size_t>(j)];
    problem.SetParameterLowerBound(fit.u.data(), static_cast<int>(j), coordinate.low);
    problem.SetParameterUpperBound(fit.u.data(), static_cast<int>(j), coordinate.high);
  }
  StepsLeft steps(options.iterations_max);
  AddCosts(data, start, options, fit.coordinates, steps, fit.u.data(), runs, problem);

  StopWhenCancelled stop(options.cancelled);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options.iterations_max;
  solver.function_tolerance = options.function_tolerance;
  solver.parameter_tolerance = kParameterTolerance;
  solver.gradient_tolerance = 0.0;
  solver.initial_trust_region_radius = 1e3;
  // A step that does not do is not sought along its line but turned, by a smaller region of trust:
  // at a bound, and in a valley, no length of it does.
  solver.max_num_line_search_step_size_iterations = 0;
  solver.logging_type = ceres::SILENT;
  solver.callbacks = {&stop, &steps};
  const BoundedSolution solution = SolveWithinBounds(solver, problem, fit.u);

  const bool cancelled = options.cancelled && options.cancelled();
  fit.status = cancelled ? FitStatus::kCancelled : StatusOf(solution.termination);
  if (fit.status == FitStatus::kFailed) fit.detail = solution.message;
  fit.state = StateAt(start, fit.coordinates, fit.u.data());
  if (!options.nuisance_only) ExpectUnseen(data, fit.coordinates, fit.state);
  fit.chi2_prior = Chi2Prior(fit);
  fit.chi2_data = (2.0 * solution.cost - fit.chi2_prior) / options.weight;
  fit.bic = Bic(fit);
  return fit;
}

Fit AlignedFit(const FitData& data, const ModelState& state, std::size_t run, FitOptions options) {
  FitData alone = data;
  alone.runs = {run};
  options.nuisance_only = true;
  options.own_pairs = HasOwnPairs(data, run);
  options.own_piece = IsAloneOfItsPiece(data, run);
  ModelState own = state;
  own.freed = {};
  return FitModel(alone, own, options);
}

ModelState Aligned(const FitData& data, const ModelState& state, std::size_t run,
                   FitOptions options) {
  const Fit aligned = AlignedFit(data, state, run, std::move(options));
  return aligned.Usable() ? aligned.state : state;
}

Reading Predicted(const FitData& data, const ModelState& state, std::size_t run,
                  const FitOptions& options) {
  Prediction prediction = data.forward->Predict(run, state, {}, OptionsOf(data, run, options));
  if (prediction.status != model::SimulateStatus::kDone) return {};
  return std::move(prediction.reading);
}

}  // namespace plenum::calibration
