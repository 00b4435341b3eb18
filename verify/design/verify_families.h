// What the catalogue offers a problem: the parts of each family, in which numbers, and how many
// combinations that makes. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_FAMILIES_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_FAMILIES_H_

#include <vector>

#include "verify/design/verify_values.h"

namespace plenum::verify {

// Parts of a family, as many as there are of them in parallel at most.
int FamilySize(const Problem& problem, Family family);
int QuantityMax(const Problem& problem, Family family);
std::vector<Family> SourceFamilies(Configuration configuration);
bool MadeReservoirAllowed(const Problem& problem);
const model::PartBasics* BasicsOf(const Problem& problem, Family family, int part);

// What a slot can be filled with: every part in every number, priced ones alone where cost matters.
std::vector<ProofItem> EntriesOf(const Problem& problem, const ProofSlot& slot);

// By the contract: of one configuration, from the catalogue alone.
BigCount Combinations(const Problem& problem, Configuration configuration);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_FAMILIES_H_
