// The kinds of a list of kinds, by names: shares nothing with the search but the rule that kind.h
// states. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_KINDS_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_KINDS_H_

#include <set>
#include <string>
#include <utility>

#include "verify/design/verify_families.h"
#include "verify/design/verify_finding.h"

namespace plenum::verify {

bool ListsKinds(const Problem& problem);

// The series of a part, which no other family has; empty where the family makes no kinds.
std::string SeriesName(const Problem& problem, Family family, int part);

using SourceName = std::pair<Configuration, std::set<std::string>>;
struct KindName {
  SourceName source;
  std::set<std::string> regulators, valves;
  auto operator<=>(const KindName&) const = default;
};
// Puts a part's series where it belongs.
void AddSeries(Family family, const std::string& series, KindName& kind);
KindName KindOf(const Problem& problem, const Design& design);

// Whether as many others as these, of different series, leave no place for a choice of the slot.
bool AreEnough(const Problem& problem, const ProofSlot& slot, std::size_t others);

// No kind twice, and of none of the sources more than there may be.
void CheckKinds(const Problem& problem, const std::vector<Design>& designs, Findings& findings);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_KINDS_H_
