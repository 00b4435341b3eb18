// The terms of a fit's χ² (fit.h) as cost functions of Ceres.
#ifndef PLENUM_CALIBRATION_FIT_RUN_COST_H_
#define PLENUM_CALIBRATION_FIT_RUN_COST_H_

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/iteration_callback.h>

#include <Eigen/Core>
#include <chrono>
#include <span>
#include <vector>

#include "calibration/fit/fit_data.h"

namespace plenum::calibration {

PredictOptions OptionsOf(const FitData& data, std::size_t run, const FitOptions& options);

// The start with its coordinates at u; numbers of effects are held within their physical range.
ModelState StateAt(const ModelState& start, const std::vector<Coordinate>& coordinates,
                   const double* u);

// Counts the steps that a search has made, over all its laps.
class StepsLeft : public ceres::IterationCallback {
 public:
  explicit StepsLeft(int steps_max) : left_(steps_max) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    if (step.iteration > 0) --left_;
    return ceres::SOLVER_CONTINUE;
  }
  // Of a step that is being made: whether none may follow.
  bool Last() const { return left_ <= 1; }

 private:
  int left_;
};

// One run over all k coordinates as one block of k + 1 rows. The search needs of the residuals e
// and their derivatives J only JᵀJ, Jᵀe and eᵀe, so that the rows are R of [J e] = Q·R, which has
// the same products and none of the readings' number; without derivatives the one row |e|. A step
// is asked for twice at one point — for its cost, and for the derivatives there — and simulated
// once without derivatives, and once with them where it is taken: unless no step is to follow, when
// Ceres gets those of the point before, and uses none. Derivatives only lead the search and are
// simulated less exactly; e never is. A run that turned out stiff is taken to stay so: the explicit
// method is not tried again.
class RunCost : public ceres::CostFunction {
 public:
  // References must outlive it.
  RunCost(const FitData& data, std::size_t run, const ModelState& start,
          const std::vector<Coordinate>& coordinates, const PredictOptions& options,
          double weight = 1.0, const StepsLeft* steps = nullptr);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;
  // Simulates the run there, unless that is known.
  void Prepare(const double* u, bool derive) const;

 private:
  template <class Value>
  struct Known {
    Eigen::VectorXd u;
    Value value;
    bool At(const Eigen::Map<const Eigen::VectorXd>& v) const {
      return u.size() == v.size() && u == v;
    }
  };

  Eigen::Index size() const { return static_cast<Eigen::Index>(coordinates_.size()); }
  const ObservedRun& Observed() const { return (*data_.observed)[run_]; }
  Prediction Predict(const double* u, std::span<const Parameter> parameters) const;
  std::vector<double> ResidualsAt(const double* u) const;
  Eigen::MatrixXd RootAt(const double* u) const;
  double SlopeOf(Eigen::Index j, const double* u) const;

  const FitData& data_;
  std::size_t run_;
  const ModelState& start_;
  const std::vector<Coordinate>& coordinates_;
  const StepsLeft* steps_;
  std::vector<Parameter> parameters_;
  mutable PredictOptions options_;
  mutable bool strict_ = false;  // derivatives as exact as the readings
  double scale_;                 // of the residuals
  // At the last point tried, and at the last with derivatives; empty where the run failed.
  mutable Known<std::vector<double>> residuals_;
  mutable Known<Eigen::MatrixXd> root_;
};

// Prepares the runs on several threads, those first that took longest: they take unlike long, and
// Ceres would give each thread as many of them in a row.
class RunsAtOnce : public ceres::EvaluationCallback {
 public:
  RunsAtOnce(const double* u, int threads) : u_(u), threads_(threads) {}
  void Add(const RunCost* run) { runs_.push_back({run}); }
  void PrepareForEvaluation(bool derive, bool new_point) override;

 private:
  const double* u_;  // where Ceres has the point
  int threads_;
  struct Timed {
    const RunCost* cost;
    std::chrono::steady_clock::duration longest = {};
  };
  std::vector<Timed> runs_;
};

// u of every coordinate that has a prior.
class PriorCost : public ceres::CostFunction {
 public:
  explicit PriorCost(const std::vector<Coordinate>& coordinates);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

 private:
  std::size_t size_;
  std::vector<std::size_t> with_prior_;
};

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_RUN_COST_H_
