// Exact best-k by branch and enumerate.
//
// Best-first over the trees of all configurations in one queue. A node stands for all children of a
// parent from a position on, in the order of their bounds, with everything below them; taking it
// splits off the first child. Nodes leave the queue in the order of their bounds, so a sized design
// that comes out is no heavier than anything that is still inside, and the list is complete when
// the next bound lies above its last design.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <queue>

#include "optimizer/conflict.h"
#include "optimizer/expand.h"
#include "optimizer/problem.h"
#include "optimizer/report.h"
#include "optimizer/sizing.h"
#include "optimizer/tree_search.h"

namespace plenum::optimizer {
namespace {

using Clock = std::chrono::steady_clock;

// Objectives this close are ties, ordered by part ids.
constexpr double kTie = 1e-6;
constexpr int kTiesMax = 100;
constexpr double kProgressIntervalS = 0.2;
constexpr double kDiveFrom = 0.3, kDiveShare = 0.2;  // of the time limit

struct Node {
  double bound;
  long long serial;  // order of creation: the same search on every run
  const Tree* tree;
  int stage;                                 // of the children; past the last one for a leaf
  Candidate candidate;                       // parent of the children, or the leaf itself
  std::shared_ptr<const Children> children;  // null: not expanded yet, or a leaf
  std::size_t position = 0;
  std::shared_ptr<CustomSizing> sizing;  // a leaf with a made-to-measure reservoir, being sized
  std::shared_ptr<const Leaf> sized;     // a leaf that is feasible
};

struct LowestBound {
  bool operator()(const Node& a, const Node& b) const {
    if (a.bound != b.bound) return a.bound > b.bound;
    if (a.stage != b.stage) return a.stage < b.stage;  // among equals, the nearest to a design
    return a.serial > b.serial;
  }
};

struct Listed {
  double objective;
  double lower_bound;            // over all settings of its parts
  std::vector<std::string> ids;  // with quantities, in order of families and groups
  Design design;
};

std::vector<std::string> TieKey(const Design& design) {
  std::vector<std::string> key;
  for (const Choice& choice : design.parts) {
    key.push_back(choice.id);
    key.push_back(std::to_string(static_cast<long long>(choice.quantity * 1000)));
  }
  return key;
}

// Where the objective is one of the limited amounts alone, its limit bounds the objective.
double ObjectiveLimit(const Problem& problem) {
  const Objective& o = problem.objective;
  if (o == Objective{.mass_kg = o.mass_kg}) return o.mass_kg * problem.mass_max_kg;
  if (o == Objective{.volume_l = o.volume_l}) return o.volume_l * problem.volume_max_l;
  if (o == Objective{.cost_eur = o.cost_eur}) return o.cost_eur * problem.cost_max_eur;
  return kUnlimited;
}

class TreeSearch {
 public:
  TreeSearch(const Problem& problem, const SearchOptions& options, Clock::time_point start)
      : problem_(problem),
        options_(options),
        start_(start),
        objective_limit_(ObjectiveLimit(problem)) {}

  Answer Run() {
    if (PlantTrees()) Enumerate();
    return Conclude();
  }

 private:
  double Seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  bool Stopped() {
    cancelled_ = cancelled_ || (options_.cancelled && options_.cancelled());
    late_ = late_ || Seconds() > options_.time_limit_s;
    return cancelled_ || late_;
  }

  // False if stopped on the way.
  bool PlantTrees() {
    std::vector<std::shared_ptr<const LineSet>> air, co2;
    const bool any_air = problem_.configurations.size() >
                         (problem_.configurations.contains(Configuration::kCo2) ? 1u : 0u);
    for (int g = 0; g < static_cast<int>(problem_.groups.size()); ++g) {
      if (any_air)
        air.push_back(std::make_shared<LineSet>(EnumerateLines(problem_, g, model::Gas::kAir)));
      if (problem_.configurations.contains(Configuration::kCo2))
        co2.push_back(std::make_shared<LineSet>(EnumerateLines(problem_, g, model::Gas::kCo2)));
      if (Stopped()) return false;
    }
    for (Configuration configuration : problem_.configurations) {
      trees_.push_back(std::make_unique<Tree>(
          MakeTree(problem_, configuration, configuration == Configuration::kCo2 ? co2 : air)));
      const Tree& tree = *trees_.back();
      proof_.combinations += tree.combinations;
      if (tree.combinations == 0) continue;
      Candidate root;
      root.configuration = configuration;
      PushChildren(tree, root, 0);
    }
    planted_ = true;
    return true;
  }

