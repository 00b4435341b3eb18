// The exact Pareto front of a problem in two or three amounts: designs of which no other is as good
// in every amount and better in one.
#ifndef PLENUM_OPTIMIZER_PARETO_H_
#define PLENUM_OPTIMIZER_PARETO_H_

#include <vector>

#include "optimizer/problem.h"

namespace plenum::optimizer {

enum class Amount { kMass, kVolume, kCost, kEnergy };
const char* Name(Amount amount);  // "mass_kg", "volume_l", "cost_eur", "energy_wh"

Objective ObjectiveOn(Amount amount);  // that amount alone

// In the unit of its name; NaN for the cost of parts without a price.
double Of(Amount amount, const Totals& totals);

// The problem's limit on an amount, in the same unit; energy has none.
double& LimitOn(Amount amount, Problem& problem);

// A region that may hide points of the front: designs within all `limits` (per amount of the front,
// +∞ where none) whose amount `least_of` is at least `least`.
struct Unexplored {
  std::vector<double> limits;
  Amount least_of;
  double least = 0.0;
};

struct Front {
  // Status, designs of the front by rising Problem::objective, conflict if there are none. The
  // proof's counts and bound are those of the first search, which has no limits but the problem's.
  Answer answer;
  std::vector<Amount> amounts;
  // A design whose amounts, but for a minimised one, all lie above those of a point of the front by
  // less than this share may be missing.
  double resolution = 0.0;
  int searches = 0, proved = 0;
  std::vector<Unexplored> unexplored;  // empty: the front is whole
};

// By the ε-constraint method: the least of one amount within limits on the others, by an exact
// search; then again in each of the regions where one of the others is lower than what was found,
// until every region is proved empty. A region's answer also serves any smaller region that holds
// it. Points that a later search finds to be matched or beaten in every amount are dropped, so that
// ties leave no weakly dominated point. (Kirlik and Sayın 2014, with overlapping regions in place
// of their partition.) With two amounts the regions are nested, and one search from each end goes
// through all of them (front_walk.h); each of its points counts as a search, and so does the last
// proof that there are no more.
//
// `optimal` only when every search was proved; a search that runs out of time leaves its region in
// `unexplored`. Where the volume of a made-to-measure reservoir trades against energy the front is
// a curve: it is sampled at a resolution of 1 %.
Front ParetoFront(const Problem& problem, const std::vector<Amount>& amounts,
                  const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PARETO_H_
