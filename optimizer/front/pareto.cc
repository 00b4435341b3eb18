#include "optimizer/front/pareto.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>

#include "optimizer/evaluate/line.h"
#include "optimizer/front/front_tree.h"
#include "optimizer/front/front_walk.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/search/tree_search.h"

namespace plenum::optimizer {
namespace {

constexpr double kTie = 1e-6;  // points this close in every amount are the same
// Shares by which the next search must better an amount. The volume of a made-to-measure reservoir
// is sized to a tolerance, and cannot be told from the next below that; where it trades against
// energy the front is a curve.
constexpr double kMadeResolution = 1e-4;
constexpr double kCurveResolution = 1e-2;
constexpr double kSearchShare = 0.5;  // of the time that is left, for one search
constexpr double kSearchLeastS = 0.5;
constexpr double kPricedEur = 1e12;  // a limit that only asks for prices

// The amount that is minimised; limits are laid on the others. Energy depends on the settings and
// has no limit of its own; a least mass is what the search proves soonest.
std::size_t Minimised(const std::vector<Amount>& amounts) {
  for (Amount preferred : {Amount::kEnergy, Amount::kMass}) {
    const auto found = std::find(amounts.begin(), amounts.end(), preferred);
    if (found != amounts.end()) return static_cast<std::size_t>(found - amounts.begin());
  }
  return 0;
}

bool MadeReservoirAllowed(const Problem& problem, const std::vector<Amount>& amounts) {
  return problem.configurations.contains(Configuration::kCompressor) && !PricesNeeded(problem) &&
         std::find(amounts.begin(), amounts.end(), Amount::kCost) == amounts.end() &&
         MadeToMeasureAllowed(problem, Family::kReservoir);
}

// Where energy counts a tank's fill trades its air against the time that coils are on.
double Resolution(const Problem& problem, const std::vector<Amount>& amounts) {
  const bool made = MadeReservoirAllowed(problem, amounts);
  const bool tank = problem.configurations.contains(Configuration::kTank) ||
                    problem.configurations.contains(Configuration::kTankAndPump);
  const bool energy = std::find(amounts.begin(), amounts.end(), Amount::kEnergy) != amounts.end();
  if (energy && (made || tank)) return kCurveResolution;
  return made ? kMadeResolution : kTie;
}

double ObjectiveOfTotals(const Objective& objective, const Totals& totals) {
  return ObjectiveOf(objective, Amounts{totals.mass_kg, totals.volume_m3, totals.cost_known_eur}) +
         objective.energy_wh * totals.energy_j / kJoulePerWattHour;
}

using Point = std::vector<double>;  // one value per amount
using Caps = std::vector<double>;   // one limit per amount; +∞ on the minimised one

bool Within(const Point& point, const Caps& limits) {
  for (std::size_t i = 0; i < point.size(); ++i)
    if (point[i] > limits[i]) return false;
  return true;
}

bool Inside(const Caps& inner, const Caps& outer) { return Within(inner, outer); }

class FrontSearch {
 public:
  FrontSearch(const Problem& problem, const std::vector<Amount>& amounts,
              const SearchOptions& options, const FindConflictsFunction& explain)
      : problem_(problem),
        amounts_(amounts),
        options_(options),
        explain_(explain),
        minimised_(Minimised(amounts)),
        resolution_(Resolution(problem, amounts)) {}

  Front Run() {
    regions_.push_back(Caps(amounts_.size(), kUnlimited));
    while (!regions_.empty()) {
      const Caps region = regions_.front();
      regions_.pop_front();
      if (Settled(region)) continue;
      if (amounts_.size() == 2 && searches_ > 0)
        ExploreTwo(region);
      else
        Explore(region);
    }
    return Conclude();
  }

 private:
  // A region that was searched, and the best point found in it.
  struct Explored {
    Caps region;
    std::optional<Point> best;  // none: proved empty
  };
  struct Found {
    Point point;
    Design design;
  };

  double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  // Whether a search of a larger region has answered for this one, or an open one will.
  bool Settled(const Caps& region) {
    for (const Caps& open : regions_)
      if (Inside(region, open)) return true;
    for (const Explored& explored : explored_) {
      if (!Inside(region, explored.region)) continue;
      if (!explored.best) return true;
      if (!Within(*explored.best, region)) continue;
      Divide(region, *explored.best);
      return true;
    }
    return false;
  }

