#include "optimizer/search/tree_search.h"

#include "optimizer/evaluate/strokes/effect_strokes.h"
#include "optimizer/search/box_search.h"
#include "optimizer/search/revised_search.h"

namespace plenum::optimizer {

Answer SearchTrees(const Problem& problem, const SearchOptions& options) {
  return HasEffects(problem) ? SearchRevised(problem, options) : SearchBoxes(problem, options);
}

}  // namespace plenum::optimizer
