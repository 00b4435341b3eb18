// What orders designs whose objectives tie: mass, then cost, then part ids.
#ifndef PLENUM_OPTIMIZER_CHOICES_TIE_KEY_H_
#define PLENUM_OPTIMIZER_CHOICES_TIE_KEY_H_

#include <compare>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/evaluate/line.h"

namespace plenum::optimizer {

// Mass and cost in whole 10⁻⁹ kg and 10⁻⁶ EUR, so that sums of shares are exact and do not depend
// on their order. An amount that is the whole objective is 0: it tells no ties apart. An unknown
// price counts as 0, a made-to-measure reservoir as the least that it can be, and a tank with the
// least air.
struct TieShare {
  long long mass = 0, cost = 0;
  TieShare& operator+=(const TieShare& other);
  auto operator<=>(const TieShare&) const = default;
};

TieShare TieShareOf(const Objective& objective, const Amounts& amounts);
// The least of each: no sum of shares of a set comes before that of these.
TieShare Least(const TieShare& a, const TieShare& b);

// Ids with numbers in parallel, in the order of a design's parts list.
using PartIds = std::vector<std::pair<std::string, int>>;
PartIds IdsOf(const Design& design);

struct TieKey {
  TieShare share;
  PartIds ids;
  auto operator<=>(const TieKey&) const = default;
};

TieKey TieKeyOf(const Problem& problem, const Design& design);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_TIE_KEY_H_
