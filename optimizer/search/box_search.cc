#include "optimizer/search/box_search.h"

#include <algorithm>
#include <memory>

#include "optimizer/bounds/leaf_sizing.h"
#include "optimizer/problem/problem.h"
#include "optimizer/search/conclusion.h"
#include "optimizer/search/configurations.h"
#include "optimizer/search/dive.h"
#include "optimizer/search/first_designs.h"
#include "optimizer/search/ranking.h"
#include "optimizer/search/recorder.h"
#include "optimizer/search/search_node.h"
#include "optimizer/search/watch.h"
#include "optimizer/sizing/report.h"

namespace plenum::optimizer {
namespace {

constexpr double kProgressIntervalS = 0.2;
constexpr double kDiveFrom = 0.3, kDiveShare = 0.2;  // of the time limit
constexpr double kFirstFrom = 0.01;                  // the same
// Work beside a look at a box: a step of sizing a made-to-measure reservoir, and a pump's source
// pressure with several groups, which may take simulations.
constexpr int kStepsPerRefine = 32, kStepsPerSimulation = 3000;

class BoxSearch {
 public:
  BoxSearch(const Problem& problem, const SearchOptions& options, Watch::Clock::time_point start)
      : problem_(problem),
        options_(options),
        watch_(options, start),
        objective_limit_(std::min(ObjectiveLimit(problem), options.objective_max) * (1.0 + 1e-12)),
        ranking_(problem),
        recorder_(options.record),
        bench_{[this] { return watch_.DiveStopped(); }, options.periodic},
        report_bench_{[this] { return watch_.OutOfGrace(reported_ > 0); }, options.periodic},
        configurations_(problem, bench_, options.record) {}

  Answer Run() {
    do Enumerate();
    while (!stopped() && !ConfirmList());
    if (stopped()) ConfirmList();
    return Conclude();
  }

  Listed List() {
    lists_ = true;
    Enumerate();
    Listed listed{{}, !stopped() && undecided_bound_ == kUnlimited, steps_};
    for (const Found& found : ranking_.list()) {
      if (static_cast<int>(listed.combinations.size()) == problem_.count) break;
      listed.combinations.push_back(
          {found.leaf.objective,
           ListParts(problem_, found.bounds->CandidateOf(found.box), found.leaf.point)});
    }
    return listed;
  }

 private:
  bool stopped() const { return watch_.stopped() || steps_ > options_.steps_max; }
  bool Stopped() { return stopped() || watch_.Stopped(); }

  // Plants the configurations come to, or all; a record names all. False if stopped before.
  bool PlantReached(bool all = false) {
    const auto reached = [&] {
      if (all || options_.record) return kUnlimited;
      const double next = open_.empty() ? kUnlimited : open_.top()->box.bound;
      return std::min(next < ranking_.run_begin() ? next : ranking_.run_end(), objective_limit_);
    };
    while (!configurations_.waiting().empty() && configurations_.LeastWaiting() <= reached())
      if (!PlantNext()) return false;
    return true;
  }

  bool PlantNext() {
    Bounds* bounds = configurations_.PlantNext();
    if (!bounds) return false;
    const Plan& plan = bounds->plan();
    proof_.pruned.unpriced += plan.pruned.unpriced;
    proof_.pruned.dominated += plan.pruned.dominated;
    if (plan.empty()) return true;
    auto node = std::make_unique<Node>();
    node->bounds = bounds;
    node->box = bounds->Root();
    node->record = recorder_.Start(plan);
    const Constraint missed = bounds->Assess(node->box, -1);
    Keep(std::move(node), missed);
    return true;
  }

  // Queues an assessed box, or counts it where its corner misses something.
  void Keep(NodePtr node, Constraint missed) {
    if (missed == Constraint::kNone) {
      Push(std::move(node));
      return;
    }
    (missed == Constraint::kMating ? proof_.pruned.incompatible : proof_.pruned.infeasible) +=
        node->bounds->Count(node->box);
    recorder_.Close(node->record, {.kind = BoxKind::kInfeasible, .constraint = missed});
  }

  void Push(NodePtr node) {
    node->serial = serial_++;
    if (ordering_ties_ && node->box.bound <= ranking_.run_end()) {
      node->earliest = EarliestKey(problem_, node->bounds->plan(), node->box);
      ties_.Push(std::move(node));
    } else {
      SaveRoom(*node);
      open_.Push(std::move(node));
    }
  }

