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

// Of the time limit: for any design at all; for some; for the groups in turns and again for what
// they suggest; for the lightest lines; and for what makes the best of it all better.
constexpr double kAnyShare = 0.25, kSomeShare = 0.05, kTurnsShare = 0.15, kLinesShare = 0.1,
                 kImproveShare = 0.05;
constexpr int kPressures = 12;                             // of the source, that are tried
constexpr double kNodeShares[] = {0.97, 0.85, 0.7, 0.55};  // of it, at the node
constexpr double kNeededShares[] = {0.0, 0.9};             // of that, by each line
constexpr int kRounds = 4;                                 // of improvements
constexpr int kBoxesBelow = 3000;                          // that are looked at below one box
constexpr int kStrongBoxes = 100;                          // the same, the strongest first
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

// Gives a box the line of each group; false where one has none.
bool TakeLines(const Walk& walk, const auto& line_of, Box& box) {
  for (int g = 0; g < static_cast<int>(walk.problem.groups.size()); ++g) {
    const auto line = line_of(g);
    if (!line) return false;
    std::copy(line->begin(), line->end(),
              box.nodes.begin() + static_cast<std::ptrdiff_t>(kSlotsPerGroup) * g);
  }
  return true;
}

bool HasPumps(const Plan& plan) { return plan.compressor_slot >= 0; }

// From high to low: what leaves most time to the lines comes first.
double TriedPressure(const Window& window, int i) {
  return window.high_pa *
         std::pow(window.low_pa / window.high_pa, static_cast<double>(i) / kPressures);
}

// Whether two boxes with the same lines have the same pumps, or regulators where there are none,
// and the same pumps of a vacuum beside them: what does not work with one reservoir, bottle and
// battery rarely does with the next.
bool HaveSameSource(const Plan& plan, const Box& a, const Box& b) {
  const auto same = [&](int slot) { return a.nodes[slot] == b.nodes[slot]; };
  const bool supply =
      HasPumps(plan) ? same(plan.compressor_slot)
                     : std::all_of(plan.regulator_slots.begin(), plan.regulator_slots.end(), same);
  return supply && (plan.rail.pump_slot < 0 || same(plan.rail.pump_slot));
}

// Whether a design is found below a box by always going on with the half that costs more, which is
// mostly the one that can do more: no good design, but soon one, where there is any with the box's
// lines.
bool SearchStrongest(const Walk& walk, Box box) {
  if (walk.bounds.Assess(box, -1) != Constraint::kNone) return false;
  while (!box.lines_finished && walk.bounds.CanFindSource(box))
    if (walk.bounds.FindSource(box) != Constraint::kNone) return false;
  std::vector<Box> open{std::move(box)};
  int in_vain = 0;
  for (int looks = 0; !open.empty() && looks < kStrongBoxes && !walk.stop(); ++looks) {
    Node node;
    node.box = std::move(open.back());
    open.pop_back();
    if (walk.bounds.IsSingle(node.box)) {
      if (Size(walk, node)) return true;  // which else leaves its box
      if (++in_vain == kSizedInVain) return false;
      while (!open.empty() && HaveSameSource(walk.bounds.plan(), node.box, open.back()))
        open.pop_back();
      continue;
    }
    const std::size_t before = open.size();
    Halves halves = Divide(walk.bounds, node.box, DivideFor::kDesigns);
    for (Box& half : halves.boxes)
      if (walk.bounds.Assess(half, halves.slot) == Constraint::kNone)
        open.push_back(std::move(half));
    if (open.size() == before + 2 && open.back().bound < open[before].bound)
      std::swap(open.back(), open[before]);
  }
  return false;
}

// Boxes of lines to be tried, each once.
class LinesToTry {
 public:
  explicit LinesToTry(const Walk& walk) : walk_(walk), root_(walk.bounds.Root()) {
    some_ = walk.bounds.Assess(root_, -1) == Constraint::kNone;
  }

  // Hands each on to `look`, which answers whether they are enough. The lines that need the least
  // at the node, for sources of falling pressure:
  void Strongest(const auto& look) {
    for (int i = 0; some_ && i < kPressures && !walk_.stop(); ++i) {
      const double source_pa = TriedPressure(root_.window, i);
      const auto line_of = [&](int g) { return walk_.bounds.groups().StrongestAt(g, source_pa); };
      if (IsEnough(line_of, look)) return;
    }
  }
  // The lightest for a source that leaves so much of its pressure at the node, of lines that need
  // so much of that. Groups with time to spare leave the more to the others the narrower theirs
  // are.
  void Lightest(const auto& look) {
    for (int i = 0; some_ && i < kPressures; ++i) {
      const double source_pa = TriedPressure(root_.window, i);
      for (const double share : kNodeShares) {
        for (const double needed : kNeededShares) {
          if (walk_.stop()) return;
          const double node_pa = share * source_pa;
          const auto line_of = [&](int g) {
            return walk_.bounds.groups().LeastAt(g, {node_pa, node_pa}, needed, source_pa);
          };
          if (IsEnough(line_of, look)) return;
        }
      }
    }
  }