  // What the region may hold besides a best point: designs that are lower in another amount.
  void Divide(const Caps& region, const Point& best) {
    for (std::size_t i = 0; i < best.size(); ++i) {
      if (i == minimised_) continue;
      Caps lower = region;
      lower[i] = best[i] * (1.0 - resolution_);
      regions_.push_back(std::move(lower));
    }
  }

  Problem Limited(const Caps& region) const {
    Problem limited = problem_;
    limited.count = 1;
    limited.objective = ObjectiveOn(amounts_[minimised_]);
    for (std::size_t i = 0; i < amounts_.size(); ++i) {
      if (i == minimised_) continue;
      double& limit = LimitOn(amounts_[i], limited);
      limit = std::min(limit, region[i]);
      if (amounts_[i] == Amount::kCost) limit = std::min(limit, kPricedEur);
    }
    return limited;
  }

  Answer Search(const Problem& limited) {
    const double used_s = Seconds();
    SearchOptions options = options_;
    const double left_s = std::max(0.0, options_.time_limit_s - used_s);
    options.time_limit_s = std::max(kSearchShare * left_s, std::min(left_s, kSearchLeastS));
    if (options_.progress)
      options.progress = [&](Progress progress) {
        progress.seconds += used_s;
        options_.progress(progress);
      };
    ++searches_;
    Answer answer = SearchTrees(limited, options);
    // The first search alone explains why there is nothing.
    if (searches_ == 1 && answer.status == Status::kInfeasible && explain_)
      answer.infeasibility = explain_(limited, options, answer.seconds);
    cancelled_ = cancelled_ || answer.status == Status::kCancelled;
    const bool proved = answer.status == Status::kOptimal || answer.status == Status::kInfeasible;
    proved_ += proved;
    if (searches_ == 1) {
      first_.proof = answer.proof;
      first_.infeasibility = std::move(answer.infeasibility);
      if (std::isinf(problem_.cost_max_eur)) PricesAreNoLimit(first_.infeasibility);
    }
    return answer;
  }

  // Prices were asked for, not a limit on their sum.
  static void PricesAreNoLimit(Infeasibility& found) {
    const std::string limit = "/supply/cost_eur_max";
    for (std::vector<Conflict>& conflict : found.conflicts)
      std::erase_if(conflict, [&](const Conflict& entry) { return entry.requirement == limit; });
    const auto dropped =
        std::find_if(found.relaxation.begin(), found.relaxation.end(),
                     [&](const Concession& one) { return one.requirement == limit; });
    if (dropped != found.relaxation.end()) *dropped = {"prices", std::nullopt, std::nullopt};
  }

  void Explore(const Caps& region) {
    const bool stopped = cancelled_ || Seconds() > options_.time_limit_s ||
                         (options_.cancelled && options_.cancelled());
    if (stopped && searches_ > 0) {
      cancelled_ = cancelled_ || (options_.cancelled && options_.cancelled());
      unexplored_.push_back({region, amounts_[minimised_], 0.0});
      return;
    }
    Answer answer = Search(Limited(region));
    if (answer.status == Status::kInfeasible) {
      explored_.push_back({region, std::nullopt});
      return;
    }
    if (answer.status != Status::kOptimal)
      unexplored_.push_back({region, amounts_[minimised_], answer.proof.lower_bound});
    if (answer.designs.empty()) return;
    Found found{PointOf(answer.designs.front()), std::move(answer.designs.front())};
    if (answer.status == Status::kOptimal) explored_.push_back({region, found.point});
    Divide(region, found.point);
    found_.push_back(std::move(found));
  }

  // All that is left of a front in two amounts.
  void ExploreTwo(const Caps& region) {
    const std::size_t limited = 1 - minimised_;
    SearchOptions options = options_;
    options.time_limit_s = options_.time_limit_s - Seconds();
    const Point& first = found_.front().point;
    FrontPart part =
        amounts_[minimised_] == Amount::kEnergy
            ? WalkFront(Limited(region), amounts_[limited], resolution_, options)
            : GrowFront(Limited(Caps(2, kUnlimited)), {amounts_[minimised_], amounts_[limited]},
                        {first[minimised_], first[limited]}, options);
    cancelled_ = cancelled_ || part.cancelled;
    proved_ += static_cast<int>(part.designs.size()) + part.open.empty();
    searches_ += static_cast<int>(part.designs.size()) + 1;
    for (const FrontPart::Open& open : part.open) {
      Caps caps(2, kUnlimited);
      caps[minimised_] = open.limits[0];
      caps[limited] = open.limits[1];
      unexplored_.push_back({std::move(caps), amounts_[minimised_], open.least});
    }
    for (Design& design : part.designs) {
      Point point = PointOf(design);
      found_.push_back({std::move(point), std::move(design)});
    }
  }

