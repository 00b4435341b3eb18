// What another seed does to a catalogue, as values.
#ifndef PLENUM_CATALOG_STORE_SEED_SEED_PLAN_H_
#define PLENUM_CATALOG_STORE_SEED_SEED_PLAN_H_

#include <string>
#include <vector>

#include "catalog/store/revision.h"

namespace plenum::catalog {

// What another seed does to the rows of a catalogue: ids, in order.
struct SeedPlan {
  std::vector<std::string> added, replaced, removed;
  std::vector<std::string>
      kept;  // of the seed, which a user changed, added or removed: they stay so
  bool operator==(const SeedPlan&) const = default;
};

struct SeedUpdate {
  SeedPlan plan;
  Revision revision;  // the one that holds it; the head where nothing was written
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SEED_SEED_PLAN_H_
