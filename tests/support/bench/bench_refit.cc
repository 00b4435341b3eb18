#include "tests/support/bench/bench_refit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace plenum::test {
namespace {

constexpr double kStepS = 2e-3;
constexpr double kUnknownScale = 0.2;  // of a step in a number without a prior
constexpr int kSteps = 5;
constexpr double kFactorLow = 0.6, kFactorHigh = 1.6;

}  // namespace

Readings BaseReadings(const BenchRig& declared, const std::vector<BenchRun>& runs,
                      const Numbers& factors) {
  Readings readings;
  for (const BenchRun& run : runs) {
    readings.push_back(SimulateEffects(Plant(declared, run, factors), run.t_s, kStepS).measured_pa);
    for (double& p : readings.back()) p -= declared.ambient_pa;
  }
  return readings;
}

double FittedRms(const Readings& a, const Readings& b) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t r = 0; r + 1 < a.size(); ++r) {
    for (std::size_t i = 0; i < a[r].size(); ++i) {
      const double difference = a[r][i] - b[r][i];
      if (std::isnan(difference)) continue;
      sum += difference * difference;
      ++count;
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

BaseFitter::BaseFitter(const BenchRig& declared, const std::vector<BenchRun>& runs,
                       const Numbers& uncertainty, const Numbers& near)
    : declared_(declared), runs_(runs), uncertainty_(uncertainty), near_(near) {
  const Readings at = BaseReadings(declared, runs, near);
  for (std::size_t n = 0; n < uncertainty.size(); ++n) {
    if (uncertainty[n] == 0.0) continue;
    free_.push_back(n);
    scale_.push_back(std::isinf(uncertainty[n]) ? kUnknownScale : uncertainty[n]);
    const double delta = 0.2 * scale_.back();
    Numbers moved = near;
    moved[n] += delta;
    sensitivity_.push_back(BaseReadings(declared, runs, moved));
    for (std::size_t r = 0; r < runs.size(); ++r) {
      for (std::size_t i = 0; i < at[r].size(); ++i) {
        double& s = sensitivity_.back()[r][i];
        s = (s - at[r][i]) / delta * scale_.back();
      }
    }
  }
}

// Normal equations of the step from a fit, and its objective.
struct BaseFitter::Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;
  double objective = 0.0;
};

BaseFitter::Normal BaseFitter::NormalAt(const BaseFit& fit, const Readings& data,
                                        double noise_pa) const {
  const auto k = static_cast<Eigen::Index>(free_.size());
  Normal normal{Eigen::MatrixXd::Zero(k, k), Eigen::VectorXd::Zero(k), 0.0};
  Eigen::VectorXd row(k);
  for (std::size_t r = 0; r + 1 < runs_.size(); ++r) {
    for (std::size_t i = 0; i < data[r].size(); ++i) {
      const double residual = (data[r][i] - fit.predicted[r][i]) / noise_pa;
      if (std::isnan(residual)) continue;
      for (Eigen::Index j = 0; j < k; ++j) row[j] = sensitivity_[j][r][i] / noise_pa;
      normal.matrix.selfadjointView<Eigen::Lower>().rankUpdate(row);
      normal.gradient += residual * row;
      normal.objective += residual * residual;
    }
  }
  for (Eigen::Index j = 0; j < k; ++j) {
    if (std::isinf(uncertainty_[free_[j]])) continue;
    const double off = (fit.factors[free_[j]] - 1.0) / scale_[j];
    normal.matrix(j, j) += 1.0;
    normal.gradient[j] -= off;
    normal.objective += off * off;
  }
  return normal;
}

BaseFit BaseFitter::Fit(const Readings& data, double noise_pa) const {
  BaseFit best;
  best.factors = near_;
  best.predicted = BaseReadings(declared_, runs_, near_);
  Normal at = NormalAt(best, data, noise_pa);
  double share = 1.0;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::VectorXd move =
        at.matrix.selfadjointView<Eigen::Lower>().ldlt().solve(at.gradient);
    BaseFit next = best;
    for (std::size_t j = 0; j < free_.size(); ++j) {
      double& factor = next.factors[free_[j]];
      factor += share * move[static_cast<Eigen::Index>(j)] * scale_[j];
      double low = kFactorLow;
      if (free_[j] == kExpansionRatio) low = std::max(low, 1.0 / declared_.expansion_ratio);
      factor = std::clamp(factor, low, kFactorHigh);
    }
    next.predicted = BaseReadings(declared_, runs_, next.factors);
    Normal there = NormalAt(next, data, noise_pa);
    if (there.objective < at.objective) {
      best = std::move(next);
      at = std::move(there);
      share = 1.0;
    } else {
      share *= 0.3;
    }
  }
  best.rms_pa = FittedRms(data, best.predicted);
  return best;
}

}  // namespace plenum::test
