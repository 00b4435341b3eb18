#include "verify/tree/verify_gaps.h"

#include <memory>
#include <numeric>

#include "verify/corner/verify_dominance.h"
#include "verify/design/verify_families.h"
#include "verify/tree/verify_box.h"
#include "verify/tree/verify_record.h"

namespace plenum::verify {
namespace {

constexpr double kNoLimit = 1e12;  // a limit that only asks for prices

double& WeightOf(Amount amount, Objective& objective) {
  return amount == Amount::kMass     ? objective.mass_kg
         : amount == Amount::kVolume ? objective.volume_l
         : amount == Amount::kCost   ? objective.cost_eur
                                     : objective.energy_wh;
}

double& LimitOf(Amount amount, Problem& problem) {
  return amount == Amount::kMass     ? problem.mass_max_kg
         : amount == Amount::kVolume ? problem.volume_max_l
                                     : problem.cost_max_eur;
}

// All amounts are limited, so that what is dominated is so in each of them.
Problem Weighted(const Problem& problem, const std::vector<Amount>& amounts, const Point& weights) {
  Problem weighted = problem;
  weighted.objective = {};
  for (std::size_t i = 0; i < amounts.size(); ++i) {
    WeightOf(amounts[i], weighted.objective) = weights[i];
    if (amounts[i] == Amount::kEnergy) continue;
    double& limit = LimitOf(amounts[i], weighted);
    limit = std::min(limit, kNoLimit);
  }
  return weighted;
}

// Whether a box of one corner lies in that of another.
bool Inside(const Point& a, const Point& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] > b[i]) return false;
  return true;
}

bool Below(const Point& a, const Point& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] >= b[i]) return false;
  return true;
}

double Sum(const Point& weights, const Point& point) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0.0) sum += weights[i] * point[i];
  return sum;
}

Point Single(std::size_t amounts, std::size_t amount) {
  Point weights(amounts, 0.0);
  weights[amount] = 1.0;
  return weights;
}

// Weights of sums, each amount but the first counting from an eighth to eight times as much as
// their least values say.
std::vector<Point> Sums(const std::vector<Point>& points) {
  Point least = points.front();
  for (const Point& point : points)
    for (std::size_t i = 0; i < point.size(); ++i) least[i] = std::min(least[i], point[i]);
  for (double& amount : least) amount = amount > 0.0 ? amount : 1.0;
  std::vector<Point> sums{{1.0 / least[0]}};
  for (std::size_t i = 1; i < least.size(); ++i) {
    std::vector<Point> more;
    for (const Point& sum : sums)
      for (double factor = 0.125; factor <= 8.0; factor *= 2.0) {
        more.push_back(sum);
        more.back().push_back(factor / least[i]);
      }
    sums = std::move(more);
  }
  return sums;
}

// The choices that no other dominates, by their share of the objective.
ProofPlan WholePlan(const Problem& problem, const Layout& layout) {
  ProofPlan plan = EmptyPlan(problem, layout);
  plan.equal_flow = FlowMustBeEqual(problem, layout);
  for (ProofSlot& slot : plan.slots) {
    const std::vector<ProofItem> entries = EntriesOf(problem, layout, slot);
    std::vector<std::pair<double, ProofItem>> kept;
    for (const ProofItem& item : entries)
      if (std::none_of(entries.begin(), entries.end(), [&](const ProofItem& other) {
            return !(other == item) && Dominates(problem, plan, slot, other, item);
          }))
        kept.emplace_back(ChoiceAmounts(problem, layout, slot, item).objective, item);
    std::stable_sort(kept.begin(), kept.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [share, item] : kept) slot.choices.push_back(item);
  }
  return plan;
}

class GapCheck {
 public:
  GapCheck(const Problem& problem, const std::vector<Amount>& amounts,
           const std::vector<Point>& points, const std::vector<Point>& gaps, const Stop& stop)
      : problem_(problem),
        amounts_(amounts),
        gaps_(gaps),
        stop_(stop),
        within_(Weighted(problem, amounts, Single(amounts.size(), 0))),
        sizer_(within_, stop) {
    for (std::size_t i = 0; i < amounts.size(); ++i) weights_.push_back(Single(amounts.size(), i));
    for (Amount amount : amounts)
      limits_.push_back(amount == Amount::kEnergy ? kUnlimited : LimitOf(amount, within_));
    if (points.empty()) return;
    const std::vector<Point> sums = Sums(points);
    weights_.insert(weights_.end(), sums.begin(), sums.end());
    least_.resize(weights_.size(), kUnlimited);
    for (std::size_t w = 0; w < weights_.size(); ++w)
      for (const Point& point : points) least_[w] = std::min(least_[w], Sum(weights_[w], point));
  }

  BigCount Run(const Layout& layout, Findings& findings) {
    plan_ = WholePlan(within_, layout);
    bounds_.clear();
    strokes_.emplace(problem_, plan_);
    bounds_.resize(weights_.size());
    Part whole;
    for (const ProofSlot& slot : plan_.slots) {
      if (slot.choices.empty()) return 0;
      whole.ranges.emplace_back(0, static_cast<int>(slot.choices.size()));
    }
    whole.gaps.resize(gaps_.size());
    std::iota(whole.gaps.begin(), whole.gaps.end(), 0);
    BigCount open = 0;
    std::vector<Part> waiting{std::move(whole)};
    while (!waiting.empty()) {
      ++looks_;
      Part part = std::move(waiting.back());
      waiting.pop_back();
      if (looks_ > kLooksMax || Stopped(stop_)) {
        open += CountOf(part.ranges);
        continue;
      }
      Corners& corners = Close(part);
      if (part.gaps.empty()) continue;
      const int slot = SlotToDivide(plan_, corners, part.ranges);
      if (slot < 0) {
        looks_ += kLooksPerSize;
        if (!IsSettled(part, findings)) open += 1;
        continue;
      }
      Part right = part;
      const auto [first, last] = part.ranges[slot];
      part.ranges[slot].second = right.ranges[slot].first = (first + last) / 2;
      waiting.push_back(std::move(right));
      waiting.push_back(std::move(part));
    }
    return open;
  }