  void Push(Node node) {
    node.serial = serial_++;
    queue_.push(std::move(node));
  }

  void PushChildren(const Tree& tree, const Candidate& parent, int stage) {
    auto children = std::make_shared<Children>(Expand(problem_, tree, parent, stage));
    const BigCount& below = tree.stages[stage].below;
    proof_.pruned.incompatible += below * children->incompatible;
    proof_.pruned.infeasible += below * children->infeasible;
    proof_.pruned.unpriced += below * children->unpriced;
    if (children->list.empty()) return;
    const double bound = children->list.front().bound;
    Push({bound, 0, &tree, stage, parent, std::move(children), 0, nullptr, nullptr});
  }

  void Enumerate() {
    while (!queue_.empty()) {
      if (Stopped()) return;
      Report();
      DiveIfSlow();
      if (ListIsComplete() || queue_.top().bound > objective_limit_) return;
      if (options_.any_design && !(incumbents_.empty() && listed_.empty())) return;
      Node node = queue_.top();
      queue_.pop();
      if (node.children)
        Branch(node);
      else if (node.stage < static_cast<int>(node.tree->stages.size()))
        PushChildren(*node.tree, node.candidate, node.stage);
      else if (node.sized)
        List(node);
      else
        Size(node);
    }
  }

  // A search that is slow to prove should not come home empty-handed: with a third of the time gone
  // it looks for good designs by depth first, trying children spread over the whole range at every
  // stage. They serve as the best so far if time runs out; the proof does not use them.
  void DiveIfSlow() {
    const double from = options_.any_design ? 0.0 : kDiveFrom;
    if (dived_ || Seconds() < from * options_.time_limit_s) return;
    dived_ = true;
    for (const std::unique_ptr<Tree>& tree : trees_) {
      Candidate root;
      root.configuration = tree->configuration;
      dive_until_s_ =
          Seconds() + kDiveShare * options_.time_limit_s / static_cast<double>(trees_.size());
      if (tree->combinations > 0) Dive(*tree, root, 0);
    }
  }

  void Dive(const Tree& tree, const Candidate& parent, int stage) {
    if (stage == static_cast<int>(tree.stages.size())) {
      DiveToLeaf(tree, parent);
      return;
    }
    const Children children = Expand(problem_, tree, parent, stage);
    const std::size_t size = children.list.size();
    for (std::size_t step : {0, 1, 2, 4, 8, 16, 32}) {
      const std::size_t index = step * size / 40;
      if (Seconds() > dive_until_s_ || index >= size) return;
      if (options_.any_design && !incumbents_.empty()) return;
      const Child& child = children.list[index];
      if (child.bound < dive_limit_)
        Dive(tree, Chosen(tree, parent, stage, children, child), stage + 1);
    }
  }

  void DiveToLeaf(const Tree& tree, const Candidate& candidate) {
    Leaf leaf;
    if (candidate.reservoir.index == kCustom) {
      CustomSizing sizing(problem_, tree.pumps[candidate.compressor.index], candidate);
      while (!sizing.Refine() && Seconds() < dive_until_s_) {
      }
      leaf = sizing.leaf();
    } else {
      leaf = SizeAtVolume(problem_, candidate, ReservoirVolume(candidate));
    }
    if (leaf.status != LeafStatus::kFeasible) return;
    incumbents_.push_back({candidate, leaf});
    std::sort(incumbents_.begin(), incumbents_.end(),
              [](const auto& a, const auto& b) { return a.second.objective < b.second.objective; });
    const std::size_t count = static_cast<std::size_t>(problem_.count);
    if (incumbents_.size() > count) incumbents_.pop_back();
    if (incumbents_.size() == count) dive_limit_ = incumbents_.back().second.objective;
  }

  double ReservoirVolume(const Candidate& candidate) const {
    const Option& reservoir = candidate.reservoir;
    return reservoir.index == kNone
               ? 0.0
               : reservoir.quantity * problem_.parts.reservoirs[reservoir.index].volume_m3;
  }