  void Enumerate() {
    while (!Stopped() && PlantReached() && !open_.empty()) {
      Report();
      if (!lists_) {
        SeekFirstDesigns();
        DiveIfSlow();
      }
      SaveRoomIfCrowded();
      const double lowest = open_.top()->box.bound;
      if (lowest > objective_limit_ || lowest > ranking_.run_end()) return;
      if (options_.any_design && !ranking_.list().empty()) return;
      if (lowest >= ranking_.run_begin()) {
        OrderTies();
        return;
      }
      Take(open_.Pop());
    }
  }

  // A box that can no longer change the list waits in case a design of it is taken out.
  void Take(NodePtr node) {
    if (ranking_.IsSettled(node->bounds->plan(), node->box)) {
      SaveRoom(*node);
      settled_.push_back(std::move(node));
    } else {
      Step(std::move(node));
    }
  }

  // All boxes that hold better designs are done. Those that may tie with the last place are
  // searched in the order of ties until none of them can come before it.
  void OrderTies() {
    ordering_ties_ = true;
    while (!open_.empty() && open_.top()->box.bound <= ranking_.run_end()) Push(open_.Pop());
    while (!ties_.empty() && !Stopped() && ranking_.MayTakeLast(ties_.top()->earliest))
      Take(ties_.Pop());
    ordering_ties_ = false;
    while (!ties_.empty()) Push(ties_.Pop());
  }

  void Step(NodePtr node) {
    ++proof_.boxes;
    steps_ += StepsOf(*node);
    Bounds& bounds = *node->bounds;
    if (bounds.CanFindSource(node->box)) {
      Constraint missed = bounds.FindSource(node->box);
      while (missed == Constraint::kNone && IsNext(*node) && bounds.CanFindSource(node->box)) {
        ++proof_.boxes;
        steps_ += StepsOf(*node);
        missed = bounds.FindSource(node->box);
      }
      Keep(std::move(node), missed);
    } else if (bounds.IsSingle(node->box)) {
      Size(std::move(node));
    } else {
      Divide(*node);
    }
  }

  // Whether a box that has come out would be the next to do so. Told to stop, a look at a box need
  // not get it any further.
  bool IsNext(const Node& node) {
    return !Stopped() && !ordering_ties_ && !open_.empty() &&
           node.box.bound < open_.top()->box.bound;
  }

  // Of a look at a box.
  long long StepsOf(const Node& node) const {
    if (node.box.core) return kStepsPerRefine;
    const Plan& plan = node.bounds->plan();
    if (problem_.groups.size() == 1 || plan.compressor_slot < 0) return 1;
    for (std::size_t s = 0; s < plan.slots.size(); ++s)
      if (plan.slots[s].family != Family::kBattery &&
          !(*plan.slots[s].nodes)[node.box.nodes[s]].single())
        return 1;
    return kStepsPerSimulation;
  }

  void Divide(Node& node) {
    // As long as a box may hold the best of all its kind is no matter.
    const bool kinds = ranking_.HasAsGoodAs(node.box.bound);
    Halves halves =
        optimizer::Divide(*node.bounds, node.box, kinds ? DivideFor::kKinds : DivideFor::kProof);
    const auto [left, right] = recorder_.Split(node.record, halves.slot, halves.middle);
    for (int half : {0, 1}) {
      auto part = std::make_unique<Node>();
      part->bounds = node.bounds;
      part->box = std::move(halves.boxes[half]);
      part->depth = node.depth + 1;
      part->record = half == 0 ? left : right;
      if (part->bounds->IsOutdone(part->box)) {
        proof_.pruned.bound += part->bounds->Count(part->box);
        outdone_.push_back(part->record);
        continue;
      }
      const Constraint missed = part->bounds->Assess(part->box, halves.slot);
      Keep(std::move(part), missed);
    }
  }

  void Size(NodePtr node) {
    TieKey key = EarliestKey(problem_, node->bounds->plan(), node->box);
    if (Found* known = ranking_.Find(key)) {  // by the dive
      proof_.evaluated += 1;
      ranking_.Place(*known, node->record);
      CountGap(known->leaf);
      recorder_.Close(node->record, {.kind = BoxKind::kNotListed, .bound = known->leaf.objective});
      return;
    }
    const Candidate candidate = node->bounds->CandidateOf(node->box);
    steps_ += node->sizing ? kStepsPerRefine : StepsOf(*node);
    const std::optional<Leaf> sized = SizeLeaf(problem_, candidate, node->box, node->sizing);
    if (!sized) {  // as its bound rises the box goes back into the queue
      Push(std::move(node));
      return;
    }
    Leaf leaf = *sized;
    if (leaf.status == LeafStatus::kUndecided && Stopped()) {
      Push(std::move(node));
      return;
    }
    proof_.evaluated += 1;
    if (leaf.status == LeafStatus::kUndecided)
      Undecided(std::max(node->box.bound, leaf.lower_bound), node->record);
    if (leaf.status == LeafStatus::kInfeasible)
      recorder_.Close(node->record, {.kind = BoxKind::kRefuted});
    if (leaf.status != LeafStatus::kFeasible) return;
    recorder_.Close(node->record, {.kind = BoxKind::kNotListed, .bound = leaf.objective});
    leaf.lower_bound = std::clamp(node->box.bound, leaf.lower_bound, leaf.objective);
    CountGap(leaf);
    ranking_.Add(
        {std::move(node->box), node->bounds, leaf, std::move(key), node->record, nullptr, {}});
  }

