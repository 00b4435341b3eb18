// Engineers who buy a design: what each knows of a hidden world, and what they test.
#ifndef PLENUM_BENCH_LOOP_ENGINEER_H_
#define PLENUM_BENCH_LOOP_ENGINEER_H_

#include <set>
#include <vector>

#include "api/json/json.h"
#include "bench/loop/testing.h"
#include "catalog/fields/part.h"
#include "tests/support/random.h"

namespace plenum::bench {

struct Habits {
  int tests_most = 5;
  double saving_least = 0.01;  // of the objective: a test that saves less is not made
};

struct Engineer {
  api::Json requirements;                   // guaranteed
  const std::vector<catalog::Part>& truth;  // asked by tests alone
  std::vector<catalog::Part> known;         // the catalogue with what was measured
  api::Json answer;                         // the list of what is known
  test::Random random;
  std::set<TestName> made = {};
  // What testing.h tells of each, with "why" ("saves", "confirms", "random"), "saving_share" that
  // was promised, and "objective_before" and "objective" of the guaranteed list.
  api::Json tests = api::Json::array();
};

// Of what measure_first and measure_together name takes that which saves most for each test still
// to be made, makes its first one, saves the part and ranks again, until nothing is named that
// saves enough, or the tests are spent.
void FollowLoop(Engineer& engineer, const Habits& habits);

// Tests what is estimated of the parts of the design that is to be bought, and ranks again, until
// nothing is or the tests are spent.
void Confirm(Engineer& engineer, const Habits& habits);

// Makes so many tests drawn from those of the parts of the guaranteed design and of those on paper
// that are better, then ranks once.
void TestAtRandom(Engineer& engineer, int count);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_LOOP_ENGINEER_H_
