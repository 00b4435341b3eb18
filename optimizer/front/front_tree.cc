#include "optimizer/front/front_tree.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "optimizer/bounds/leaf_sizing.h"
#include "optimizer/choices/make_plan.h"
#include "optimizer/choices/reweigh.h"
#include "optimizer/front/front_clock.h"
#include "optimizer/front/stairs.h"
#include "optimizer/search/queue.h"
#include "optimizer/sizing/report.h"

namespace plenum::optimizer {
namespace {

constexpr double kNoLimit = 1e12;  // finite: dominance compares what is limited
// A point so far below the line through a region's ends divides it; of the distance from the line
// to the region's corner.
constexpr double kHullDepth = 0.01;

struct Node {
  Box box;
  Bounds* bounds = nullptr;
  long long serial = 0;
  int depth = 0;
  int weighing = 0;                      // for which the key holds
  std::size_t points = 0;                // that were known when it was pushed
  double key = 0.0;                      // of its weighted sum, at least
  Pair low{};                            // of its amounts, at least
  std::unique_ptr<CustomSizing> sizing;  // of a made-to-measure reservoir
  std::optional<Leaf> leaf;              // `low` is then what it takes
};
using NodePtr = std::unique_ptr<Node>;
using Nodes = std::vector<NodePtr>;

// Between two points of the front, and the boxes that it may need.
struct Region {
  Pair left, right;
  Nodes nodes;
};

class FrontTree {
 public:
  FrontTree(const Problem& problem, std::array<Amount, 2> amounts, Pair first,
            const SearchOptions& options)
      : problem_(problem),
        amounts_(amounts),
        first_(first),
        clock_(options),
        bench_{[this] { return clock_.Stopped(); }, options.periodic},
        stairs_(first) {
    for (Amount amount : amounts) {
      double& limit = LimitOn(amount, problem_);
      limit = std::min(limit, kNoLimit);
    }
  }

  FrontPart Run() {
    const auto inverse = [](double amount) { return amount > 0.0 ? 1.0 / amount : 1.0; };
    Weigh({inverse(first_[0]), inverse(first_[1])});
    Region whole{first_, {kUnlimited, 0.0}, Plant()};
    FindFarEnd(whole);
    if (stairs_.points().size() > 1 || clock_.Stopped()) regions_.push_back(std::move(whole));
    while (!regions_.empty() && !clock_.Stopped()) {
      Region region = std::move(regions_.back());
      regions_.pop_back();
      Explore(std::move(region));
    }
    for (const Region& region : regions_) LeaveOpen(region);
    part_.cancelled = clock_.cancelled();
    return std::move(part_);
  }

 private:
  void Weigh(const Pair& weights) {
    weights_ = weights;
    ++weighing_;
    const Objective one = ObjectiveOn(amounts_[0]), two = ObjectiveOn(amounts_[1]);
    problem_.objective = {.mass_kg = weights[0] * one.mass_kg + weights[1] * two.mass_kg,
                          .volume_l = weights[0] * one.volume_l + weights[1] * two.volume_l,
                          .cost_eur = weights[0] * one.cost_eur + weights[1] * two.cost_eur};
    for (const std::unique_ptr<Plan>& plan : plans_) Reweigh(problem_, *plan);
    for (const std::unique_ptr<Bounds>& bounds : bounds_) bounds->ChangeWeights();
  }

  double Weighted(const Pair& at) const { return weights_[0] * at[0] + weights_[1] * at[1]; }

  Pair PairOf(const Amounts& amounts) const {
    const Totals totals{amounts.mass_kg, amounts.volume_m3, amounts.cost_eur};
    return {Of(amounts_[0], totals), Of(amounts_[1], totals)};
  }

  Nodes Plant() {
    Nodes roots;
    for (const Layout& layout : LayoutsOf(problem_)) {
      std::unique_ptr<Plan> plan = MakePlan(problem_, layout, false, bench_.stop);
      if (!plan) break;
      plans_.push_back(std::move(plan));
      if (plans_.back()->empty()) continue;
      bounds_.push_back(std::make_unique<Bounds>(
          problem_, *plans_.back(), &bench_,
          [this](const Amounts& amounts) { return stairs_.Below(PairOf(amounts)); }));
      auto root = std::make_unique<Node>();
      root->bounds = bounds_.back().get();
      root->box = root->bounds->Root();
      if (root->bounds->Assess(root->box, -1) != Constraint::kNone) continue;
      root->low = PairOf(root->bounds->LeastAssessed(root->box));
      roots.push_back(std::move(root));
    }
    return roots;
  }

