#include "calibration/fit/start_scan.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "calibration/fit/run_cost.h"
#include "calibration/values/effect_sets.h"
#include "calibration/values/parallel.h"
#include "calibration/values/symmetric.h"
#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

constexpr double kShortest = 0.05, kLongest = 6.0, kLengthStep = 1.05;  // m
// Shorter lines ring so often before they rest that no grid keeps in step; they also take longest.
constexpr double kInStepFrom = 0.3, kShortStep = 1.16;  // m
// Beside several effects: a set that comes to explain the runs is scanned again (ScannedAgain).
constexpr double kCoarseStep = kLengthStep * kLengthStep;
constexpr double kBores[] = {2e-3, 3.5e-3};  // m
constexpr double kApart = 2.5;               // steps of length
constexpr std::size_t kKept = 3, kKeptAgain = 5;
// The whole grid is tried on every so many-th run, the best share of it on the others.
constexpr std::size_t kFirstRuns = 3, kOthersShare = 5;
constexpr double kHopeful = 0.5;  // of what the best point explains
constexpr double kAbout = 2.5;    // of the length
constexpr double kBoresAbout[] = {0.92, 1.0, 1.09};
constexpr double kTolerance = 1e-5;  // at the tightest
constexpr double kRidge = 1e-10;     // of the diagonal: numbers that nothing depends on

// The shortest that fits search.
double ShortestOf(const FitData& data, const model::EffectSpec& spec) {
  const Coordinate length = EffectCoordinates(spec, 0, data.sizes).front();
  return length.Number(length.low);
}

std::vector<double> Lengths(double shortest_m, double step) {
  std::vector<double> lengths_m;
  for (double m = std::max(kShortest, shortest_m); m < kLongest;
       m *= m < kInStepFrom ? kShortStep : step)
    lengths_m.push_back(m);
  return lengths_m;
}

std::vector<model::Effect> GridOf(const FitData& data, const model::EffectSpec& spec, double step) {
  std::vector<model::Effect> grid;
  for (const double length_m : Lengths(ShortestOf(data, spec), step))
    for (const double bore_m : kBores) grid.push_back({&spec, {length_m, bore_m}});
  for (const std::size_t run : data.runs)
    for (const LinePiece& piece : data.forward->dataset().runs[run].line)
      if (piece.tube) grid.push_back({&spec, {piece.tube->length_m, piece.tube->inner_diameter_m}});
  return grid;
}

// What a run, or the priors, has of a χ²: |e|², Jᵀe and JᵀJ.
struct Terms {
  double squares;
  Eigen::VectorXd je;
  Eigen::MatrixXd jj;
};

// χ² at the best of the numbers that J is of, to first order.
double AtBest(const Terms& terms) {
  Eigen::MatrixXd jj = terms.jj;
  jj.diagonal() *= 1.0 + kRidge;
  return terms.squares - terms.je.dot(SolvedSymmetric(jj, terms.je));
}

// The fit's residuals and derivatives by run, and the priors' part.
struct Linear {
  std::vector<Eigen::MatrixXd> j;
  std::vector<Terms> terms;
  Terms priors;
};

PredictOptions Rough(const FitData& data, std::size_t run, const FitOptions& options) {
  PredictOptions rough = OptionsOf(data, run, options);
  rough.relative_tolerance = std::max(rough.relative_tolerance, kTolerance);
  return rough;
}

Eigen::VectorXd ResidualsOf(const FitData& data, std::size_t run, const Prediction& prediction) {
  const ObservedRun& observed = (*data.observed)[run];
  Eigen::VectorXd e(static_cast<Eigen::Index>(observed.rows()));
  Residuals(data.forward->dataset().runs[run], observed, prediction.reading,
            {e.data(), observed.rows()});
  return e;
}

