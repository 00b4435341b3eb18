#include "verify/tree/verify_record.h"

#include <algorithm>
#include <list>
#include <map>
#include <set>

#include "verify/design/cycle/verify_gait.h"
#include "verify/design/cycle/verify_pump_curve.h"
#include "verify/design/verify_families.h"
#include "verify/tree/verify_box.h"

namespace plenum::verify {
namespace {

// Positions of a listed design's parts among the choices; none where one was left out.
std::optional<std::vector<int>> PositionsOf(const Problem& problem, const ProofPlan& plan,
                                            const Design& design) {
  std::vector<int> positions;
  for (const ProofSlot& slot : plan.slots) {
    std::string id;
    int quantity = 1;
    for (const Choice& choice : design.parts)
      if (choice.family == slot.family && choice.group == slot.group) {
        id = choice.id;
        if (slot.group < 0)
          quantity = static_cast<int>(choice.quantity) / TimesBought(problem, choice.family);
      }
    int position = -1;
    for (std::size_t i = 0; i < slot.choices.size(); ++i) {
      const ProofItem& item = slot.choices[i];
      const std::string item_id = item.part == -2 ? "custom"
                                  : item.part == -1
                                      ? ""
                                      : BasicsOf(problem.parts, slot.family, item.part).id;
      if (item_id == id && (item.part == -1 || item.quantity == quantity))
        position = static_cast<int>(i);
    }
    if (position < 0) return std::nullopt;
    positions.push_back(position);
  }
  return positions;
}

bool Holds(const Ranges& ranges, const std::vector<int>& positions) {
  for (std::size_t s = 0; s < ranges.size(); ++s)
    if (positions[s] < ranges[s].first || positions[s] >= ranges[s].second) return false;
  return true;
}

class RecordCheck {
 public:
  RecordCheck(const Problem& problem, const Answer& answer, const Stop& stop, Findings& findings)
      : problem_(problem),
        answer_(answer),
        claims_(problem, answer),
        stop_(stop),
        findings_(findings) {}

  void Run(std::vector<NotRechecked>& open) {
    const ProofRecord& record = *answer_.proof.record;
    if (record.count != problem_.count)
      findings_.push_back({"choices", "the record was made for another number of designs"});
    const std::vector<Layout> asked = LayoutsOf(problem_);
    const auto plans_of = [&](const Layout& layout) {
      return std::count_if(record.plans.begin(), record.plans.end(),
                           [&](const ProofPlan& plan) { return LayoutOf(plan) == layout; });
    };
    for (const ProofPlan& plan : record.plans) {
      if (std::find(asked.begin(), asked.end(), LayoutOf(plan)) == asked.end() ||
          plans_of(LayoutOf(plan)) > 1)
        findings_.push_back({"choices", "a plan that was not asked for, or twice"});
      CheckPlan(plan);
    }
    for (const Layout& layout : asked)
      if (plans_of(layout) == 0) Missing(layout);
    CheckCounts();
    for (std::size_t i = 0; i < answer_.designs.size(); ++i)
      if (found_[i] != 1)
        findings_.push_back({"designs_in_tree", "rank " + std::to_string(i + 1) + " is in " +
                                                    std::to_string(found_[i]) + " of its boxes"});
    const double least = LeastBehind();
    if (answer_.proof.lower_bound > least * (1.0 + kSumTolerance))
      findings_.push_back({"bound", "the lower bound is above that of a box that is not listed"});
    for (Replayed& replayed : replayed_) Recheck(replayed, open);
  }

 private:
  struct Replayed {
    Replayed(const Problem& problem, const ProofPlan& replayed, const Claims& claims,
             const Stop& stop, Findings& findings)
        : plan(replayed), closed(Replay(plan, findings)), check(problem, plan, claims, stop) {}
    const ProofPlan& plan;
    std::vector<ClosedBox> closed;
    BoxCheck check;
  };

  double last() const {
    return static_cast<int>(answer_.designs.size()) == problem_.count
               ? answer_.designs.back().objective
               : kUnlimited;
  }

