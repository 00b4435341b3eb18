// Copies of catalog.db, taken and put back while others use it.
#ifndef PLENUM_CATALOG_STORE_BACKUP_H_
#define PLENUM_CATALOG_STORE_BACKUP_H_

#include <filesystem>

#include "catalog/store/store.h"

namespace plenum::catalog {

// Copies the catalogue with its whole history to `copy`, of one moment, also while it is written.
// The copy is checked, and takes its name only when it is complete and on disk; a file of that name
// is replaced. Throws StoreError; then there is no copy, and what had its name is as it was.
void Backup(const std::filesystem::path& catalogue, const std::filesystem::path& copy);

// Puts the parts and the history of `copy` in the place of those of `catalogue`, in one
// transaction: a reader, also a running service, sees the one or the other. The copy is first
// brought to the newest schema beside the catalogue and checked; one that is damaged, foreign or
// newer is refused (StoreError) and the catalogue is as it was. `copy` is only read. A missing
// catalogue is created.
void Restore(const std::filesystem::path& catalogue, const std::filesystem::path& copy);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_BACKUP_H_