  // The least of the second amount there is.
  void FindFarEnd(Region& whole) {
    Weigh({0.0, 1.0});
    Open(whole);
    while (!open_.empty() && !clock_.Stopped())
      if (const std::optional<Pair> point = Next()) {
        whole.right = *point;
        break;
      }
    parked_.clear();
    while (!open_.empty()) whole.nodes.push_back(open_.Pop());
  }

  // Finds all points in the region, or one that divides it in two.
  void Explore(Region region) {
    const Pair sides{region.right[0] - region.left[0], region.left[1] - region.right[1]};
    if (sides[0] <= kTie * region.right[0] || sides[1] <= kTie * region.left[1])
      return PassOn(region.nodes);
    Weigh({1.0 / sides[0], 1.0 / sides[1]});
    Open(region);
    bool alone = true;  // no point of the region is found yet
    while (!open_.empty() && !clock_.Stopped()) {
      const std::optional<Pair> point = Next();
      const Pair corner{region.left[0], region.right[1]};
      if (point && alone && Weighted(*point) - Weighted(corner) < 1.0 - kHullDepth)
        return Divide(region, *point);
      alone = alone && !point;
    }
    if (clock_.Stopped()) return regions_.push_back(std::move(region));
    PassOn(parked_);
  }

  void Divide(const Region& region, const Pair& point) {
    PassOn(parked_);
    Region left{region.left, point, {}};
    while (!open_.empty()) left.nodes.push_back(open_.Pop());
    regions_.push_back({point, region.right, {}});
    regions_.push_back(std::move(left));
  }

  // To the region that comes next.
  void PassOn(Nodes& nodes) {
    if (!regions_.empty())
      for (NodePtr& node : nodes) regions_.back().nodes.push_back(std::move(node));
    nodes.clear();
  }

  // Queues what the region admits by what it takes at least.
  void Open(Region& region) {
    limits_ = {region.right[0] * (1.0 - kTie), region.left[1] * (1.0 - kTie)};
    for (NodePtr& node : region.nodes) {
      node->key = Weighted(node->low);
      Enqueue(std::move(node));
    }
    region.nodes.clear();
  }

  bool Admitted(const Node& node) const {
    return stairs_.Admit(node.low, limits_, weights_, node.key);
  }

  void Enqueue(NodePtr node) {
    if (!Admitted(*node)) return parked_.push_back(std::move(node));
    node->serial = serial_++;
    open_.Push(std::move(node));
  }

  void Push(NodePtr node, double sum) {
    node->key = std::max(sum, Weighted(node->low));
    node->weighing = weighing_;
    node->points = stairs_.points().size();
    Enqueue(std::move(node));
  }

  void Keep(NodePtr node, Constraint missed) {
    if (missed != Constraint::kNone) return;
    node->low = PairOf(node->bounds->LeastAssessed(node->box));
    const double bound = node->box.bound;
    Push(std::move(node), bound);
  }

  // A step with the lowest node; the point that it was, if any.
  std::optional<Pair> Next() {
    Report();
    NodePtr node = open_.Pop();
    Bounds& bounds = *node->bounds;
    Box& box = node->box;
    if (!Admitted(*node)) {
      parked_.push_back(std::move(node));
    } else if (node->leaf) {
      return Take(std::move(node));
    } else if (node->sizing) {
      Size(std::move(node));
    } else if (node->weighing != weighing_) {
      const Constraint missed = bounds.Reweigh(box);
      Keep(std::move(node), missed);
    } else if (node->points != stairs_.points().size()) {  // does it still have anything to offer?
      const Constraint missed = bounds.Reassess(box);
      Keep(std::move(node), missed);
    } else if (bounds.CanFindSource(box)) {
      const Constraint missed = bounds.FindSource(box);
      Keep(std::move(node), missed);
    } else if (bounds.IsSingle(box)) {
      Size(std::move(node));
    } else {
      Halve(*node);
    }
    return std::nullopt;
  }