  // Incumbents of the dive fill a list that was not finished.
  void ListIncumbents() {
    for (const auto& [candidate, leaf] : incumbents_) {
      if (static_cast<int>(listed_.size()) >= problem_.count) return;
      std::optional<Design> design = MakeDesign(problem_, candidate, leaf, !late_);
      if (!design) continue;
      std::vector<std::string> ids = TieKey(*design);
      if (std::any_of(listed_.begin(), listed_.end(),
                      [&](const Listed& listed) { return listed.ids == ids; }))
        continue;
      ++proof_.simulated;
      const double objective = design->objective;
      listed_.push_back({objective, leaf.lower_bound, std::move(ids), std::move(*design)});
    }
  }

  // All that ties with the last place is listed, too, so that ids can order it, up to a limit: an
  // objective that most parts do not touch has ties without end.
  bool ListIsComplete() const {
    const int listed = static_cast<int>(listed_.size());
    return listed >= problem_.count + kTiesMax ||
           (listed >= problem_.count && queue_.top().bound > TieLimit());
  }

  // Largest objective that still ties with the last design of a full list.
  double TieLimit() const {
    std::vector<double> objectives;
    for (const Listed& listed : listed_) objectives.push_back(listed.objective);
    std::nth_element(objectives.begin(), objectives.begin() + problem_.count - 1, objectives.end());
    const double last = objectives[problem_.count - 1];
    return last + kTie * std::abs(last);
  }

  void Branch(Node& node) {
    const Child& child = node.children->list[node.position];
    const Tree& tree = *node.tree;
    const Candidate candidate = Chosen(tree, node.candidate, node.stage, *node.children, child);
    const double bound = std::max(child.bound, SharedSourceBound(problem_, tree, candidate));
    const int stage = node.stage + 1;
    if (std::isinf(bound))
      proof_.pruned.infeasible += tree.stages[node.stage].below;
    else if (bound > child.bound || stage == static_cast<int>(tree.stages.size()))
      Push({bound, 0, &tree, stage, candidate, nullptr, 0, nullptr, nullptr});
    else
      PushChildren(tree, candidate, stage);
    if (++node.position < node.children->list.size()) {
      node.bound = node.children->list[node.position].bound;
      Push(std::move(node));
    }
  }

  void Size(Node& node) {
    const Option& reservoir = node.candidate.reservoir;
    if (reservoir.index == kCustom) {
      SizeCustom(node);
      return;
    }
    Conclude(node, SizeAtVolume(problem_, node.candidate, ReservoirVolume(node.candidate)));
  }

  // A few steps at a time: as its bound rises the leaf goes back into the queue.
  void SizeCustom(Node& node) {
    bool done = false;
    if (node.sizing)
      done = node.sizing->Refine();
    else
      node.sizing = std::make_shared<CustomSizing>(
          problem_, node.tree->pumps[node.candidate.compressor.index], node.candidate);
    if (done) {
      Conclude(node, node.sizing->leaf());
      return;
    }
    node.bound = std::max(node.bound, node.sizing->leaf().lower_bound);
    Push(std::move(node));
  }

  void Conclude(Node& node, const Leaf& leaf) {
    proof_.evaluated += 1;
    if (leaf.status == LeafStatus::kUndecided) Undecided(std::max(node.bound, leaf.lower_bound));
    if (leaf.status != LeafStatus::kFeasible) return;
    node.bound = std::max(node.bound, leaf.objective);
    node.sized = std::make_shared<Leaf>(leaf);
    node.sizing.reset();
    Push(std::move(node));
  }

  void Undecided(double bound) {
    ++proof_.undecided;
    undecided_bound_ = std::min(undecided_bound_, bound);
  }

  void List(const Node& node) {
    ++proof_.simulated;
    std::optional<Design> design = MakeDesign(problem_, node.candidate, *node.sized, !late_);
    if (!design) {
      Undecided(node.bound);
      return;
    }
    const double objective = design->objective;
    listed_.push_back({objective, node.sized->lower_bound, TieKey(*design), std::move(*design)});
  }

  void Report() {
    if (!options_.progress) return;
    const double seconds = Seconds();
    if (seconds - reported_s_ < kProgressIntervalS) return;
    reported_s_ = seconds;
    Progress progress;
    progress.seconds = seconds;
    progress.evaluated = static_cast<long long>(proof_.evaluated);
    progress.open = static_cast<long long>(queue_.size());
    for (const Listed& listed : listed_)
      progress.best = std::min(progress.best.value_or(kUnlimited), listed.objective);
    progress.lower_bound = queue_.top().bound;
    options_.progress(progress);
  }

