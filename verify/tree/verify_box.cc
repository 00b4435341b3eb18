#include "verify/tree/verify_box.h"

#include "verify/design/verify_families.h"
#include "verify/design/verify_size.h"

namespace plenum::verify {
namespace {

std::string IdOf(const Problem& problem, Family family, const ProofItem& item) {
  return item.part == -2 ? "custom" : BasicsOf(problem.parts, family, item.part).id;
}

}  // namespace

Ids EarliestIds(const Problem& problem, const ProofPlan& plan, const Ranges& ranges) {
  Ids ids;
  const ProofPlan listed = EmptyPlan(problem, plan.configuration);  // in the order of a parts list
  for (const ProofSlot& place : listed.slots) {
    const int slot = SlotOf(plan, place.family, place.group);
    if (slot < 0) continue;
    std::optional<Ids::value_type> first;
    for (int i = ranges[slot].first; i < ranges[slot].second; ++i) {
      const ProofItem& item = plan.slots[slot].choices[i];
      if (item.part == -1) continue;
      Ids::value_type id{IdOf(problem, place.family, item), item.quantity};
      if (!first || id < *first) first = std::move(id);
    }
    if (first) ids.push_back(std::move(*first));
  }
  return ids;
}

Claim ClaimOf(const Problem& problem, const Answer& answer) {
  if (!answer.proof.complete)
    return {answer.proof.lower_bound * (1.0 - kSumTolerance), -kUnlimited, {}};
  if (static_cast<int>(answer.designs.size()) < problem.count) return {kUnlimited, -kUnlimited, {}};
  double run = -kUnlimited;  // objective of the first of the run of ties that the last one is in
  for (const Design& design : answer.designs)
    if (!(design.objective <= run + kTieTolerance * std::abs(run))) run = design.objective;
  const double tie = kTieTolerance * std::abs(run);
  return {run - tie, run + tie, IdsOf(answer.designs.back())};
}

Assembly AssemblyAt(const Problem& problem, const ProofPlan& plan, const Ranges& single) {
  Assembly assembly;
  assembly.configuration = plan.configuration;
  assembly.lines.resize(problem.groups.size());
  for (std::size_t s = 0; s < plan.slots.size(); ++s)
    Place(problem, plan.slots[s].family, plan.slots[s].group,
          plan.slots[s].choices[single[s].first], assembly);
  return assembly;
}

BoxCheck::BoxCheck(const Problem& problem, const ProofPlan& plan, const Claim& claim)
    : problem_(problem),
      plan_(plan),
      claim_(claim),
      strokes_(problem, plan),
      corners_(problem, plan, strokes_),
      sizer_(problem) {}

// Whether a combination with this objective, or more, bears out the claim.
bool BoxCheck::Holds(double objective, const Ranges& single) const {
  if (!(objective >= claim_.least)) return false;
  return objective > claim_.tie_end || EarliestIds(problem_, plan_, single) > claim_.last;
}

int SlotToDivide(const ProofPlan& plan, Corners& corners, const Ranges& ranges) {
  int widest = -1;
  std::pair<bool, double> most{false, -1.0};
  for (int s = 0; s < static_cast<int>(ranges.size()); ++s) {
    if (ranges[s].second - ranges[s].first < 2) continue;
    const LeastAmounts& amounts = corners.Least(ranges, s);
    const std::pair<bool, double> spread{!SpecOf(plan.slots[s].family).by_need,
                                         amounts.objective_most - amounts.least.objective};
    if (widest < 0 || spread > most) {
      widest = s;
      most = spread;
    }
  }
  return widest;
}

bool BoxCheck::IsSettled(const Ranges& single, Findings& findings) {
  const Assembly assembly = AssemblyAt(problem_, plan_, single);
  const double enough = std::max(claim_.least, claim_.tie_end);
  const Sizing sizing = sizer_.Size(assembly, -kToSpare, enough);
  if (sizing.status == Sized::kInfeasible || Holds(sizing.lower_bound, single)) return true;
  if (sizing.status != Sized::kFeasible || Holds(sizing.objective, single)) return false;
  findings.push_back({"rechecked", "a " + std::string(Name(plan_.configuration)) +
                                       " design that is not listed comes to " +
                                       std::to_string(sizing.objective) + ": " +
                                       Text(EarliestIds(problem_, plan_, single))});
  return true;
}

// Whether bounds alone bear out the claim; ids, which cost more, are asked only where they may
// help.
bool BoxCheck::IsBeyond(const Ranges& ranges) {
  const double past_ties = std::max(claim_.least, claim_.tie_end);
  const double bound = corners_.LeastObjective(ranges, past_ties);
  if (bound > past_ties || (bound >= claim_.least && std::isinf(claim_.tie_end))) return true;
  return std::isfinite(claim_.tie_end) && EarliestIds(problem_, plan_, ranges) > claim_.last &&
         corners_.LeastObjective(ranges, claim_.least) > claim_.least;
}

// Whether what no battery changes, the energy that strokes take, is too much already. The parts
// beside the batteries are sized once, without limits that a battery sets.
bool BoxCheck::IsCoreBeyond(const Ranges& ranges, int battery_slot) {
  if (!(problem_.objective.energy_wh > 0.0)) return false;
  const double enough = std::max(claim_.least, claim_.tie_end);
  Ranges core = ranges;
  core[battery_slot] = {0, 1};
  if (CountOf(core) > 1) return false;
  if (core != core_) {
    Assembly assembly = AssemblyAt(problem_, plan_, core);
    assembly.battery = nullptr;
    looks_ += kLooksPerSize;
    core_ = core;
    core_least_ = sizer_.Size(assembly, -kToSpare, enough).lower_bound;
  }
  return core_least_ > enough;
}

BigCount BoxCheck::Recheck(const Ranges& ranges, Findings& findings) {
  BigCount open = 0;
  std::vector<Ranges> waiting{ranges};
  while (!waiting.empty()) {
    ++looks_;
    Ranges part = std::move(waiting.back());
    waiting.pop_back();
    if (IsBeyond(part)) continue;
    if (looks_ > kLooksMax) {
      open += CountOf(part);
      continue;
    }
    const int slot = SlotToDivide(plan_, corners_, part);
    if (slot >= 0 && plan_.slots[slot].family == Family::kBattery && IsCoreBeyond(part, slot))
      continue;
    if (slot < 0) {
      looks_ += kLooksPerSize;
      if (!IsSettled(part, findings)) open += 1;
      continue;
    }
    Ranges right = part;
    part[slot].second = right[slot].first = (part[slot].first + part[slot].second) / 2;
    waiting.push_back(std::move(right));
    waiting.push_back(std::move(part));
  }
  return open;
}

}  // namespace plenum::verify
