// Parts to and from the tables of catalog.db. Internal to the store.
#ifndef PLENUM_CATALOG_STORE_ROWS_H_
#define PLENUM_CATALOG_STORE_ROWS_H_

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// Inserts and deletes parts through statements prepared once; the caller owns the transaction.
class PartWriter {
 public:
  explicit PartWriter(SQLite::Database& db);
  void Insert(const Part& part);
  void Delete(const std::string& id);

 private:
  SQLite::Statement part_, number_, text_, curve_, point_, alias_, offer_, document_, delete_;
};

// Reads parts through statements prepared once: all, or those whose `column` (id or family) equals
// a value. Call inside a transaction, so that the tables are of one moment.
class PartReader {
 public:
  PartReader(SQLite::Database& db, const std::optional<std::string>& column);
  // In order of id.
  std::vector<Part> Read(const std::string& value = "");
  std::optional<Part> One(const std::string& value);

 private:
  void ReadBasics(std::vector<Part>& parts);
  void ReadLists(std::vector<Part>& parts);
  static std::string Select(const std::string& what, const std::string& order,
                            const std::optional<std::string>& column);

  bool filtered_;
  SQLite::Statement part_, number_, text_, curve_, point_, alias_, offer_, document_;
};

// All parts in order of id.
std::vector<Part> ReadParts(SQLite::Database& db);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_ROWS_H_
