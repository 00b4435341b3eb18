// What a fit tells of its numbers: the price of each in BIC, and how far the readings fix it.
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numbers>

#include "calibration/fit/fit.h"
#include "calibration/fit/run_cost.h"
#include "calibration/noise/whiteness.h"
#include "calibration/values/parallel.h"
#include "calibration/values/symmetric.h"

namespace plenum::calibration {
namespace {

constexpr double kTwoSided95 = 1.96;
constexpr double kLeastCurvature = 1e-12;

// The number at u, held within the bounds.
double Edge(const Coordinate& coordinate, double u) {
  return coordinate.Number(std::clamp(u, coordinate.low, coordinate.high));
}

}  // namespace

// Numbers with a prior are the same in every model and do not count.
double Penalty(const Fit& fit, double memory) {
  const double most = std::log(std::max(1.0, static_cast<double>(fit.rows) / memory));
  const auto free = std::count_if(fit.coordinates.begin(), fit.coordinates.end(),
                                  [](const Coordinate& coordinate) { return !coordinate.prior; });
  double penalty = (static_cast<double>(free) - static_cast<double>(fit.narrowed.size())) * most;
  for (const double nats : fit.narrowed) penalty += std::clamp(nats - std::log(memory), 0.0, most);
  return penalty;
}

double Bic(const Fit& fit) {
  const double n = static_cast<double>(fit.rows);
  return n * std::log(fit.chi2_data / n) + fit.chi2_prior + Penalty(fit, 1.0);
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

ModelState Unstretched(const FitData& data, const Fit& fit) {
  ModelState state = fit.state;
  if (PriorsHold(fit)) return state;
  const ModelState declared = data.forward->Declared();
  for (const Coordinate& coordinate : fit.coordinates)
    if (coordinate.parameter.kind == Parameter::Kind::kDeclared && coordinate.prior)
      NumberOf(state, coordinate.parameter) = NumberOf(declared, coordinate.parameter);
  return state;
}

double Inflation(const Fit& fit, double memory) {
  const double freedom =
      static_cast<double>(fit.rows) - static_cast<double>(fit.coordinates.size());
  return memory * std::max(1.0, fit.chi2_data / std::max(1.0, freedom));
}

Eigen::MatrixXd Covariance(const FitData& data, const Fit& fit, const FitOptions& options,
                           double memory) {
  const auto size = static_cast<Eigen::Index>(fit.coordinates.size());
  if (size == 0)
    return Eigen::MatrixXd(0, 0);  // nothing was fitted; Eigen decomposes no empty matrix
  std::vector<Eigen::MatrixXd> of_runs(data.runs.size(), Eigen::MatrixXd::Zero(size, size));
  ForAll(data.runs.size(), options.threads, [&](std::size_t i) {
    const std::size_t run = data.runs[i];
    const RunCost cost(data, run, fit.state, fit.coordinates, OptionsOf(data, run, options));
    const Eigen::Index rows = cost.num_residuals();
    Eigen::VectorXd residuals(rows);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows, size);
    const double* blocks[] = {fit.u.data()};
    double* jacobians[] = {jacobian.data()};
    if (cost.Evaluate(blocks, residuals.data(), jacobians))
      of_runs[i] = jacobian.transpose() * jacobian;
  });
  Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(size, size);
  for (const Eigen::MatrixXd& of_run : of_runs) curvature += of_run;
  curvature /= Inflation(fit, memory);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Coordinate& coordinate = fit.coordinates[static_cast<std::size_t>(j)];
    if (coordinate.prior) curvature(j, j) += 1.0;
  }
  // By eigenvalues of the scaled curvature: directions without any leave their parameters unknown.
  const Eigen::VectorXd scale = curvature.diagonal().cwiseMax(kLeastCurvature).cwiseSqrt();
  const Eigen::MatrixXd scaled =
      scale.cwiseInverse().asDiagonal() * curvature * scale.cwiseInverse().asDiagonal();
  const SymmetricEigen eigen = EigenOf(scaled);
  const Eigen::VectorXd spread = eigen.values.cwiseMax(kLeastCurvature).cwiseInverse();
  const Eigen::VectorXd unit = scale.cwiseInverse();
  return unit.asDiagonal() * eigen.vectors * spread.asDiagonal() * eigen.vectors.transpose() *
         unit.asDiagonal();
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

}  // namespace plenum::calibration
