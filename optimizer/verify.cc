#include "optimizer/verify.h"

#include <map>
#include <set>

#include "optimizer/verify_corner.h"
#include "optimizer/verify_design.h"
#include "optimizer/verify_tree.h"

namespace plenum::optimizer {
namespace {

constexpr std::size_t kFindingsShown = 3;

using Ids = std::vector<std::pair<std::string, int>>;

// Ids and pieces in the order of the parts list; tubes by id alone.
Ids IdsOf(const Design& design) {
  Ids ids;
  for (const Choice& choice : design.parts)
    ids.emplace_back(choice.id,
                     choice.family == Family::kTubing ? 1 : static_cast<int>(choice.quantity));
  return ids;
}

void CheckOrder(const Problem& problem, const std::vector<Design>& designs, Findings& findings) {
  if (static_cast<int>(designs.size()) > problem.count)
    findings.push_back({"order", "more designs than were asked for"});
  std::set<std::pair<Configuration, Ids>> seen;
  double run = -kUnlimited;  // objective of the first of a run of ties
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const std::string rank = "rank " + std::to_string(i + 1);
    if (!seen.insert({designs[i].configuration, IdsOf(designs[i])}).second)
      findings.push_back({"order", rank + " is listed twice"});
    const double objective = designs[i].objective;
    if (i > 0 && objective <= run + kTieTolerance * std::abs(run) * (1.0 + kTieTolerance) &&
        objective >= run) {
      if (IdsOf(designs[i]) < IdsOf(designs[i - 1]) &&
          objective <= run + kTieTolerance * std::abs(run) * (1.0 - kTieTolerance))
        findings.push_back({"order", rank + " ties with the one before and comes first by ids"});
      continue;
    }
    if (objective < run - kTieTolerance * std::abs(run))
      findings.push_back({"order", rank + " is better than the one before"});
    run = std::max(run, objective);
  }
}

void CheckProofNumbers(const Problem& problem, const Answer& answer, Findings& findings) {
  const Proof& proof = answer.proof;
  BigCount combinations = 0;
  for (Configuration configuration : problem.configurations)
    combinations += Combinations(problem, configuration);
  if (combinations != proof.combinations)
    findings.push_back({"combinations", "the catalogue has " + combinations.str() + ", not " +
                                            proof.combinations.str()});
  const Pruned& pruned = proof.pruned;
  if (pruned.incompatible + pruned.infeasible + pruned.bound + pruned.dominated + pruned.unpriced +
          proof.evaluated !=
      proof.combinations)
    findings.push_back({"combinations", "pruned and evaluated ones do not add up to them"});

  const bool none = answer.designs.empty();
  const double last = none ? 0.0 : answer.designs.back().objective;
  const double gap = std::isfinite(proof.lower_bound) && last > 0.0
                         ? std::max(0.0, 1.0 - proof.lower_bound / last)
                         : 0.0;
  if (!none && std::abs(proof.gap - gap) > kSumTolerance)
    findings.push_back({"bound", "the gap is not that of the lower bound and the last design"});
  const bool proved = answer.status == Status::kOptimal || answer.status == Status::kInfeasible;
  if (proved != proof.complete)
    findings.push_back({"status", std::string(Name(answer.status)) + " with complete " +
                                      (proof.complete ? "true" : "false")});
  if ((answer.status == Status::kOptimal && (none || proof.gap > kTieTolerance)) ||
      (answer.status == Status::kInfeasible && (!none || proof.undecided > 0)))
    findings.push_back({"status", std::string(Name(answer.status)) + " is more than is proved"});
  const bool short_list = static_cast<int>(answer.designs.size()) < problem.count;
  if (answer.status == Status::kOptimal && short_list && std::isfinite(proof.lower_bound))
    findings.push_back({"bound", "a complete list that is not full leaves no other design"});
}

void CheckDesigns(const Problem& problem, const Answer& answer, Findings& findings,
                  std::vector<NotRechecked>& open) {
  BigCount not_simulated = 0;
  for (std::size_t i = 0; i < answer.designs.size(); ++i) {
    Findings own;
    const Design& design = answer.designs[i];
    if (const std::optional<Assembly> assembly = Assemble(problem, design, own)) {
      CheckAmounts(problem, design, *assembly, own);
      if (!CheckPerformance(problem, design, *assembly, own)) not_simulated += 1;
    }
    for (Finding& finding : own) {
      finding.detail = "rank " + std::to_string(i + 1) + ": " + finding.detail;
      findings.push_back(std::move(finding));
    }
  }
  if (not_simulated > 0)
    open.push_back(
        {"listed designs whose periodic state the simulator did not reach", not_simulated});
}

// Whether the pump's energy per air rises with pressure, on a fine grid.
bool EnergyPerAirRises(const model::CompressorCurve& curve, double ambient_pa) {
  constexpr int kSteps = 500;
  double before = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double pa = ambient_pa + (model::HighestPressure(curve) - ambient_pa) * i / kSteps;
    const double flow = model::FreeAirDelivery(curve, pa);
    if (!(flow > 0.0)) return true;
    const double energy = model::ElectricalPower(curve, pa) / flow;
    if (energy < before * (1.0 - kSumTolerance)) return false;
    before = energy;
  }
  return true;
}

