#include "calibration/profile.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/parallel.h"

namespace plenum::calibration {
namespace {

constexpr double kRise = 3.841;  // 95 % quantile of χ² with one degree of freedom
constexpr double kNearLow = 0.75, kNearHigh = 1.3;  // of kRise: a parabola does for the rest
constexpr double kStepLeast = 0.25, kStepMost = 3.0;
constexpr int kTries = 6;
constexpr int kIterations = 12;
constexpr double kFunctionTolerance = 1e-6;

// One side of one coordinate's interval.
class Side {
 public:
  Side(const FitData& data, const Fit& fit, const Eigen::MatrixXd& covariance, double inflation,
       const FitOptions& options, Eigen::Index j, double sign)
      : data_(data), fit_(fit), covariance_(covariance), options_(options), j_(j), sign_(sign) {
    options_.threads = 1;
    options_.weight = 1.0 / inflation;
    options_.iterations_max = kIterations;
    options_.function_tolerance = kFunctionTolerance;
    options_.fixed = Of(j).parameter;
  }

  // The coordinate where Q has risen by kRise.
  std::optional<double> Edge() const {
    const double most = sign_ > 0.0 ? Of(j_).high - fit_.u[j_] : fit_.u[j_] - Of(j_).low;
    double step = std::min(std::sqrt(kRise * covariance_(j_, j_)), most);
    double below = 0.0, above = most;  // steps known to rise by less, by more
    for (int k = 0; k < kTries && step > 0.0; ++k) {
      const std::optional<double> rise = Rise(step);
      if (!rise) return {};
      if (*rise < kRise && step >= most) return fit_.u[j_] + sign_ * most;
      const double ratio = std::sqrt(kRise / std::max(*rise, 1e-6));
      const bool near = *rise > kNearLow * kRise && *rise < kNearHigh * kRise;
      (*rise < kRise ? below : above) = step;
      step = std::clamp(step * std::clamp(ratio, kStepLeast, kStepMost), below, above);
      if (near) break;
    }
    return fit_.u[j_] + sign_ * step;
  }

 private:
  const Coordinate& Of(Eigen::Index j) const {
    return fit_.coordinates[static_cast<std::size_t>(j)];
  }

  double Q(const Fit& fit) const { return options_.weight * fit.chi2_data + fit.chi2_prior; }

  // From the others' place along the ridge of the parabola.
  std::optional<double> Rise(double step) const {
    ModelState start = fit_.state;
    for (Eigen::Index i = 0; i < fit_.u.size(); ++i) {
      const double along = i == j_ ? 1.0 : covariance_(i, j_) / covariance_(j_, j_);
      const double u = std::clamp(fit_.u[i] + sign_ * step * along, Of(i).low, Of(i).high);
      NumberOf(start, Of(i).parameter) = Of(i).Number(u);
    }
    const Fit moved = FitModel(data_, start, options_);
    if (!moved.Usable()) return {};
    return Q(moved) - Q(fit_);
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
  for (std::size_t j = 0; j < fit.coordinates.size(); ++j)
    if (fit.coordinates[j].parameter.kind == Parameter::Kind::kEffect) profiled.push_back(j);
  std::vector<std::optional<double>> edges(2 * profiled.size());
  ForAll(edges.size(), options.threads, [&](std::size_t k) {
    const auto j = static_cast<Eigen::Index>(profiled[k / 2]);
    edges[k] = Side(data, fit, covariance, inflation, options, j, k % 2 == 0 ? -1.0 : 1.0).Edge();
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
