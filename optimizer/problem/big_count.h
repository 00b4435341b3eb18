// Exact counts of combinations, past 2^64: whole numbers from 0, without an upper limit.
#ifndef PLENUM_OPTIMIZER_PROBLEM_BIG_COUNT_H_
#define PLENUM_OPTIMIZER_PROBLEM_BIG_COUNT_H_

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::optimizer {

class BigCount {
 public:
  BigCount() = default;
  BigCount(std::uint64_t count);  // NOLINT: whole numbers are counts
  // One or more decimal digits and nothing else; none otherwise.
  static std::optional<BigCount> FromDecimal(std::string_view digits);

  BigCount& operator+=(const BigCount& other);
  // A difference below zero is zero.
  BigCount& operator-=(const BigCount& other);
  BigCount& operator*=(const BigCount& other);
  friend BigCount operator+(BigCount a, const BigCount& b) { return a += b; }
  friend BigCount operator-(BigCount a, const BigCount& b) { return a -= b; }
  friend BigCount operator*(BigCount a, const BigCount& b) { return a *= b; }
  friend bool operator==(const BigCount&, const BigCount&) = default;
  friend std::strong_ordering operator<=>(const BigCount& a, const BigCount& b);

  std::string str() const;  // in decimal digits
  // Within 1e-15 of the count, exact up to 2^53; +∞ past the largest double.
  double ToDouble() const;

 private:
  void DropLeadingZeros();

  std::vector<std::uint32_t> limbs_;  // the least significant first, without leading zeros
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_BIG_COUNT_H_
