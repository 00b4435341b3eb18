#include "optimizer/search/first_designs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "optimizer/bounds/leaf_sizing.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/search/search_node.h"

namespace plenum::optimizer {
namespace {

// Of the time limit: for the groups in turns and again for what they suggest, and for the rest.
constexpr double kTurnsShare = 0.15, kFirstShare = 0.1;
constexpr int kPressures = 12;                             // of the source, that are tried
constexpr double kNodeShares[] = {0.97, 0.85, 0.7, 0.55};  // of it, at the node
constexpr double kNeededShares[] = {0.0, 0.9};             // of that, by each line
constexpr int kRounds = 4;                                 // of improvements
constexpr int kBoxesBelow = 3000;                          // that are looked at below one box
constexpr int kSizedInVain = 6;    // designs below one box, one after the other
constexpr int kRefinements = 200;  // of a made-to-measure reservoir

struct Walk {
  const Problem& problem;
  Bounds& bounds;
  const std::function<bool()>& stop;
  Ranking& ranking;
};

// Whether it is a design that the ranking did not have.
bool Size(const Walk& walk, Node& node) {
  TieKey key = EarliestKey(walk.problem, walk.bounds.plan(), node.box);
  if (walk.ranking.Find(key) != nullptr) return false;
  const Candidate candidate = walk.bounds.CandidateOf(node.box);
  std::optional<Leaf> sized;
  for (int i = 0; !sized && i < kRefinements && !walk.stop(); ++i)
    sized = SizeLeaf(walk.problem, candidate, node.box, node.sizing);
  if (!sized || sized->status != LeafStatus::kFeasible) return false;
  walk.ranking.Add({std::move(node.box), &walk.bounds, *sized, std::move(key), -1, nullptr, {}});
  return true;
}

// Best first below a box that is not assessed yet, until so many designs are found.
void SearchBelow(const Walk& walk, Box box, int wanted) {
  if (walk.bounds.Assess(box, -1) != Constraint::kNone) return;
  Queue<NodePtr, LowestBound> open;
  long long serial = 0;
  const auto push = [&](Box part, int depth) {
    auto node = std::make_unique<Node>();
    node->box = std::move(part);
    node->depth = depth;
    node->serial = serial++;
    open.Push(std::move(node));
  };
  push(std::move(box), 0);
  int in_vain = 0;
  for (int looks = 0; !open.empty() && looks < kBoxesBelow && !walk.stop(); ++looks) {
    NodePtr node = open.Pop();
    if (node->box.bound > walk.ranking.run_end()) return;
    if (walk.ranking.IsSettled(walk.bounds.plan(), node->box)) continue;
    if (walk.bounds.CanFindSource(node->box)) {
      if (walk.bounds.FindSource(node->box) == Constraint::kNone)
        push(std::move(node->box), node->depth);
    } else if (walk.bounds.IsSingle(node->box)) {
      const bool found = Size(walk, *node);
      in_vain = found ? 0 : in_vain + 1;
      if ((found && --wanted == 0) || in_vain == kSizedInVain) return;
    } else {
      Halves halves = Divide(walk.bounds, node->box, DivideFor::kDesigns);
      for (Box& half : halves.boxes)
        if (walk.bounds.Assess(half, halves.slot) == Constraint::kNone)
          push(std::move(half), node->depth + 1);
    }
  }
}

// The box of all sources with each group's lightest lines for a source of this pressure that
// leaves so much of it at the node, of lines that need this share of it; false where there are
// none. Groups with time to spare leave the more to the others the narrower their lines are.
bool TakeLines(const Walk& walk, double source_pa, double node_pa, double needed, Box& box) {
  for (int g = 0; g < static_cast<int>(walk.problem.groups.size()); ++g) {
    const auto line = walk.bounds.groups().LeastAt(g, {node_pa, node_pa}, needed, source_pa);
    if (!line) return false;
    std::copy(line->begin(), line->end(),
              box.nodes.begin() + static_cast<std::ptrdiff_t>(kSlotsPerGroup) * g);
  }
  return true;
}

void TryLines(const Walk& walk, const Box& root) {
  const auto& [low_pa, high_pa] = root.window;
  std::set<std::vector<int>> tried;
  for (int i = 0; i < kPressures; ++i) {
    const double source_pa =
        high_pa * std::pow(low_pa / high_pa, static_cast<double>(i) / kPressures);
    for (double share : kNodeShares) {
      for (double needed : kNeededShares) {
        if (walk.stop()) return;
        Box box = walk.bounds.Root();
        if (!TakeLines(walk, source_pa, share * source_pa, needed, box)) continue;
        if (tried.insert({box.nodes.begin(), box.nodes.end()}).second)
          SearchBelow(walk, std::move(box), 1);
      }
    }
  }
}

// Of the best design: the slots of one group, or of the source, chosen anew.
void Exchange(const Walk& walk, const Box& best, int group, int wanted) {
  Box box = walk.bounds.Root();
  const int groups = static_cast<int>(walk.problem.groups.size());
  for (int s = 0; s < static_cast<int>(box.nodes.size()); ++s)
    if (const int of = walk.bounds.plan().slots[s].group; (of < 0 ? groups : of) != group)
      box.nodes[s] = best.nodes[s];
  SearchBelow(walk, std::move(box), wanted);
}

}  // namespace

std::vector<Bounds*> Due(const Problem& problem,
                         const std::vector<std::unique_ptr<Bounds>>& planted, bool slow,
                         Sought& sought) {
  std::vector<Bounds*> chosen;
  const bool alone = problem.groups.size() == 1;
  for (const std::unique_ptr<Bounds>& bounds : planted) {
    const Configuration configuration = bounds->plan().configuration;
    const bool cheap = !alone && StrokesMeet(problem) && !KeepsReservoir(configuration);
    const bool wanted = slow && (!alone || IsCheaperInTurns(problem, configuration));
    if (!bounds->plan().empty() && (cheap || wanted) && sought.first.insert(bounds.get()).second)
      chosen.push_back(bounds.get());
  }
  return chosen;
}

void SearchLikely(const Problem& problem, Bounds& bounds, std::vector<Box> likely,
                  const std::function<bool()>& stop, Ranking& ranking) {
  const Walk walk{problem, bounds, stop, ranking};
  for (Box& box : likely) SearchBelow(walk, std::move(box), 1);
}

void FindFirstDesigns(const Problem& problem, Bounds& bounds, const std::function<bool()>& stop,
                      Ranking& ranking) {
  const Walk walk{problem, bounds, stop, ranking};
  Box root = bounds.Root();
  if (bounds.Assess(root, -1) != Constraint::kNone) return;
  const int groups = static_cast<int>(problem.groups.size());
  if (groups > 1) TryLines(walk, root);
  for (int round = 0; round < kRounds && !ranking.list().empty() && !stop(); ++round) {
    if (ranking.list().front().bounds != &bounds) return;
    const double before = ranking.list().front().leaf.objective;
    for (int g = 0; g <= groups && !stop(); ++g)
      Exchange(walk, Box(ranking.list().front().box), g, problem.count);
    if (!(ranking.list().front().leaf.objective < before)) return;
  }
}

void SeekFirst(const Problem& problem, const std::vector<Bounds*>& due,
               const SearchOptions& options, const ListDesigns& list, Watch& watch,
               const std::function<bool()>& stop, Ranking& ranking) {
  const double turns_share = kTurnsShare / static_cast<double>(due.size());
  SearchOptions own = options;
  own.time_limit_s *= turns_share;
  for (Bounds* bounds : due) {
    std::vector<Box> likely = LikeInTurns(problem, *bounds, own, list);
    watch.DiveFor(turns_share,
                  [&] { SearchLikely(problem, *bounds, std::move(likely), stop, ranking); });
    watch.DiveFor(kFirstShare / static_cast<double>(due.size()),
                  [&] { FindFirstDesigns(problem, *bounds, stop, ranking); });
  }
}

}  // namespace plenum::optimizer
