// Stop pressure and volume of a made-to-measure reservoir as a small smooth program near a point:
// the objective, and every margin as a constraint, with exact first derivatives.
#ifndef PLENUM_OPTIMIZER_SIZING_SIZING_PROGRAM_H_
#define PLENUM_OPTIMIZER_SIZING_SIZING_PROGRAM_H_

#include <optional>

#include "optimizer/sizing/nlp.h"
#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {

// x[0] is the share of the window of source pressures, x[1] the volume by that of the start, within
// a tenth of it. The program refers to problem and candidate.
class SizingProgram {
 public:
  // None where there is no freedom, or where the start does not work.
  static std::optional<SizingProgram> At(const Problem& problem, const Candidate& candidate,
                                         const OperatingPoint& start);
  Nlp MakeNlp() const;
  OperatingPoint PointOf(const std::vector<double>& x) const;

 private:
  SizingProgram(const Problem& problem, const Candidate& candidate, const OperatingPoint& start)
      : problem_(&problem), candidate_(&candidate), start_(start) {}
  bool Evaluate(const std::vector<double>& x, NlpValues& values) const;
  bool Differentiate(const std::vector<double>& x, NlpDerivatives& derivatives) const;

  const Problem* problem_;
  const Candidate* candidate_;
  OperatingPoint start_;
  Window window_{0.0, 0.0};
  double scale_ = 1.0;  // of the objective
  int constraints_ = 0;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SIZING_SIZING_PROGRAM_H_
