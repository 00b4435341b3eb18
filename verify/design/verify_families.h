// What the catalogue offers a problem, in which numbers, and how many combinations that makes.
// Internal to verify*.cc.
#ifndef PLENUM_VERIFY_DESIGN_VERIFY_FAMILIES_H_
#define PLENUM_VERIFY_DESIGN_VERIFY_FAMILIES_H_

#include <optional>
#include <utility>
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

// verify_packs.cc: what is bought in whole packs, by counting them once more.
double PacksNeeded(double pieces, const model::PartBasics& basics);
double CostInPacks(double pieces, const model::PartBasics& basics);
// A choice of a group, one of several, may share packs with those of others; it counts its pieces
// at their share of a pack.
bool MaySharePacks(const Problem& problem, int group);
// What so many pieces may cost a design more and less than that.
std::pair<double, double> OpenPacksEur(double pieces, const model::PartBasics& basics);
bool HasPacks(const Problem& problem);  // whether any part is sold in them
// The cost of rows, one after another: of packs once all of a part are there.
class PackedCosts {
 public:
  void Add(const model::PartBasics* part, double pieces) {  // null: made to measure
    if (!part || !part->cost_eur) {
      known_ = false;
    } else if (part->pack > 0.0) {
      AddPacked(*part, pieces);
    } else {
      sum_eur_ += pieces * *part->cost_eur;
    }
  }
  bool known() const { return known_; }
  double Sum() const;

 private:
  void AddPacked(const model::PartBasics& part, double pieces);

  bool known_ = true;
  double sum_eur_ = 0.0;
  std::vector<std::pair<const model::PartBasics*, double>> packed_;
};

// The packs of a design, by the quantities of its rows.
std::vector<optimizer::PackRow> PacksBought(const Problem& problem, const Design& design);
// What each row of a design costs; none: its part has no price.
std::vector<std::optional<double>> RowCosts(const Problem& problem, const Design& design);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_DESIGN_VERIFY_FAMILIES_H_
