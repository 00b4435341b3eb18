#include "optimizer/explain/prices.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "optimizer/evaluate/line.h"
#include "optimizer/explain/requirements.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/search/tree_search.h"
#include "optimizer/sizing/report.h"
#include "optimizer/sizing/resize.h"

namespace plenum::optimizer {
namespace {

constexpr double kSlightly = 1e-5;  // past a tie
constexpr double kTightestFactor = 2.0;
constexpr double kTightenTolerance = 1e-3;
constexpr int kCutsMax = 8;

class Budget {
 public:
  explicit Budget(const SearchOptions& options) : options_(options) {
    options_.progress = nullptr;
    limit_s_ = options.time_limit_s;
  }
  double Left() const {
    return limit_s_ - std::chrono::duration<double>(Clock::now() - start_).count();
  }
  bool Out() const { return Left() <= 0.0 || (options_.cancelled && options_.cancelled()); }
  // Best design; `share` of what is left of the time.
  Answer Best(Problem problem, double share) {
    problem.count = 1;
    problem.list = ListOf::kCombinations;
    options_.time_limit_s = share * std::max(0.0, Left());
    return SearchTrees(problem, options_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  SearchOptions options_;
  double limit_s_;
  Clock::time_point start_ = Clock::now();
};

// Objective that all pieces of a part carry in a design; gas charges do not change with the part.
double Carried(const Problem& problem, const Design& design, const model::PartBasics& basics) {
  double quantity = 0.0;
  for (const Choice& choice : design.parts)
    if (choice.id == basics.id) quantity += choice.quantity;
  return ObjectiveOf(problem.objective, Bought(quantity, basics));
}

void Scale(model::PartBasics& basics, double factor) {
  basics.mass_kg *= factor;
  basics.body_volume_m3 *= factor;
  if (basics.cost_eur) *basics.cost_eur *= factor;
}

// Share by which the part must fall for `design` to pass `other`; none where no share does.
std::optional<double> ShareToPass(const Problem& problem, const Design& design, const Design& other,
                                  const model::PartBasics& basics) {
  const double gap = design.objective - other.objective;
  const double lever = Carried(problem, design, basics) - Carried(problem, other, basics);
  const double needed = gap + kSlightly * std::abs(other.objective);
  if (needed <= 0.0) return 0.0;
  if (lever <= needed) return std::nullopt;
  return needed / lever;
}

// Cutting planes: each search that lists another design first gives one more design to pass.
std::optional<PartFlip> FlipPart(const Problem& problem, const std::vector<Design>& designs,
                                 std::size_t rank, const Choice& choice, Budget& budget) {
  Problem changed = problem;
  const int part = FindPart(problem.parts, choice.family, choice.id);
  if (part < 0) return std::nullopt;  // made to measure
  const model::PartBasics& basics = BasicsOf(problem.parts, choice.family, part);
  PartFlip flip{choice.family, choice.id, 0.0, false};
  const auto pass = [&](const Design& other) {
    const auto share = ShareToPass(problem, designs[rank], other, basics);
    if (share) flip.share = std::max(flip.share, *share);
    return share.has_value();
  };
  for (std::size_t i = 0; i < rank; ++i)
    if (!pass(designs[i])) return std::nullopt;
  for (int cut = 0; cut < kCutsMax && !budget.Out(); ++cut) {
    for (const FamilySpec& spec : Families()) {  // a reservoir in each of its roles
      if (CatalogueFamily(spec.family) != CatalogueFamily(choice.family)) continue;
      const int same = FindPart(changed.parts, spec.family, choice.id);
      if (same < 0) continue;
      model::PartBasics& scaled = BasicsOf(changed.parts, spec.family, same);
      scaled = basics;
      Scale(scaled, 1.0 - flip.share);
    }
    const Answer answer = budget.Best(changed, 0.3);
    if (answer.status != Status::kOptimal) return flip;
    Design best = answer.designs.front();
    if (SameParts(best.parts, designs[rank].parts)) {
      flip.confirmed = true;
      return flip;
    }
    // As it is with the part unchanged.
    best.objective += flip.share * Carried(problem, best, basics);
    const double before = flip.share;
    if (!pass(best)) return std::nullopt;
    if (flip.share <= before) return flip;  // a tie that ids decide
  }
  return flip;
}

// Means nothing once the budget is out. Whether the designs before `rank` fail, or come after it,
// where the requirement has this value; none where it fails itself.
std::optional<bool> ComesFirst(const std::vector<Problem>& own, const std::vector<Design>& designs,
                               std::size_t rank, const Requirement& requirement, double value,
                               const Budget& budget) {
  const auto objective = [&](std::size_t i) {
    Problem trial = own[i];
    requirement.set(trial, value);
    const Leaf leaf = Resize(trial, designs[i], [&] { return budget.Out(); });
    return leaf.status == LeafStatus::kFeasible ? leaf.objective : kUnlimited;
  };
  const double mine = objective(rank);
  if (std::isinf(mine)) return std::nullopt;
  for (std::size_t i = 0; i < rank; ++i)
    if (objective(i) <= mine) return false;
  return true;
}

std::optional<RequirementFlip> FlipRequirement(const Problem& problem,
                                               const std::vector<Problem>& own,
                                               const std::vector<Design>& designs, std::size_t rank,
                                               const Requirement& requirement, Budget& budget) {
  // Of pressures under vacuum, which are below 0, the sizes count.
  const bool less_is_harder = std::abs(requirement.loosest) > std::abs(requirement.required);
  const auto at = [&](double tightening) {  // 0: as required, 1: the tightest
    const double value =
        requirement.required * std::pow(kTightestFactor, less_is_harder ? -tightening : tightening);
    return requirement.whole ? std::ceil(value) : value;
  };
  const auto comes_first = [&](double tightening) {
    return ComesFirst(own, designs, rank, requirement, at(tightening), budget);
  };
  // The tightest value that the design bears, then the least at which it is first.
  double bears = 0.0, fails = 1.0;
  if (comes_first(1.0).has_value()) bears = 1.0;
  while (bears < 1.0 && fails - bears > kTightenTolerance && !budget.Out()) {
    const double middle = 0.5 * (bears + fails);
    (comes_first(middle).has_value() ? bears : fails) = middle;
  }
  if (!comes_first(bears).value_or(false)) return std::nullopt;
  double behind = 0.0, first = bears;
  while (first - behind > kTightenTolerance && !budget.Out()) {
    const double middle = 0.5 * (behind + first);
    (comes_first(middle).value_or(false) ? first : behind) = middle;
  }
  if (budget.Out()) return std::nullopt;
  RequirementFlip flip{requirement.pointer, requirement.required, at(first), false};
  Problem tightened = problem;
  requirement.set(tightened, flip.tightened);
  const Answer answer = budget.Best(std::move(tightened), 0.3);
  flip.confirmed = answer.status == Status::kOptimal &&
                   SameParts(answer.designs.front().parts, designs[rank].parts);
  return flip;
}

Flip FlipRank(const Problem& problem, const std::vector<Problem>& own,
              const std::vector<Design>& designs, std::size_t rank, Budget& budget) {
  Flip flip;
  flip.rank = static_cast<int>(rank) + 1;
  flip.objective_gap = designs[rank].objective - designs[0].objective;
  std::vector<std::string> seen;  // groups may share a part
  for (const Choice& choice : designs[rank].parts) {
    if (budget.Out()) return flip;
    if (std::find(seen.begin(), seen.end(), choice.id) != seen.end()) continue;
    seen.push_back(choice.id);
    if (auto part = FlipPart(problem, designs, rank, choice, budget)) flip.parts.push_back(*part);
  }
  for (const Requirement& requirement : Requirements(problem)) {
    if (budget.Out()) return flip;
    if (auto tightened = FlipRequirement(problem, own, designs, rank, requirement, budget))
      flip.requirements.push_back(*tightened);
  }
  flip.complete = !budget.Out();
  return flip;
}

}  // namespace

std::vector<Price> FindPrices(const Problem& problem, const SearchOptions& options) {
  Budget budget(options);
  const std::vector<Requirement> requirements = Requirements(problem);
  std::vector<Price> prices;
  for (std::size_t i = 0; i < requirements.size(); ++i) {
    const Requirement& requirement = requirements[i];
    Price price{requirement.pointer, requirement.required, Loosened(requirement, kPriceShare),
                Status::kCancelled,  std::nullopt,         0.0};
    if (!budget.Out()) {
      Problem looser = problem;
      requirement.set(looser, price.loosened);
      const Answer answer =
          budget.Best(std::move(looser), 1.0 / static_cast<double>(requirements.size() - i));
      price.status = answer.status;
      price.lower_bound = answer.proof.lower_bound;
      if (!answer.designs.empty()) {
        price.objective = answer.designs.front().objective;
        price.lower_bound = std::min(price.lower_bound, *price.objective);
      }
    }
    prices.push_back(std::move(price));
  }
  return prices;
}

std::vector<Flip> FindFlips(const Problem& problem, const std::vector<Design>& designs, int ranks,
                            const SearchOptions& options) {
  Budget budget(options);
  std::vector<Problem> own;
  own.reserve(designs.size());
  for (const Design& design : designs) own.push_back(WithPartsOf(problem, design));
  std::vector<Flip> flips;
  for (std::size_t rank = 1; rank < std::min<std::size_t>(designs.size(), ranks); ++rank)
    flips.push_back(FlipRank(problem, own, designs, rank, budget));
  return flips;
}

}  // namespace plenum::optimizer
