// Good designs of several groups on one source, before anything is proved.
//
// Lines that make do with the same pressure at the node that they share suit each other, whatever
// feeds it. So for some pressures each group gets its lightest line (equal groups equal ones), and
// the source is chosen best first by the bounds. Where pumps are chosen, too, that takes long, and
// there is a design sooner on the strongest of them. The best design is then improved part by part:
// the line of one group, or a part of the source, is chosen anew while all else stays. Each design
// is sized as any other leaf of the search.
#ifndef PLENUM_OPTIMIZER_SEARCH_FIRST_DESIGNS_H_
#define PLENUM_OPTIMIZER_SEARCH_FIRST_DESIGNS_H_

#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "optimizer/search/in_turns.h"
#include "optimizer/search/ranking.h"
#include "optimizer/search/watch.h"

namespace plenum::optimizer {

// Where designs have been sought.
struct Sought {
  std::set<const Bounds*> first;  // in the plans of these, first designs
  bool deep = false;              // in all, by depth first
};
// In which plans first designs are to be sought now, once each: of several groups, and of one where
// a look takes a simulation. Where a design takes one, or groups do not meet, only once the search
// has proved slow.
std::vector<Bounds*> Due(const Problem& problem,
                         const std::vector<std::unique_ptr<Bounds>>& planted, bool slow,
                         Sought& sought);

// In each of these plans: designs of the strongest lines and pumps, the boxes that designs in turns
// suggest (in_turns.h), by the search `list`, then the lightest lines and the best design part by
// part; for shares of the time limit. Adds what it finds to the ranking, until `stop` says so.
void SeekFirst(const Problem& problem, const std::vector<Bounds*>& due,
               const SearchOptions& options, const ListDesigns& list, Watch& watch,
               const std::function<bool()>& stop, Ranking& ranking);

// Looks into boxes, not assessed, that are likely to hold designs, for one in each.
void SearchLikely(const Problem& problem, Bounds& bounds, std::vector<Box> likely,
                  const std::function<bool()>& stop, Ranking& ranking);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_FIRST_DESIGNS_H_