 private:
  bool IsEnough(const auto& line_of, const auto& look) {
    Box box = walk_.bounds.Root();
    return TakeLines(walk_, line_of, box) &&
           tried_.insert({box.nodes.begin(), box.nodes.end()}).second && look(std::move(box));
  }

  const Walk& walk_;
  Box root_;
  bool some_;
  std::set<std::vector<int>> tried_;
};

// Any design, soon. Without pumps the best source of some lines is as soon found as the strongest.
void FindAny(const Walk& walk) {
  const auto found = [&] { return !walk.ranking.list().empty(); };
  const auto on_strongest = [&](Box box) { return SearchStrongest(walk, std::move(box)); };
  const auto on_best = [&](Box box) {
    SearchBelow(walk, std::move(box), 1);
    return found();
  };
  LinesToTry lines(walk);
  const bool pumped = HasPumps(walk.bounds.plan());
  if (!pumped) lines.Lightest(on_best);
  if (!found()) lines.Strongest(on_strongest);
  if (!found() && pumped) lines.Lightest(on_strongest);
}

// Designs of all lightest lines on the strongest source. Returns the boxes of lines that have one.
std::vector<Box> FindSome(const Walk& walk) {
  std::vector<Box> worked;
  LinesToTry(walk).Lightest([&](Box box) {
    if (SearchStrongest(walk, box)) worked.push_back(std::move(box));
    return false;
  });
  return worked;
}

// Each on the best source, those that are known to work first.
void TryLines(const Walk& walk, std::vector<Box> worked) {
  for (Box& box : worked)
    if (!walk.stop()) SearchBelow(walk, std::move(box), 1);
  LinesToTry(walk).Lightest([&](Box box) {
    SearchBelow(walk, std::move(box), 1);
    return false;
  });
}

// Of the best design: these slots chosen anew.
void Exchange(const Walk& walk, const Box& best, int wanted, const auto& is_free) {
  Box box = walk.bounds.Root();
  for (int s = 0; s < static_cast<int>(box.nodes.size()); ++s)
    if (!is_free(s)) box.nodes[s] = best.nodes[s];
  SearchBelow(walk, std::move(box), wanted);
}

// The best design, where it is of this plan, part by part: each part of the source, the line of
// each group, then the source as a whole.
void Improve(const Walk& walk) {
  const std::vector<Slot>& slots = walk.bounds.plan().slots;
  const auto best = [&]() -> const Found& { return walk.ranking.list().front(); };
  const auto exchange = [&](const auto& is_free) {
    if (!walk.stop()) Exchange(walk, Box(best().box), walk.problem.count, is_free);
  };
  for (int round = 0; round < kRounds && !walk.ranking.list().empty(); ++round) {
    if (best().bounds != &walk.bounds) return;
    const double before = best().leaf.objective;
    for (int slot = 0; slot < static_cast<int>(slots.size()); ++slot)
      if (slots[slot].group < 0) exchange([&](int s) { return s == slot; });
    for (int g = 0; g < static_cast<int>(walk.problem.groups.size()); ++g)
      exchange([&](int s) { return slots[s].group == g; });
    exchange([&](int s) { return slots[s].group < 0; });
    if (walk.stop() || !(best().leaf.objective < before)) return;
  }
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

void SeekFirst(const Problem& problem, const std::vector<Bounds*>& due,
               const SearchOptions& options, const ListDesigns& list, Watch& watch,
               const std::function<bool()>& stop, Ranking& ranking) {
  if (due.empty()) return;  // as at nearly every box of a search
  const double each = 1.0 / static_cast<double>(due.size());
  const bool several = problem.groups.size() > 1;
  SearchOptions own = options;
  own.time_limit_s *= kTurnsShare * each;
  for (Bounds* bounds : due) {
    const Walk walk{problem, *bounds, stop, ranking};
    const auto dive = [&](double share, const auto& look) { watch.DiveFor(share * each, look); };
    if (several && ranking.list().empty()) dive(kAnyShare, [&] { FindAny(walk); });
    std::vector<Box> worked;
    if (several && HasPumps(bounds->plan()) && !ranking.list().empty())
      dive(kSomeShare, [&] { worked = FindSome(walk); });
    std::vector<Box> likely = LikeInTurns(problem, *bounds, own, list);
    dive(kTurnsShare, [&] { SearchLikely(problem, *bounds, std::move(likely), stop, ranking); });
    if (several) dive(kLinesShare, [&] { TryLines(walk, std::move(worked)); });
    dive(kImproveShare, [&] { Improve(walk); });
  }
}

}  // namespace plenum::optimizer
