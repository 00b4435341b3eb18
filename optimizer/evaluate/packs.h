// Whole packs: a part that a design needs q pieces of, over all its rows, costs what the packs cost
// that hold q (PartBasics::pack).
//
// Where all pieces of a part are those of one choice, as of a single group and of the source, the
// choice has the cost of whole packs. Where another choice may have the same part – lines and
// regulators of several groups, and what joins them – each counts its pieces at their share of a
// pack. That bounds the cost from below, as no design buys less than it needs. What whole packs
// cost beyond, the surplus, is known and added once all choices of a design are.
//
// So such a choice adds to a design at most what packs for it alone cost beyond its count, and it
// adds less than its count at most by the pieces that fill up a pack which others have begun: of n
// pieces in packs of P at least ⌊n/P⌋ packs are its own. Both ends count where one choice is to
// take the place of another in any design (dominance.h).
#ifndef PLENUM_OPTIMIZER_EVALUATE_PACKS_H_
#define PLENUM_OPTIMIZER_EVALUATE_PACKS_H_

#include <vector>

#include "optimizer/evaluate/line.h"

namespace plenum::optimizer {

struct PackRange {
  double more_eur = 0.0, less_eur = 0.0;  // than each piece at its share of a pack; ≥ 0
  PackRange& operator+=(const PackRange& other);
};
PackRange RangeOf(double quantity, const model::PartBasics& basics);

// Pieces that a design has of a choice, of a tube metres; `group` −1: of the source.
double PiecesOf(const Problem& problem, Family family, int group, int part, int quantity);

// Whether other choices than that of a group, −1 of the source, may have the same part.
inline bool SharesPacks(const Problem& problem, int group) {
  return group >= 0 && problem.groups.size() > 1;
}
// Whether any part that choices may share is sold in packs: else no design has a surplus.
bool AnySharedPacks(const Problem& problem);

// What a choice counts of so many pieces.
inline Amounts Counted(double quantity, const model::PartBasics& basics, bool shared) {
  return shared ? quantity * basics : Bought(quantity, basics);
}

// Of the rows of a design, whose joints are found anew; ≥ 0.
double PackSurplus(const Problem& problem, const std::vector<Choice>& rows);

// What each row costs: of the packs of its part, over all rows, the share that its pieces have.
void SetCosts(const Problem& problem, std::vector<Choice>& rows);

// What is bought in packs, in the order of the rows.
std::vector<PackRow> PacksOf(const Problem& problem, const std::vector<Choice>& rows);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_PACKS_H_
