// What the pumps of a vacuum beside a pressure supply bear at least in a box. Internal to
// verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_LEAST_RAIL_H_
#define PLENUM_VERIFY_CORNER_VERIFY_LEAST_RAIL_H_

#include <map>
#include <optional>
#include <vector>

#include "verify/corner/verify_line.h"
#include "verify/design/cycle/verify_rail.h"

namespace plenum::verify {

class LeastRails {
 public:
  LeastRails(const Problem& problem, const ProofPlan& plan);

  // Whether a battery of the box drives a pump of it.
  bool Mates(const Ranges& ranges) const;

  // Energy of the mission, J, with the best line of each group; +∞ where no vacuum does. 0 as long
  // as there are several kinds or numbers of pumps: of several reservoirs the largest counts,
  // without its first fill.
  double Energy(const Ranges& ranges, const std::vector<const BestLine*>& lines);

 private:
  double EnergyOf(const Ranges& ranges, const std::vector<const BestLine*>& lines) const;

  const Problem& problem_;
  const ProofPlan& plan_;
  int pumps_, reservoirs_, batteries_;  // their slots; −1: none
  std::map<std::vector<const void*>, double> known_;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_LEAST_RAIL_H_