  // By objective; ties, counted from the first of each run of them, by part ids.
  void Rank() {
    std::sort(listed_.begin(), listed_.end(), [](const Listed& a, const Listed& b) {
      return a.objective != b.objective ? a.objective < b.objective : a.ids < b.ids;
    });
    for (std::size_t first = 0; first < listed_.size();) {
      const double limit = listed_[first].objective + kTie * std::abs(listed_[first].objective);
      std::size_t last = first;
      while (last < listed_.size() && listed_[last].objective <= limit) ++last;
      std::sort(listed_.begin() + first, listed_.begin() + last,
                [](const Listed& a, const Listed& b) { return a.ids < b.ids; });
      first = last;
    }
  }

  Answer Conclude() {
    Answer answer;
    // A stopped search lists what it has sized, too, as the best so far.
    double lower_bound = undecided_bound_;
    while (!queue_.empty()) {
      const Node node = queue_.top();
      queue_.pop();
      if (node.sized && static_cast<int>(listed_.size()) < problem_.count) {
        List(node);
        continue;
      }
      if (!node.sized)
        (node.bound > objective_limit_ ? proof_.pruned.infeasible : proof_.pruned.bound) +=
            OpenCount(node);
      if (node.bound <= objective_limit_)
        lower_bound = std::min(lower_bound, node.sized ? node.sized->lower_bound : node.bound);
    }
    if (cancelled_ || late_ || options_.any_design) ListIncumbents();
    Rank();
    for (std::size_t i = problem_.count; i < listed_.size(); ++i)
      lower_bound = std::min(lower_bound, listed_[i].lower_bound);
    if (static_cast<int>(listed_.size()) > problem_.count) listed_.resize(problem_.count);
    for (Listed& listed : listed_) answer.designs.push_back(std::move(listed.design));

    proof_.lower_bound = planted_ ? lower_bound : 0.0;
    if (!answer.designs.empty() && planted_) {
      const double last = answer.designs.back().objective;
      proof_.gap =
          std::isfinite(lower_bound) && last > 0.0 ? std::max(0.0, 1.0 - lower_bound / last) : 0.0;
    } else {
      proof_.gap =
          answer.designs.empty() && (cancelled_ || late_ || proof_.undecided > 0) ? 1.0 : 0.0;
    }
    const bool stopped = cancelled_ || late_ || (options_.any_design && !answer.designs.empty());
    proof_.complete =
        !stopped && (answer.designs.empty() ? proof_.undecided == 0 : proof_.gap <= kTie);
    answer.status = cancelled_               ? Status::kCancelled
                    : !proof_.complete       ? Status::kFeasible
                    : answer.designs.empty() ? Status::kInfeasible
                                             : Status::kOptimal;
    answer.proof = proof_;
    answer.seconds = Seconds();
    return answer;
  }

  // Combinations in a node that was not taken.
  static BigCount OpenCount(const Node& node) {
    if (node.stage == static_cast<int>(node.tree->stages.size())) return 1;
    if (!node.children)
      return node.tree->stages[node.stage].total * node.tree->stages[node.stage].below;
    return node.tree->stages[node.stage].below *
           static_cast<long long>(node.children->list.size() - node.position);
  }

  const Problem& problem_;
  const SearchOptions& options_;
  Clock::time_point start_;
  double objective_limit_;  // a bound above it breaks a limit
  std::vector<std::unique_ptr<Tree>> trees_;
  std::priority_queue<Node, std::vector<Node>, LowestBound> queue_;
  std::vector<Listed> listed_;
  std::vector<std::pair<Candidate, Leaf>> incumbents_;
  double dive_limit_ = kUnlimited, dive_until_s_ = 0.0;
  bool dived_ = false;
  Proof proof_;
  double undecided_bound_ = kUnlimited;
  double reported_s_ = 0.0;
  long long serial_ = 0;
  bool cancelled_ = false, late_ = false, planted_ = false;
};

}  // namespace

Answer SearchTrees(const Problem& problem, const SearchOptions& options) {
  return TreeSearch(problem, options, Clock::now()).Run();
}

Answer Search(const Problem& problem, const SearchOptions& options) {
  const Clock::time_point start = Clock::now();
  Answer answer = SearchTrees(problem, options);
  if (answer.status == Status::kInfeasible)
    answer.conflict = FindConflict(problem, options, answer.seconds);
  answer.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return answer;
}

}  // namespace plenum::optimizer
