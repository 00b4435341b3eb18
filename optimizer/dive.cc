#include "optimizer/dive.h"

#include <algorithm>

namespace plenum::optimizer {
namespace {

// After this many single combinations without a design below a box the dive turns elsewhere.
constexpr int kTriesPerBox = 4;

class Diver {
 public:
  Diver(const Problem& problem, Bounds& bounds, bool any, const std::function<bool()>& stop,
        Ranking& ranking)
      : problem_(problem), bounds_(bounds), any_(any), stop_(stop), ranking_(ranking) {}

  void Run() {
    if (bounds_.plan().empty()) return;
    Box root = bounds_.Root();
    if (bounds_.Assess(root, -1) == Constraint::kNone) Below(std::move(root));
  }

 private:
  bool Done() const { return stop_() || (any_ && !ranking_.list().empty()); }

  // Number of single combinations tried below the box.
  int Below(Box box) {
    if (Done() || box.bound > ranking_.run_end()) return 0;
    if (bounds_.CanFindSource(box) && bounds_.FindSource(box) != Constraint::kNone) return 1;
    if (bounds_.IsSingle(box)) {
      Try(std::move(box));
      return 1;
    }
    const int slot = bounds_.WidestSlot(box);
    const BoxNode& divided = (*bounds_.plan().slots[slot].nodes)[box.nodes[slot]];
    std::vector<Box> parts;
    for (int child : {divided.left, divided.right}) {
      Box part = box;
      part.nodes[slot] = child;
      if (bounds_.Assess(part, slot) == Constraint::kNone) parts.push_back(std::move(part));
    }
    std::sort(parts.begin(), parts.end(),
              [](const Box& a, const Box& b) { return a.bound < b.bound; });
    int tries = 0;
    for (Box& part : parts) {
      tries += Below(std::move(part));
      if (tries >= kTriesPerBox) break;
    }
    return tries;
  }

  void Try(Box box) {
    PartIds ids = EarliestIds(problem_, bounds_.plan(), box);
    if (ranking_.Find(ids) != nullptr) return;
    const Candidate candidate = bounds_.CandidateOf(box);
    Leaf leaf;
    if (candidate.reservoir.index == kCustom) {
      CustomSizing sizing(problem_, candidate);
      while (!sizing.Refine() && !stop_()) {
      }
      leaf = sizing.leaf();
    } else {
      leaf = SizeAtVolume(problem_, candidate, ReservoirVolume(problem_, candidate));
    }
    if (leaf.status == LeafStatus::kFeasible)
      ranking_.Add({std::move(box), &bounds_, leaf, std::move(ids), -1, nullptr});
  }

  const Problem& problem_;
  Bounds& bounds_;
  bool any_;
  const std::function<bool()>& stop_;
  Ranking& ranking_;
};

}  // namespace

void Dive(const Problem& problem, Bounds& bounds, bool any, const std::function<bool()>& stop,
          Ranking& ranking) {
  Diver(problem, bounds, any, stop, ranking).Run();
}

}  // namespace plenum::optimizer
