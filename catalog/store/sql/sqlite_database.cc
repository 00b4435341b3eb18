#include "catalog/store/sql/sqlite_database.h"

#include <sqlite3.h>

#include <utility>

#include "catalog/store/sql/sqlite_file.h"

namespace plenum::catalog {
namespace {

constexpr SqlWords kWords = {"strftime('%Y-%m-%dT%H:%M:%SZ', 'now')",
                             "strftime('%Y-%m-%dT%H:%M:%SZ', 'now', '-7 days')"};

template <class Action>
auto Guarded(const Action& action) {
  try {
    return action();
  } catch (const SQLite::Exception& error) {
    throw ToSqlError(error);
  }
}

class SqliteStatement : public SqlStatement {
 public:
  SqliteStatement(SQLite::Database& db, const std::string& sql) : statement_(db, sql) {}

  void Bind(int place, const SqlValue& value) override {
    Guarded([&] {
      if (const auto* text = std::get_if<std::string>(&value))
        statement_.bind(place, *text);
      else if (const auto* real = std::get_if<double>(&value))
        statement_.bind(place, *real);
      else if (const auto* integer = std::get_if<std::int64_t>(&value))
        statement_.bind(place, *integer);
      else if (const auto* bytes = std::get_if<SqlBytes>(&value))
        statement_.bind(place, bytes->bytes.data(), static_cast<int>(bytes->bytes.size()));
      else
        statement_.bind(place);
    });
  }
  bool Step() override {
    return Guarded([&] { return statement_.executeStep(); });
  }
  void Reset() override {
    Guarded([&] { statement_.reset(); });
  }

  int columns() const override { return statement_.getColumnCount(); }
  SqlValue Get(int column) const override {
    const SQLite::Column cell = statement_.getColumn(column);
    if (cell.isNull()) return {};
    if (cell.isInteger()) return cell.getInt64();
    if (cell.isFloat()) return cell.getDouble();
    if (cell.isBlob()) return SqlBytes{cell.getString()};
    return cell.getString();
  }
  bool IsNull(int column) const override { return statement_.getColumn(column).isNull(); }
  std::string Text(int column) const override { return statement_.getColumn(column).getString(); }
  std::string Bytes(int column) const override { return Text(column); }
  std::int64_t Integer(int column) const override {
    return statement_.getColumn(column).getInt64();
  }
  double Real(int column) const override {
    const SQLite::Column cell = statement_.getColumn(column);
    if (!cell.isFloat()) throw SqlError("a number is missing or not a real");
    return cell.getDouble();
  }

 private:
  mutable SQLite::Statement statement_;
};

class SqliteDatabase : public SqlDatabase {
 public:
  explicit SqliteDatabase(std::shared_ptr<SQLite::Database> db) : db_(std::move(db)) {}

  std::unique_ptr<SqlStatement> Prepare(const std::string& sql) override {
    return Guarded([&] { return std::make_unique<SqliteStatement>(*db_, sql); });
  }
  void Execute(const std::string& script) override {
    Guarded([&] { db_->exec(script); });
  }
  const SqlWords& words() const override { return kWords; }

  void Begin(Purpose purpose) override {
    RollBack();  // what could not be taken back when there was no memory or the disk failed
    Execute(purpose == Purpose::kRead ? "BEGIN DEFERRED" : "BEGIN IMMEDIATE");
  }
  void Commit() override {
    try {
      Execute("COMMIT");
    } catch (const SqlError&) {
      RollBack();
      throw;
    }
  }
  void RollBack() noexcept override {
    constexpr int kTries = 20;
    for (int i = 0; i < kTries && sqlite3_get_autocommit(db_->getHandle()) == 0; ++i)
      db_->tryExec("ROLLBACK");
  }

  void WaitForLocks(std::chrono::milliseconds patience) override {
    catalog::WaitForLocks(*db_, patience);
  }
  void TryToWrite() override {
    Guarded([&] {
      // Nothing is kept, so nothing need outlast a power cut.
      struct Unsynced {
        explicit Unsynced(SQLite::Database& of) : db(of) { db.exec("PRAGMA synchronous = OFF"); }
        ~Unsynced() { db.tryExec("PRAGMA synchronous = EXTRA"); }
        SQLite::Database& db;
      } const unsynced(*db_);
      const SQLite::Transaction taken_back(*db_, SQLite::TransactionBehavior::IMMEDIATE);
      // Changes the first page, and so makes the journal.
      db_->exec("PRAGMA user_version = " + std::to_string(SchemaVersion(*db_)));
    });
  }
  void Compact() override { Execute("VACUUM"); }
  std::vector<std::string> CheckStorage() override {
    return Guarded([&] { return CheckFile(*db_); });
  }

 private:
  std::shared_ptr<SQLite::Database> db_;
};

}  // namespace

std::unique_ptr<SqlDatabase> MakeSqliteDatabase(std::shared_ptr<SQLite::Database> db) {
  return std::make_unique<SqliteDatabase>(std::move(db));
}

}  // namespace plenum::catalog
