#include "optimizer/search/conclusion.h"

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {

double ObjectiveLimit(const Problem& problem) {
  const Objective& o = problem.objective;
  if (o == Objective{.mass_kg = o.mass_kg}) return o.mass_kg * problem.mass_max_kg;
  if (o == Objective{.volume_l = o.volume_l}) return o.volume_l * problem.volume_max_l;
  if (o == Objective{.cost_eur = o.cost_eur}) return o.cost_eur * problem.cost_max_eur;
  return kUnlimited;
}

double GapOf(double lower_bound, double last) {
  return std::isfinite(lower_bound) && last > 0.0 ? std::max(0.0, 1.0 - lower_bound / last) : 0.0;
}

Answer Conclude(const Problem& problem, const Ending& ending, Proof proof, Ranking& ranking,
                Recorder& recorder) {
  Answer answer;
  for (Found& found : ranking.list()) {
    if (static_cast<int>(answer.designs.size()) == problem.count || !found.design) break;
    if (found.record >= 0)
      recorder.Close(found.record, {.kind = BoxKind::kDesign,
                                    .design = static_cast<int>(answer.designs.size()),
                                    .bound = found.leaf.objective});
    answer.designs.push_back(std::move(*found.design));
  }
  // Designs with a choice that was left out are no better than the last of a full list.
  if (proof.pruned.dominated > 0 && static_cast<int>(answer.designs.size()) == problem.count)
    proof.lower_bound = std::min(proof.lower_bound, ranking.last().leaf.objective);
  if (!answer.designs.empty())
    proof.gap = GapOf(proof.lower_bound, answer.designs.back().objective);
  else
    proof.gap = ending.stopped || proof.undecided > 0 ? 1.0 : 0.0;
  const bool ended = ending.stopped || (ending.any_design && !answer.designs.empty());
  // An undecided leaf may be a further design of a list that is not full.
  const bool full = static_cast<int>(answer.designs.size()) == problem.count;
  const bool closed = full || !std::isfinite(proof.lower_bound);
  proof.complete =
      !ended && (answer.designs.empty() ? proof.undecided == 0 : closed && proof.gap <= kTie);
  answer.status = ending.cancelled         ? Status::kCancelled
                  : !proof.complete        ? Status::kFeasible
                  : answer.designs.empty() ? Status::kInfeasible
                                           : Status::kOptimal;
  proof.record = recorder.Finish(problem);
  answer.proof = std::move(proof);
  answer.seconds = ending.seconds;
  return answer;
}

}  // namespace plenum::optimizer
