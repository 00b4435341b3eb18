// What is kept of boxes of lines against a map of the same.
#include "optimizer/choices/known_lines.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace plenum::test {
namespace known_lines_test {

using optimizer::Constraint;
using optimizer::KnownLines;
using Known = KnownLines::Known;

TEST(KnownLinesTest, KnowsWhatWasSetAndNothingElse) {
  std::mt19937 random(1);
  const auto draw = [&](int count) {
    return static_cast<int>(random() % static_cast<unsigned>(count));
  };
  KnownLines lines;
  std::map<KnownLines::Nodes, Known> expected;
  EXPECT_EQ(lines.Find({0, 0, 0}), nullptr);
  for (int i = 0; i < 20000; ++i) {
    const KnownLines::Nodes nodes{draw(50), draw(20), draw(30)};
    const Known* known = lines.Find(nodes);
    const auto found = expected.find(nodes);
    ASSERT_EQ(known != nullptr, found != expected.end());
    if (known) {
      ASSERT_EQ(*known, found->second);
    }
    if (draw(2) == 0) continue;
    const Known now = draw(2) == 0 ? Known::Made(i) : Known::Missing(Constraint::kFall);
    lines.Set(nodes, now);
    expected[nodes] = now;
  }
}

TEST(KnownLinesTest, ForgetsOnlyTheLineThatIsKnown) {
  const KnownLines::Nodes made{1, 2, 3}, remade{1, 2, 4}, missing{1, 2, 5}, unknown{1, 2, 6};
  KnownLines lines;
  lines.ForgetLine(made, 0);
  EXPECT_EQ(lines.Find(made), nullptr);
  lines.Set(made, Known::Made(0));
  lines.Set(remade, Known::Made(7));
  lines.Set(missing, Known::Missing(Constraint::kRise));
  for (const KnownLines::Nodes& nodes : {made, remade, missing, unknown})
    lines.ForgetLine(nodes, 0);
  EXPECT_EQ(*lines.Find(made), Known::Missing(Constraint::kNone));
  EXPECT_EQ(*lines.Find(remade), Known::Made(7));
  EXPECT_EQ(*lines.Find(missing), Known::Missing(Constraint::kRise));
  EXPECT_EQ(lines.Find(unknown), nullptr);
}

TEST(KnownLinesTest, ABoxMissesSomethingOrMayHaveItsLine) {
  for (Constraint missed : {Constraint::kNone, Constraint::kMating, Constraint::kAmounts}) {
    EXPECT_EQ(Known::Missing(missed).missed(), missed);
    EXPECT_EQ(Known::Missing(missed).line(), -1);
  }
  for (int line : {0, 1, 49'999}) {
    EXPECT_EQ(Known::Made(line).missed(), Constraint::kNone);
    EXPECT_EQ(Known::Made(line).line(), line);
  }
  EXPECT_EQ(Known(), Known::Missing(Constraint::kNone));
}

}  // namespace known_lines_test
}  // namespace plenum::test