  void CheckPlan(const ProofPlan& plan) {
    if (FlowMustBeEqual(problem_, LayoutOf(plan)) && !plan.equal_flow)
      findings_.push_back({"dominance", "flows are compared where only equal ones may be"});
    if (std::isfinite(last()) && plan.tie < TieOf(problem_) * last() * (1.0 - kSumTolerance))
      findings_.push_back({"dominance", "the tie is smaller than that of the last design"});
    const std::size_t before = findings_.size();
    CheckSlots(problem_, plan, counts_, findings_);
    for (const Finding& finding : Findings(findings_.begin() + before, findings_.end()))
      if (finding.check == "choices") return;  // the boxes mean nothing then
    Replayed& replayed = replayed_.emplace_back(problem_, plan, claims_, stop_, findings_);
    const std::vector<ClosedBox>& closed = replayed.closed;
    for (const ClosedBox& box : closed) CheckBox(plan, box, replayed.check);
    for (std::size_t i = 0; i < answer_.designs.size(); ++i)
      if (LayoutOf(answer_.designs[i]) == LayoutOf(plan)) Place(plan, closed, i);
  }

  // A layout without a plan has a family without a choice.
  void Missing(const Layout& layout) {
    const BigCount combinations = Combinations(problem_, layout);
    if (combinations > 0 && !AsksForPrices(problem_))
      findings_.push_back({"choices", std::string("no plan of ") + Name(layout.configuration)});
    else
      counts_.unpriced += combinations;
  }

  // Where each listed design lies: in a box of its own, or in one that a search that was stopped
  // left open.
  void Place(const ProofPlan& plan, const std::vector<ClosedBox>& closed, std::size_t rank) {
    const Design& design = answer_.designs[rank];
    const auto positions = PositionsOf(problem_, plan, design);
    if (!positions) return;
    for (const ClosedBox& box : closed) {
      if (!Holds(box.ranges, *positions)) continue;
      const bool own = box.end.kind == BoxKind::kDesign && box.end.design == static_cast<int>(rank);
      const bool open = !answer_.proof.complete &&
                        (box.end.kind == BoxKind::kBound || box.end.kind == BoxKind::kOrder) &&
                        box.end.bound <= design.objective * (1.0 + TieOf(problem_));
      if (own || open) ++found_[rank];
    }
  }

  void CheckBox(const ProofPlan& plan, const ClosedBox& box, BoxCheck& check) {
    const BigCount count = CountOf(box.ranges);
    const std::string where = std::string(" (") + Name(plan.configuration) + ")";
    switch (box.end.kind) {
      case BoxKind::kInfeasible:
        if (box.end.constraint == Constraint::kMating) {
          counts_.incompatible += count;
          if (!check.CannotMate(box.ranges))
            findings_.push_back({"infeasible", "parts of a box do fit together" + where});
          return;
        }
        counts_.infeasible += count;
        break;
      case BoxKind::kBound:
      case BoxKind::kOrder:
        counts_.bound += count;
        Behind(box.end.bound, "a box was closed that may hold a better design" + where);
        break;
      case BoxKind::kKind:
        counts_.bound += count;
        if (&check.ClaimOn(box.ranges) == &claims_.all() ||
            box.end.bound < check.ClaimOn(box.ranges).least)
          findings_.push_back(
              {"bound", "a box was closed by a kind that is not listed, or is no better" + where});
        break;
      default:
        if (count != 1)
          findings_.push_back({"boxes", "a box of several designs ends as one" + where});
        evaluated_ += count;
        if (box.end.kind == BoxKind::kDesign) {
          const int rank = box.end.design;
          if (rank < 0 || rank >= static_cast<int>(answer_.designs.size()))
            findings_.push_back(
                {"designs_in_tree", "a box names a design that is not listed" + where});
          return;
        }
        if (box.end.kind == BoxKind::kNotListed && !IsOfListed(box, check))
          Behind(box.end.bound, "a better design was not listed" + where);
        if (box.end.kind == BoxKind::kUndecided) {
          behind_ = std::min(behind_, box.end.bound);
          ++undecided_;
        }
    }
  }

