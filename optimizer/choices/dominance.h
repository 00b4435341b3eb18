// Choices that cannot be among the k best, because k others of the family are at least as good in
// every respect. For a list of kinds (kind.h) one other of the same series is enough, or k others
// of different series: they make a better design of the same kind, or k better kinds.
//
// A dominates B when it mates with the same parts, is no worse in any number that a requirement or
// the objective depends on, and is listed first: its share of the objective is smaller by more than
// a tie, or no larger with the earlier mass, cost and id (tie_key.h). Any design with B then has k
// better designs, one with each of B's dominators in its place: each meets what that design meets,
// at the same settings, with an objective that is no larger. The relation is a strict order, so
// that dominators which are left out themselves have k dominators that stay. Of a design whose
// choices are dominated by a, b, c… others each, any of them can take the place of any of its
// choices: (1 + a)(1 + b)… − 1 designs are better.
#ifndef PLENUM_OPTIMIZER_CHOICES_DOMINANCE_H_
#define PLENUM_OPTIMIZER_CHOICES_DOMINANCE_H_

#include <boost/container/small_vector.hpp>
#include <functional>
#include <string_view>
#include <vector>

#include "optimizer/choices/tie_key.h"
#include "optimizer/problem/proof.h"

namespace plenum::optimizer {

// Kept within the contender, since there are many of them. As many as any family has.
using Losses = boost::container::small_vector<double, 18>;

// A choice as dominance sees it.
struct Contender {
  ProofItem item;
  std::string_view id;     // of the part, which outlives this
  double objective = 0.0;  // its share
  double beyond = 0.0;     // that it takes besides, at most; no less than others of which more is
  int mates = 0;           // from 0; equal for parts that mate with the same parts and behave alike
  int series = -1;         // from 0; −1: its own
  TieShare tie = {};
  Losses losses;  // smaller is better, as many for each choice of a family
};

// What a choice adds to a design, where other choices may share its packs (packs.h).
struct PackEnd {
  double objective = 0.0;
  double cost_eur = 0.0;  // where a limit counts it
  TieShare tie = {};
};
struct PackEnds {
  PackEnd most, least;
};

struct Skyband {
  std::vector<int> kept;     // indices into the contenders, by id and quantity
  std::vector<int> outdone;  // of each contender that is kept: by how many others it is dominated
  std::vector<ProofDominated> left_out;
};

// `tie`: objectives closer than this may tie. `name_left_out`: fill Skyband::left_out.
// `ends`: empty, or of each contender: then A at its most must be no worse than B at its least.
// Told to stop, it gives nothing that can be used.
Skyband KeepBest(const std::vector<Contender>& contenders, int k, double tie, bool name_left_out,
                 const std::function<bool()>& stop = {}, const std::vector<PackEnds>& ends = {});

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_DOMINANCE_H_
