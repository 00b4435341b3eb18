#include "optimizer/problem/big_count.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace plenum::optimizer {
namespace big_count_test {

using Reference = boost::multiprecision::cpp_int;

BigCount CountOf(const Reference& reference) {
  return BigCount::FromDecimal(reference.str()).value();
}

// Numbers of up to 200 bits, many of them with runs of zeros and ones, where carries go far.
Reference Draw(std::mt19937& random) {
  Reference number = 0;
  for (int bits = static_cast<int>(random() % 201); bits > 0;) {
    const int run = std::min(bits, 1 + static_cast<int>(random() % 70));
    const int kind = static_cast<int>(random() % 3);
    Reference part = kind == 0 ? Reference(0) : (Reference(1) << run) - 1;
    if (kind == 2) part &= (Reference(random()) << 32) + random();
    number = (number << run) + part;
    bits -= run;
  }
  return number;
}

TEST(BigCount, ComputesAsBoostDoes) {
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const Reference a = Draw(random), b = i % 10 == 0 ? a : Draw(random);
    const BigCount x = CountOf(a), y = CountOf(b);
    ASSERT_EQ((x + y).str(), Reference(a + b).str());
    ASSERT_EQ((x * y).str(), Reference(a * b).str());
    ASSERT_EQ((x - y).str(), (a > b ? Reference(a - b) : Reference(0)).str()) << a << " - " << b;
    ASSERT_EQ(x < y, a < b) << a << " " << b;
    ASSERT_EQ(x == y, a == b) << a << " " << b;
    ASSERT_EQ(x + y - y, x);
    ASSERT_NEAR(x.ToDouble(), a.convert_to<double>(), 1e-15 * a.convert_to<double>());
  }
}

TEST(BigCount, ANumberIsACount) {
  EXPECT_EQ(BigCount().str(), "0");
  EXPECT_EQ(BigCount(0), BigCount());
  EXPECT_EQ(BigCount(1'000'000'000).str(), "1000000000");
  EXPECT_EQ(BigCount(std::numeric_limits<std::uint64_t>::max()).str(), "18446744073709551615");
  EXPECT_EQ((BigCount(std::numeric_limits<std::uint64_t>::max()) + 1).str(),
            "18446744073709551616");
  EXPECT_EQ(BigCount((std::uint64_t{1} << 53) - 1).ToDouble(), 9007199254740991.0);
}

TEST(BigCount, ReadsDigitsAndNothingElse) {
  for (const char* text : {"", "-1", "+1", " 1", "1 ", "1e3", "0x10", "1.0"})
    EXPECT_FALSE(BigCount::FromDecimal(text)) << text;
  EXPECT_EQ(BigCount::FromDecimal("000"), BigCount(0));
  EXPECT_EQ(BigCount::FromDecimal("00012"), BigCount(12));
  const std::string digits = "1" + std::string(999, '0');
  EXPECT_EQ(BigCount::FromDecimal(digits)->str(), digits);
  EXPECT_EQ(BigCount::FromDecimal(digits)->ToDouble(), std::numeric_limits<double>::infinity());
}

}  // namespace big_count_test
}  // namespace plenum::optimizer
