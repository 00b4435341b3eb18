#include "catalog/store/copy.h"

#include <string>
#include <utility>
#include <vector>

#include "catalog/store/connection.h"
#include "catalog/store/sql/address.h"
#include "catalog/store/tables/files.h"
#include "catalog/store/tables/history.h"
#include "catalog/store/tables/models.h"

namespace plenum::catalog {
namespace {

namespace fs = std::filesystem;

// What is sent in one statement; SQLite takes 32,766 values, PostgreSQL 65,535.
constexpr std::size_t kValuesMost = 1'000, kBytesMost = 1 << 20;

// In an order in which no row refers to a later one. Both stores have their columns in one order.
struct Table {
  const char* name;
  const char* order;
};
constexpr Table kTables[] = {{"revision", "number"},
                             {"change", "revision, part_id"},
                             {"request_key", "key"},
                             {"model", "name, version"},
                             {"part", "id"},
                             {"number", "part_id, field"},
                             {"text", "part_id, field"},
                             {"curve", "part_id"},
                             {"curve_point", "part_id, pressure_kpa_gauge"},
                             {"alias", "part_id, place"},
                             {"offer", "part_id, place"},
                             {"document", "part_id, place"},
                             {"file", "sha256"},
                             {"file_piece", "sha256, place"}};

class RowWriter {
 public:
  RowWriter(SqlDatabase& db, std::string table) : db_(db), table_(std::move(table)) {}

  void Add(std::vector<SqlValue> row) {
    columns_ = row.size();
    for (SqlValue& value : row) {
      if (const auto* text = std::get_if<std::string>(&value)) bytes_ += text->size();
      if (const auto* piece = std::get_if<SqlBytes>(&value)) bytes_ += piece->bytes.size();
      values_.push_back(std::move(value));
    }
    if (values_.size() + columns_ > kValuesMost || bytes_ > kBytesMost) Flush();
  }
  void Flush() {
    if (values_.empty()) return;
    std::string row = "(?";
    for (std::size_t i = 1; i < columns_; ++i) row += ", ?";
    row += ")";
    std::string sql = "INSERT INTO " + table_ + " VALUES " + row;
    for (std::size_t i = 1; i < values_.size() / columns_; ++i) sql += ", " + row;
    const auto insert = db_.Prepare(sql);
    for (std::size_t i = 0; i < values_.size(); ++i)
      insert->Bind(static_cast<int>(i + 1), values_[i]);
    while (insert->Step()) {
    }
    values_.clear();
    bytes_ = 0;
  }

 private:
  SqlDatabase& db_;
  const std::string table_;
  std::size_t columns_ = 0, bytes_ = 0;
  std::vector<SqlValue> values_;
};

std::vector<SqlValue> RowOf(const SqlStatement& query) {
  std::vector<SqlValue> row;
  row.reserve(static_cast<std::size_t>(query.columns()));
  for (int i = 0; i < query.columns(); ++i) row.push_back(query.Get(i));
  return row;
}

std::int64_t Count(SqlDatabase& db, const std::string& table) {
  const auto query = Query(db, "SELECT count(*) FROM " + table);
  return query->Step() ? query->Integer(0) : -1;
}

void CopyTable(SqlDatabase& from, SqlDatabase& to, const Table& table) {
  const std::string name = table.name;
  const auto rows = from.Prepare("SELECT * FROM " + name + " ORDER BY " + table.order);
  RowWriter writer(to, name);
  // A new catalogue has a first revision, which becomes that of the other.
  if (name == "revision" && rows->Step()) {
    const auto first = to.Prepare(
        "UPDATE revision SET number = ?, hash = ?, at = ?, who = ?, what = ? WHERE hash IS NULL");
    const auto row = RowOf(*rows);
    for (std::size_t i = 0; i < row.size(); ++i) first->Bind(static_cast<int>(i + 1), row[i]);
    while (first->Step()) {
    }
  }
  while (rows->Step()) writer.Add(RowOf(*rows));
  writer.Flush();
}

void Verify(SqlDatabase& from, SqlDatabase& to) {
  const auto refuse = [](const std::string& why) {
    throw StoreError("would not be a true copy: " + why);
  };
  for (const Table& table : kTables)
    if (Count(from, table.name) != Count(to, table.name))
      refuse(std::string("the table ") + table.name + " has another number of rows");
  if (Head(from) != Head(to)) refuse("the newest revision is another one");
  for (const std::string& fault : CheckHistory(to)) refuse(fault);
  for (const std::string& fault : CheckModels(to)) refuse(fault);
  for (const std::string& fault : CheckFiles(to)) refuse(fault);
}

Revision CopyInto(SqlDatabase& source, const fs::path& to) {
  const SqlTransaction one_moment(source, Purpose::kRead);
  Revision head = Head(source);
  try {
    MakeCatalogue(to.string(), [&](SqlDatabase& made) {
      for (const Table& table : kTables) CopyTable(source, made, table);
      Verify(source, made);
    });
  } catch (const SqlError& error) {
    throw ToStoreError(Shown(to) + ": the copy could not be made", error);
  } catch (const StoreError& error) {
    throw StoreError(Shown(to) + " " + error.what(), error.fault());
  }
  return head;
}

}  // namespace

Revision CopyCatalogue(const fs::path& from, const fs::path& to) {
  std::error_code ignored;
  if (!IsServer(from) && !IsServer(to) && fs::equivalent(from, to, ignored))
    throw StoreError(to.string() + " is the catalogue itself");
  const bool is_new_file = !IsServer(to) && !fs::exists(to, ignored);
  std::unique_ptr<SqlDatabase> source;
  try {
    source = Connect(from.string(), Access::kRead);
  } catch (const SqlError& error) {
    throw ToStoreError(Shown(from) + ": cannot be opened for reading", error);
  } catch (const StoreError& error) {
    throw StoreError(Shown(from) + " " + error.what(), error.fault());
  }
  try {
    return CopyInto(*source, to);
  } catch (const StoreError&) {
    if (is_new_file) fs::remove(to, ignored);
    throw;
  } catch (const SqlError& error) {
    if (is_new_file) fs::remove(to, ignored);
    throw ToStoreError(Shown(from), error);
  }
}

}  // namespace plenum::catalog
