// The nearest of some names, against the edit distance as it is defined.
#include "catalog/units/text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace plenum::catalog {
namespace text_test {

// By the definition: the last bytes are replaced (or equal), inserted, deleted, or swapped.
std::size_t Distance(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  const auto less = [](std::string_view text, std::size_t n) {
    return text.substr(0, text.size() - n);
  };
  std::size_t best = std::min({Distance(less(a, 1), less(b, 1)) + (a.back() != b.back()),
                               Distance(a, less(b, 1)) + 1, Distance(less(a, 1), b) + 1});
  if (a.size() > 1 && b.size() > 1 && a.back() == b[b.size() - 2] && a[a.size() - 2] == b.back())
    best = std::min(best, Distance(less(a, 2), less(b, 2)) + 1);
  return best;
}

TEST(NearestName, HoldsTheNameAsAWordWhereNoneIsAMisspelling) {
  const std::vector<std::string_view> known = {"note", "rest_volume_ml", "operating_pressure_kpa",
                                               "pressure_kpa_max", "volumes"};
  EXPECT_EQ(NearestName("volume", {known.begin(), known.end() - 1}), "rest_volume_ml");
  EXPECT_EQ(NearestName("volume", known), "volumes");  // a misspelling goes first
  EXPECT_EQ(NearestName("pressure", known), "pressure_kpa_max");
  EXPECT_EQ(NearestName("lume", {"note", "volume_ml"}), "note");  // a part of a word is none
}

TEST(NearestName, IsThatOfTheSmallestDistance) {
  std::mt19937 random(7);
  const auto word = [&] {
    std::string text(std::uniform_int_distribution<std::size_t>(0, 6)(random), ' ');
    for (char& c : text) c = "abc"[std::uniform_int_distribution<>(0, 2)(random)];
    return text;
  };
  for (int i = 0; i < 300; ++i) {
    std::vector<std::string> words(5);
    std::generate(words.begin(), words.end(), word);
    const std::string name = word();
    std::string nearest;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const std::string& candidate : words)
      if (const std::size_t distance = Distance(name, candidate); distance < least) {
        least = distance;
        nearest = candidate;
      }
    EXPECT_EQ(NearestName(name, {words.begin(), words.end()}), nearest) << name;
  }
}

}  // namespace text_test
}  // namespace plenum::catalog
