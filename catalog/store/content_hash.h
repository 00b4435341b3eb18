// Digests that name contents: SHA-256 of a text, and the hash of a set of texts.
#ifndef PLENUM_CATALOG_STORE_CONTENT_HASH_H_
#define PLENUM_CATALOG_STORE_CONTENT_HASH_H_

#include <array>
#include <string>
#include <string_view>

namespace plenum::catalog {

// SHA-256 (FIPS 180-4) as 64 hexadecimal digits.
std::string Sha256(std::string_view text);

// The sum of the SHA-256 of each text as 256-bit numbers modulo 2^256: equal sets have equal hashes
// in whatever order they were built, and a change of one text costs one text's work (AdHash:
// Bellare and Micciancio, EUROCRYPT 1997). It tells states apart and finds damage; it does not
// withstand an adversary who composes thousands of texts for a collision.
class SetHash {
 public:
  SetHash() = default;                          // of the empty set
  explicit SetHash(const std::string& digits);  // 64 hexadecimal digits

  void Add(std::string_view text);
  void Remove(std::string_view text);
  std::string Digits() const;

 private:
  std::array<unsigned char, 32> sum_{};  // most significant byte first
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_CONTENT_HASH_H_
