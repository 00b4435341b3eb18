// What an answer says of combinations that are not listed. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_TREE_VERIFY_CLAIMS_H_
#define PLENUM_VERIFY_TREE_VERIFY_CLAIMS_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "verify/design/verify_ids.h"
#include "verify/design/verify_kinds.h"
#include "verify/tree/verify_tree.h"

namespace plenum::verify {

// The objective of every combination of a set that is not listed is `least` or more, and past
// `tie_end` unless it comes after `last` among ties.
struct Claim {
  double least = 0.0, tie_end = -kUnlimited;
  TieKey last;
  double enough() const { return std::max(least, tie_end); }  // past it nothing is to be shown
};

// The claims of an answer: on all combinations; of a list of kinds on those of a listed kind, that
// they are no better than its design, and on those of a source of which as many kinds are listed as
// may be, that they are no better than the last of these.
class Claims {
 public:
  Claims(const Problem& problem, const Answer& answer);

  const Claim& all() const { return all_; }
  // On those of a kind, or of a source where the kind is not known.
  const Claim* OfKind(const KindName& kind) const;
  const Claim* OfSource(const SourceName& source) const;

 private:
  Claim all_;
  std::map<KindName, Claim> kinds_;
  std::map<SourceName, Claim> sources_;
};

// The series of the choices of a plan, for a list of kinds.
class SeriesOfPlan {
 public:
  SeriesOfPlan(const Problem& problem, const ProofPlan& plan);

  // Whether the choices in the range are of several.
  bool AreSeveral(int slot, const std::pair<int, int>& range) const;
  // Where the series changes that is nearest to the middle of a range of several.
  int Border(int slot, const std::pair<int, int>& range) const;
  // The claim on all in the box.
  const Claim& ClaimOn(const Claims& claims, const Ranges& ranges) const;
  const ProofPlan& plan() const { return plan_; }

 private:
  std::optional<KindName> Name(const Ranges& ranges, bool source_alone) const;

  const ProofPlan& plan_;
  bool kinds_;
  std::vector<std::vector<std::string>> series_;  // per slot and choice; none of a list of designs
  std::vector<std::vector<int>> same_until_;      // the same: where the run of its series ends
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_TREE_VERIFY_CLAIMS_H_