// Empty where a run cannot be simulated.
Linear Linearised(const FitData& data, const Fit& fit, const FitOptions& options) {
  const Eigen::Index size = fit.u.size();
  std::vector<Parameter> parameters;
  for (const Coordinate& coordinate : fit.coordinates) parameters.push_back(coordinate.parameter);
  Linear linear{{}, {}, {0.0, Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)}};
  for (Eigen::Index k = 0; k < size; ++k) {
    if (!fit.coordinates[static_cast<std::size_t>(k)].prior) continue;
    linear.priors.squares += fit.u[k] * fit.u[k];
    linear.priors.je[k] = fit.u[k];
    linear.priors.jj(k, k) = 1.0;
  }
  for (const std::size_t run : data.runs) {
    const ObservedRun& observed = (*data.observed)[run];
    const Prediction prediction =
        data.forward->Predict(run, fit.state, parameters, Rough(data, run, options));
    if (prediction.status != model::SimulateStatus::kDone) return {};
    const std::vector<double> slopes =
        GridSlopes(data.forward->dataset().runs[run], observed, prediction.reading);
    Eigen::MatrixXd& j = linear.j.emplace_back(static_cast<Eigen::Index>(observed.rows()), size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const auto at = static_cast<std::size_t>(k);
      Whitened(observed, prediction.derivatives[at], slopes, {j.col(k).data(), observed.rows()});
      j.col(k) *= fit.coordinates[at].Slope(fit.u[k]);
    }
    const Eigen::VectorXd e = ResidualsOf(data, run, prediction);
    linear.terms.push_back({e.squaredNorm(), j.transpose() * e, j.transpose() * j});
  }
  return linear;
}

// Tries states on some runs at a time.
class Scan {
 public:
  Scan(const FitData& data, const Linear& linear, const FitOptions& options)
      : data_(data), linear_(linear), options_(options) {}

  std::size_t runs() const { return data_.runs.size(); }
  const FitOptions& options() const { return options_; }

  // Adds the terms of the runs first, first + step, ...; false where one cannot be simulated.
  bool Add(const ModelState& state, std::size_t first, std::size_t step, Terms& terms) const {
    for (std::size_t r = first; r < runs(); r += step) {
      const std::size_t run = data_.runs[r];
      PredictOptions rough = Rough(data_, run, options_);
      rough.stiff = true;
      const Prediction prediction = data_.forward->Predict(run, state, {}, rough);
      if (prediction.status != model::SimulateStatus::kDone) return false;
      const Eigen::VectorXd e = ResidualsOf(data_, run, prediction);
      terms.squares += e.squaredNorm();
      terms.je += linear_.j[r].transpose() * e;
      terms.jj += linear_.terms[r].jj;
    }
    return true;
  }

  const Terms& priors() const { return linear_.priors; }
  // Of the fit itself.
  double Chi2() const {
    Terms all = linear_.priors;
    for (const Terms& run : linear_.terms)
      all.squares += run.squares, all.je += run.je, all.jj += run.jj;
    return AtBest(all);
  }

 private:
  const FitData& data_;
  const Linear& linear_;
  const FitOptions& options_;
};

struct Point {
  std::size_t at;  // of the grid
  Terms terms;
  double chi2;
};

// The points of the grid, best first: on the first runs alone, and the best share of them on all.
std::vector<Point> Ranked(const Scan& scan, std::size_t size,
                          const std::function<ModelState(std::size_t)>& state_of) {
  std::vector<Point> points(size);
  for (std::size_t i = 0; i < size; ++i) points[i] = {i, scan.priors(), 0.0};
  const auto take = [&](std::size_t first, std::size_t step) {
    ForAll(points.size(), scan.options().threads, [&](std::size_t i) {
      Point& point = points[i];
      point.chi2 = scan.Add(state_of(point.at), first, step, point.terms)
                       ? AtBest(point.terms)
                       : std::numeric_limits<double>::infinity();
    });
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
      return std::pair(a.chi2, a.at) < std::pair(b.chi2, b.at);
    });
  };
  take(0, kFirstRuns);
  points.resize((size + kOthersShare - 1) / kOthersShare);
  for (std::size_t first = 1; first < std::min(kFirstRuns, scan.runs()); ++first)
    take(first, kFirstRuns);
  return points;
}

