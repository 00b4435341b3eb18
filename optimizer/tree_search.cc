#include "optimizer/tree_search.h"

#include "optimizer/box_search.h"
#include "optimizer/effect_strokes.h"
#include "optimizer/revised_search.h"

namespace plenum::optimizer {

Answer SearchTrees(const Problem& problem, const SearchOptions& options) {
  return HasEffects(problem) ? SearchRevised(problem, options) : SearchBoxes(problem, options);
}

}  // namespace plenum::optimizer
