#include "optimizer/problem/big_count.h"

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {
namespace {

constexpr int kLimbBits = 32;
constexpr std::uint32_t kDigitsBase = 1'000'000'000;  // digits are read and written by nines
constexpr std::size_t kDigits = 9;

std::uint32_t Low(std::uint64_t value) { return static_cast<std::uint32_t>(value); }

}  // namespace

BigCount::BigCount(std::uint64_t count) {
  for (; count > 0; count >>= kLimbBits) limbs_.push_back(Low(count));
}

std::optional<BigCount> BigCount::FromDecimal(std::string_view digits) {
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos)
    return std::nullopt;
  BigCount count;
  while (!digits.empty()) {
    const std::size_t length = digits.size() % kDigits == 0 ? kDigits : digits.size() % kDigits;
    count *= kDigitsBase;
    count += std::stoul(std::string(digits.substr(0, length)));
    digits.remove_prefix(length);
  }
  return count;
}

BigCount& BigCount::operator+=(const BigCount& other) {
  if (limbs_.size() < other.limbs_.size()) limbs_.resize(other.limbs_.size());
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    carry += limbs_[i];
    if (i < other.limbs_.size()) carry += other.limbs_[i];
    limbs_[i] = Low(carry);
    carry >>= kLimbBits;
  }
  if (carry > 0) limbs_.push_back(Low(carry));
  return *this;
}

BigCount& BigCount::operator-=(const BigCount& other) {
  if (*this <= other) {
    limbs_.clear();
    return *this;
  }
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    const std::uint64_t taken = borrow + (i < other.limbs_.size() ? other.limbs_[i] : 0);
    borrow = limbs_[i] < taken ? 1 : 0;
    limbs_[i] = Low(limbs_[i] - taken);
  }
  DropLeadingZeros();
  return *this;
}

BigCount& BigCount::operator*=(const BigCount& other) {
  std::vector<std::uint32_t> product(limbs_.size() + other.limbs_.size());
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < other.limbs_.size(); ++j) {
      carry += std::uint64_t{limbs_[i]} * other.limbs_[j] + product[i + j];
      product[i + j] = Low(carry);
      carry >>= kLimbBits;
    }
    product[i + other.limbs_.size()] = Low(carry);
  }
  limbs_ = std::move(product);
  DropLeadingZeros();
  return *this;
}

std::strong_ordering operator<=>(const BigCount& a, const BigCount& b) {
  if (a.limbs_.size() != b.limbs_.size()) return a.limbs_.size() <=> b.limbs_.size();
  return std::lexicographical_compare_three_way(a.limbs_.rbegin(), a.limbs_.rend(),
                                                b.limbs_.rbegin(), b.limbs_.rend());
}

std::string BigCount::str() const {
  std::string reversed;
  for (BigCount rest = *this; !rest.limbs_.empty(); rest.DropLeadingZeros()) {
    std::uint64_t remainder = 0;
    for (auto limb = rest.limbs_.rbegin(); limb != rest.limbs_.rend(); ++limb) {
      remainder = (remainder << kLimbBits) + *limb;
      *limb = Low(remainder / kDigitsBase);
      remainder %= kDigitsBase;
    }
    std::string digits = std::to_string(remainder);
    digits.insert(0, kDigits - digits.size(), '0');
    reversed.append(digits.rbegin(), digits.rend());
  }
  reversed.erase(reversed.find_last_not_of('0') + 1);
  return reversed.empty() ? "0" : std::string(reversed.rbegin(), reversed.rend());
}

double BigCount::ToDouble() const {
  double value = 0.0;
  for (auto limb = limbs_.rbegin(); limb != limbs_.rend(); ++limb)
    value = std::ldexp(value, kLimbBits) + *limb;
  return value;
}

void BigCount::DropLeadingZeros() {
  while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
}

}  // namespace plenum::optimizer