  Point PointOf(const Design& design) const {
    Point point;
    for (Amount amount : amounts_) point.push_back(Of(amount, design.totals));
    return point;
  }

  bool Beats(const Point& a, const Point& b) const {
    bool better = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] > b[i] * (1.0 + kTie)) return false;
      better = better || a[i] < b[i] * (1.0 - kTie);
    }
    return better;
  }

  bool Same(const Point& a, const Point& b) const {
    for (std::size_t i = 0; i < a.size(); ++i)
      if (std::abs(a[i] - b[i]) > kTie * std::abs(b[i])) return false;
    return true;
  }

  // Of a point and those that it beats, or that are the same, one stays; and of two amounts those
  // that better the limited one by the resolution.
  std::vector<Found> Nondominated() {
    std::stable_sort(found_.begin(), found_.end(), [&](const Found& a, const Found& b) {
      return a.point[minimised_] < b.point[minimised_];
    });
    std::vector<Found> front;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const Point& point = found_[i].point;
      const bool beaten = std::any_of(found_.begin(), found_.end(), [&](const Found& other) {
        return Beats(other.point, point);
      });
      const bool near = std::any_of(front.begin(), front.end(), [&](const Found& kept) {
        return Same(kept.point, point) ||
               (point.size() == 2 &&
                point[1 - minimised_] > kept.point[1 - minimised_] * (1.0 - resolution_));
      });
      if (!beaten && !near) front.push_back(found_[i]);
    }
    return front;
  }

  // Limits of a region are not requirements of the problem.
  void RestoreRequirements(Design& design) const {
    const auto restore = [&](const char* pointer, double limit) {
      const auto margin = std::find_if(design.margins.begin(), design.margins.end(),
                                       [&](const Margin& m) { return m.requirement == pointer; });
      if (margin == design.margins.end()) return;
      if (std::isinf(limit)) {
        design.margins.erase(margin);
        return;
      }
      margin->required = limit;
      margin->relative_margin = (limit - margin->achieved) / limit;
    };
    restore("/supply/mass_kg_max", problem_.mass_max_kg);
    restore("/supply/volume_l_max", problem_.volume_max_l);
    restore("/supply/cost_eur_max", problem_.cost_max_eur);
    design.objective = ObjectiveOfTotals(problem_.objective, design.totals);
  }

  Front Conclude() {
    Front front;
    front.amounts = amounts_;
    front.resolution = resolution_;
    front.searches = searches_;
    front.proved = proved_;
    front.unexplored = std::move(unexplored_);
    front.answer = std::move(first_);
    for (Found& found : Nondominated()) {
      front.answer.designs.push_back(std::move(found.design));
      RestoreRequirements(front.answer.designs.back());
    }
    std::vector<Design>& designs = front.answer.designs;
    std::stable_sort(designs.begin(), designs.end(),
                     [](const Design& a, const Design& b) { return a.objective < b.objective; });
    front.answer.proof.complete = !cancelled_ && front.unexplored.empty();
    front.answer.status = cancelled_                     ? Status::kCancelled
                          : !front.answer.proof.complete ? Status::kFeasible
                          : designs.empty()              ? Status::kInfeasible
                                                         : Status::kOptimal;
    front.answer.seconds = Seconds();
    return front;
  }

  const Problem& problem_;
  const std::vector<Amount>& amounts_;
  const SearchOptions& options_;
  const FindConflictsFunction& explain_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const std::size_t minimised_;
  const double resolution_;
  std::deque<Caps> regions_;  // still to be looked at
  std::vector<Explored> explored_;
  std::vector<Found> found_;
  std::vector<Unexplored> unexplored_;
  Answer first_;
  int searches_ = 0, proved_ = 0;
  bool cancelled_ = false;
};

}  // namespace

Front ParetoFront(const Problem& problem, const std::vector<Amount>& amounts,
                  const SearchOptions& options, const FindConflictsFunction& explain) {
  return FrontSearch(problem, amounts, options, explain).Run();
}

}  // namespace plenum::optimizer
