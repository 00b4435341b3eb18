// A whole catalogue into another store: from a file to a server, back, or between two of a kind.
#ifndef PLENUM_CATALOG_STORE_COPY_H_
#define PLENUM_CATALOG_STORE_COPY_H_

#include <filesystem>

#include "catalog/store/revision.h"

namespace plenum::catalog {

// Parts, all revisions with their changes, undo, keys of requests, saved models and files of
// documents, as they are at one moment; others may read and write `from` meanwhile. `to` must hold
// no catalogue yet. Before it is committed the copy is read back and checked: the number of rows of
// each table, the hash of each revision recomputed from the parts and changes, and those of each
// model and file. Gives the newest revision. Throws StoreError; then `to` is as it was.
Revision CopyCatalogue(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_COPY_H_