// The best few points of the grid, apart by more than neighbours are, with a χ² of at most
// `chi2_max` that may depend on the best one's; `with`: the state with one.
std::vector<model::Effect> BestOf(const Scan& scan, const std::vector<model::Effect>& grid,
                                  std::size_t kept_max,
                                  const std::function<double(double)>& chi2_max,
                                  const std::function<ModelState(const model::Effect&)>& with) {
  std::vector<model::Effect> kept;
  const std::vector<Point> points =
      Ranked(scan, grid.size(), [&](std::size_t i) { return with(grid[i]); });
  for (const Point& point : points) {
    if (!std::isfinite(point.chi2) || point.chi2 > chi2_max(points.front().chi2)) break;
    const model::Effect& effect = grid[point.at];
    const bool near = std::any_of(kept.begin(), kept.end(), [&](const model::Effect& other) {
      const double ratio = effect.parameters[0] / other.parameters[0];
      return std::abs(std::log(ratio)) < kApart * std::log(kLengthStep);
    });
    if (!near) kept.push_back(effect);
    if (kept.size() == kept_max) break;
  }
  return kept;
}

// Other lengths, of about the same bore near by, and everywhere of about the same volume, which
// strokes fix however the line rings.
std::vector<model::Effect> GridAbout(const model::Effect& found, double shortest_m) {
  const double length_m = found.parameters[0], bore_m = found.parameters[1];
  std::vector<model::Effect> grid;
  const double nearest = std::max(1.0 / kAbout, shortest_m / length_m);
  for (double share = nearest; share < kAbout; share *= kLengthStep)
    for (const double bore : kBoresAbout)
      grid.push_back({found.spec, {share * length_m, bore * bore_m}});
  for (const double other_m : Lengths(shortest_m, kLengthStep))
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
  const Linear linear = Rings(spec) ? Linearised(data, without, options) : Linear{};
  if (linear.j.empty()) return EffectStarts(spec, data.sizes);
  const Scan scan(data, linear, options);
  // One is enough where none explains what would be accepted.
  const auto hopeful = [&](double best) {
    const double gain = scan.Chi2() - best;
    return gain > kAccept ? best + (1.0 - kHopeful) * gain : best;
  };
  const double step = without.state.effects.size() < 2 ? kLengthStep : kCoarseStep;
  const auto with = [&](const model::Effect& line) {
    ModelState state = without.state;
    state.effects.push_back(line);
    return state;
  };
  std::vector<model::Effect> starts = BestOf(scan, GridOf(data, spec, step), kKept, hopeful, with);
  return starts.empty() ? EffectStarts(spec, data.sizes) : starts;  // none can be simulated
}

std::vector<ModelState> ScannedAgain(const FitData& data, const Fit& with,
                                     const FitOptions& options) {
  const std::vector<model::Effect>& effects = with.state.effects;
  const auto rings = std::find_if(effects.begin(), effects.end(),
                                  [](const model::Effect& effect) { return Rings(*effect.spec); });
  if (rings == effects.end() || !with.Usable()) return {};
  const auto at = static_cast<std::size_t>(rings - effects.begin());
  const Linear linear = Linearised(data, WithoutNumbersOf(with, at), options);
  if (linear.j.empty()) return {};
  const auto replaced = [&](const model::Effect& line) {
    ModelState state = with.state;
    state.effects[at] = line;
    return state;
  };
  const auto any = [](double) { return std::numeric_limits<double>::infinity(); };
  std::vector<ModelState> starts;
  for (const model::Effect& line :
       BestOf(Scan(data, linear, options), GridAbout(*rings, ShortestOf(data, *rings->spec)),
              kKeptAgain, any, replaced))
    starts.push_back(replaced(line));
  return starts;
}

}  // namespace plenum::calibration
