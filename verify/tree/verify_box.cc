#include "verify/tree/verify_box.h"

#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_families.h"
#include "verify/design/verify_size.h"

namespace plenum::verify {
namespace {

const std::string& IdOf(const Problem& problem, Family family, const ProofItem& item) {
  static const std::string custom = "custom";
  return item.part == -2 ? custom : BasicsOf(problem.parts, family, item.part).id;
}

int SizeOf(const std::pair<int, int>& range) { return range.second - range.first; }

// Of the slots that may be divided the one whose choices differ most in their share of the
// objective, those chosen by need last, and of these the batteries; −1: there is none.
int Widest(const ProofPlan& plan, Corners& corners, const Ranges& ranges, const auto& may_be) {
  int widest = -1;
  std::tuple<bool, bool, double> most;
  for (int s = 0; s < static_cast<int>(ranges.size()); ++s) {
    if (!may_be(s)) continue;
    const LeastAmounts& amounts = corners.Least(ranges, s);
    const Family family = plan.slots[s].family;
    const std::tuple<bool, bool, double> spread{!SpecOf(family).by_need, family != Family::kBattery,
                                                amounts.objective_most - amounts.least.objective};
    if (widest < 0 || spread > most) {
      widest = s;
      most = spread;
    }
  }
  return widest;
}

}  // namespace

Ids EarliestIds(const Problem& problem, const ProofPlan& plan, const Ranges& ranges) {
  Ids ids;
  const ProofPlan listed = EmptyPlan(problem, LayoutOf(plan));  // in the order of a parts list
  for (const ProofSlot& place : listed.slots) {
    const int slot = SlotOf(plan, place.family, place.group);
    if (slot < 0) continue;
    std::optional<std::pair<std::string_view, int>> first;
    for (int i = ranges[slot].first; i < ranges[slot].second; ++i) {
      const ProofItem& item = plan.slots[slot].choices[i];
      if (item.part == -1) continue;
      const std::pair<std::string_view, int> id{IdOf(problem, place.family, item),
                                                item.quantity * TimesBought(problem, place.family)};
      if (!first || id < *first) first = id;
    }
    if (first) ids.emplace_back(first->first, first->second);
  }
  return ids;
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

BoxCheck::BoxCheck(const Problem& problem, const ProofPlan& plan, const Claims& claims,
                   const Stop& stop)
    : problem_(problem),
      plan_(plan),
      claims_(claims),
      series_(problem, plan),
      stop_(stop),
      share_packs_(HasPacks(problem)),
      strokes_(problem, plan),
      corners_(problem, plan, strokes_),
      sizer_(problem, stop) {}

int SlotToDivide(const ProofPlan& plan, Corners& corners, const Ranges& ranges) {
  return Widest(plan, corners, ranges, [&](int slot) { return SizeOf(ranges[slot]) > 1; });
}

bool BoxCheck::ComesAfter(const Ranges& ranges, const TieKey& last) {
  TieShare share;
  for (int s = 0; s < static_cast<int>(ranges.size()); ++s)
    share += ShareOfTies(problem_, corners_.Least(ranges, s).least);
  if (share_packs_ && SlotToDivide(plan_, corners_, ranges) < 0) {
    double counted_eur = 0.0;
    for (int s = 0; s < static_cast<int>(ranges.size()); ++s)
      counted_eur += corners_.Least(ranges, s).least.cost_eur;
    const Totals totals = TotalsOf(problem_, AssemblyAt(problem_, plan_, ranges), {});
    share += SurplusOfTies(problem_, totals.cost_known_eur, counted_eur);
  }
  return share > last.share ||
         (share == last.share && EarliestIds(problem_, plan_, ranges) > last.ids);
}

// Whether a combination with this objective, or more, bears out the claim.
bool BoxCheck::Holds(const Claim& claim, double objective, const Ranges& single) {
  if (!(objective >= claim.least)) return false;
  return objective > claim.tie_end || ComesAfter(single, claim.last);
}

bool BoxCheck::IsSettled(const Claim& claim, const Ranges& single, Findings& findings) {
  const Assembly assembly = AssemblyAt(problem_, plan_, single);
  const Sizing sizing = sizer_.Size(assembly, -kToSpare, claim.enough());
  if (sizing.status == Sized::kInfeasible || Holds(claim, sizing.lower_bound, single)) return true;
  if (sizing.status != Sized::kFeasible || Holds(claim, sizing.objective, single)) return false;
  findings.push_back({"rechecked", "a " + std::string(Name(plan_.configuration)) +
                                       " design that is not listed comes to " +
                                       std::to_string(sizing.objective) + ": " +
                                       Text(EarliestIds(problem_, plan_, single))});
  return true;
}

// Whether bounds alone bear out the claim; the order of ties, which costs more, is asked only where
// it may help.
bool BoxCheck::IsBeyond(const Claim& claim, const Ranges& ranges) {
  const double past_ties = claim.enough();
  const double bound = corners_.LeastObjective(ranges, past_ties);
  if (bound > past_ties || (bound >= claim.least && std::isinf(claim.tie_end))) return true;
  return std::isfinite(claim.tie_end) && ComesAfter(ranges, claim.last) &&
         corners_.LeastObjective(ranges, claim.least) > claim.least;
}

// Whether what no battery changes is too much already. The parts beside the batteries are sized
// once, without limits that a battery sets; the least battery of the box comes on top.
bool BoxCheck::IsCoreBeyond(const Claim& claim, const Ranges& ranges, int battery_slot) {
  const double battery = corners_.Least(ranges, battery_slot).least.objective;
  Ranges core = ranges;
  core[battery_slot] = {0, 1};
  if (!IsPumped(plan_.configuration) || CountOf(core) > 1) return false;
  if (core != core_) {
    Assembly assembly = AssemblyAt(problem_, plan_, core);
    assembly.battery = nullptr;
    looks_ += kLooksPerSize;
    core_ = core;
    core_least_ = sizer_.Size(assembly, -kToSpare, claim.enough() - battery).lower_bound;
  }
  return core_least_ + battery > claim.enough();
}

// Of a list of kinds what decides the kind is divided first; −1 where it is known.
int BoxCheck::SlotOfKinds(const Ranges& ranges) {
  return Widest(plan_, corners_, ranges,
                [&](int slot) { return series_.AreSeveral(slot, ranges[slot]); });
}

BigCount BoxCheck::Recheck(const Ranges& ranges, Findings& findings) {
  BigCount open = 0;
  std::vector<Ranges> waiting{ranges};
  while (!waiting.empty()) {
    ++looks_;
    Ranges part = std::move(waiting.back());
    waiting.pop_back();
    const bool stopped = Stopped(stop_);
    const Claim& claim = ClaimOn(part);
    if (!stopped && IsBeyond(claim, part)) continue;
    if (stopped || looks_ > kLooksMax) {
      open += CountOf(part);
      continue;
    }
    const int of_kinds = SlotOfKinds(part);
    const int slot = of_kinds >= 0 ? of_kinds : SlotToDivide(plan_, corners_, part);
    if (slot >= 0 && plan_.slots[slot].family == Family::kBattery &&
        IsCoreBeyond(claim, part, slot))
      continue;
    if (slot < 0) {
      looks_ += kLooksPerSize;
      if (!IsSettled(claim, part, findings)) open += 1;
      continue;
    }
    Ranges right = part;
    const int middle = of_kinds >= 0 ? series_.Border(slot, part[slot])
                                     : (part[slot].first + part[slot].second) / 2;
    part[slot].second = right[slot].first = middle;
    waiting.push_back(std::move(right));
    waiting.push_back(std::move(part));
  }
  return open;
}

}  // namespace plenum::verify
