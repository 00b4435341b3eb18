// Parts to and from the tables of catalog.db. Internal to the store.
#ifndef PLENUM_CATALOG_ROWS_H_
#define PLENUM_CATALOG_ROWS_H_

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <vector>

#include "catalog/part.h"

namespace plenum::catalog {

// Inserts and deletes parts through statements prepared once; the caller owns the transaction.
class PartWriter {
 public:
  explicit PartWriter(SQLite::Database& db);
  void Insert(const Part& part);
  void Delete(const std::string& id);

 private:
  SQLite::Statement part_, number_, text_, curve_, point_, delete_;
};

// Which parts to read: all, or those whose `column` (id or family) equals `value`.
struct Filter {
  std::string column;
  std::string value;
};

// Parts in order of id. Call inside a transaction, so that the tables are of one moment.
std::vector<Part> ReadParts(SQLite::Database& db, const std::optional<Filter>& filter);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_ROWS_H_
