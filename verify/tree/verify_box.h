// Closed boxes, looked at again. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_TREE_VERIFY_BOX_H_
#define PLENUM_VERIFY_TREE_VERIFY_BOX_H_

#include "verify/corner/verify_corner.h"
#include "verify/design/verify_design.h"
#include "verify/design/verify_size.h"
#include "verify/design/verify_values.h"
#include "verify/tree/verify_claims.h"

namespace plenum::verify {

// Of each slot the choice with the first id.
Ids EarliestIds(const Problem& problem, const ProofPlan& plan, const Ranges& ranges);

// The parts at one place of each slot.
Assembly AssemblyAt(const Problem& problem, const ProofPlan& plan, const Ranges& single);

// Looks at parts of boxes that are tried, sized combinations counted as many: some minutes.
inline constexpr long long kLooksMax = 20'000'000;
inline constexpr long long kLooksPerSize = 200;
// A combination counts as feasible only if it meets every requirement with this to spare.
inline constexpr double kToSpare = 1e-6;

// The slot whose choices differ most in their share of the objective; reservoirs, which bounds look
// at one by one, bottles and batteries, which do not change the strokes, last. −1: a single
// combination.
int SlotToDivide(const ProofPlan& plan, Corners& corners, const Ranges& ranges);

class BoxCheck {
 public:
  BoxCheck(const Problem& problem, const ProofPlan& plan, const Claims& claims, const Stop& stop);

  // What the answer says of all in a box.
  const Claim& ClaimOn(const Ranges& ranges) const { return series_.ClaimOn(claims_, ranges); }

  bool CannotMate(const Ranges& ranges) { return corners_.CannotMate(ranges); }

  // Divides the box until each part of it is refuted, bounded, or a single combination, which is
  // sized. How many combinations that leaves open; one that contradicts the claim is a finding.
  BigCount Recheck(const Ranges& ranges, Findings& findings);

 private:
  // No combination in the box that ties, with the least mass and cost of each slot and the first
  // ids, comes before `last` or is it.
  bool ComesAfter(const Ranges& ranges, const TieKey& last);
  bool Holds(const Claim& claim, double objective, const Ranges& single);
  bool IsBeyond(const Claim& claim, const Ranges& ranges);
  bool IsCoreBeyond(const Claim& claim, const Ranges& ranges, int battery_slot);
  bool IsSettled(const Claim& claim, const Ranges& single, Findings& findings);
  int SlotOfKinds(const Ranges& ranges);

  const Problem& problem_;
  const ProofPlan& plan_;
  const Claims& claims_;
  SeriesOfPlan series_;
  const Stop stop_;
  const bool share_packs_;
  KnownStrokes strokes_;
  Corners corners_;
  Sizer sizer_;
  Ranges core_;  // the last one that was sized, and its objective at least
  double core_least_ = 0.0;
  long long looks_ = 0;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_TREE_VERIFY_BOX_H_
