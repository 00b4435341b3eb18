#include "verify/verify.h"

#include "verify/design/verify_families.h"
#include "verify/design/verify_kinds.h"
#include "verify/design/verify_list.h"
#include "verify/tree/verify_front.h"
#include "verify/tree/verify_record.h"

namespace plenum::verify {
namespace {

void CheckCombinations(const Problem& problem, const Proof& proof, Findings& findings) {
  BigCount combinations = 0;
  for (const Layout& layout : LayoutsOf(problem)) combinations += Combinations(problem, layout);
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

const CheckNames kOfDesigns{
    {"parts", "every listed part is in the catalogue, allowed, and fits the others"},
    {"amounts", "rows and totals are those of the parts"},
    {"strokes", "times, air and energy are those of the simulated periodic state"},
    {"supply", "every requirement is met, and no part is overstrained"},
    {"margins", "margins are those of the simulated design"},
    {"order", "designs are ordered by objective, ties by mass, cost and part ids"},
    {"combinations", "their number is the catalogue's, and all are accounted for"},
    {"status", "the status claims no more than was proved"}};

}  // namespace

Verification Verify(const Problem& problem, const Answer& answer, const VerifyOptions& options) {
  Verification result;
  Findings findings;
  CheckDesigns(problem, answer.designs, options.stop, findings, result.not_rechecked);
  CheckOrder(problem, answer.designs, findings);
  if (ListsKinds(problem)) CheckKinds(problem, answer.designs, findings);
  CheckProofNumbers(problem, answer, findings);
  CheckNames names = kOfDesigns;
  names.emplace_back("bound", "the lower bound, the gap and the list agree");
  if (answer.proof.record) {
    CheckRecord(problem, answer, options.stop, findings, result.not_rechecked);
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
  if (options.brute_force) {
    result.brute_force =
        CheckByBruteForce(problem, answer, {options.stop, options.progress}, findings);
    names.emplace_back("brute_force", "the list is that of all combinations, one by one");
  }
  result.checks = Gather(names, findings);
  return result;
}

Verification VerifyFront(const Problem& problem, const Front& front, const Stop& stop) {
  Verification result;
  Findings findings;
  Problem uncut = problem;  // a front is not cut to the number of designs that was asked for
  uncut.count = std::max(uncut.count, static_cast<int>(front.answer.designs.size()));
  CheckDesigns(uncut, front.answer.designs, stop, findings, result.not_rechecked);
  CheckOrder(uncut, front.answer.designs, findings);
  CheckCombinations(problem, front.answer.proof, findings);
  CheckFront(problem, front, stop, findings, result.not_rechecked);
  CheckNames names = kOfDesigns;
  names.emplace_back("front", "no point is matched or beaten by another");
  names.emplace_back("rechecked", "no combination found that lies between points");
  result.checks = Gather(names, findings);
  return result;
}

}  // namespace plenum::verify
