#include "optimizer/search/dive.h"

#include <algorithm>
#include <limits>

#include "optimizer/bounds/leaf_sizing.h"

namespace plenum::optimizer {
namespace {

constexpr int kTurnsMax = 12;
constexpr int kCrowdDives = 20;  // for each design that is wanted
constexpr int kBoxesPerDiveStep = 2, kDiveStepsLeast = 10'000;
constexpr int kHardDesigns = 16;     // no design takes more than this part of the steps of dives
constexpr int kStepsPerRefine = 32;  // CustomSizing::Refine() takes the time of so many looks
constexpr long long kUnlimitedSteps = std::numeric_limits<long long>::max();

class Diver {
 public:
  Diver(const Problem& problem, Bounds& bounds, bool any, const std::function<bool()>& stop,
        DiveSteps& steps, Ranking& ranking)
      : problem_(problem),
        bounds_(bounds),
        any_(any),
        stop_(stop),
        steps_(steps),
        ranking_(ranking) {}

  // Follows the lower bound at every division but for a few, first none of them, then one, and so
  // on: the first choices, made on the weakest bounds, are the likeliest to be wrong.
  void Run() {
    if (bounds_.plan().empty()) return;
    for (int turns = 0; turns <= kTurnsMax && !Done(); ++turns) {
      Box root = bounds_.Root();
      if (bounds_.Assess(root, -1) != Constraint::kNone) return;
      Below(std::move(root), turns);
    }
  }

  void From(Box box, int turns) { Below(std::move(box), turns); }

 private:
  bool Done() const { return steps_.left <= 0 || stop_() || (any_ && !ranking_.list().empty()); }
  // Whether a box may still improve the list; its bound rises and that of the list falls.
  bool IsWanted(const Box& box) const {
    return !Done() && box.bound <= ranking_.run_end() && !ranking_.IsSettled(bounds_.plan(), box);
  }

  // `turns`: how often the part with the higher bound is taken below the box.
  void Below(Box box, int turns) {
    while (IsWanted(box) && bounds_.CanFindSource(box)) {
      const Constraint missed = bounds_.FindSource(box);
      steps_.left -= box.core ? kStepsPerRefine : 1;
      if (missed != Constraint::kNone) return;
    }
    if (!IsWanted(box)) return;
    if (bounds_.IsSingle(box)) {
      if (turns == 0) Try(std::move(box));
      return;
    }
    const int slot = bounds_.WidestSlot(box, DivideFor::kDesigns);
    const BoxNode& divided = (*bounds_.plan().slots[slot].nodes)[box.nodes[slot]];
    std::vector<Box> parts;
    for (int child : {divided.left, divided.right}) {
      --steps_.left;
      Box part = box;
      part.nodes[slot] = child;
      if (bounds_.Assess(part, slot) == Constraint::kNone) parts.push_back(std::move(part));
    }
    std::sort(parts.begin(), parts.end(),
              [](const Box& a, const Box& b) { return a.bound < b.bound; });
    if (parts.size() == 2 && turns > 0) Below(std::move(parts[1]), turns - 1);
    if (!parts.empty()) Below(std::move(parts[0]), turns);
  }

  void Try(Box box) {
    TieKey key = EarliestKey(problem_, bounds_.plan(), box);
    if (ranking_.Find(key) != nullptr) return;
    const Candidate candidate = bounds_.CandidateOf(box);
    std::unique_ptr<CustomSizing> sizing;
    std::optional<Leaf> sized;
    for (long long steps = 0; !sized && IsWanted(box) && steps < steps_.of_design;
         steps += kStepsPerRefine, steps_.left -= kStepsPerRefine)
      sized = SizeLeaf(problem_, candidate, box, sizing);
    if (sized && sized->status == LeafStatus::kFeasible)
      ranking_.Add({std::move(box), &bounds_, *sized, std::move(key), -1, nullptr, {}});
  }

  const Problem& problem_;
  Bounds& bounds_;
  bool any_;
  const std::function<bool()>& stop_;
  DiveSteps& steps_;
  Ranking& ranking_;
};

}  // namespace

void Dive(const Problem& problem, Bounds& bounds, bool any, const std::function<bool()>& stop,
          Ranking& ranking) {
  DiveSteps unlimited{kUnlimitedSteps, kUnlimitedSteps};
  Diver(problem, bounds, any, stop, unlimited, ranking).Run();
}

void DiveFrom(Box box, int turns, const Problem& problem, Bounds& bounds,
              const std::function<bool()>& stop, DiveSteps& steps, Ranking& ranking) {
  Diver(problem, bounds, false, stop, steps, ranking).From(std::move(box), turns);
}

void DiveFromNext(Queue<NodePtr, LowestBound>& open, const Problem& problem,
                  const std::function<bool()>& stop, long long boxes_done, Ranking& ranking) {
  DiveSteps steps{boxes_done / kBoxesPerDiveStep + kDiveStepsLeast, 0};
  steps.of_design = steps.left / kHardDesigns;
  const auto improves = [&](const Node& node, int turns) {
    const double before = ranking.run_end();
    DiveFrom(node.box, turns, problem, *node.bounds, stop, steps, ranking);
    return ranking.run_end() < before;
  };
  std::vector<NodePtr> first;
  std::vector<const Node*> led;  // the best last
  while (!open.empty() && static_cast<int>(first.size()) < kCrowdDives * problem.count) {
    first.push_back(open.Pop());
    if (improves(*first.back(), 0)) led.push_back(first.back().get());
  }
  for (int i = 0; i < problem.count && !led.empty(); ++i, led.pop_back()) improves(*led.back(), 1);
  for (NodePtr& node : first) open.Push(std::move(node));
}

}  // namespace plenum::optimizer
