// The part ids of a design, and what orders designs whose objectives tie: mass, then cost, then
// ids. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_IDS_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_IDS_H_

#include <compare>
#include <string>
#include <utility>
#include <vector>

#include "verify/design/verify_choice.h"

namespace plenum::verify {

// Ids in the order of a parts list, with pieces where parts of the source stand in parallel.
using Ids = std::vector<std::pair<std::string, int>>;
Ids IdsOf(const Design& design);
std::string Text(const Ids& ids);

// Nanokilograms and millionths of a euro, which add up without rounding; 0 where the amount is all
// of the objective. A price that is not known is 0; a made-to-measure reservoir counts as the least
// one.
struct TieShare {
  long long mass = 0, cost = 0;
  TieShare& operator+=(const TieShare& other);
  auto operator<=>(const TieShare&) const = default;
};
TieShare ShareOfTies(const Problem& problem, const ItemAmounts& amounts);
// What the packs of a design cost beyond what its choices count.
TieShare SurplusOfTies(const Problem& problem, double cost_eur, double counted_eur);

struct TieKey {
  TieShare share;
  Ids ids;
  auto operator<=>(const TieKey&) const = default;
};
TieKey TieKeyOf(const Problem& problem, const Design& design);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_IDS_H_
