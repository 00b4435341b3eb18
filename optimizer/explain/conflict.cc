#include "optimizer/explain/conflict.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "optimizer/evaluate/line.h"
#include "optimizer/explain/requirements.h"
#include "optimizer/search/tree_search.h"

namespace plenum::optimizer {
namespace {

constexpr double kBestTolerance = 0.002;  // relative, on what the catalogue reaches at best
constexpr double kLimitS = 12.0;          // for the whole analysis
constexpr double kSearchShare = 0.15;     // of what is left, for one search
constexpr double kSearchLeastS = 0.5;

class ConflictSearch {
 public:
  ConflictSearch(const SearchOptions& options, double used_s)
      : options_(options),
        start_(std::chrono::steady_clock::now()),
        limit_s_(std::min(kLimitS, options.time_limit_s - used_s)) {
    options_.progress = nullptr;
  }

  // Some design that meets the problem, or the proof that there is none, or neither in time.
  Answer Any(Problem problem) { return Run(std::move(problem), true); }
  // The best design.
  Answer Best(Problem problem) { return Run(std::move(problem), false); }

  double Left() const {
    const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start_;
    return limit_s_ - used.count();
  }
  bool OutOfTime() const { return Left() <= 0.0 || (options_.cancelled && options_.cancelled()); }

 private:
  Answer Run(Problem problem, bool any_design) {
    problem.count = 1;
    // A limit on an amount is decided soonest by minimising it.
    if (std::isfinite(problem.mass_max_kg))
      problem.objective = {.mass_kg = 1.0};
    else if (std::isfinite(problem.volume_max_l))
      problem.objective = {.volume_l = 1.0};
    options_.any_design = any_design;
    options_.time_limit_s = std::max(kSearchShare * Left(), std::min(Left(), kSearchLeastS));
    return SearchTrees(problem, options_);
  }

  SearchOptions options_;
  std::chrono::steady_clock::time_point start_;
  double limit_s_;
};

std::optional<double> Achieved(const Answer& answer, const std::string& pointer) {
  if (answer.designs.empty()) return std::nullopt;
  for (const Margin& margin : answer.designs.front().margins)
    if (margin.requirement == pointer) return margin.achieved;
  return std::nullopt;
}

// Best value between the required one, which is infeasible, and the loosest, by halving on a log
// scale; a feasible search moves the bracket to what its design achieves.
std::optional<double> Best(const Problem& problem, const Requirement& requirement,
                           ConflictSearch& search) {
  Problem loose = problem;
  requirement.set(loose, requirement.loosest);
  if (requirement.objective) {
    // The lightest design is a second opinion where the search for the least amount runs out of
    // time.
    std::optional<double> best;
    for (const Objective& objective : {*requirement.objective, Objective{.mass_kg = 1.0}}) {
      loose.objective = objective;
      const Answer answer = search.Best(loose);
      if (answer.designs.empty()) continue;
      const Totals& totals = answer.designs.front().totals;
      if (requirement.objective->cost_eur > 0.0 && !totals.cost_eur) continue;
      const double amount =
          ObjectiveOf(*requirement.objective,
                      Amounts{totals.mass_kg, totals.volume_m3, totals.cost_eur.value_or(0.0)});
      best = std::min(best.value_or(kUnlimited), amount);
    }
    return best;
  }
  const bool less_is_harder = requirement.loosest > requirement.required;
  double hard = requirement.required;
  double easy = requirement.loosest;
  const auto reach = [&](double value) {
    Problem trial = problem;
    requirement.set(trial, value);
    const Answer answer = search.Any(trial);
    if (answer.designs.empty()) return false;
    const double achieved = Achieved(answer, requirement.pointer).value_or(value);
    const double good = less_is_harder ? std::max(hard, std::min(achieved, value))
                                       : std::min(hard, std::max(achieved, value));
    easy = good;
    return true;
  };
  // Looser is not always easier: a slower cycle holds valves longer. Approach from the required
  // side.
  double reached = less_is_harder ? hard * 2.0 : hard * 0.5;
  while (!reach(reached)) {
    if (search.OutOfTime() || (less_is_harder ? reached >= easy : reached <= easy))
      return std::nullopt;
    hard = reached;
    reached = less_is_harder ? std::min(reached * 2.0, easy) : std::max(reached * 0.5, easy);
  }
  while (std::abs(std::log(easy / hard)) > kBestTolerance && !search.OutOfTime()) {
    const double middle = std::sqrt(easy * hard);
    if (!reach(middle)) hard = middle;
  }
  return easy;
}

}  // namespace

std::vector<Conflict> FindConflict(const Problem& problem, const SearchOptions& options,
                                   double used_s) {
  ConflictSearch search(options, used_s);
  const std::vector<Requirement> all = Requirements(problem);
  std::vector<const Requirement*> kept;
  for (const Requirement& requirement : all) kept.push_back(&requirement);

  const auto without = [&](const std::vector<const Requirement*>& holding) {
    Problem trial = problem;
    for (const Requirement& requirement : all)
      if (std::find(holding.begin(), holding.end(), &requirement) == holding.end())
        requirement.set(trial, requirement.loosest);
    return trial;
  };
  std::set<const Requirement*> proved;
  for (std::size_t i = 0; i < kept.size() && !search.OutOfTime();) {
    std::vector<const Requirement*> rest = kept;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    const Answer answer = search.Any(without(rest));
    if (answer.status == Status::kInfeasible) {
      kept = std::move(rest);
    } else {
      if (!answer.designs.empty()) proved.insert(kept[i]);
      ++i;
    }
  }

  std::vector<Conflict> conflict;
  for (const Requirement* requirement : kept) {
    std::optional<double> best;
    if (!search.OutOfTime()) best = Best(problem, *requirement, search);
    conflict.push_back(
        {requirement->pointer, requirement->required, best, proved.contains(requirement)});
  }
  std::stable_partition(conflict.begin(), conflict.end(),
                        [](const Conflict& c) { return c.proved; });
  if (conflict.empty())  // nothing that can be loosened helps: the pressures themselves
    for (std::size_t g = 0; g < problem.groups.size(); ++g)
      conflict.push_back(
          {"/actuators/" + std::to_string(g) + "/operating_pressure_kpa_gauge",
           (problem.groups[g].chamber.operating_pressure_pa - problem.ambient.pressure_pa) / 1e3,
           std::nullopt});
  return conflict;
}

}  // namespace plenum::optimizer
