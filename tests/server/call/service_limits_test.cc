// Who may enter, and how much may be held.
#include "server/call/service_limits.h"

#include <gtest/gtest.h>

namespace plenum::server {
namespace service_limits_test {

TEST(Gate, LetsInInTheOrderOfTickets) {
  int left = 0;
  Gate gate(1, 2, [&] { ++left; });
  Gate::Ticket none, first, second, third;
  auto inside = gate.Enter(none);
  ASSERT_TRUE(inside);
  EXPECT_FALSE(none);
  EXPECT_FALSE(gate.Enter(first));
  EXPECT_FALSE(gate.Enter(second));
  EXPECT_FALSE(gate.Enter(third));
  EXPECT_TRUE(first && second);
  EXPECT_FALSE(third);  // too many wait
  inside = nullptr;
  EXPECT_EQ(left, 1);
  EXPECT_FALSE(gate.Enter(second));
  EXPECT_FALSE(gate.Enter(none));  // nobody passes those who wait
  EXPECT_TRUE(gate.Enter(first));  // and leaves at once
  first = nullptr;
  second = nullptr;  // who gives up is passed
  EXPECT_TRUE(gate.Enter(none));
}

TEST(ByteBudget, CountsTextsUntilTheirLastCopyGoes) {
  ByteBudget budget(10);
  Bytes large = budget.Hold("more than ten bytes");  // alone
  ASSERT_TRUE(large);
  EXPECT_EQ(*large, "more than ten bytes");
  EXPECT_FALSE(budget.Hold("x"));
  Bytes copy = large;
  large = nullptr;
  EXPECT_FALSE(budget.Hold("x"));
  copy = nullptr;
  EXPECT_EQ(budget.held(), 0u);
  const Bytes one = budget.Hold("12345"), other = budget.Hold("67890");
  EXPECT_TRUE(one && other);
  EXPECT_FALSE(budget.Hold("x"));
  EXPECT_EQ(budget.held(), 10u);
}

}  // namespace service_limits_test
}  // namespace plenum::server
