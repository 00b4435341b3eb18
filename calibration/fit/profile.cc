#include "calibration/fit/profile.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/values/effect_sets.h"
#include "calibration/values/parallel.h"

namespace plenum::calibration {
namespace {

constexpr double kRise = 3.841;  // 95 % quantile of χ² with one degree of freedom
constexpr double kNearLow = 0.75, kNearHigh = 1.3;  // of kRise: a parabola does for the rest
constexpr double kStepMost = 3.0;                   // times the one before
constexpr double kShareLeast = 0.1;                 // of what is between two steps
constexpr int kTries = 8;
constexpr int kIterations = 12;      // from the ridge
constexpr int kIterationsFrom = 40;  // from a fit nearby
constexpr double kFunctionTolerance = 1e-6;

// One side of one coordinate's interval.
class Side {
 public:
  Side(const FitData& data, const Fit& fit, const Eigen::MatrixXd& covariance, double inflation,
       const FitOptions& options, Eigen::Index j, double sign)
      : data_(data), fit_(fit), covariance_(covariance), options_(options), j_(j), sign_(sign) {
    options_.weight = 1.0 / inflation;
    options_.iterations_max = kIterations;
    options_.function_tolerance = kFunctionTolerance;
    options_.fixed = Of(j).parameter;
  }

  // The coordinate where Q has risen by kRise. The root of a parabola's rise is straight: steps
  // grow along it until they rise by more, then come to √kRise from both sides (Illinois method).
  std::optional<double> Edge() const {
    const double most = sign_ > 0.0 ? Of(j_).high - fit_.u[j_] : fit_.u[j_] - Of(j_).low;
    const double goal = std::sqrt(kRise);
    double step = std::min(goal * std::sqrt(covariance_(j_, j_)), most);
    double below = 0.0, lack = goal, above = 0.0, excess = 0.0;  // steps, and the roots beside goal
    ModelState nearest = fit_.state;                             // at the step below
    for (int k = 0; k < kTries && step > 0.0; ++k) {
      const Fit moved = Moved(step, nearest);
      if (!moved.Usable()) return {};
      const double rise = std::max(0.0, Rise(moved)), root = std::sqrt(rise);
      if (rise > kNearLow * kRise && rise < kNearHigh * kRise)
        return fit_.u[j_] + sign_ * std::min(step * goal / root, most);
      if (rise < kRise) {
        if (step >= most) return fit_.u[j_] + sign_ * most;
        if (below > 0.0) excess *= 0.5;
        below = step, lack = goal - root;
        nearest = moved.state;
      } else {
        if (above > 0.0) lack *= 0.5;
        above = step, excess = root - goal;
      }
      if (above > 0.0)
        step = below +
               (above - below) * std::clamp(lack / (lack + excess), kShareLeast, 1.0 - kShareLeast);
      else
        step = std::min(step * std::min(goal / std::max(root, 1e-3), kStepMost), most);
    }
    return fit_.u[j_] + sign_ * step;
  }

 private:
  const Coordinate& Of(Eigen::Index j) const {
    return fit_.coordinates[static_cast<std::size_t>(j)];
  }

  double Rise(const Fit& moved) const {
    const auto q = [&](const Fit& fit) { return options_.weight * fit.chi2_data + fit.chi2_prior; };
    return q(moved) - q(fit_);
  }

  // The least over the others, from their place along the ridge of the parabola. A parabola may
  // point where the others have no effect left and no way back: a fit that rises by more than the
  // interval allows is made again from the nearest one known.
  Fit Moved(double step, const ModelState& nearest) const {
    Fit moved = FitModel(data_, OnRidge(step), options_);
    if (moved.Usable() && Rise(moved) < kNearHigh * kRise) return moved;
    ModelState start = nearest;
    NumberOf(start, Of(j_).parameter) = Of(j_).Number(fit_.u[j_] + sign_ * step);
    FitOptions patient = options_;
    patient.iterations_max = kIterationsFrom;
    Fit near = FitModel(data_, start, patient);
    return near.Usable() && !(moved.Usable() && Rise(moved) < Rise(near)) ? near : moved;
  }

  ModelState OnRidge(double step) const {
    ModelState start = fit_.state;
    for (Eigen::Index i = 0; i < fit_.u.size(); ++i) {
      const double along = i == j_ ? 1.0 : covariance_(i, j_) / covariance_(j_, j_);
      const double u = std::clamp(fit_.u[i] + sign_ * step * along, Of(i).low, Of(i).high);
      NumberOf(start, Of(i).parameter) = Of(i).Number(u);
    }
    return start;
  }

  const FitData& data_;
  const Fit& fit_;
  const Eigen::MatrixXd& covariance_;
  FitOptions options_;
  Eigen::Index j_;
  double sign_;
};

}  // namespace

void ProfileIntervals(const FitData& data, const Fit& fit, const Eigen::MatrixXd& covariance,
                      double inflation, const FitOptions& options,
                      std::vector<Estimate>& estimates) {
  std::vector<std::size_t> profiled;
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j) {
    const Parameter& parameter = fit.coordinates[j].parameter;
    const bool named = parameter.kind == Parameter::Kind::kEffect &&
                       !IsLearned(*fit.state.effects[parameter.effect].spec);
    if (named) profiled.push_back(j);
  }
  std::vector<std::optional<double>> edges(2 * profiled.size());
  ForAll(edges.size(), options.threads, [&](std::size_t k) {
    FitOptions each = options;
    each.threads = ThreadsWithin(k, edges.size(), options.threads);
    const auto j = static_cast<Eigen::Index>(profiled[k / 2]);
    edges[k] = Side(data, fit, covariance, inflation, each, j, k % 2 == 0 ? -1.0 : 1.0).Edge();
  });
  for (std::size_t k = 0; k < profiled.size(); ++k) {
    const Coordinate& coordinate = fit.coordinates[profiled[k]];
    if (!edges[2 * k] || !edges[2 * k + 1]) continue;
    const double one = coordinate.Number(*edges[2 * k]),
                 other = coordinate.Number(*edges[2 * k + 1]);
    estimates[profiled[k]].low = std::min(one, other);
    estimates[profiled[k]].high = std::max(one, other);
  }
}

}  // namespace plenum::calibration
