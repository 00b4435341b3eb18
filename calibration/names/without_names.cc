#include "calibration/names/without_names.h"

#include <string>

#include "calibration/judge/findings.h"
#include "calibration/judge/stated.h"
#include "calibration/learn/slip_kinds.h"
#include "calibration/names/record_warnings.h"

namespace plenum::calibration {

void StatePrediction(const Bench& bench, const Fit& aligned, Diagnosis& diagnosis) {
  diagnosis.noise_pa = NoiseOf(bench, bench.data.runs);
  StateDeclared(bench, diagnosis);
  if (!aligned.Usable()) {
    diagnosis.sentence = "The saved model cannot be run on these data: " + aligned.detail + ".";
    return;
  }
  const Leftover left = LeftoverOf(bench, aligned, false);
  StateModels(bench, aligned, aligned, diagnosis);
  diagnosis.residual = left.residual;
  diagnosis.verdict = IsNoise(left) ? Verdict::kAdequate : Verdict::kUnexplained;
  diagnosis.unexplained_fraction =
      diagnosis.verdict == Verdict::kAdequate ? 0.0 : UnexplainedFraction(left, left);
  AddSeries(bench, diagnosis);
  AddWarnings(bench, diagnosis);
  diagnosis.sentence = diagnosis.verdict == Verdict::kAdequate
                           ? "The saved model predicts these runs to within their noise."
                           : "The saved model leaves structure in these runs.";
}

void StateUnsettled(const Bench& bench, const Fit& base, Diagnosis& diagnosis) {
  diagnosis.verdict = Verdict::kUndecided;
  diagnosis.noise_pa = NoiseOf(bench, bench.data.runs);
  StateDeclared(bench, diagnosis);
  if (base.Usable()) {
    const Leftover left = LeftoverOf(bench, base, false);
    StateModels(bench, base, base, diagnosis);
    static_cast<Estimates&>(diagnosis) = EstimatesOf(bench, base, IntervalsFrom::kCurvature);
    diagnosis.residual = left.residual;
    diagnosis.unexplained_fraction = UnexplainedFraction(left, left);
    AddSeries(bench, diagnosis);
  }
  AddWarnings(bench, diagnosis);
  std::string names;
  for (const SuspectedSlip& slip : diagnosis.slips) names += slip.assume + " or ";
  diagnosis.sentence = "Undecided: " + diagnosis.slips.front().what +
                       ". No effect is named before this is settled: assume " + names +
                       std::string(kAsWritten) + ".";
}

}  // namespace plenum::calibration
