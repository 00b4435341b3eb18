// Seed rows within a write. Internal to the store.
#ifndef PLENUM_CATALOG_STORE_SEED_SEED_ROWS_H_
#define PLENUM_CATALOG_STORE_SEED_SEED_ROWS_H_

#include <string>
#include <string_view>
#include <vector>

#include "catalog/store/seed/seed_plan.h"
#include "catalog/store/tables/history.h"

namespace plenum::catalog {

// What revisions that replace the seed are called.
inline constexpr std::string_view kSeedWrite = "seed";

// The parts as seed rows, in order of id. Throws StoreError for a part that Validate refuses and
// for two of one id.
std::vector<Part> SeedRows(std::vector<Part> parts);

// Changes what `seed` (SeedRows) changes; UpdateSeed (seed_update.h) says what stays.
SeedPlan ReplaceSeedRows(SqlDatabase& db, const std::vector<Part>& seed, RevisionWriter& writer);

// The same as one revision, or, in a dry run, what that would be.
SeedUpdate UpdateSeedRows(SqlDatabase& db, const std::vector<Part>& seed, const std::string& who,
                          bool dry_run);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SEED_SEED_ROWS_H_
