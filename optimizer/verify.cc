#include "optimizer/verify.h"

#include <set>

#include "optimizer/verify_box.h"
#include "optimizer/verify_brute_force.h"
#include "optimizer/verify_front.h"
#include "optimizer/verify_record.h"

namespace plenum::optimizer {
namespace {

constexpr std::size_t kFindingsShown = 3;

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

void CheckCombinations(const Problem& problem, const Proof& proof, Findings& findings) {
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
}

void CheckProofNumbers(const Problem& problem, const Answer& answer, Findings& findings) {
  const Proof& proof = answer.proof;
  CheckCombinations(problem, proof, findings);
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

using Names = std::vector<std::pair<const char*, const char*>>;
const Names kOfDesigns{
    {"parts", "every listed part is in the catalogue, allowed, and fits the others"},
    {"amounts", "rows and totals are those of the parts"},
    {"strokes", "times, air and energy are those of the simulated periodic state"},
    {"supply", "every requirement is met, and no part is overstrained"},
    {"margins", "margins are those of the simulated design"},
    {"order", "designs are ordered by objective, ties by part ids"},
    {"combinations", "their number is the catalogue's, and all are accounted for"},
    {"status", "the status claims no more than was proved"}};

std::vector<Check> Gather(const Names& names, const Findings& findings) {
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

Verification Verify(const Problem& problem, const Answer& answer,
                    const BruteForceOptions* brute_force) {
  Verification result;
  Findings findings;
  CheckDesigns(problem, answer, findings, result.not_rechecked);
  CheckOrder(problem, answer.designs, findings);
  CheckProofNumbers(problem, answer, findings);
  Names names = kOfDesigns;
  names.emplace_back("bound", "the lower bound, the gap and the list agree");
  if (answer.proof.record) {
    CheckRecord(problem, answer, findings, result.not_rechecked);
    names.insert(names.end(), {{"choices", "choices and those left out make up each family"},
                               {"dominance", "every choice left out is dominated often enough"},
                               {"boxes", "the boxes divide all combinations"},
                               {"infeasible", "parts of boxes closed as incompatible do not fit"},
                               {"rechecked", "no combination found that belongs on the list"},
                               {"counts", "the counts are those of the boxes"},
                               {"designs_in_tree", "every listed design has its box"}});
  } else {
    result.not_rechecked.push_back(
        {"combinations that are not listed: the result holds no record of the search",
         answer.proof.combinations - answer.designs.size()});
  }
  if (brute_force) {
    result.brute_force = CheckByBruteForce(problem, answer, *brute_force, findings);
    names.emplace_back("brute_force", "the list is that of all combinations, one by one");
  }
  result.checks = Gather(names, findings);
  return result;
}

Verification VerifyFront(const Problem& problem, const Front& front) {
  Verification result;
  Findings findings;
  Problem uncut = problem;  // a front is not cut to the number of designs that was asked for
  uncut.count = std::max(uncut.count, static_cast<int>(front.answer.designs.size()));
  CheckDesigns(uncut, front.answer, findings, result.not_rechecked);
  CheckOrder(uncut, front.answer.designs, findings);
  CheckCombinations(problem, front.answer.proof, findings);
  CheckFront(problem, front, findings, result.not_rechecked);
  Names names = kOfDesigns;
  names.emplace_back("front", "no point is matched or beaten by another");
  names.emplace_back("rechecked", "no combination found that lies between points");
  result.checks = Gather(names, findings);
  return result;
}

}  // namespace plenum::optimizer