  // Found by a dive alone it has no record yet, and its box is still open.
  void Undecided(double bound, int record) {
    proof_.undecided += record >= 0 || !options_.record;
    undecided_bound_ = std::min(undecided_bound_, bound);
    if (record >= 0) recorder_.Close(record, {.kind = BoxKind::kUndecided, .bound = bound});
  }

  // A leaf whose best settings are not proved may be better than the place that it gets.
  void CountGap(const Leaf& leaf) {
    if (leaf.lower_bound < leaf.objective * (1.0 - kTie))
      undecided_bound_ = std::min(undecided_bound_, leaf.lower_bound);
  }

  // Several groups are slow to prove, and most boxes need no look once the list is good.
  void SeekFirstDesigns() {
    const bool slow = watch_.looked_s() >= kFirstFrom * options_.time_limit_s;
    if (slow && problem_.groups.size() > 1 && ranking_.list().empty() && !PlantReached(true))
      return;
    const auto list = [](const auto&... asked) { return ListCombinations(asked...).combinations; };
    SeekFirst(problem_, Due(problem_, configurations_.planted(), slow, sought_), options_, list,
              watch_, bench_.stop, ranking_);
  }

  // With a third of the time gone good designs are sought by depth first, in case time runs out.
  void DiveIfSlow() {
    const double from_s = options_.any_design ? 0.0 : kDiveFrom * options_.time_limit_s;
    if (sought_.deep || watch_.looked_s() < from_s) return;
    sought_.deep = true;
    if (!PlantReached(true)) return;
    const auto& all = configurations_.planted();
    for (const std::unique_ptr<Bounds>& bounds : all)
      watch_.DiveFor(kDiveShare / static_cast<double>(all.size()),
                     [&] { Dive(problem_, *bounds, options_.any_design, bench_.stop, ranking_); });
  }

  // What boxes know takes room, and most of it would only be asked if their bounds came up. Designs
  // found by depth first tell which bounds surely will not; where they are taken back (ConfirmList)
  // what was forgotten is found anew. To look for designs takes longer than to forget, and is worth
  // it less often.
  void SaveRoomIfCrowded() {
    if (open_.size() >= crowd_to_dive_) {
      crowd_to_dive_ += crowd_to_dive_;
      DiveFromNext(open_, problem_, bench_.stop, proof_.boxes, ranking_);
    }
    if (open_.size() < crowd_) return;
    crowd_ += crowd_ / 4 + 1;
    open_.ForEach([&](const NodePtr& node) { SaveRoom(*node); });
  }

  void SaveRoom(Node& node) const {
    if (ranking_.full() && !node.sizing)  // which points to the box's lines
      node.bounds->Forget(node.box, ranking_.run_end());
  }

  // Makes the designs of the list. One that the simulator does not confirm is taken out, and the
  // search has to go on: false.
  bool ConfirmList() {
    std::vector<Found>& list = ranking_.list();
    bool all = true;
    for (std::size_t i = 0; i < list.size() && static_cast<int>(i) < problem_.count;) {
      Found& found = list[i];
      if (!found.design) {
        ++proof_.simulated;
        Candidate candidate = found.bounds->CandidateOf(found.box);
        candidate.bench = &report_bench_;
        std::optional<Design> design =
            MakeDesign(problem_, candidate, found.leaf, [this] { return Stopped(); });
        if (!design && report_bench_.stopped()) {  // the rest is left out, and bounds the list
          undecided_bound_ = std::min(undecided_bound_, ranking_.LeaveOutFrom(i));
          return false;
        }
        if (!design) {
          Undecided(found.leaf.lower_bound, found.record);
          ranking_.Remove(i);
          for (NodePtr& node : settled_) open_.Push(std::move(node));
          settled_.clear();
          if (!stopped()) return false;
          all = false;
          continue;
        }
        found.design = std::make_shared<Design>(std::move(*design));
        ++reported_;
      }
      ++i;
    }
    return all;
  }

