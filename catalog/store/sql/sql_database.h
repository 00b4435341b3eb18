// A connection to a database: prepared statements and transactions, the same for SQLite and
// PostgreSQL. Internal to the store.
//
// Statements are written in the SQL that both understand, with ? for each value; what they say in
// different words stands in SqlWords. All functions throw SqlError.
#ifndef PLENUM_CATALOG_STORE_SQL_SQL_DATABASE_H_
#define PLENUM_CATALOG_STORE_SQL_SQL_DATABASE_H_

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "catalog/store/sql/sql_error.h"

namespace plenum::catalog {

struct SqlBytes {  // any bytes, where a text is UTF-8
  std::string bytes;
};
using SqlValue =
    std::variant<std::monostate, std::int64_t, double, std::string, SqlBytes>;  // first: NULL

// A statement with its values and, after Step, one row of its result. Places of values count from
// 1, columns from 0. A value stays bound until another is.
class SqlStatement {
 public:
  virtual ~SqlStatement() = default;
  virtual void Bind(int place, const SqlValue& value) = 0;
  // To the next row; false after the last. The first step executes the statement.
  virtual bool Step() = 0;
  virtual void Reset() = 0;  // to be executed again

  virtual int columns() const = 0;
  virtual SqlValue Get(int column) const = 0;
  virtual bool IsNull(int column) const = 0;
  virtual std::string Text(int column) const = 0;  // empty for NULL
  virtual std::string Bytes(int column) const = 0;
  virtual std::int64_t Integer(int column) const = 0;
  virtual double Real(int column) const = 0;  // throws where the column holds no real
};

struct SqlWords {
  const char* now;       // the time as text: UTC, ISO 8601, to the second
  const char* week_ago;  // so, of seven days ago
};

// kRead: all statements see one moment. kWrite: nobody else writes the catalogue meanwhile; waits
// for others who do. kRows: of rows that the statements lock themselves.
enum class Purpose { kRead, kWrite, kRows };

class SqlDatabase {
 public:
  virtual ~SqlDatabase() = default;

  virtual std::unique_ptr<SqlStatement> Prepare(const std::string& sql) = 0;
  virtual void Execute(const std::string& script) = 0;  // statements without values or result
  virtual const SqlWords& words() const = 0;

  // A server that was lost is connected to again.
  virtual void Begin(Purpose purpose) = 0;
  virtual void Commit() = 0;
  virtual void RollBack() noexcept = 0;

  // How long a statement waits for the locks of other connections; then its fault is kBusy.
  virtual void WaitForLocks(std::chrono::milliseconds patience) = 0;
  virtual void TryToWrite() = 0;  // throws where a write would fail at once; nothing is kept
  virtual void Compact() = 0;     // outside of transactions
  // What the engine's own checks of its storage find.
  virtual std::vector<std::string> CheckStorage() = 0;
};

// Taken back unless it is committed.
class SqlTransaction {
 public:
  SqlTransaction(SqlDatabase& db, Purpose purpose) : db_(db) { db.Begin(purpose); }
  ~SqlTransaction() {
    if (!over_) db_.RollBack();
  }
  SqlTransaction(const SqlTransaction&) = delete;
  SqlTransaction& operator=(const SqlTransaction&) = delete;
  void Commit() {
    over_ = true;
    db_.Commit();
  }

 private:
  SqlDatabase& db_;
  bool over_ = false;
};

inline SqlValue ToSqlValue(const std::string& text) { return text; }
inline SqlValue ToSqlValue(const char* text) { return std::string(text); }
inline SqlValue ToSqlValue(const SqlBytes& bytes) { return bytes; }
inline SqlValue ToSqlValue(double value) { return value; }
inline SqlValue ToSqlValue(std::int64_t value) { return value; }
inline SqlValue ToSqlValue(int value) { return std::int64_t{value}; }
template <class T>
SqlValue ToSqlValue(const std::optional<T>& value) {
  return value ? ToSqlValue(*value) : SqlValue();
}

// Binds the values in order.
template <class... Values>
void BindAll(SqlStatement& statement, const Values&... values) {
  int place = 0;
  (statement.Bind(++place, ToSqlValue(values)), ...);
}

// Executes the statement with these values, for what it does.
template <class... Values>
void Run(SqlStatement& statement, const Values&... values) {
  statement.Reset();
  BindAll(statement, values...);
  while (statement.Step()) {
  }
}
template <class... Values>
void Run(SqlDatabase& db, const std::string& sql, const Values&... values) {
  Run(*db.Prepare(sql), values...);
}

// The statement, before its first row.
template <class... Values>
std::unique_ptr<SqlStatement> Query(SqlDatabase& db, const std::string& sql,
                                    const Values&... values) {
  auto statement = db.Prepare(sql);
  BindAll(*statement, values...);
  return statement;
}

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SQL_SQL_DATABASE_H_