bool FlowMustBeEqual(const Problem& problem, Configuration configuration) {
  const std::size_t groups = problem.groups.size();
  if (configuration != Configuration::kCompressor)
    return groups > 1 && (problem.simultaneous || groups > 2);
  return groups > 1 ||
         !std::all_of(problem.parts.compressors.begin(), problem.parts.compressors.end(),
                      [&](const model::Compressor& pump) {
                        return EnergyPerAirRises(pump.curve, problem.ambient.pressure_pa);
                      });
}

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
        if (slot.group < 0) quantity = static_cast<int>(choice.quantity);
      }
    int position = -1;
    for (std::size_t i = 0; i < slot.choices.size(); ++i) {
      const ProofItem& item = slot.choices[i];
      const std::string item_id = item.part == -2   ? "custom"
                                  : item.part == -1 ? ""
                                                    : BasicsOf(problem, slot.family, item.part)->id;
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
  RecordCheck(const Problem& problem, const Answer& answer, Findings& findings)
      : problem_(problem), answer_(answer), findings_(findings) {}

  void Run(std::vector<NotRechecked>& open) {
    const ProofRecord& record = *answer_.proof.record;
    if (record.count != problem_.count)
      findings_.push_back({"choices", "the record was made for another number of designs"});
    std::set<Configuration> seen;
    for (const ProofPlan& plan : record.plans) {
      if (!problem_.configurations.contains(plan.configuration) ||
          !seen.insert(plan.configuration).second)
        findings_.push_back({"choices", "a plan that was not asked for, or twice"});
      CheckPlan(plan);
    }
    for (Configuration configuration : problem_.configurations)
      if (!seen.contains(configuration)) Missing(configuration);
    CheckCounts();
    for (std::size_t i = 0; i < answer_.designs.size(); ++i)
      if (found_[i] != 1)
        findings_.push_back({"designs_in_tree", "rank " + std::to_string(i + 1) + " is in " +
                                                    std::to_string(found_[i]) + " of its boxes"});
    const double least = LeastBehind();
    if (answer_.proof.lower_bound > least * (1.0 + kSumTolerance))
      findings_.push_back({"bound", "the lower bound is above that of a box that is not listed"});
    for (const auto& [what, count] : open_) open.push_back({what, count});
  }

 private:
  double last() const {
    return static_cast<int>(answer_.designs.size()) == problem_.count
               ? answer_.designs.back().objective
               : kUnlimited;
  }

  void CheckPlan(const ProofPlan& plan) {
    if (FlowMustBeEqual(problem_, plan.configuration) && !plan.equal_flow)
      findings_.push_back({"dominance", "flows are compared where only equal ones may be"});
    if (std::isfinite(last()) && plan.tie < kTieTolerance * last() * (1.0 - kSumTolerance))
      findings_.push_back({"dominance", "the tie is smaller than that of the last design"});
    const std::size_t before = findings_.size();
    CheckSlots(problem_, plan, counts_, findings_);
    for (const Finding& finding : Findings(findings_.begin() + before, findings_.end()))
      if (finding.check == "choices") return;  // the boxes mean nothing then
    const std::vector<ClosedBox> closed = Replay(plan, findings_);
    for (const ClosedBox& box : closed) CheckBox(plan, box);
    for (std::size_t i = 0; i < answer_.designs.size(); ++i)
      if (answer_.designs[i].configuration == plan.configuration) Place(plan, closed, i);
  }

  // A configuration without a plan has a family without a choice.
  void Missing(Configuration configuration) {
    const bool cost = problem_.objective.cost_eur > 0.0 || std::isfinite(problem_.cost_max_eur);
    if (Combinations(problem_, configuration) > 0 && !cost)
      findings_.push_back({"choices", std::string("no plan of ") + Name(configuration)});
    else
      counts_.unpriced += Combinations(problem_, configuration);
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
                        box.end.bound <= design.objective * (1.0 + kTieTolerance);
      if (own || open) ++found_[rank];
    }
  }

  void Open(const std::string& what, const BigCount& count) { open_[what] += count; }

  void CheckBox(const ProofPlan& plan, const ClosedBox& box) {
    const BigCount count = CountOf(box.ranges);
    const std::string where = std::string(" (") + Name(plan.configuration) + ")";
    switch (box.end.kind) {
      case BoxKind::kInfeasible:
        if (box.end.constraint == Constraint::kMating) {
          counts_.incompatible += count;
          if (!CannotMate(problem_, plan, box.ranges))
            findings_.push_back({"infeasible", "parts of a box do fit together" + where});
          return;
        }
        counts_.infeasible += count;
        if (!CannotMate(problem_, plan, box.ranges) && !CannotWork(problem_, plan, box.ranges) &&
            !BeyondTheList(plan, box))
          Open("infeasible boxes that a simpler corner does not refute" + where, count);
        return;
      case BoxKind::kBound:
      case BoxKind::kOrder:
        counts_.bound += count;
        behind_ = std::min(behind_, box.end.bound);
        if (answer_.proof.complete && box.end.bound < last() * (1.0 - kTieTolerance))
          findings_.push_back({"bound", "a box was closed that may hold a better design" + where});
        if (!BeyondTheList(plan, box) &&
            LeastObjective(problem_, plan, box.ranges) < box.end.bound * (1.0 - kSumTolerance) &&
            !CannotMate(problem_, plan, box.ranges) && !CannotWork(problem_, plan, box.ranges))
          Open("bounded boxes that a sum of least amounts does not bound as high" + where, count);
        return;
      default:
        break;
    }
    if (count != 1) findings_.push_back({"boxes", "a box of several designs ends as one" + where});
    evaluated_ += count;
    if (box.end.kind == BoxKind::kDesign) {
      const int rank = box.end.design;
      if (rank < 0 || rank >= static_cast<int>(answer_.designs.size()))
        findings_.push_back({"designs_in_tree", "a box names a design that is not listed" + where});
      return;
    }
    if (box.end.kind != BoxKind::kRefuted) behind_ = std::min(behind_, box.end.bound);
    if (box.end.kind == BoxKind::kNotListed && answer_.proof.complete &&
        box.end.bound < last() * (1.0 - kTieTolerance))
      findings_.push_back({"bound", "a better design was not listed" + where});
    if (box.end.kind == BoxKind::kUndecided) ++undecided_;
    if (!BeyondTheList(plan, box) && !CannotWork(problem_, plan, box.ranges))
      Open("single combinations whose sizing was not repeated" + where, count);
  }

  // Every design in the box is heavier than the last one listed, whatever it was closed for.
  bool BeyondTheList(const ProofPlan& plan, const ClosedBox& box) const {
    return LeastObjective(problem_, plan, box.ranges) > last() * (1.0 + 2 * kTieTolerance);
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
  Findings& findings_;
  Pruned counts_;
  BigCount evaluated_ = 0;
  long long undecided_ = 0;
  double behind_ = kUnlimited;  // least bound of what is not listed
  std::map<std::size_t, int> found_;
  std::map<std::string, BigCount> open_;
};

