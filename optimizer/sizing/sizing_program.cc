#include "optimizer/sizing/sizing_program.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/sizing/stroke_gradients.h"

namespace plenum::optimizer {

std::optional<SizingProgram> SizingProgram::At(const Problem& problem, const Candidate& candidate,
                                               const OperatingPoint& start) {
  SizingProgram program(problem, candidate, start);
  program.window_ = SourceWindow(problem, candidate);
  if (!(program.window_.high_pa > program.window_.low_pa) ||
      !(start.reservoir_m3 > model::kMadeReservoirSmallestM3))
    return std::nullopt;
  const Evaluation evaluation = optimizer::Evaluate(problem, candidate, start);
  if (!evaluation.works) return std::nullopt;
  program.scale_ = std::abs(ObjectiveValue(problem, candidate, start, evaluation));
  program.constraints_ =
      static_cast<int>(SolverMargins(problem, candidate, start, evaluation).size());
  return program;
}

OperatingPoint SizingProgram::PointOf(const std::vector<double>& x) const {
  const double volume_m3 = x[1] * start_.reservoir_m3;
  return {window_.low_pa + x[0] * (window_.high_pa - window_.low_pa), volume_m3, volume_m3};
}

Nlp SizingProgram::MakeNlp() const {
  Nlp nlp;
  nlp.low = {0.0, std::max(0.9, model::kMadeReservoirSmallestM3 / start_.reservoir_m3)};
  nlp.high = {1.0, std::min(1.1, model::kMadeReservoirLargestM3 / start_.reservoir_m3)};
  nlp.start = {(start_.source_pa - window_.low_pa) / (window_.high_pa - window_.low_pa), 1.0};
  nlp.constraints = constraints_;
  nlp.evaluate = [this](const auto& x, NlpValues& values) { return Evaluate(x, values); };
  nlp.differentiate = [this](const auto& x, NlpDerivatives& derivatives) {
    return Differentiate(x, derivatives);
  };
  nlp.stop = [this] { return candidate_->stopped(); };
  return nlp;
}

bool SizingProgram::Evaluate(const std::vector<double>& x, NlpValues& values) const {
  const OperatingPoint point = PointOf(x);
  const Evaluation evaluation = optimizer::Evaluate(*problem_, *candidate_, point);
  if (!evaluation.works) return false;
  values.objective = ObjectiveValue(*problem_, *candidate_, point, evaluation) / scale_;
  values.constraints = SolverMargins(*problem_, *candidate_, point, evaluation);
  return true;
}

bool SizingProgram::Differentiate(const std::vector<double>& x, NlpDerivatives& derivatives) const {
  using model::Dual;
  const OperatingPoint point = PointOf(x);
  const Strokes values = EvaluateStrokes(*problem_, *candidate_, point);
  if (!values.works) return false;
  const std::optional<StrokesOf<Dual>> strokes =
      DifferentiateStrokes(*problem_, *candidate_, point, values);
  if (!strokes) return false;
  const Dual volume_m3(point.reservoir_m3, kAlongVolume);
  const OperatingPointOf<Dual> lifted{Dual(point.source_pa, kAlongPressure), volume_m3, volume_m3};
  const EvaluationOf<Dual> evaluation = EvaluateWith(*strokes, *problem_, *candidate_, lifted);
  const auto along_x = [&](const Dual& value) {
    return std::vector<double>{value.v[kAlongPressure] * (window_.high_pa - window_.low_pa),
                               value.v[kAlongVolume] * start_.reservoir_m3};
  };
  derivatives.gradient =
      along_x(ObjectiveValue(*problem_, *candidate_, lifted, evaluation) / scale_);
  derivatives.jacobian.clear();
  for (const Dual& margin : SolverMargins(*problem_, *candidate_, lifted, evaluation))
    derivatives.jacobian.push_back(along_x(margin));
  return true;
}

}  // namespace plenum::optimizer
