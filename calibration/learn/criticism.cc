#include "calibration/learn/criticism.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "calibration/values/parallel.h"
#include "calibration/values/symmetric.h"
#include "model/effects/learned/learned.h"

namespace plenum::calibration {
namespace {

constexpr double kLeast = 1e-300;
constexpr double kRidge = 1e-10;  // of a unit diagonal: numbers that nothing depends on
constexpr double kOwn = 1e-4;     // of a unit square: what a direction must have beside the fit's

// A term with all numbers that stand for its size at 0, and which those are.
struct Term {
  model::Effect absent;
  std::vector<std::size_t> sizes;
};

std::vector<Term> Terms() {
  std::vector<Term> terms;
  const auto add = [&](const char* id, const char* law) {
    const model::EffectSpec* spec = model::FindEffect(id, law);
    Term term{{spec, std::vector<double>(spec->parameters.size(), 0.0)}, {}};
    for (std::size_t i = 0; i < spec->parameters.size(); ++i) term.sizes.push_back(i);
    terms.push_back(std::move(term));
  };
  add("learned_leak", "pressure_5");
  add("learned_conductance", "pressure_5");
  add("learned_conductance", "expansion_5");
  add("learned_volume", "pressure_5");
  add("learned_volume", "memory_1");
  add("learned_sensor", "pressure_5");
  for (const double place : {0.3, 0.55, 0.8}) {
    terms.push_back({{model::FindEffect("learned_leak", "opening"), {0.0, place, 0.05}}, {0}});
    terms.push_back({{model::FindEffect("learned_volume", "bend"), {0.0, place, 0.05}}, {0}});
  }
  return terms;
}

// A run at the fit: its residuals, and their derivatives along the fit's coordinates.
struct AtFit {
  Eigen::VectorXd e;
  Eigen::MatrixXd j;
};

// JᵀJ, JᵀA, AᵀA, Jᵀe and Aᵀe over all runs.
struct Sums {
  Eigen::MatrixXd jj, ja, aa;
  Eigen::VectorXd je, ae;  // with the priors' pull in je
};

PredictOptions OptionsOf(const FitOptions& options) {
  PredictOptions predict;
  predict.steps_max = options.steps_max;
  predict.cancelled = options.cancelled;
  return predict;
}

// Of the run's whitened readings, by parameter; with the residuals as one column more. Empty where
// the run cannot be simulated.
Eigen::MatrixXd Derivatives(const FitData& data, const ModelState& state,
                            const std::vector<Parameter>& parameters, std::size_t run,
                            const FitOptions& options) {
  const Prediction prediction = data.forward->Predict(run, state, parameters, OptionsOf(options));
  if (prediction.status != model::SimulateStatus::kDone) return {};
  const ObservedRun& observed = (*data.observed)[run];
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(observed.rows()), count + 1);
  const auto column = [&](Eigen::Index k) {
    return std::span<double>(columns.col(k).data(), observed.rows());
  };
  const Run& measured = data.forward->dataset().runs[run];
  const std::vector<double> slopes = GridSlopes(measured, observed, prediction.reading);
  for (Eigen::Index k = 0; k < count; ++k)
    Whitened(observed, prediction.derivatives[static_cast<std::size_t>(k)], slopes, column(k));
  Residuals(measured, observed, prediction.reading, column(count));
  return columns;
}

// Without derivatives where the run cannot be simulated.
AtFit RunAtFit(const FitData& data, const Fit& fit, std::size_t run, const FitOptions& options) {
  std::vector<Parameter> parameters;
  for (const Coordinate& coordinate : fit.coordinates) parameters.push_back(coordinate.parameter);
  const Eigen::MatrixXd columns = Derivatives(data, fit.state, parameters, run, options);
  if (columns.size() == 0) return {};
  const auto count = static_cast<Eigen::Index>(parameters.size());
  AtFit at{columns.col(count), columns.leftCols(count)};
  for (Eigen::Index k = 0; k < count; ++k)
    at.j.col(k) *= fit.coordinates[static_cast<std::size_t>(k)].Slope(fit.u[k]);
  return at;
}

bool AddRun(const FitData& data, const Fit& fit, const AtFit& at, const Term& term, std::size_t run,
            const FitOptions& options, Sums& sums) {
  ModelState state = fit.state;
  state.effects.push_back(term.absent);
  std::vector<Parameter> parameters;
  for (const std::size_t number : term.sizes)
    parameters.push_back(
        {.kind = Parameter::Kind::kEffect, .effect = state.effects.size() - 1, .number = number});
  const Eigen::MatrixXd columns = Derivatives(data, state, parameters, run, options);
  if (columns.size() == 0) return false;
  const auto a = columns.leftCols(columns.cols() - 1);
  sums.ja += at.j.transpose() * a;
  sums.aa += a.transpose() * a;
  sums.ae += a.transpose() * at.e;
  return true;
}

// Δχ². Directions of the term that the fitted numbers all but span count as theirs.
double Gain(const Sums& sums) {
  Eigen::MatrixXd m = sums.aa;
  Eigen::VectorXd g = sums.ae;
  if (sums.jj.rows() > 0) {
    const Eigen::VectorXd unit = sums.jj.diagonal().cwiseMax(kLeast).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled =
        unit.asDiagonal() * sums.jj * unit.asDiagonal() +
        kRidge * Eigen::MatrixXd::Identity(sums.jj.rows(), sums.jj.rows());
    const Eigen::MatrixXd taken =
        unit.asDiagonal() * SolvedSymmetric(scaled, Eigen::MatrixXd(unit.asDiagonal() * sums.ja));
    m -= sums.ja.transpose() * taken;
    g -= taken.transpose() * sums.je;
  }
  const Eigen::VectorXd unit = sums.aa.diagonal().cwiseMax(kLeast).cwiseSqrt().cwiseInverse();
  const SymmetricEigen eigen = EigenOf(unit.asDiagonal() * m * unit.asDiagonal());
  const Eigen::VectorXd along = eigen.vectors.transpose() * (unit.asDiagonal() * g);
  double gain = 0.0;
  for (Eigen::Index k = 0; k < along.size(); ++k)
    if (eigen.values[k] > kOwn) gain += along[k] * along[k] / eigen.values[k];
  return gain;
}

}  // namespace

