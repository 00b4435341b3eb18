#include "bench/diagnosis/correction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

namespace plenum::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Root mean square and its number of samples for one run predicted from others.
using Predictor = std::function<VectorXd(const Sample& learned, const MatrixXd& at)>;

Sample Joined(const std::vector<Sample>& runs, std::size_t count, std::size_t left_out) {
  Index rows = 0;
  for (std::size_t r = 0; r < count; ++r) rows += r == left_out ? 0 : runs[r].residual.size();
  Sample all{MatrixXd(rows, runs[0].features.cols()), VectorXd(rows)};
  Index at = 0;
  for (std::size_t r = 0; r < count; ++r) {
    if (r == left_out) continue;
    const Index n = runs[r].residual.size();
    all.features.middleRows(at, n) = runs[r].features;
    all.residual.segment(at, n) = runs[r].residual;
    at += n;
  }
  return all;
}

double SquaredError(const Predictor& predict, const std::vector<Sample>& runs, std::size_t count,
                    std::size_t tested) {
  const Sample learned = Joined(runs, count, tested);
  const Sample& test = runs[tested];
  return (test.residual - predict(learned, test.features)).squaredNorm();
}

// The best predictor by leaving out each fitted run, then its RMS on the last.
double HeldOutError(const std::vector<Predictor>& predictors, const std::vector<Sample>& runs) {
  const std::size_t fitted = runs.size() - 1;
  const Predictor* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Predictor& predict : predictors) {
    double sum = 0.0;
    for (std::size_t r = 0; r < fitted; ++r) sum += SquaredError(predict, runs, fitted, r);
    if (sum < least) {
      least = sum;
      best = &predict;
    }
  }
  const double squares = SquaredError(*best, runs, fitted, fitted);
  return std::sqrt(squares / static_cast<double>(runs.back().residual.size()));
}

VectorXd Ridge(double penalty, const Sample& learned, const MatrixXd& at) {
  MatrixXd normal = learned.features.transpose() * learned.features;
  normal.diagonal().array() += penalty * static_cast<double>(learned.residual.size());
  return at * normal.ldlt().solve(learned.features.transpose() * learned.residual);
}

VectorXd Neighbours(std::size_t count, const Sample& learned, const MatrixXd& at) {
  VectorXd predicted(at.rows());
  std::vector<std::pair<double, Index>> distance(static_cast<std::size_t>(learned.residual.size()));
  for (Index i = 0; i < at.rows(); ++i) {
    const VectorXd away = (learned.features.rowwise() - at.row(i)).rowwise().squaredNorm();
    for (Index j = 0; j < away.size(); ++j) distance[static_cast<std::size_t>(j)] = {away[j], j};
    const std::size_t k = std::min(count, distance.size());
    std::nth_element(distance.begin(), distance.begin() + static_cast<std::ptrdiff_t>(k - 1),
                     distance.end());
    double sum = 0.0;
    for (std::size_t n = 0; n < k; ++n) sum += learned.residual[distance[n].second];
    predicted[i] = sum / static_cast<double>(k);
  }
  return predicted;
}

}  // namespace

MatrixXd Features(const calibration::Run& run, const std::vector<double>& predicted_pa) {
  const double span_pa = run.chamber.operating_pressure_pa - run.ambient.pressure_pa;
  constexpr Index kRaw = 8;
  const auto n = static_cast<Index>(predicted_pa.size());
  MatrixXd raw = MatrixXd::Zero(n, kRaw);
  std::size_t command = 0;
  for (Index i = 0; i < n; ++i) {
    const auto s = static_cast<std::size_t>(i);
    while (command + 1 < run.valve.size() && run.valve[command + 1].time_s <= run.t_s[s]) ++command;
    const std::size_t before = s > 0 ? s - 1 : 0, after = std::min(s + 1, predicted_pa.size() - 1);
    const double rate = (predicted_pa[after] - predicted_pa[before]) /
                        std::max(run.t_s[after] - run.t_s[before], 1e-9);
    const model::ValveState state = run.valve[command].state;
    const double source_pa = run.channels.source_pressure_pa.empty()
                                 ? run.source_pressure_pa
                                 : run.channels.source_pressure_pa[s];
    raw.row(i) << 1.0, (predicted_pa[s] - run.ambient.pressure_pa) / span_pa, 0.2 * rate / span_pa,
        state == model::ValveState::kInflate, state == model::ValveState::kDeflate,
        std::log1p(std::max(0.0, run.t_s[s] - run.valve[command].time_s)),
        std::isfinite(source_pa) ? (source_pa - run.ambient.pressure_pa) / (2.0 * span_pa) : 0.0,
        run.blocked;
  }
  MatrixXd features(n, kRaw * (kRaw + 1) / 2);
  Index column = 0;
  for (Index a = 0; a < kRaw; ++a) {
    for (Index b = a; b < kRaw; ++b) {
      features.col(column++) = raw.col(a).cwiseProduct(raw.col(b));
    }
  }
  return features;
}

double RidgeError(const std::vector<Sample>& runs) {
  std::vector<Predictor> predictors;
  for (const double penalty : {1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 1e3}) {
    predictors.push_back(
        [=](const Sample& learned, const MatrixXd& at) { return Ridge(penalty, learned, at); });
  }
  return HeldOutError(predictors, runs);
}

double NeighbourError(const std::vector<Sample>& runs) {
  std::vector<Predictor> predictors;
  for (const std::size_t count : {5, 20, 80}) {
    predictors.push_back(
        [=](const Sample& learned, const MatrixXd& at) { return Neighbours(count, learned, at); });
  }
  return HeldOutError(predictors, runs);
}

}  // namespace plenum::bench
