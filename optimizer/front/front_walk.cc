#include "optimizer/front/front_walk.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "optimizer/bounds/leaf_sizing.h"
#include "optimizer/choices/make_plan.h"
#include "optimizer/front/front_clock.h"
#include "optimizer/search/queue.h"
#include "optimizer/sizing/report.h"

namespace plenum::optimizer {
namespace {

struct Node {
  Box box;
  Bounds* bounds = nullptr;
  long long serial = 0;
  int depth = 0;
  double key = 0.0;                      // the box's bound, or the objective of its leaf
  std::unique_ptr<CustomSizing> sizing;  // of a made-to-measure reservoir
  std::optional<Leaf> leaf;              // sized within a limit that held then
  double limit = kUnlimited;             // when it was pushed
};
using NodePtr = std::unique_ptr<Node>;

class Walker {
 public:
  Walker(const Problem& problem, Amount limited, double resolution, const SearchOptions& options)
      : problem_(problem),
        limited_(limited),
        limit_(LimitOn(limited, problem_)),
        resolution_(resolution),
        clock_(options),
        bench_{[this] { return clock_.Stopped(); }, options.periodic} {}

  FrontPart Run() {
    const bool planted = Plant();
    while (!open_.empty() && !clock_.Stopped()) {
      Report();
      Step(open_.Pop());
    }
    if (!planted || !open_.empty()) LeaveOpen(planted ? open_.top()->key : 0.0);
    walk_.cancelled = clock_.cancelled();
    return std::move(walk_);
  }

 private:
  void LeaveOpen(double least) { walk_.open.push_back({{kUnlimited, limit_}, least}); }

  // False if stopped on the way.
  bool Plant() {
    for (const Layout& layout : LayoutsOf(problem_)) {
      std::unique_ptr<Plan> plan = MakePlan(problem_, layout, false, bench_.stop);
      if (!plan) return false;
      plans_.push_back(std::move(plan));
      if (plans_.back()->empty()) continue;
      bounds_.push_back(std::make_unique<Bounds>(problem_, *plans_.back(), &bench_));
      auto node = std::make_unique<Node>();
      node->bounds = bounds_.back().get();
      node->box = node->bounds->Root();
      const Constraint missed = node->bounds->Assess(node->box, -1);
      Keep(std::move(node), missed);
    }
    return true;
  }

  void Push(NodePtr node, double key) {
    node->key = key;
    node->limit = limit_;
    node->serial = serial_++;
    open_.Push(std::move(node));
  }

  void Keep(NodePtr node, Constraint missed) {
    const double bound = node->box.bound;
    if (missed == Constraint::kNone) Push(std::move(node), bound);
  }

  void Step(NodePtr node) {
    Bounds& bounds = *node->bounds;
    if (node->leaf) {
      Take(std::move(node));
    } else if (node->limit > limit_ && !node->sizing) {  // does it still have anything to offer?
      const Constraint missed = bounds.Reassess(node->box);
      Keep(std::move(node), missed);
    } else if (bounds.CanFindSource(node->box)) {
      const Constraint missed = bounds.FindSource(node->box);
      Keep(std::move(node), missed);
    } else if (bounds.IsSingle(node->box)) {
      Size(std::move(node));
    } else {
      Divide(*node);
    }
  }

  void Divide(const Node& node) {
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

  void Size(NodePtr node) {
    const Candidate candidate = node->bounds->CandidateOf(node->box);
    const std::optional<Leaf> sized = SizeLeaf(problem_, candidate, node->box, node->sizing);
    if (!sized) {
      const double bound = node->box.bound;
      Push(std::move(node), bound);
      return;
    }
    node->sizing.reset();
    const Leaf& leaf = *sized;
    const double bound = std::max(node->box.bound, leaf.lower_bound);
    if (leaf.status == LeafStatus::kUndecided && clock_.Stopped()) {
      Push(std::move(node), bound);
      return;
    }
    if (leaf.status == LeafStatus::kUndecided || leaf.lower_bound < leaf.objective * (1.0 - kTie))
      if (leaf.status != LeafStatus::kInfeasible) LeaveOpen(bound);
    if (leaf.status != LeafStatus::kFeasible) return;
    node->leaf = leaf;
    Push(std::move(node), leaf.objective);
  }

  // A sized leaf that no other undercuts.
  void Take(NodePtr node) {
    Candidate candidate = node->bounds->CandidateOf(node->box);
    const Leaf leaf = *node->leaf;
    const bool made = candidate.reservoir.index == kCustom || HasTank(candidate.configuration);
    // Where energy counts another volume, or fill of a tank, may do within a lower limit; else this
    // is the least.
    const bool again = made && problem_.objective.energy_wh > 0.0;
    if (!Within(candidate, leaf.point)) {
      node->leaf.reset();
      if (made) Push(std::move(node), leaf.objective);
      return;
    }
    std::optional<Design> design = MakeDesign(problem_, candidate, leaf);
    if (!design) {
      if (clock_.Stopped())
        Push(std::move(node), leaf.objective);
      else
        LeaveOpen(leaf.objective);
      return;
    }
    limit_ = Of(limited_, design->totals) * (1.0 - resolution_);
    walk_.designs.push_back(std::move(*design));
    if (!again) return;
    node->leaf.reset();
    Push(std::move(node), leaf.objective);
  }

  bool Within(const Candidate& candidate, const OperatingPoint& point) const {
    const Amounts total = TotalAmounts(problem_, candidate, point);
    return total.mass_kg <= problem_.mass_max_kg &&
           total.volume_m3 * 1e3 <= problem_.volume_max_l &&
           total.cost_eur <= problem_.cost_max_eur;
  }

  void Report() {
    Progress progress;
    progress.open = static_cast<long long>(open_.size());
    progress.lower_bound = open_.top()->key;
    clock_.Report(progress);
  }

  Problem problem_;
  const Amount limited_;
  double& limit_;  // in problem_
  const double resolution_;
  FrontClock clock_;
  Workbench bench_;
  std::vector<std::unique_ptr<Plan>> plans_;
  std::vector<std::unique_ptr<Bounds>> bounds_;
  Queue<NodePtr, LowestKey> open_;
  FrontPart walk_;
  long long serial_ = 0;
};

}  // namespace

FrontPart WalkFront(const Problem& problem, Amount limited, double resolution,
                    const SearchOptions& options) {
  return Walker(problem, limited, resolution, options).Run();
}

}  // namespace plenum::optimizer
