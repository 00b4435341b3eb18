// How the seed rows of a catalogue follow a newer seed.
#ifndef PLENUM_CATALOG_STORE_SEED_SEED_UPDATE_H_
#define PLENUM_CATALOG_STORE_SEED_SEED_UPDATE_H_

#include <filesystem>
#include <string>

#include "catalog/store/seed/seed_plan.h"

namespace plenum::catalog {

// Makes the seed rows of `catalog` those of the catalogue `seed`, as one revision, or, in a dry
// run, says what that would do. Rows that users added or changed stay, and so do seed rows that
// users removed stay removed. Both files may be in use. Throws StoreError.
SeedUpdate UpdateSeed(const std::filesystem::path& catalog, const std::filesystem::path& seed,
                      const std::string& who, bool dry_run);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SEED_SEED_UPDATE_H_