 private:
  struct Bound {  // on a weighted sum of the amounts
    Bound(const Problem& weighted, const ProofPlan& plan, KnownStrokes& strokes)
        : problem(weighted), corners(problem, plan, strokes) {}
    const Problem problem;
    Corners corners;
  };
  struct Part {  // a box, and the gaps that it may reach into
    Ranges ranges;
    std::vector<int> gaps;
  };

  Corners& CornersOf(std::size_t weights) {
    std::unique_ptr<Bound>& bound = bounds_[weights];
    if (!bound)
      bound = std::make_unique<Bound>(Weighted(problem_, amounts_, weights_[weights]), plan_,
                                      *strokes_);
    return bound->corners;
  }

  double Corner(std::size_t weights, int gap) const { return Sum(weights_[weights], gaps_[gap]); }

  // Leaves out the gaps that a bound closes, the lowest first.
  void Close(Part& part, std::size_t weights) {
    while (!part.gaps.empty()) {
      double lowest = kUnlimited;
      for (int gap : part.gaps) lowest = std::min(lowest, Corner(weights, gap));
      if (std::isinf(lowest) && weights > 0) return;
      const double bound = CornersOf(weights).LeastObjective(part.ranges, lowest);
      if (!(bound > lowest) && !std::isinf(bound)) return;
      std::erase_if(part.gaps, [&](int gap) { return Corner(weights, gap) <= bound; });
    }
  }

  // By the single amounts, then by the sum that tells most of the gap in the middle; the one asked
  // last.
  Corners& Close(Part& part) {
    for (std::size_t w = 0; w < amounts_.size(); ++w) Close(part, w);
    std::size_t best = 0;
    if (!part.gaps.empty()) {
      const int middle = part.gaps[part.gaps.size() / 2];
      double lowest = kUnlimited;
      for (std::size_t w = amounts_.size(); w < weights_.size(); ++w)
        if (const double share = Corner(w, middle) / least_[w]; share < lowest) {
          lowest = share;
          best = w;
        }
      if (best > 0) Close(part, best);
    }
    return CornersOf(best);
  }

  bool IsSettled(const Part& single, Findings& findings) {
    const Assembly assembly = AssemblyAt(within_, plan_, single.ranges);
    for (int gap : single.gaps) {
      const Point& corner = gaps_[gap];
      for (std::size_t i = 1; i < amounts_.size(); ++i)
        LimitOf(amounts_[i], within_) = std::min(limits_[i], corner[i]);
      const Sizing sizing = sizer_.Size(assembly, -kToSpare, corner[0]);
      if (sizing.status == Sized::kInfeasible || sizing.lower_bound >= corner[0]) continue;
      if (sizing.status != Sized::kFeasible || sizing.objective >= corner[0]) return false;
      findings.push_back({"rechecked", "a " + std::string(Name(plan_.configuration)) +
                                           " design that is not listed comes to " +
                                           std::to_string(sizing.objective) + ": " +
                                           Text(EarliestIds(within_, plan_, single.ranges))});
      return true;
    }
    return true;
  }

  const Problem& problem_;
  const std::vector<Amount>& amounts_;
  const std::vector<Point>& gaps_;
  const Stop& stop_;
  Point limits_;                // of the problem
  std::vector<Point> weights_;  // of the single amounts, then of sums
  std::vector<double> least_;   // of the points, by these
  Problem within_;              // the least of the first amount within a gap
  Sizer sizer_;
  ProofPlan plan_;
  std::optional<KnownStrokes> strokes_;
  std::vector<std::unique_ptr<Bound>> bounds_;  // by these weights, once they are asked
  long long looks_ = 0;
};

}  // namespace

std::vector<Point> GapsBetween(const std::vector<Point>& points, std::size_t amounts) {
  std::vector<Point> gaps{Point(amounts, kUnlimited)};
  for (const Point& point : points) {
    std::vector<Point> kept, cut;
    for (Point& gap : gaps) (Below(point, gap) ? cut : kept).push_back(std::move(gap));
    for (const Point& gap : cut)
      for (std::size_t i = 0; i < amounts; ++i) {
        Point lower = gap;
        lower[i] = point[i];
        const auto holds = [&](const Point& other) { return Inside(lower, other); };
        if (std::any_of(kept.begin(), kept.end(), holds)) continue;
        std::erase_if(kept, [&](const Point& other) { return Inside(other, lower); });
        kept.push_back(std::move(lower));
      }
    gaps = std::move(kept);
  }
  return gaps;
}

BigCount CheckGaps(const Problem& problem, const std::vector<Amount>& amounts,
                   const std::vector<Point>& points, const std::vector<Point>& gaps,
                   const Stop& stop, Findings& findings) {
  GapCheck check(problem, amounts, points, gaps, stop);
  BigCount open = 0;
  for (const Layout& layout : LayoutsOf(problem)) open += check.Run(layout, findings);
  return open;
}

}  // namespace plenum::verify