std::vector<Check> Gather(const std::vector<std::pair<const char*, const char*>>& names,
                          const Findings& findings) {
  std::vector<Check> checks;
  for (const auto& [name, what] : names) {
    Check check{name, true, what};
    std::size_t count = 0;
    for (const Finding& finding : findings) {
      if (finding.check != name) continue;
      if (count == 0) check.detail.clear();
      if (count < kFindingsShown) check.detail += (count ? "; " : "") + finding.detail;
      ++count;
    }
    if (count > kFindingsShown)
      check.detail += "; and " + std::to_string(count - kFindingsShown) + " more";
    check.ok = count == 0;
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace

Verification Verify(const Problem& problem, const Answer& answer) {
  Verification result;
  Findings findings;
  CheckDesigns(problem, answer, findings, result.not_rechecked);
  CheckOrder(problem, answer.designs, findings);
  CheckProofNumbers(problem, answer, findings);
  std::vector<std::pair<const char*, const char*>> names{
      {"parts", "every listed part is in the catalogue, allowed, and fits the others"},
      {"amounts", "rows and totals are those of the parts"},
      {"strokes", "times, air and energy are those of the simulated periodic state"},
      {"supply", "every requirement is met, and no part is overstrained"},
      {"margins", "margins are those of the simulated design"},
      {"order", "designs are ordered by objective, ties by part ids"},
      {"combinations", "their number is the catalogue's, and all are accounted for"},
      {"bound", "the lower bound, the gap and the list agree"},
      {"status", "the status claims no more than was proved"}};
  if (answer.proof.record) {
    RecordCheck(problem, answer, findings).Run(result.not_rechecked);
    names.insert(names.end(), {{"choices", "choices and those left out make up each family"},
                               {"dominance", "every choice left out is dominated often enough"},
                               {"boxes", "the boxes divide all combinations"},
                               {"infeasible", "parts of boxes closed as incompatible do not fit"},
                               {"counts", "the counts are those of the boxes"},
                               {"designs_in_tree", "every listed design has its box"}});
  } else {
    result.not_rechecked.push_back(
        {"combinations that are not listed: the result holds no record of the search",
         answer.proof.combinations - answer.designs.size()});
  }
  result.checks = Gather(names, findings);
  return result;
}

}  // namespace plenum::optimizer
