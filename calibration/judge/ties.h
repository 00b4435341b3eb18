// Sets of effects that the data cannot tell apart, and the run that would.
#ifndef PLENUM_CALIBRATION_JUDGE_TIES_H_
#define PLENUM_CALIBRATION_JUDGE_TIES_H_

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/experiment/experiment.h"
#include "calibration/judge/errors.h"
#include "calibration/search/contenders.h"

namespace plenum::calibration {

// The chosen set and those of its size that do as well, the chosen one first, each set of ids once:
// within `reach` of its BIC, residuals worth 1/memory of their number. Where one run is all there
// is also those within `reach` of its evidence, and those whose gap is within kTieScatter times its
// scatter (closeness.h). Not those that do no better than a set of some of their effects, or stand
// at the limit of a wider law alone (wider_laws.h).
std::vector<const Contender*> TiedWith(const Bench& bench, std::span<const Contender> contenders,
                                       const Contender& chosen, double memory, double reach);

// The run that would tell them apart; else why there is none, or why it may not.
struct Proposal {
  std::optional<Experiment> experiment;
  std::string why_none, caution;
};

// With a usable `by_the_clock`, no effects but the clock of the only run off, the run must part
// them from that too, and all may move the clocks.
Proposal ProposalFor(const Bench& bench, const std::vector<const Contender*>& tied,
                     const Fit& by_the_clock);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_TIES_H_
