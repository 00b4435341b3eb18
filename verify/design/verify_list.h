// A list of designs, and what was found of it. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_LIST_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_LIST_H_

#include <utility>
#include <vector>

#include "verify/design/verify_finding.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Designs by objective, ties by mass, cost and ids, none twice, no more than were asked for.
void CheckOrder(const Problem& problem, const std::vector<Design>& designs, Findings& findings);

// Each design's parts, amounts and performance (verify_design.h).
void CheckDesigns(const Problem& problem, const std::vector<Design>& designs, const Stop& stop,
                  Findings& findings, std::vector<NotRechecked>& open);

// Of each check its name and what holds where it finds nothing.
using CheckNames = std::vector<std::pair<const char*, const char*>>;
std::vector<Check> Gather(const CheckNames& names, const Findings& findings);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_LIST_H_
