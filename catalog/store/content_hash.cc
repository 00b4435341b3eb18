#include "catalog/store/content_hash.h"

#include <openssl/evp.h>

#include <charconv>
#include <stdexcept>

namespace plenum::catalog {
namespace {

using Digest = std::array<unsigned char, 32>;

Digest DigestOf(std::string_view text) {
  Digest digest{};
  if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 failed");
  return digest;
}

std::string Hexadecimal(const Digest& digest) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest) text += {kDigits[byte >> 4], kDigits[byte & 15]};
  return text;
}

}  // namespace

std::string Sha256(std::string_view text) { return Hexadecimal(DigestOf(text)); }

SetHash::SetHash(const std::string& digits) {
  for (std::size_t i = 0; i < sum_.size() && 2 * i + 2 <= digits.size(); ++i)
    std::from_chars(&digits[2 * i], &digits[2 * i] + 2, sum_[i], 16);
}

void SetHash::Add(std::string_view text) {
  const Digest digest = DigestOf(text);
  int carry = 0;
  for (std::size_t i = sum_.size(); i-- > 0;) {
    carry += sum_[i] + digest[i];
    sum_[i] = static_cast<unsigned char>(carry & 0xFF);
    carry >>= 8;
  }
}

void SetHash::Remove(std::string_view text) {
  const Digest digest = DigestOf(text);
  int borrow = 0;
  for (std::size_t i = sum_.size(); i-- > 0;) {
    const int difference = sum_[i] - digest[i] - borrow;
    borrow = difference < 0;
    sum_[i] = static_cast<unsigned char>(difference & 0xFF);
  }
}

std::string SetHash::Digits() const { return Hexadecimal(sum_); }

}  // namespace plenum::catalog
