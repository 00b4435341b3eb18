// What the catalogue offers a problem, in which numbers, and how many combinations that makes.
// Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_FAMILIES_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_FAMILIES_H_

#include <vector>

#include "optimizer/problem/family_specs.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

using optimizer::BasicsOf;
using optimizer::ChoicesIn;
using optimizer::FamilySpec;
using optimizer::FieldValue;
using optimizer::FindPart;
using optimizer::LineFamilies;
using optimizer::MadeToMeasureAllowed;
using optimizer::MayLack;
using optimizer::PartField;
using optimizer::Pieces;
using optimizer::QuantityMax;
using optimizer::SourceFamilies;
using optimizer::SpecOf;
using optimizer::Use;

// Whether a part without a price is no choice.
bool AsksForPrices(const Problem& problem);

// What a slot can be filled with: every part in every number, priced ones alone where cost matters,
// and no part where the source may lack one.
std::vector<ProofItem> EntriesOf(const Problem& problem, const Layout& layout,
                                 const ProofSlot& slot);

// A plan of a layout with a slot for each family that it needs, without choices: of each
// group, then of the source.
ProofPlan EmptyPlan(const Problem& problem, const Layout& layout);

// By the contract: of one layout, from the catalogue alone.
BigCount Combinations(const Problem& problem, const Layout& layout);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_FAMILIES_H_