double LearnableGain(const FitData& data, const Fit& fit, double memory,
                     const FitOptions& options) {
  const auto fitted = static_cast<Eigen::Index>(fit.coordinates.size());
  std::vector<AtFit> runs(data.runs.size());
  ForAll(runs.size(), options.threads,
         [&](std::size_t i) { runs[i] = RunAtFit(data, fit, data.runs[i], options); });
  Eigen::MatrixXd jj = Eigen::MatrixXd::Zero(fitted, fitted);
  Eigen::VectorXd je = Eigen::VectorXd::Zero(fitted);
  for (const AtFit& at : runs) {
    if (at.e.size() == 0) return 0.0;
    jj += at.j.transpose() * at.j;
    je += at.j.transpose() * at.e;
  }
  for (Eigen::Index j = 0; j < fitted; ++j) {
    if (!fit.coordinates[static_cast<std::size_t>(j)].prior) continue;
    jj(j, j) += 1.0;
    je[j] += fit.u[j];
  }
  const double worth = static_cast<double>(fit.rows) / memory;
  const std::vector<Term> terms = Terms();
  std::vector<double> bics(terms.size(), 0.0);
  ForAll(terms.size(), options.threads, [&](std::size_t i) {
    const auto numbers = static_cast<Eigen::Index>(terms[i].sizes.size());
    Sums sums{jj, Eigen::MatrixXd::Zero(fitted, numbers), Eigen::MatrixXd::Zero(numbers, numbers),
              je, Eigen::VectorXd::Zero(numbers)};
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (options.cancelled && options.cancelled()) return;
      if (!AddRun(data, fit, runs[k], terms[i], data.runs[k], options, sums)) return;
    }
    const double gain = std::min(Gain(sums), 0.5 * fit.chi2_data);
    bics[i] = worth * std::log(fit.chi2_data / (fit.chi2_data - gain)) -
              static_cast<double>(numbers) * std::log(std::max(1.0, worth));
  });
  return std::max(0.0, *std::max_element(bics.begin(), bics.end()));
}

}  // namespace plenum::calibration