  void Halve(const Node& node) {
    Halves halves = optimizer::Divide(*node.bounds, node.box, DivideFor::kProof);
    for (Box& half : halves.boxes) {
      auto part = std::make_unique<Node>();
      part->bounds = node.bounds;
      part->box = std::move(half);
      part->depth = node.depth + 1;
      const Constraint missed = part->bounds->Assess(part->box, halves.slot);
      Keep(std::move(part), missed);
    }
  }

  // The least volume that does is the best under all weights: with a larger one the stop pressure
  // may be lower, but by far not so much that its walls weigh less. So a made-to-measure reservoir
  // is sized by the first amount alone, and what is known of it holds for the next region.
  std::optional<Leaf> SizeForAll(const Candidate& candidate, Node& node) {
    Box box = node.box;
    const Objective weighted = std::exchange(problem_.objective, ObjectiveOn(amounts_[0]));
    const std::optional<Leaf> leaf = SizeLeaf(problem_, candidate, box, node.sizing);
    problem_.objective = weighted;
    return leaf;
  }

  void Size(NodePtr node) {
    const Candidate candidate = node->bounds->CandidateOf(node->box);
    const std::optional<Leaf> leaf = SizeForAll(candidate, *node);
    if (!leaf) {
      node->low = PairOf(
          TotalAmounts(problem_, candidate, LeastPoint(problem_, node->sizing->volume_least_m3())));
      Push(std::move(node), 0.0);
      return;
    }
    if (leaf->status == LeafStatus::kUndecided && clock_.Stopped()) {
      const double bound = node->box.bound;
      Push(std::move(node), bound);
      return;
    }
    node->sizing.reset();
    if (leaf->status == LeafStatus::kInfeasible) return;
    if (leaf->status == LeafStatus::kUndecided ||
        leaf->lower_bound < leaf->objective * (1.0 - kTie))
      LeaveOpen(node->low);
    if (leaf->status == LeafStatus::kUndecided) return;
    node->leaf = leaf;
    node->low = PairOf(TotalAmounts(problem_, candidate, leaf->point));
    Push(std::move(node), 0.0);
  }

  // A sized leaf that no other undercuts.
  std::optional<Pair> Take(NodePtr node) {
    const Candidate candidate = node->bounds->CandidateOf(node->box);
    std::optional<Design> design = MakeDesign(problem_, candidate, *node->leaf);
    if (!design) {
      if (!clock_.Stopped()) LeaveOpen(node->low);
      return std::nullopt;
    }
    const Pair point{Of(amounts_[0], design->totals), Of(amounts_[1], design->totals)};
    stairs_.Add(point);
    part_.designs.push_back(std::move(*design));
    return point;
  }

  // A design that takes at least so much may be missing.
  void LeaveOpen(const Pair& low) {
    double second = kUnlimited;
    for (const Pair& point : stairs_.points())
      if (point[0] <= low[0]) second = point[1];
    part_.open.push_back({{kUnlimited, second}, low[0]});
  }

  // Any design in a gap of the region may be.
  void LeaveOpen(const Region& region) {
    const std::vector<Pair>& points = stairs_.points();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (region.left[0] <= points[i][0] && points[i][0] < region.right[0])
        part_.open.push_back(
            {{i + 1 < points.size() ? points[i + 1][0] : kUnlimited, points[i][1]}, points[i][0]});
  }

  void Report() {
    Progress progress;
    progress.evaluated = static_cast<long long>(part_.designs.size());
    progress.open = static_cast<long long>(open_.size());
    progress.lower_bound = first_[0];
    clock_.Report(progress);
  }

  Problem problem_;
  const std::array<Amount, 2> amounts_;
  const Pair first_;
  FrontClock clock_;
  Workbench bench_;
  Stairs stairs_;
  std::vector<std::unique_ptr<Plan>> plans_;
  std::vector<std::unique_ptr<Bounds>> bounds_;
  std::vector<Region> regions_;  // still to be explored, the next one last
  Pair limits_{}, weights_{};    // of the region that is
  int weighing_ = 0;
  Queue<NodePtr, LowestKey> open_;
  Nodes parked_;  // that the region does not admit
  FrontPart part_;
  long long serial_ = 0;
};

}  // namespace

FrontPart GrowFront(const Problem& problem, std::array<Amount, 2> amounts, Pair first,
                    const SearchOptions& options) {
  return FrontTree(problem, amounts, first, options).Run();
}

}  // namespace plenum::optimizer
