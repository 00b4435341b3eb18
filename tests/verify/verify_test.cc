// The verifier against the search and against itself, on small random problems: answers of the
// search are accepted with nothing left open, its bounds lie below every design of a box, and lists
// from which a design was withheld, or to which one was added, are refused.
#include "verify/verify.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"
#include "verify/design/verify_size.h"
#include "verify/tree/verify_box.h"

namespace plenum::test {
namespace verify_test {

using optimizer::Answer;
using optimizer::BoxKind;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::ProofBox;
using optimizer::ProofPlan;
using optimizer::ProofRecord;
using optimizer::Status;

#ifdef PLENUM_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

// One source, one or two groups, any objective; few parts, so that every combination can be sized.
Problem Drawn(std::uint64_t seed) {
  constexpr optimizer::Objective kObjectives[] = {
      {1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
  Random random(seed);
  Draw draw;
  draw.seed = 50000 + seed;
  draw.groups = Chance(random, 0.75) ? 1 : 2;
  draw.simultaneous = draw.groups > 1 && Chance(random, 0.3);
  draw.severity = Uniform(random, 0.0, 0.5);
  draw.configurations = {static_cast<Configuration>(seed % 4)};
  draw.size = draw.groups == 1 ? CatalogueSize{2, 2, 3, 2, 2, 2, 2, 2, 2}
                               : CatalogueSize{1, 2, 2, 1, 1, 2, 1, 2, 1};
  Problem problem = RandomProblem(draw);
  problem.objective = kObjectives[Pick(random, 0, 3)];
  problem.count = Pick(random, 1, 12);
  const bool made = draw.groups == 1 && problem.objective.energy_wh == 0.0 && seed % 16 == 2;
  if (made) problem.parts.compressors.resize(1), problem.parts.batteries.resize(1);
  if (!made) problem.exclude.insert("custom");
  if (draw.groups > 1) problem.limits = {1, 1, 2, 2, 1};
  if (Chance(random, 0.2)) problem.mass_max_kg = Uniform(random, 0.5, 3.0);
  return problem;
}

Answer Recorded(const Problem& problem) {
  optimizer::SearchOptions options = Within(300.0);
  options.record = true;
  return optimizer::SearchTrees(problem, options);
}

// "check: why" of all that is refused.
std::string Refusals(const verify::Verification& verification) {
  std::string refusals;
  for (const verify::Check& check : verification.checks)
    if (!check.ok) refusals += check.name + ": " + check.detail + "\n";
  return refusals;
}

std::string Refusals(const Problem& problem, const Answer& answer) {
  return Refusals(
      verify::Verify(problem, answer, {.stop = {}, .brute_force = true, .progress = {}}));
}

bool Refuses(const std::string& refusals, const std::string& check) {
  return ("\n" + refusals).find("\n" + check + ": ") != std::string::npos;
}

TEST(VerifyTest, AcceptsWhatTheSearchFoundAndLeavesNothingOpen) {
  int open = 0, with_designs = 0;
  optimizer::BigCount sized = 0;
  for (std::uint64_t seed = 1; seed <= (kSanitized ? 8 : 48); ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(seed);
    const Answer answer = Recorded(problem);
    const verify::Verification verification =
        verify::Verify(problem, answer, {.stop = {}, .brute_force = true, .progress = {}});
    EXPECT_EQ(Refusals(verification), "");
    for (const verify::NotRechecked& left : verification.not_rechecked) {
      std::printf("seed %d: %s × %s\n", static_cast<int>(seed), left.combinations.str().c_str(),
                  left.what.c_str());
      ++open;
    }
    with_designs += !answer.designs.empty();
    ASSERT_TRUE(verification.brute_force);
    EXPECT_FALSE(verification.brute_force->cancelled);
    EXPECT_EQ(verification.brute_force->combinations, answer.proof.combinations);
    EXPECT_GE(verification.brute_force->feasible + verification.brute_force->undecided,
              answer.designs.size());
    sized += verification.brute_force->feasible + verification.brute_force->infeasible;
  }
  EXPECT_EQ(open, 0);
  EXPECT_GT(with_designs, kSanitized ? 2 : 24);
  EXPECT_GT(sized, kSanitized ? 30 : 300);
}

// Position of each choice of a design in the plan's slots; none where one was left out.
std::optional<verify::Ranges> PlaceOf(const Problem& problem, const ProofPlan& plan,
                                      const PartsKey& key) {
  verify::Ranges ranges(plan.slots.size());
  for (std::size_t s = 0; s < plan.slots.size(); ++s) {
    const auto& choices = plan.slots[s].choices;
    int found = -1;
    for (int i = 0; i < static_cast<int>(choices.size()); ++i) {
      verify::Ranges one(plan.slots.size(), {0, 1});
      one[s] = {i, i + 1};
      const auto* basics =
          choices[i].part < 0
              ? nullptr
              : &optimizer::BasicsOf(problem.parts, plan.slots[s].family, choices[i].part);
      if (choices[i].part == -1) found = i;
      for (const auto& [id, quantity] : key) {
        const bool same = basics ? basics->id == id : choices[i].part == -2 && id == "custom";
        if (same && (plan.slots[s].group >= 0 || quantity == choices[i].quantity)) found = i;
      }
    }
    if (found < 0) return std::nullopt;
    ranges[s] = {found, found + 1};
  }
  return ranges;
}

// One group, so that an id stands for one slot.
TEST(VerifyTest, BoundsLieBelowEveryDesignOfABox) {
  int compared = 0, infinite = 0;
  for (std::uint64_t seed = 1; seed <= (kSanitized ? 12 : 80); ++seed) {
    Problem problem = Drawn(seed);
    if (problem.groups.size() > 1) continue;
    SCOPED_TRACE(seed);
    const Answer answer = Recorded(problem);
    const BruteForce truth = Enumerate(problem);
    Random random(seed);
    for (const ProofPlan& plan : answer.proof.record->plans) {
      verify::KnownStrokes strokes(problem, plan);
      verify::Corners corners(problem, plan, strokes);
      for (const Enumerated& design : truth.designs) {
        if (design.configuration != plan.configuration) continue;
        const auto place = PlaceOf(problem, plan, design.key);
        if (!place) continue;
        for (int box = 0; box < 4; ++box) {  // the design alone, then wider and wider boxes
          verify::Ranges ranges = *place;
          for (std::size_t s = 0; box > 0 && s < ranges.size(); ++s) {
            const int last = static_cast<int>(plan.slots[s].choices.size());
            ranges[s].first = Pick(random, 0, ranges[s].first);
            ranges[s].second = Pick(random, ranges[s].second, last);
          }
          const double bound = corners.LeastObjective(ranges, optimizer::kUnlimited);
          EXPECT_LE(bound, design.leaf.objective * (1.0 + 1e-6));
          EXPECT_FALSE(corners.CannotMate(ranges));
          // With a threshold the bound may be less close, never less true.
          for (const double enough : {0.7, 0.98, 1.0, 1.02})
            EXPECT_LE(corners.LeastObjective(ranges, enough * design.leaf.objective),
                      design.leaf.objective * (1.0 + 1e-6));
          infinite += std::isinf(bound);
          ++compared;
        }
      }
    }
  }
  EXPECT_EQ(infinite, 0);
  EXPECT_GT(compared, kSanitized ? 300 : 3000);
}

TEST(VerifyTest, SizesAsTheSearchDoes) {
  int feasible = 0, infeasible = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= (kSanitized ? 6 : 34); ++seed) {
    Problem problem = Drawn(seed);
    if (problem.groups.size() > 1) continue;
    SCOPED_TRACE(seed);
    const BruteForce truth = Enumerate(problem);
    problem.count = 1'000'000;
    const Answer answer = Recorded(problem);
    for (const ProofPlan& plan : answer.proof.record->plans) {
      std::vector<verify::Ranges> feasible_places;
      verify::Sizer sizer(problem);
      for (const Enumerated& design : truth.designs) {
        if (design.configuration != plan.configuration) continue;
        const auto place = PlaceOf(problem, plan, design.key);
        ASSERT_TRUE(place);  // nothing is dominated a million times
        feasible_places.push_back(*place);
        const verify::Sizing sizing =
            sizer.Size(verify::AssemblyAt(problem, plan, *place), 1e-6, optimizer::kUnlimited);
        EXPECT_EQ(sizing.status, verify::Sized::kFeasible);
        EXPECT_NEAR(sizing.objective, design.leaf.objective, 2e-5 * design.leaf.objective);
        EXPECT_LE(sizing.lower_bound, sizing.objective);
        ++feasible;
      }
      // Every other combination has no settings that meet the requirements with room to spare.
      verify::Ranges place(plan.slots.size(), {0, 1});
      for (bool more = true; more;) {
        if (std::find(feasible_places.begin(), feasible_places.end(), place) ==
            feasible_places.end()) {
          verify::KnownStrokes strokes(problem, plan);
          verify::Corners corners(problem, plan, strokes);
          if (!corners.CannotMate(place)) {
            const verify::Sizing sizing =
                sizer.Size(verify::AssemblyAt(problem, plan, place), -1e-6, optimizer::kUnlimited);
            apart += sizing.status == verify::Sized::kUnknown;
            EXPECT_NE(sizing.status, verify::Sized::kFeasible);
            ++infeasible;
          }
        }
        more = false;
        for (std::size_t s = 0; s < place.size() && !more; ++s) {
          more = place[s].second < static_cast<int>(plan.slots[s].choices.size());
          place[s] = more ? std::pair{place[s].first + 1, place[s].second + 1} : std::pair{0, 1};
        }
      }
    }
  }
  EXPECT_GT(feasible, kSanitized ? 20 : 100);
  EXPECT_GT(infeasible, kSanitized ? 10 : 100);
  EXPECT_EQ(apart, 0);
}

// A copy of the record that may be changed.
ProofRecord& Editable(Answer& answer) {
  auto record = std::make_shared<ProofRecord>(*answer.proof.record);
  ProofRecord& edited = *record;
  answer.proof.record = record;
  return edited;
}

// Problems whose list is full, with more designs behind it.
std::vector<std::pair<Problem, Answer>> FullLists(std::size_t count = kSanitized ? 3 : 8) {
  std::vector<std::pair<Problem, Answer>> lists;
  for (std::uint64_t seed = 1; lists.size() < count; ++seed) {
    Problem problem = Drawn(seed);
    // Energies that differ by little are not told apart.
    if (problem.objective.energy_wh > 0.0 || problem.groups.size() > 1) continue;
    problem.exclude.insert("custom");
    problem.count = 3;
    const Answer answer = Recorded(problem);
    if (answer.status == Status::kOptimal && answer.designs.size() == 3)
      lists.emplace_back(std::move(problem), answer);
  }
  return lists;
}

// The best design taken off the list, its box closed for another reason and the counts put right:
// only looking at the box again, or at all combinations, shows it.
TEST(VerifyTest, FindsADesignThatWasWithheld) {
  for (auto& [problem, answer] : FullLists()) {
    problem.count = 2;
    answer.designs.erase(answer.designs.begin());
    ProofRecord& record = Editable(answer);
    record.count = 2;
    for (ProofPlan& plan : record.plans)
      for (ProofBox& box : plan.boxes)
        if (box.kind == BoxKind::kDesign && --box.design < 0)
          box = {.kind = BoxKind::kInfeasible, .constraint = optimizer::Constraint::kRise};
    answer.proof.evaluated -= 1;
    answer.proof.pruned.infeasible += 1;
    const std::string refusals = Refusals(problem, answer);
    EXPECT_TRUE(Refuses(refusals, "rechecked")) << refusals;
    EXPECT_TRUE(Refuses(refusals, "brute_force")) << refusals;
    EXPECT_FALSE(Refuses(refusals, "boxes") || Refuses(refusals, "counts")) << refusals;
  }
}

// The same with the box said to have been sized and refuted.
TEST(VerifyTest, FindsADesignThatWasRefuted) {
  for (auto& [problem, answer] : FullLists()) {
    problem.count = 2;
    answer.designs.erase(answer.designs.begin());
    ProofRecord& record = Editable(answer);
    record.count = 2;
    for (ProofPlan& plan : record.plans)
      for (ProofBox& box : plan.boxes)
        if (box.kind == BoxKind::kDesign && --box.design < 0) box = {.kind = BoxKind::kRefuted};
    const std::string refusals = Refusals(problem, answer);
    EXPECT_TRUE(Refuses(refusals, "rechecked")) << refusals;
    EXPECT_TRUE(Refuses(refusals, "brute_force")) << refusals;
  }
}

// A list of a looser problem: its designs do not meet the requirements.
TEST(VerifyTest, FindsADesignThatWasAdded) {
  int tightened = 0;
  for (const auto& [problem, answer] : FullLists()) {
    Problem tight = problem;
    tight.actuations *= 1e3;
    if (answer.designs.front().configuration == Configuration::kMains)
      tight.groups[0].rise_time_max_s = 0.5 * answer.designs[0].performance.groups[0].rise_time_s;
    const std::string refusals = Refusals(tight, answer);
    EXPECT_TRUE(Refuses(refusals, "brute_force")) << refusals;
    ++tightened;
  }
  EXPECT_GT(tightened, 0);
}

// A wrong value in the list that everything else in the answer bears out.
TEST(VerifyTest, FindsAnObjectiveThatIsNotThatOfTheParts) {
  for (auto& [problem, answer] : FullLists()) {
    for (optimizer::Design& design : answer.designs) design.objective *= 1.01;
    answer.proof.lower_bound *= 1.01;
    EXPECT_TRUE(Refuses(Refusals(problem, answer), "brute_force"));
  }
}

TEST(VerifyTest, BruteForceStopsWhenItIsToldTo) {
  const auto lists = FullLists(8);  // some of which take long enough to be asked
  int asked = 0, shown = 0;
  const verify::VerifyOptions options{[&asked] { return ++asked > 0; }, true,
                                      [&shown](const optimizer::BigCount&) { ++shown; }};
  bool stopped = false;
  for (const auto& [problem, answer] : lists) {
    Problem all = problem;
    all.count = 1'000'000;  // nothing is beyond the list
    Answer without = answer;
    without.proof.record.reset();
    const auto verification = verify::Verify(all, without, options);
    ASSERT_TRUE(verification.brute_force);
    if (verification.brute_force->cancelled) {
      stopped = true;
      EXPECT_LT(verification.brute_force->combinations, answer.proof.combinations);
    }
  }
  EXPECT_TRUE(stopped);
  EXPECT_EQ(asked > 0, shown > 0);
}

}  // namespace verify_test
}  // namespace plenum::test
