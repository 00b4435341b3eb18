// Files of documents to and from their tables. Internal to the store; the caller owns the
// transaction.
#ifndef PLENUM_CATALOG_STORE_TABLES_FILES_H_
#define PLENUM_CATALOG_STORE_TABLES_FILES_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/store/documents/kept_file.h"
#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

std::optional<KeptFile> FindFile(SqlDatabase& db, const std::string& sha256);
// The whole content of a file that FindFile finds.
std::string ReadFile(SqlDatabase& db, const KeptFile& file);
// Keeps the content under its hash, once: a file that is there stays with its media type.
void InsertFile(SqlDatabase& db, const KeptFile& file, std::string_view content);

// Files whose content does not have its hash or its size. One file at a time is in memory.
std::vector<std::string> CheckFiles(SqlDatabase& db);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_TABLES_FILES_H_
