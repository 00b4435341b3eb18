#include "optimizer/choices/dominance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace dominance_test {

using optimizer::Contender;
using optimizer::KeepBest;
using optimizer::Skyband;

bool Dominates(const Contender& a, const Contender& b, double tie) {
  if (a.mates != b.mates) return false;
  for (std::size_t i = 0; i < a.losses.size(); ++i)
    if (a.losses[i] > b.losses[i]) return false;
  if (a.objective > b.objective) return false;
  return a.objective < b.objective - tie || a.id < b.id;
}

struct Family {
  std::deque<std::string> ids;
  std::vector<Contender> contenders;
};

Family Random(std::uint64_t seed, int count) {
  test::Random random(seed);
  Family family;
  for (int i = 0; i < count; ++i) {
    Contender c;
    c.item = {i, 1};
    c.id = family.ids.emplace_back("part-" + std::to_string(Pick(random, 100000, 999999)));
    c.mates = Chance(random, 0.5) ? 0 : 1;
    c.objective = 0.1 * Pick(random, 1, 20);
    for (int k = 0; k < 2; ++k) c.losses.push_back(Pick(random, 0, 8));
    family.contenders.push_back(c);
  }
  return family;
}

// Against the definition: left out is what k others dominate, and only that.
TEST(DominanceTest, LeavesOutWhatKOthersDominate) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    for (int k : {1, 2, 5}) {
      const double tie = seed % 3 == 0 ? 0.15 : 0.01;
      const Family family = Random(seed, 400);
      const std::vector<Contender>& contenders = family.contenders;
      const Skyband skyband = KeepBest(contenders, k, tie, true);
      EXPECT_EQ(skyband.kept.size() + skyband.left_out.size(), contenders.size());
      EXPECT_TRUE(std::is_sorted(skyband.kept.begin(), skyband.kept.end(), [&](int a, int b) {
        return contenders[a].id < contenders[b].id;
      }));
      for (const auto& left_out : skyband.left_out) {
        ASSERT_EQ(static_cast<int>(left_out.dominators.size()), k);
        for (const auto& dominator : left_out.dominators) {
          EXPECT_TRUE(Dominates(contenders[dominator.part], contenders[left_out.item.part], tie));
          EXPECT_EQ(std::count(skyband.kept.begin(), skyband.kept.end(), dominator.part), 1);
        }
      }
      ASSERT_EQ(skyband.outdone.size(), contenders.size());
      for (int i : skyband.kept) {
        const auto dominators = std::count_if(
            contenders.begin(), contenders.end(),
            [&](const Contender& other) { return Dominates(other, contenders[i], tie); });
        EXPECT_LT(dominators, k);
        EXPECT_EQ(skyband.outdone[i], dominators);
      }
    }
}

}  // namespace dominance_test
}  // namespace plenum::test
