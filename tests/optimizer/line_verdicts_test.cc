// What is kept of boxes of lines against a map of the same.
#include "optimizer/line_verdicts.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace plenum::test {
namespace {

using optimizer::Constraint;
using optimizer::LineVerdicts;

TEST(LineVerdictsTest, KnowsWhatWasSetAndNothingElse) {
  std::mt19937 random(1);
  const auto draw = [&](int count) {
    return static_cast<int>(random() % static_cast<unsigned>(count));
  };
  LineVerdicts verdicts;
  std::map<LineVerdicts::Nodes, Constraint> expected;
  EXPECT_EQ(verdicts.Find({0, 0, 0}), nullptr);
  for (int i = 0; i < 20000; ++i) {
    const LineVerdicts::Nodes nodes{draw(50), draw(20), draw(30)};
    const Constraint* known = verdicts.Find(nodes);
    const auto found = expected.find(nodes);
    ASSERT_EQ(known != nullptr, found != expected.end());
    if (known) {
      ASSERT_EQ(*known, found->second);
    }
    if (draw(2) == 0) continue;
    const Constraint missed = draw(2) == 0 ? Constraint::kNone : Constraint::kFall;
    verdicts.Set(nodes, missed);
    expected[nodes] = missed;
  }
}

}  // namespace
}  // namespace plenum::test
