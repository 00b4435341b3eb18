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

// From the required value of a number to the hardest with which a design is found. Looser is not
// always easier: a slower cycle holds valves longer.
class Approach {
 public:
  Approach(const Problem& problem, const Requirement& number, TrialSearch& search)
      : problem_(problem),
        number_(number),
        search_(search),
        sign_(number.required < 0.0 ? -1.0 : 1.0),
        less_is_harder_(sign_ * number.loosest > sign_ * number.required),
        hard_(sign_ * number.required),
        easy_(sign_ * number.loosest),
        reach_{std::nullopt, number.required} {}

  Reach Run() {
    if (std::isinf(easy_) && !Reaches(easy_)) return reach_;
    const double last = easy_;
    const auto looser = [&](double value) {
      return less_is_harder_ ? std::min(value * 2.0, last) : std::max(value * 0.5, last);
    };
    double value = looser(hard_);
    while (!Reaches(Rounded(value))) {
      if (search_.OutOfTime() || value == last) return reach_;
      hard_ = value;
      value = looser(value);
    }
    Halve();
    Confirm();
    reach_.best = sign_ * Outward(easy_, less_is_harder_, number_.whole);
    return reach_;
  }

 private:
  // Whole numbers to the easy side: what a design achieves must still be met by it.
  double Rounded(double value) const {
    if (!number_.whole) return value;
    return less_is_harder_ ? std::ceil(value) : std::floor(value);
  }

  // Whether a design is found with the value; `easy_` moves to what it achieves.
  bool Reaches(double value) {
    Problem trial = problem_;
    number_.set(trial, sign_ * value);
    const Answer answer = search_.Any(trial);
    if (answer.designs.empty()) {
      known_ = known_ && answer.status == Status::kInfeasible;
      if (known_) reach_.bound = sign_ * value;
      return false;
    }
    found_at_ = value;
    const std::optional<double> found = Achieved(answer, number_.pointer);
    const double achieved = Rounded(found && takes_word_ ? sign_ * *found : value);
    easy_ = less_is_harder_ ? std::max(hard_, std::min(achieved, value))
                            : std::min(hard_, std::max(achieved, value));
    return true;
  }

  void Halve() {
    while (std::abs(std::log(easy_ / hard_)) > kTolerance && !search_.OutOfTime()) {
      const double middle = Rounded(std::sqrt(easy_ * hard_));
      if (middle == Rounded(hard_) || middle == Rounded(easy_)) break;
      if (!Reaches(middle)) hard_ = middle;
    }
  }

  // What a design achieves it may do only as long as nothing more is asked of it: a shorter mission
  // lets a bottle of CO2 give more at once.
  void Confirm() {
    takes_word_ = false;
    const double found_at = found_at_, best = Outward(easy_, less_is_harder_, number_.whole);
    if (best == found_at || Reaches(best)) return;
    hard_ = best;
    easy_ = found_at;
    Halve();
  }

  const Problem& problem_;
  const Requirement& number_;
  TrialSearch& search_;
  double sign_;  // pressures under vacuum are below 0: their sizes are looked for
  bool less_is_harder_;
  double hard_, easy_;
  double found_at_ = 0.0;   // the last value with which a design was found
  bool takes_word_ = true;  // that a design says what it achieves
  bool known_ = true;       // that all up to `hard_` is infeasible
  Reach reach_;
};

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
  if (demand.number->objective) return LeastAmount(problem, demand, search);
  return Approach(problem, *demand.number, search).Run();
}

}  // namespace plenum::optimizer