  void Report() {
    if (!options_.progress) return;
    const double seconds = watch_.Seconds();
    if (seconds - reported_s_ < kProgressIntervalS) return;
    reported_s_ = seconds;
    const std::vector<Found>& list = ranking_.list();
    options_.progress({seconds, static_cast<long long>(proof_.evaluated.ToDouble()),
                       static_cast<long long>(open_.size()),
                       list.empty() ? std::nullopt : std::optional(list.front().leaf.objective),
                       open_.top()->box.bound});
  }

  // Boxes whose combinations are outdone hold none that is better than the last of a full list, and
  // none that is feasible where the list is not full. `rest`: the least objective of all others
  // that are not listed, which may be better than those.
  double CloseOutdone(double rest) {
    if (outdone_.empty()) return rest;
    const double least = ranking_.full() ? std::min(rest, ranking_.last().leaf.objective) : rest;
    for (int record : outdone_) recorder_.Close(record, {.kind = BoxKind::kOrder, .bound = least});
    return least;
  }

  // Boxes that are still open, and configurations that still wait, are closed by their bound; the
  // least of these, or +∞.
  double CloseRest() {
    double least = kUnlimited;
    for (const Outline& outline : configurations_.waiting()) {
      const bool over = outline.bound > objective_limit_;
      (over ? proof_.pruned.infeasible : proof_.pruned.bound) += outline.priced;
      proof_.pruned.unpriced += outline.combinations - outline.priced;
      if (!over) least = std::min(least, outline.bound);
    }
    open_.ForEach([&](const NodePtr& node) {
      const double bound = node->box.bound;
      const bool over = bound > objective_limit_;
      (over ? proof_.pruned.infeasible : proof_.pruned.bound) += node->bounds->Count(node->box);
      if (!over) least = std::min(least, bound);
      recorder_.Close(node->record,
                      {.kind = over ? BoxKind::kInfeasible : ranking_.EndBehind(bound),
                       .constraint = over ? Constraint::kAmounts : Constraint::kNone,
                       .bound = bound});
    });
    for (const NodePtr& node : settled_) {
      proof_.pruned.bound += node->bounds->Count(node->box);
      const BoxKind kind = ranking_.EndOfSettled(node->bounds->plan(), node->box);
      if (kind != BoxKind::kKind) least = std::min(least, node->box.bound);
      recorder_.Close(node->record, {.kind = kind, .bound = node->box.bound});
    }
    return least;
  }

  Answer Conclude() {
    proof_.combinations = configurations_.combinations();
    proof_.lower_bound =
        CloseOutdone(std::min({undecided_bound_, CloseRest(), ranking_.BoundBehind()}));
    const Ending ending{.stopped = stopped(),
                        .cancelled = watch_.cancelled(),
                        .any_design = options_.any_design,
                        .seconds = watch_.Seconds()};
    return optimizer::Conclude(problem_, ending, std::move(proof_), ranking_, recorder_);
  }

  const Problem& problem_;
  const SearchOptions& options_;
  Watch watch_;
  double objective_limit_;  // a bound above it breaks a limit
  Queue<NodePtr, LowestBound> open_;
  Queue<NodePtr, EarliestFirst> ties_;
  bool ordering_ties_ = false;
  std::vector<NodePtr> settled_;  // whose kind or source is (ranking.h)
  Ranking ranking_;
  Recorder recorder_;
  Proof proof_;
  double undecided_bound_ = kUnlimited;
  std::vector<int> outdone_;        // boxes, as recorded
  Workbench bench_, report_bench_;  // for the search, for the designs of the list
  Configurations configurations_;
  Sought sought_;
  int reported_ = 0;
  // Boxes that wait when room is saved next, and when designs are sought for it.
  std::size_t crowd_ = options_.crowd, crowd_to_dive_ = options_.crowd;
  double reported_s_ = 0.0;
  long long serial_ = 0, steps_ = 0;
  bool lists_ = false;  // all there is: no dives, which depend on the clock
};

}  // namespace

Answer SearchBoxes(const Problem& problem, const SearchOptions& options) {
  return BoxSearch(problem, options, Watch::Clock::now()).Run();
}

Listed ListCombinations(const Problem& problem, const SearchOptions& options) {
  return BoxSearch(problem, options, Watch::Clock::now()).List();
}

}  // namespace plenum::optimizer
