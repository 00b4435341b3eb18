// Against all subsets: what fails is drawn as a list of conflicts, and the oracle knows only that.
#include "optimizer/explain/minimal_conflicts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace plenum::test {
namespace minimal_conflicts_test {

using optimizer::DemandSet;
using optimizer::DropOracle;
using optimizer::Met;
using optimizer::MinimalConflict;

constexpr int kCount = 7;

DemandSet FromBits(unsigned bits) {
  DemandSet set;
  for (int i = 0; i < kCount; ++i)
    if (bits >> i & 1u) set.insert(i);
  return set;
}

struct World {
  std::vector<unsigned> conflicts;  // no one holds another
  int asked = 0;

  bool Fails(unsigned in_force) const {
    return std::any_of(conflicts.begin(), conflicts.end(),
                       [&](unsigned conflict) { return (conflict & ~in_force) == 0; });
  }
  DropOracle Oracle() {
    return DropOracle([this](const DemandSet& dropped) {
      ++asked;
      unsigned in_force = (1u << kCount) - 1u;
      for (const int demand : dropped) in_force &= ~(1u << demand);
      return Fails(in_force) ? Met::kNo : Met::kYes;
    });
  }
};

World Draw(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  World world;
  const int wanted = 1 + static_cast<int>(random() % 5);
  for (int tries = 0; tries < 40 && static_cast<int>(world.conflicts.size()) < wanted; ++tries) {
    const unsigned drawn = random() & random() & ((1u << kCount) - 1u);
    const auto related = [&](unsigned other) {
      return (other & ~drawn) == 0 || (drawn & ~other) == 0;
    };
    if (drawn != 0 && std::none_of(world.conflicts.begin(), world.conflicts.end(), related))
      world.conflicts.push_back(drawn);
  }
  return world;
}

std::set<DemandSet> SmallestDropsByBruteForce(const World& world) {
  std::set<DemandSet> smallest;
  std::size_t size = kCount + 1;
  for (unsigned dropped = 0; dropped < 1u << kCount; ++dropped) {
    if (world.Fails(~dropped & ((1u << kCount) - 1u))) continue;
    const DemandSet set = FromBits(dropped);
    if (set.size() < size) smallest.clear();
    size = std::min(size, set.size());
    if (set.size() == size) smallest.insert(set);
  }
  return smallest;
}

TEST(MinimalConflicts, AreThoseOfTheWorldDisjointAndAsManyAsCanBeAdded) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    World world = Draw(seed);
    DropOracle oracle = world.Oracle();
    unsigned used = 0;
    for (const MinimalConflict& found : FindDisjointConflicts(kCount, oracle)) {
      unsigned bits = 0;
      for (const int demand : found.demands) bits |= 1u << demand;
      EXPECT_THAT(world.conflicts, testing::Contains(bits)) << "seed " << seed;
      EXPECT_EQ(used & bits, 0u);
      EXPECT_EQ(found.proved, found.demands);
      used |= bits;
    }
    EXPECT_FALSE(world.Fails(~used)) << "seed " << seed;
  }
}

TEST(MinimalConflicts, TheSmallestDropsAreThoseOfBruteForce) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    World world = Draw(seed);
    DropOracle oracle = world.Oracle();
    const auto conflicts = FindDisjointConflicts(kCount, oracle);
    const auto drops = FindSmallestDrops(kCount, conflicts, 1000, oracle);
    EXPECT_EQ(std::set<DemandSet>(drops.begin(), drops.end()), SmallestDropsByBruteForce(world))
        << "seed " << seed;
    EXPECT_LT(world.asked, 80) << "seed " << seed;  // of 128 subsets
  }
}

TEST(MinimalConflicts, WhatNothingMendsHasNoConflictAndNoDrop) {
  DropOracle oracle([](const DemandSet&) { return Met::kNo; });
  const auto conflicts = FindDisjointConflicts(kCount, oracle);
  ASSERT_EQ(conflicts.size(), 1u);
  EXPECT_TRUE(conflicts.front().demands.empty());
  EXPECT_TRUE(FindSmallestDrops(kCount, conflicts, 10, oracle).empty());
}

// What is not known takes part, unproved, and no drop is claimed.
TEST(MinimalConflicts, OutOfTimeClaimsNothing) {
  DropOracle oracle([](const DemandSet&) { return Met::kUnknown; });
  const MinimalConflict found = FindMinimalConflict(kCount, {}, oracle);
  EXPECT_EQ(found.demands.size(), static_cast<std::size_t>(kCount));
  EXPECT_TRUE(found.proved.empty());
  EXPECT_TRUE(FindSmallestDrops(kCount, {found}, 10, oracle).empty());
}

}  // namespace minimal_conflicts_test
}  // namespace plenum::test
