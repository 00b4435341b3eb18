// The record of a search, replayed: boxes divide the choices without gap or overlap, and every
// feasible design is where the record says that something no better may be.
#include "optimizer/problem/proof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace proof_test {

using optimizer::Answer;
using optimizer::BoxKind;
using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Family;
using optimizer::Option;
using optimizer::Problem;
using optimizer::ProofBox;
using optimizer::ProofItem;
using optimizer::ProofPlan;
using optimizer::ProofSlot;

using Ranges = std::vector<std::pair<int, int>>;

struct ClosedBox {
  ProofBox end;
  Ranges ranges;
};

// Walks the preorder once.
class Replay {
 public:
  explicit Replay(const ProofPlan& plan) : plan_(plan) {
    Ranges all;
    for (const ProofSlot& slot : plan.slots)
      all.emplace_back(0, static_cast<int>(slot.choices.size()));
    if (!plan.boxes.empty()) Read(all);
    EXPECT_EQ(next_, plan.boxes.size());
  }
  std::vector<ClosedBox> closed;

 private:
  void Read(const Ranges& ranges) {
    ASSERT_LT(next_, plan_.boxes.size());
    const ProofBox box = plan_.boxes[next_++];
    if (box.kind != BoxKind::kSplit) {
      closed.push_back({box, ranges});
      return;
    }
    const auto [first, last] = ranges[box.slot];
    ASSERT_LT(first, box.middle);
    ASSERT_LT(box.middle, last);
    Ranges left = ranges, right = ranges;
    left[box.slot].second = right[box.slot].first = box.middle;
    Read(left);
    Read(right);
  }

  const ProofPlan& plan_;
  std::size_t next_ = 0;
};

ProofItem ItemOf(const ProofSlot& slot, const Candidate& candidate) {
  const auto item = [](const Option& option) { return ProofItem{option.index, option.quantity}; };
  switch (slot.family) {
    case Family::kTubing:
      return {candidate.lines[slot.group]->tubing, 1};
    case Family::kFitting:
      return {candidate.lines[slot.group]->fitting,
              candidate.lines[slot.group]->fitting < 0 ? 0 : 1};
    case Family::kValve:
      return {candidate.lines[slot.group]->valve, 1};
    case Family::kRegulator:
      return item(candidate.regulator);
    case Family::kCylinder:
    case Family::kCo2:
      return item(candidate.bottle);
    case Family::kCompressor:
      return item(candidate.compressor);
    case Family::kBattery:
      return item(candidate.battery);
    default:
      return item(candidate.reservoir);
  }
}

// The closed box that holds the candidate; null where a choice was left out as dominated.
const ClosedBox* Holder(const ProofPlan& plan, const Replay& replay, const Candidate& candidate) {
  std::vector<int> positions;
  for (const ProofSlot& slot : plan.slots) {
    const ProofItem item = ItemOf(slot, candidate);
    const auto at = std::find(slot.choices.begin(), slot.choices.end(), item);
    if (at == slot.choices.end()) {
      EXPECT_TRUE(std::any_of(slot.dominated.begin(), slot.dominated.end(),
                              [&](const auto& d) { return d.item == item; }));
      return nullptr;
    }
    positions.push_back(static_cast<int>(at - slot.choices.begin()));
  }
  const ClosedBox* holder = nullptr;
  for (const ClosedBox& box : replay.closed) {
    bool inside = true;
    for (std::size_t s = 0; s < positions.size(); ++s)
      inside = inside && box.ranges[s].first <= positions[s] && positions[s] < box.ranges[s].second;
    if (!inside) continue;
    EXPECT_EQ(holder, nullptr) << "boxes overlap";
    holder = &box;
  }
  EXPECT_NE(holder, nullptr) << "boxes leave a gap";
  return holder;
}

void Check(const Problem& problem, int& dominated) {
  optimizer::SearchOptions options = Within(100.0);
  options.record = true;
  const Answer answer = optimizer::SearchTrees(problem, options);
  ASSERT_NE(answer.proof.record, nullptr);
  EXPECT_EQ(answer.proof.record->count, problem.count);
  std::map<Configuration, const ProofPlan*> plans;
  std::map<Configuration, Replay> replays;
  for (const ProofPlan& plan : answer.proof.record->plans) {
    plans[plan.configuration] = &plan;
    replays.try_emplace(plan.configuration, plan);
    for (const ProofSlot& slot : plan.slots)
      for (const auto& left_out : slot.dominated) {
        EXPECT_EQ(static_cast<int>(left_out.dominators.size()), problem.count);
        for (const ProofItem& dominator : left_out.dominators)
          EXPECT_EQ(std::count(slot.choices.begin(), slot.choices.end(), dominator), 1);
      }
  }
  ForEachCombination(problem, [&](const Candidate& candidate) {
    const auto plan = plans.find(candidate.configuration);
    if (plan == plans.end()) return;  // some family has no choice
    const optimizer::Leaf leaf = SizeAlone(problem, candidate);
    const ClosedBox* box = Holder(*plan->second, replays.at(candidate.configuration), candidate);
    if (leaf.status != optimizer::LeafStatus::kFeasible) return;
    if (box == nullptr) {  // the list is full of designs that are no worse
      ++dominated;
      ASSERT_EQ(static_cast<int>(answer.designs.size()), problem.count);
      EXPECT_GE(leaf.objective * (1.0 + 1e-6), answer.designs.back().objective);
      return;
    }
    EXPECT_NE(box->end.kind, BoxKind::kInfeasible);
    EXPECT_NE(box->end.kind, BoxKind::kRefuted);
    EXPECT_LE(box->end.bound, leaf.objective * (1.0 + 1e-6));
    if (box->end.kind == BoxKind::kDesign) {
      ASSERT_LT(box->end.design, static_cast<int>(answer.designs.size()));
      EXPECT_EQ(KeyOf(problem, candidate), KeyOf(answer.designs[box->end.design]));
    }
  });
}

TEST(ProofTest, RecordHoldsEveryCombination) {
  int dominated = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Draw draw;
    draw.seed = 9000 + seed;
    draw.configurations = {static_cast<Configuration>(seed % 4)};
    draw.severity = 0.03 * static_cast<double>(seed % 12);
    draw.size = {3, 3, 3, 3, 3, 3, 2, 3, 2};
    Problem problem = RandomProblem(draw);
    problem.exclude.insert("custom");
    problem.count = 1 + static_cast<int>(seed % 3);
    problem.limits = {1, 2, 2, 2, 1};
    SCOPED_TRACE("seed " + std::to_string(seed));
    Check(problem, dominated);
  }
  EXPECT_GT(dominated, 0);
}

TEST(ProofTest, NoRecordUnlessAskedFor) {
  const Problem problem = EasyProblem(1, {Configuration::kMains});
  EXPECT_EQ(optimizer::SearchTrees(problem, Within(100.0)).proof.record, nullptr);
}

}  // namespace proof_test
}  // namespace plenum::test
