#include "catalog/store/content_hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace plenum::catalog {
namespace content_hash_test {

// Examples of FIPS 180-4 (NIST, SHA-256 test vectors).
TEST(ContentHash, Sha256IsThatOfTheStandard) {
  EXPECT_EQ(Sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

// Sums computed with Python's unbounded integers; the first wraps past 2^256.
TEST(ContentHash, OfASetIsTheSumModuloTwoToThe256) {
  SetHash hash;
  EXPECT_EQ(hash.Digits(), std::string(64, '0'));
  for (const char* text : {"a", "b", "c"}) hash.Add(text);
  EXPECT_EQ(hash.Digits(), "3738952c73a591f7943876ce346e132766d80bfb3a748e521e66cbd627e5391e");
  hash.Remove("c");
  EXPECT_EQ(hash.Digits(), "08bb6928ca5517152e4b8118ff058d82334469f89d507abd84f46634858a4958");
  SetHash negative;
  negative.Remove("c");
  EXPECT_EQ(negative.Digits(), "d182d3fc56af851d9a130a4aca977a5acc6c5dfd62dbec6b668d9a5e5da5103a");
}

TEST(ContentHash, OfASetForgetsTheOrderAndWhatWasTakenBack) {
  std::mt19937 random(5);
  std::vector<std::string> texts;
  for (int i = 0; i < 200; ++i) texts.push_back(std::to_string(random()));
  SetHash straight;
  for (const std::string& text : texts) straight.Add(text);
  std::shuffle(texts.begin(), texts.end(), random);
  SetHash other(SetHash().Digits());
  other.Add("extra");
  for (const std::string& text : texts) {
    other = SetHash(other.Digits());  // survives being written down
    other.Add(text);
  }
  EXPECT_NE(other.Digits(), straight.Digits());
  other.Remove("extra");
  EXPECT_EQ(other.Digits(), straight.Digits());
}

}  // namespace content_hash_test
}  // namespace plenum::catalog
