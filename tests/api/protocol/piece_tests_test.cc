// Tests of pieces of one type.
#include "api/protocol/piece_tests.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plenum::api {
namespace piece_tests_test {

TEST(PieceTests, ASourceRemembersThem) {
  const std::vector<PieceTest> pieces = {{"A", {5.71, 3.2, 0.0}, 0.0072},
                                         {"the \"other\"; ± 2", {5.5, 3.0, 0.0}, 0.01},
                                         {"", {5.6, 3.1, 0.0}, 0.02}};
  const std::string source = WithPieces("fitted to a.csv", pieces);
  EXPECT_EQ(source.substr(0, 52), "fitted to a.csv; pieces: \"A\" 5.71 3.2 0 ± 0.0072; \"");
  EXPECT_EQ(PiecesOf(source), pieces);
  for (const char* other :
       {"", "fitted to a.csv", "x; pieces: A 1 ± 0.1", "x; pieces: \"A\" 1", "x; pieces: \"A",
        "x; pieces: \"A\" 1 ± -1", "x; pieces: \"A\" 1 ± 0.1; \"B\" 1 2 ± 0.1"})
    EXPECT_TRUE(PiecesOf(other).empty()) << other;
}

// By hand: pieces of 1, 1.2 and 1.1: mean 1.1, spread 0.1, standard error 0.1/√3.
TEST(PieceTests, TheSpreadBetweenPiecesBeatsThePrecisionOfOne) {
  const TypeNumber type = OfType({{"a", {1.0}, 0.004}, {"b", {1.2}, 0.004}, {"c", {1.1}, 0.005}});
  EXPECT_DOUBLE_EQ(type.values[0], 1.1);
  EXPECT_NEAR(type.spread.value(), 0.1 / 1.1, 1e-12);
  EXPECT_NEAR(type.standard_error.value(), 0.1 / std::sqrt(3.0) / 1.1, 1e-12);
  EXPECT_NEAR(type.uncertainty, std::hypot(0.1, 0.1 / std::sqrt(3.0)) / 1.1, 1e-12);
  EXPECT_GE(type.uncertainty, *type.spread);
}

TEST(PieceTests, AlikeByChanceAreNoBetterKnownThanATestOfOne) {
  const TypeNumber type = OfType({{"a", {1.0}, 0.01}, {"b", {1.0}, 0.02}});
  EXPECT_EQ(type.spread, 0.0);
  EXPECT_DOUBLE_EQ(type.uncertainty, 0.02);
  const TypeNumber one = OfType({{"a", {1.0}, 0.01}});
  EXPECT_FALSE(one.spread);
  EXPECT_DOUBLE_EQ(one.uncertainty, 0.01);
}

// The end of a pump's table, where little is delivered, does not decide.
TEST(PieceTests, OfACurveTheLargestSpreadCounts) {
  const TypeNumber type = OfType({{"a", {10.0, 5.0, 0.1}, 0.01}, {"b", {10.2, 5.4, 0.3}, 0.01}});
  EXPECT_NEAR(type.spread.value(), 0.4 / std::sqrt(2.0) / 5.2, 1e-12);
}

}  // namespace piece_tests_test
}  // namespace plenum::api
