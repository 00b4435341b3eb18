// A search beside the enumeration of its problem, and before the verifier.
#ifndef PLENUM_TESTS_SUPPORT_ENUMERATED_SEARCH_H_
#define PLENUM_TESTS_SUPPORT_ENUMERATED_SEARCH_H_

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/in_full.h"
#include "verify/verify.h"

namespace plenum::test {

// A search that keeps its record.
inline optimizer::Answer Recorded(const optimizer::Problem& problem, double seconds = 60.0) {
  optimizer::SearchOptions options = Within(seconds);
  options.record = true;
  return optimizer::SearchTrees(problem, options);
}

inline bool Accepts(const optimizer::Problem& problem, const optimizer::Answer& answer) {
  const verify::Verification verification = verify::Verify(problem, answer);
  return std::all_of(verification.checks.begin(), verification.checks.end(),
                     [](const verify::Check& check) { return check.ok; });
}

// Whether it refuses the answer with its first design changed.
template <typename Change>
bool RefusesFirst(const optimizer::Problem& problem, optimizer::Answer answer,
                  const Change& change) {
  change(answer.designs.front());
  return !Accepts(problem, answer);
}

// Every check of `verify` with brute force.
inline void ExpectVerified(const optimizer::Problem& problem, const optimizer::Answer& answer) {
  for (const verify::Check& check :
       verify::Verify(problem, answer, {.stop = {}, .brute_force = true, .progress = {}}).checks)
    EXPECT_TRUE(check.ok) << check.name << ": " << check.detail;
}

// No looser problem has a worse best design than `answer`, which has one.
inline void ExpectNeverWorse(const optimizer::Answer& answer,
                             const std::vector<optimizer::Problem>& looser) {
  for (const optimizer::Problem& loose : looser) {
    const optimizer::Answer better = optimizer::SearchTrees(loose, Within(60.0));
    ASSERT_FALSE(better.designs.empty());
    EXPECT_LE(better.designs[0].objective, answer.designs[0].objective * (1.0 + 1e-6));
  }
}

// Searches, expects the list that enumeration gives and that `verify` accepts it, and hands each
// listed design with its enumerated twin to `see`. Whether there is a design.
template <typename See>
bool ExpectAsEnumerated(const optimizer::Problem& problem, const See& see) {
  using optimizer::Status;
  const BruteForce truth = Enumerate(problem);
  const optimizer::Answer answer = Recorded(problem, 120.0);
  EXPECT_EQ(answer.proof.combinations, optimizer::BigCount(truth.combinations));
  EXPECT_EQ(answer.proof.undecided, 0);
  EXPECT_EQ(answer.status, truth.designs.empty() ? Status::kInfeasible : Status::kOptimal);
  const std::size_t expected =
      std::min(truth.designs.size(), static_cast<std::size_t>(problem.count));
  EXPECT_EQ(answer.designs.size(), expected);
  for (std::size_t i = 0; i < std::min(expected, answer.designs.size()); ++i) {
    const Enumerated& enumerated = truth.designs[i];
    EXPECT_EQ(KeyOf(answer.designs[i]), enumerated.key) << "rank " << i + 1;
    EXPECT_NEAR(answer.designs[i].objective, enumerated.leaf.objective,
                1e-6 * enumerated.leaf.objective)
        << "rank " << i + 1;
    see(answer.designs[i], enumerated);
  }
  ExpectVerified(problem, answer);
  return expected > 0;
}

// Of problems that are compared so.
struct Compared {
  int feasible = 0, infeasible = 0, designs = 0;
};
inline void CompareLists(const optimizer::Problem& problem, Compared& compared) {
  const bool found = ExpectAsEnumerated(
      problem, [&](const optimizer::Design&, const Enumerated&) { ++compared.designs; });
  ++(found ? compared.feasible : compared.infeasible);
}

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_ENUMERATED_SEARCH_H_
