// Parts to and from their tables. Internal to the store.
#ifndef PLENUM_CATALOG_STORE_TABLES_ROWS_H_
#define PLENUM_CATALOG_STORE_TABLES_ROWS_H_

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catalog/fields/part.h"
#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

// Inserts and deletes parts through statements prepared once; the caller owns the transaction.
class PartWriter {
 public:
  explicit PartWriter(SqlDatabase& db);
  void Insert(const Part& part);
  void Delete(const std::string& id);

 private:
  std::unique_ptr<SqlStatement> part_, number_, text_, curve_, point_, alias_, offer_, document_,
      delete_;
};

// Reads parts through statements prepared once: all, or those whose `column` (id or family) equals
// a value. Call inside a transaction, so that the tables are of one moment.
class PartReader {
 public:
  PartReader(SqlDatabase& db, const std::optional<std::string>& column);
  // In order of id.
  std::vector<Part> Read(const std::string& value = "");
  std::optional<Part> One(const std::string& value);

 private:
  void ReadBasics(std::vector<Part>& parts);
  void ReadLists(std::vector<Part>& parts);
  static std::string Select(const std::string& what, const std::string& order,
                            const std::optional<std::string>& column);

  bool filtered_;
  std::unique_ptr<SqlStatement> part_, number_, text_, curve_, point_, alias_, offer_, document_;
};

// All parts in order of id.
std::vector<Part> ReadParts(SqlDatabase& db);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_TABLES_ROWS_H_
