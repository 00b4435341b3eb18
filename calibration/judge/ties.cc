#include "calibration/judge/ties.h"

#include <algorithm>

#include "calibration/judge/closeness.h"
#include "calibration/judge/evidence.h"
#include "calibration/judge/findings.h"
#include "calibration/judge/wider_laws.h"
#include "calibration/values/thresholds.h"

namespace plenum::calibration {

namespace {

// Whether the set does better than every set of some of its effects.
bool Improves(std::span<const Contender> contenders, const Contender& set, double memory) {
  const double bic = BicWith(set.fit, memory);
  return std::none_of(contenders.begin(), contenders.end(), [&](const Contender& part) {
    return part.effects.size() < set.effects.size() && Contains(set, part) && part.fit.Usable() &&
           BicWith(part.fit, memory) <= bic;
  });
}

std::optional<Experiment> ExperimentFor(const Bench& bench,
                                        const std::vector<const Contender*>& tied,
                                        const Fit& by_the_clock) {
  FitData data = bench.data;
  std::vector<Fit> with_clocks;
  if (by_the_clock.Usable()) {
    data.clocks = true;
    for (const Contender* contender : tied)
      with_clocks.push_back(FitModel(data, contender->fit.state, bench.tight));
  }
  std::vector<TiedFit> fits;
  for (std::size_t i = 0; i < tied.size(); ++i)
    fits.push_back({IdsOf(*tied[i]), with_clocks.empty() ? &tied[i]->fit : &with_clocks[i]});
  if (by_the_clock.Usable()) fits.push_back({{}, &by_the_clock});
  const bool usable =
      std::all_of(fits.begin(), fits.end(), [](const TiedFit& one) { return one.fit->Usable(); });
  return usable ? DesignExperiment(data, fits, bench.tight) : std::nullopt;
}

}  // namespace

std::vector<const Contender*> TiedWith(const Bench& bench, std::span<const Contender> contenders,
                                       const Contender& chosen, double memory, double reach) {
  const double worth = static_cast<double>(chosen.fit.rows) / memory;
  const bool alone = (IsOneRecording(bench.data) && bench.held_out.empty()) || worth < kFewReadings;
  const double evidence = alone ? EvidenceOf(bench, chosen.fit, memory) : 0.0;
  const auto apart = [&](const Fit& other) {
    const bool worse = BicWith(other, memory) > BicWith(chosen.fit, memory) + reach;
    if (!worse || !alone) return worse;
    const Gap gap = GapTo(bench, chosen.fit, other, memory);
    return gap.size > kTieScatter * gap.scatter &&
           EvidenceOf(bench, other, memory) > evidence + reach;
  };
  std::vector<const Contender*> tied = {&chosen};
  for (const Contender& contender : contenders) {
    if (contender.effects.size() != chosen.effects.size() || !contender.fit.Usable()) continue;
    if (!MayBeNamed(contender) || apart(contender.fit)) continue;
    const bool known = std::any_of(tied.begin(), tied.end(), [&](const Contender* other) {
      return SameEffects(contender, *other);
    });
    if (!known) tied.push_back(&contender);
  }
  std::erase_if(tied, [&](const Contender* one) {
    return one != &chosen &&
           (!Improves(contenders, *one, memory) || FitsNoBetter(*one, contenders));
  });
  const std::vector<const Contender*> all = tied;
  std::erase_if(tied, [&](const Contender* wide) {
    return wide != &chosen && std::any_of(all.begin(), all.end(), [&](const Contender* narrow) {
             return StandsAtLimitAlone(bench, *wide, *narrow, memory);
           });
  });
  return tied;
}

Proposal ProposalFor(const Bench& bench, const std::vector<const Contender*>& tied,
                     const Fit& by_the_clock) {
  Proposal proposal{ExperimentFor(bench, tied, by_the_clock), {}, {}};
  if (!proposal.experiment) {
    proposal.why_none = Stopped(bench) ? "there was no time left to look for a run"
                                       : "no run that could tell them apart can be simulated";
  } else if (proposal.experiment->expected_delta_bic < kTie) {
    proposal.experiment.reset();
    proposal.why_none =
        "no run within the range of these data would part them: each set can follow what any "
        "other would show";
  } else if (proposal.experiment->expected_delta_bic < kDecisiveDeltaBic) {
    proposal.caution =
        "no run within the range of these data is expected to tell them apart for sure: the one "
        "proposed comes nearest";
  }
  return proposal;
}

}  // namespace plenum::calibration
