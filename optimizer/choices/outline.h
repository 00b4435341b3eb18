// What is known of a layout before its families are planted: from one look at every part,
// without dominance and trees.
#ifndef PLENUM_OPTIMIZER_CHOICES_OUTLINE_H_
#define PLENUM_OPTIMIZER_CHOICES_OUTLINE_H_

#include "optimizer/problem/own_regulators.h"

namespace plenum::optimizer {

struct Outline {
  Layout layout;
  BigCount combinations, priced;  // priced: those with all prices that the objective needs
  double bound = 0.0;             // of the objective of each; +∞ where a family has no choice
};

// The bound is the sum of each family's least share, of a bottle that holds the air of the chambers
// alone and of a battery that feeds the coils alone; what fits together is not asked.
Outline MakeOutline(const Problem& problem, const Layout& layout);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_OUTLINE_H_
