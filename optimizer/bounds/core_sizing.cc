#include "optimizer/bounds/core_sizing.h"

#include <algorithm>

#include "optimizer/bounds/box.h"

namespace plenum::optimizer {

bool Bounds::CanSizeCore(const Box& box) const {
  return problem_.objective.energy_wh > 0.0 && KeepsReservoir(plan_.configuration) &&
         plan_.reservoirs.corners[box.nodes[plan_.reservoir_slot]].custom &&
         !(box.core && box.core->done);
}

Constraint Bounds::SizeCore(Box& box) {
  if (!box.core) {
    Candidate candidate = CandidateOf(box);
    candidate.battery = {};
    candidate.pack_surplus_eur = 0.0;  // as where more than the battery is open
    box.core = std::make_shared<CoreSizing>(
        CoreSizing{{box.lines.begin(), box.lines.end()},
                   CustomSizing(problem_, std::move(candidate), NeedsOf(box))});
  }
  CustomSizing& sizing = box.core->sizing;
  box.core->done = sizing.Refine();
  const Leaf& leaf = sizing.leaf();
  if (box.core->done && leaf.status == LeafStatus::kInfeasible) return Constraint::kPump;
  const double battery = CornerAt(plan_.batteries, box, plan_.battery_slot).objective;
  box.bound = std::max(box.bound, leaf.lower_bound + battery);
  return Constraint::kNone;
}

std::optional<Leaf> LeafOfCore(const Problem& problem, const Candidate& candidate,
                               const CoreSizing& core) {
  Leaf leaf = core.sizing.leaf();
  if (!core.done || leaf.status != LeafStatus::kFeasible ||
      leaf.lower_bound < leaf.objective * (1.0 - kTie))
    return std::nullopt;
  const Evaluation evaluation = Evaluate(problem, candidate, leaf.point);
  if (evaluation.failed || !evaluation.works ||
      SupplyMargin(problem, candidate, leaf.point, evaluation) < 0.0)
    return std::nullopt;
  leaf.objective = ObjectiveValue(problem, candidate, leaf.point, evaluation);
  leaf.lower_bound =
      std::min(leaf.objective, leaf.lower_bound + candidate.battery.objective +
                                   problem.objective.cost_eur * candidate.pack_surplus_eur);
  return leaf;
}

}  // namespace plenum::optimizer
