#include "calibration/start_scan.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "calibration/parallel.h"

namespace plenum::calibration {
namespace {

constexpr double kShortest = 0.05, kLongest = 6.0, kLengthStep = 1.05;  // m
constexpr double kBores[] = {2e-3, 3.5e-3};                             // m
constexpr double kApart = 2.5;                                          // steps of length
constexpr std::size_t kKept = 3, kKeptAgain = 5;
constexpr double kAbout = 2.5;  // of the length
constexpr double kBoresAbout[] = {0.92, 1.0, 1.09};
constexpr const char* kRings = "line_dynamics";
constexpr double kTolerance = 1e-5;  // as of the fits that start there
constexpr double kRidge = 1e-10;     // of a unit diagonal: numbers that nothing depends on

std::vector<model::Effect> GridOf(const FitData& data, const model::EffectSpec& spec) {
  std::vector<model::Effect> grid;
  for (double length_m = kShortest; length_m < kLongest; length_m *= kLengthStep)
    for (const double bore_m : kBores) grid.push_back({&spec, {length_m, bore_m}});
  for (const std::size_t run : data.runs)
    for (const LinePiece& piece : data.forward->dataset().runs[run].line)
      if (piece.tube) grid.push_back({&spec, {piece.tube->length_m, piece.tube->inner_diameter_m}});
  return grid;
}

// The fit's derivatives by run, and the priors' part of JᵀJ and Jᵀe.
struct Linear {
  std::vector<Eigen::MatrixXd> j;
  Eigen::MatrixXd jj;
  Eigen::VectorXd je;
};

PredictOptions Rough(const FitOptions& options) {
  return {.relative_tolerance = kTolerance,
          .cancelled = options.cancelled,
          .steps_max = options.steps_max,
          .recorded_alone = true};
}

// Empty where a run cannot be simulated.
Linear Linearised(const FitData& data, const Fit& fit, const FitOptions& options) {
  const Eigen::Index size = fit.u.size();
  std::vector<Parameter> parameters;
  for (const Coordinate& coordinate : fit.coordinates) parameters.push_back(coordinate.parameter);
  Linear linear{{}, Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (Eigen::Index k = 0; k < size; ++k) {
    if (!fit.coordinates[static_cast<std::size_t>(k)].prior) continue;
    linear.jj(k, k) = 1.0;
    linear.je[k] = fit.u[k];
  }
  for (const std::size_t run : data.runs) {
    const ObservedRun& observed = (*data.observed)[run];
    const Prediction prediction = data.forward->Predict(run, fit.state, parameters, Rough(options));
    if (prediction.status != model::SimulateStatus::kDone) return {};
    const std::vector<double> slopes =
        GridSlopes(data.forward->dataset().runs[run], observed, prediction.reading);
    Eigen::MatrixXd& j = linear.j.emplace_back(static_cast<Eigen::Index>(observed.rows()), size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const auto at = static_cast<std::size_t>(k);
      Whitened(observed, prediction.derivatives[at], slopes, {j.col(k).data(), observed.rows()});
      j.col(k) *= fit.coordinates[at].Slope(fit.u[k]);
    }
    linear.jj += j.transpose() * j;
  }
  const Eigen::VectorXd ridge = kRidge * linear.jj.diagonal();
  linear.jj += ridge.asDiagonal();
  return linear;
}

double Chi2(const FitData& data, const Linear& linear, const ModelState& state,
            const FitOptions& options) {
  double squares = 0.0;
  Eigen::VectorXd g = linear.je;
  for (std::size_t r = 0; r < data.runs.size(); ++r) {
    const std::size_t run = data.runs[r];
    const ObservedRun& observed = (*data.observed)[run];
    const Prediction prediction = data.forward->Predict(run, state, {}, Rough(options));
    if (prediction.status != model::SimulateStatus::kDone)
      return std::numeric_limits<double>::infinity();
    Eigen::VectorXd e(static_cast<Eigen::Index>(observed.rows()));
    Residuals(data.forward->dataset().runs[run], observed, prediction.reading,
              {e.data(), observed.rows()});
    squares += e.squaredNorm();
    g += linear.j[r].transpose() * e;
  }
  return squares - g.dot(linear.jj.ldlt().solve(g));
}

// The best few points of the grid, apart by more than neighbours are; `with`: the state with one.
std::vector<model::Effect> BestOf(const FitData& data, const Linear& linear,
                                  const std::vector<model::Effect>& grid, std::size_t kept_max,
                                  const FitOptions& options,
                                  const std::function<ModelState(const model::Effect&)>& with) {
  std::vector<std::pair<double, std::size_t>> ranked(grid.size());
  ForAll(grid.size(), options.threads, [&](std::size_t i) {
    ranked[i] = {Chi2(data, linear, with(grid[i]), options), i};
  });
  std::sort(ranked.begin(), ranked.end());
  std::vector<model::Effect> kept;
  for (const auto& [chi2, at] : ranked) {
    const std::size_t i = at;
    const bool near = std::any_of(kept.begin(), kept.end(), [&](const model::Effect& other) {
      const double ratio = grid[i].parameters[0] / other.parameters[0];
      return std::abs(std::log(ratio)) < kApart * std::log(kLengthStep);
    });
    if (!near) kept.push_back(grid[i]);
    if (kept.size() == kept_max) break;
  }
  return kept;
}

// Other lengths, of about the same bore near by, and everywhere of about the same volume, which
// strokes fix however the line rings.
std::vector<model::Effect> GridAbout(const model::Effect& found) {
  const double length_m = found.parameters[0], bore_m = found.parameters[1];
  std::vector<model::Effect> grid;
  for (double share = 1.0 / kAbout; share < kAbout; share *= kLengthStep)
    for (const double bore : kBoresAbout)
      grid.push_back({found.spec, {share * length_m, bore * bore_m}});
  for (double other_m = kShortest; other_m < kLongest; other_m *= kLengthStep)
    grid.push_back({found.spec, {other_m, std::sqrt(length_m / other_m) * bore_m}});
  return grid;
}

// A fit without the numbers of its effect `at`, which stay as they are.
Fit WithoutNumbersOf(Fit fit, std::size_t at) {
  std::vector<Coordinate> coordinates;
  std::vector<double> u;
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j) {
    const Parameter& parameter = fit.coordinates[j].parameter;
    if (parameter.kind == Parameter::Kind::kEffect && parameter.effect == at) continue;
    coordinates.push_back(fit.coordinates[j]);
    u.push_back(fit.u[static_cast<Eigen::Index>(j)]);
  }
  fit.coordinates = std::move(coordinates);
  fit.u = Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
  return fit;
}

}  // namespace

std::vector<model::Effect> ScannedStarts(const FitData& data, const Fit& without,
                                         const model::EffectSpec& spec, const FitOptions& options) {
  const Linear linear = spec.id == kRings ? Linearised(data, without, options) : Linear{};
  if (linear.j.empty()) return EffectStarts(spec, data.sizes);
  return BestOf(data, linear, GridOf(data, spec), kKept, options, [&](const model::Effect& line) {
    ModelState state = without.state;
    state.effects.push_back(line);
    return state;
  });
}

std::vector<ModelState> ScannedAgain(const FitData& data, const Fit& with,
                                     const FitOptions& options) {
  const std::vector<model::Effect>& effects = with.state.effects;
  const auto rings = std::find_if(effects.begin(), effects.end(), [](const model::Effect& effect) {
    return effect.spec->id == kRings;
  });
  if (rings == effects.end() || !with.Usable()) return {};
  const auto at = static_cast<std::size_t>(rings - effects.begin());
  const Linear linear = Linearised(data, WithoutNumbersOf(with, at), options);
  if (linear.j.empty()) return {};
  const auto replaced = [&](const model::Effect& line) {
    ModelState state = with.state;
    state.effects[at] = line;
    return state;
  };
  std::vector<ModelState> starts;
  for (const model::Effect& line :
       BestOf(data, linear, GridAbout(*rings), kKeptAgain, options, replaced))
    starts.push_back(replaced(line));
  return starts;
}

}  // namespace plenum::calibration
