#include "optimizer/explain/reach.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "optimizer/evaluate/line.h"
#include "optimizer/search/tree_search.h"

namespace plenum::optimizer {
namespace {

constexpr double kTolerance = 0.002;   // relative
constexpr double kDigits = 1e4;        // of a value of 1 to 10
constexpr double kSearchShare = 0.15;  // of what is left, for one search
constexpr double kSearchLeastS = 0.5;

std::optional<double> Achieved(const Answer& answer, const std::string& pointer) {
  for (const Margin& margin : answer.designs.front().margins)
    if (margin.requirement == pointer) return margin.achieved;
  return std::nullopt;
}

// To few digits, and no harder; whole numbers stay so.
double Outward(double value, bool less_is_harder, bool whole) {
  if (!(value > 0.0) || std::isinf(value)) return value;
  const double unit = whole ? 1.0 : std::pow(10.0, std::floor(std::log10(value))) / kDigits;
  const double units = value / unit;
  return unit * (less_is_harder ? std::ceil(units - 1e-9) : std::floor(units + 1e-9));
}

// A limited amount: the least of it at once. The lightest design is a second opinion where the
// search for the least amount runs out of time.
Reach LeastAmount(const Problem& problem, const Demand& demand, TrialSearch& search) {
  Problem loose = problem;
  demand.drop(loose);
  const Objective& wanted = *demand.number->objective;
  Reach reach{std::nullopt, demand.number->required};
  for (const Objective& objective : {wanted, Objective{.mass_kg = 1.0}}) {
    const Answer answer = search.Best(loose, objective);
    if (answer.designs.empty()) continue;
    const Totals& totals = answer.designs.front().totals;
    if (wanted.cost_eur > 0.0 && !totals.cost_eur && !problem.unpriced_allowed) continue;
    const double amount =
        ObjectiveOf(wanted, Amounts{totals.mass_kg, totals.volume_m3, totals.cost_known_eur});
    reach.best = std::min(reach.best.value_or(kUnlimited), Outward(amount, true, false));
    if (answer.status == Status::kOptimal && objective == wanted) {
      reach.bound = amount;
      break;
    }
  }
  return reach;
}

}  // namespace

TrialSearch::TrialSearch(const SearchOptions& options, double limit_s)
    : options_(options), limit_s_(limit_s) {
  options_.progress = nullptr;
  options_.record = false;
}

double TrialSearch::Left() const {
  const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start_;
  return limit_s_ - used.count();
}

bool TrialSearch::OutOfTime() const {
  return Left() <= 0.0 || (options_.cancelled && options_.cancelled());
}

Answer TrialSearch::Best(Problem problem, const Objective& objective) {
  problem = ForAnyDesign(std::move(problem));
  problem.objective = objective;
  return Run(problem, false);
}

Answer TrialSearch::Run(const Problem& problem, bool any_design) {
  options_.any_design = any_design;
  options_.time_limit_s = std::max(kSearchShare * Left(), std::min(Left(), kSearchLeastS));
  return SearchTrees(problem, options_);
}

Reach FindReach(const Problem& problem, const Demand& demand, TrialSearch& search) {
  const Requirement& number = *demand.number;
  if (number.objective) return LeastAmount(problem, demand, search);
  // Pressures under vacuum are below 0: their sizes are looked for.
  const double sign = number.required < 0.0 ? -1.0 : 1.0;
  const bool less_is_harder = sign * number.loosest > sign * number.required;
  // Whole numbers to the easy side: what a design achieves must still be met by it.
  const auto rounded = [&](double value) {
    if (!number.whole) return value;
    return less_is_harder ? std::ceil(value) : std::floor(value);
  };
  double hard = sign * number.required, easy = sign * number.loosest;
  Reach reach{std::nullopt, number.required};
  bool known = true;  // that all up to `hard` is infeasible
  // Whether a design is found with the value; `easy` moves to what it achieves.
  const auto reaches = [&](double value) {
    Problem trial = problem;
    number.set(trial, sign * value);
    const Answer answer = search.Any(trial);
    if (answer.designs.empty()) {
      known = known && answer.status == Status::kInfeasible;
      if (known) reach.bound = sign * value;
      return false;
    }
    const std::optional<double> found = Achieved(answer, number.pointer);
    const double achieved = rounded(found ? sign * *found : value);
    easy = less_is_harder ? std::max(hard, std::min(achieved, value))
                          : std::min(hard, std::max(achieved, value));
    return true;
  };
  // Looser is not always easier: a slower cycle holds valves longer. Approach from the required
  // side.
  if (std::isinf(easy) && !reaches(easy)) return reach;
  const double last = easy;
  const auto looser = [&](double value) {
    return less_is_harder ? std::min(value * 2.0, last) : std::max(value * 0.5, last);
  };
  double value = looser(hard);
  while (!reaches(rounded(value))) {
    if (search.OutOfTime() || value == last) return reach;
    hard = value;
    value = looser(value);
  }
  while (std::abs(std::log(easy / hard)) > kTolerance && !search.OutOfTime()) {
    const double middle = rounded(std::sqrt(easy * hard));
    if (middle == rounded(hard) || middle == rounded(easy)) break;
    if (!reaches(middle)) hard = middle;
  }
  reach.best = sign * Outward(easy, less_is_harder, number.whole);
  return reach;
}

}  // namespace plenum::optimizer