  // Whether a combination comes behind a listed one of its kind or source.
  bool IsOfListed(const ClosedBox& box, const BoxCheck& check) const {
    const Claim& claim = check.ClaimOn(box.ranges);
    return &claim != &claims_.all() && box.end.bound >= claim.least;
  }

  // Looks at every closed box again; an answer that is refused already is left at that.
  void Recheck(Replayed& replayed, std::vector<NotRechecked>& open) {
    BigCount count = 0;
    for (const ClosedBox& box : replayed.closed) {
      if (box.end.kind == BoxKind::kDesign || box.end.constraint == Constraint::kMating) continue;
      count +=
          findings_.empty() ? replayed.check.Recheck(box.ranges, findings_) : CountOf(box.ranges);
    }
    if (count > 0)
      open.push_back({std::string("combinations of closed boxes (") +
                          Name(replayed.plan.configuration) + ")" +
                          (findings_.empty() ? "" : ", since the answer is refused"),
                      count});
  }

  // Takes note of a bound of what is not listed.
  void Behind(double bound, const std::string& why) {
    behind_ = std::min(behind_, bound);
    if (answer_.proof.complete && bound < claims_.all().least) findings_.push_back({"bound", why});
  }

  double LeastBehind() const { return counts_.dominated > 0 ? std::min(behind_, last()) : behind_; }

  void CheckCounts() {
    const Pruned& given = answer_.proof.pruned;
    const auto expect = [&](const char* what, const BigCount& claimed, const BigCount& counted) {
      if (claimed != counted)
        findings_.push_back({"counts", std::string(what) + " is given as " + claimed.str() +
                                           ", counted " + counted.str()});
    };
    expect("incompatible", given.incompatible, counts_.incompatible);
    expect("infeasible", given.infeasible, counts_.infeasible);
    expect("bound", given.bound, counts_.bound);
    expect("dominated", given.dominated, counts_.dominated);
    expect("unpriced", given.unpriced, counts_.unpriced);
    expect("evaluated", answer_.proof.evaluated, evaluated_);
    expect("undecided", answer_.proof.undecided, undecided_);
  }

  const Problem& problem_;
  const Answer& answer_;
  const Claims claims_;
  const Stop& stop_;
  Findings& findings_;
  Pruned counts_;
  BigCount evaluated_ = 0;
  long long undecided_ = 0;
  double behind_ = kUnlimited;  // least bound of what is not listed
  std::map<std::size_t, int> found_;
  std::list<Replayed> replayed_;
};

}  // namespace

bool FlowMustBeEqual(const Problem& problem, const Layout& layout) {
  const Configuration configuration = layout.configuration;
  // A regulator of one group may still feed some of its actuators while others fill.
  const auto in_parts = [](const ActuatorGroup& group) { return group.gait.phases.size() > 1; };
  if (layout.own_regulators && std::none_of(problem.groups.begin(), problem.groups.end(), in_parts))
    return false;
  if (!IsPumped(configuration)) return MayOverlap(problem);
  if (IsDirect(configuration) && PumpsHoldOn(problem)) return true;
  const std::vector<model::Compressor>& pumps = PumpsOf(problem, configuration);
  return (UnitsOf(problem).size() > 1 && KeepsReservoir(configuration)) ||
         !std::all_of(pumps.begin(), pumps.end(), [&](const model::Compressor& pump) {
           return EnergyPerAirHeld(pump.curve, problem.ambient.pressure_pa,
                                   model::HighestPressure(pump.curve)) == 1.0;
         });
}

void CheckRecord(const Problem& problem, const Answer& answer, const Stop& stop, Findings& findings,
                 std::vector<NotRechecked>& open) {
  RecordCheck(problem, answer, stop, findings).Run(open);
}

}  // namespace plenum::verify
