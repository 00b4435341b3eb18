#include "catalog/store/sql/postgres_database.h"

#include <libpq-fe.h>

#include <array>
#include <charconv>
#include <deque>
#include <new>
#include <string_view>
#include <utility>

#include "catalog/store/sql/address.h"

namespace plenum::catalog {
namespace {

constexpr SqlWords kWords = {
    R"(to_char(now() AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS"Z"'))",
    R"(to_char((now() AT TIME ZONE 'UTC') - interval '7 days', 'YYYY-MM-DD"T"HH24:MI:SS"Z"'))"};
// Held to the end of a transaction that writes the catalogue; advisory locks are the database's
// own.
constexpr char kWriteLock[] = "SELECT pg_advisory_xact_lock(1886154349)";
constexpr std::chrono::milliseconds kPatience{10'000};
// Types of columns (pg_type.dat).
constexpr Oid kBytea = 17, kInt8 = 20, kInt4 = 23, kFloat8 = 701;
constexpr std::size_t kMessageMax = 300;  // characters

using Result = std::unique_ptr<PGresult, decltype(&PQclear)>;

std::string FirstLine(std::string_view text) {
  text = text.substr(0, text.find('\n'));
  return std::string(text.substr(0, kMessageMax));
}

// SQLSTATE (PostgreSQL 15, appendix A).
StoreFault FaultOf(std::string_view state) {
  for (const char* busy : {"55P03", "40001", "40P01", "57014", "53300"})
    if (state == busy) return StoreFault::kBusy;
  for (const char* away : {"08", "57P", "25P03", "28"})
    if (state.starts_with(away)) return StoreFault::kAway;
  for (const char* storage : {"53", "58", "25006", "42501"})
    if (state.starts_with(storage)) return StoreFault::kStorage;
  return StoreFault::kOther;
}

// Sets what is not set in the address: a cut network is noticed within half a minute.
constexpr std::array<const char*, 9> kNames = {
    "connect_timeout",           "keepalives_idle",  "keepalives_interval",
    "keepalives_count",          "tcp_user_timeout", "client_encoding",
    "fallback_application_name", "dbname",           nullptr};

// Values of a statement as libpq takes them.
struct SentValues {
  std::vector<const char*> texts;
  std::vector<int> lengths, formats;  // which count for bytes alone
};

class PostgresStatement;

class PostgresDatabase : public SqlDatabase {
 public:
  explicit PostgresDatabase(std::string address) : address_(std::move(address)) { Open(); }

  std::unique_ptr<SqlStatement> Prepare(const std::string& sql) override;
  void Execute(const std::string& script) override {
    Finish();
    Check(Result(PQexec(session_.get(), script.c_str()), PQclear));
  }
  const SqlWords& words() const override { return kWords; }

  void Begin(Purpose purpose) override {
    const std::string begin = BeginOf(purpose);
    try {
      Execute(begin);
    } catch (const SqlError& error) {
      if (!error.lost()) {
        RollBack();
        throw;
      }
      Open();
      Execute(begin);  // nothing had been done
    }
  }
  void Commit() override {
    try {
      Finish();
      const Result result(PQexec(session_.get(), "COMMIT"), PQclear);
      Check(result);
      // The answer of a transaction in which a statement failed.
      if (std::string_view(PQcmdStatus(result.get())) != "COMMIT")
        throw SqlError("the transaction was taken back");
    } catch (const SqlError& error) {
      if (!error.lost()) throw;
      throw SqlError::Uncertain(
          "the connection was lost while the write was being confirmed, so it may or may not have "
          "been done; look before it is done again");
    }
  }
  void RollBack() noexcept override {
    try {
      Finish();
    } catch (const SqlError&) {
    }
    Result(PQexec(session_.get(), "ROLLBACK"), PQclear);
  }

  void WaitForLocks(std::chrono::milliseconds patience) override { patience_ = patience; }
  void TryToWrite() override {
    Begin(Purpose::kWrite);
    try {
      Execute("UPDATE migration SET name = name WHERE number = 1");
    } catch (const SqlError&) {
      RollBack();
      throw;
    }
    RollBack();
  }
  void Compact() override {}                                       // autovacuum does
  std::vector<std::string> CheckStorage() override { return {}; }  // pg_amcheck does

  // Of the statement that sends.
  void Send(PostgresStatement& statement, const std::string& sql, const SentValues& values);
  Result Next() { return {PQgetResult(session_.get()), PQclear}; }
  void Check(const Result& result) const;
  void Forget(const PostgresStatement& statement) {
    if (reading_ == &statement) reading_ = nullptr;
  }

 private:
  void Open();
  // Takes the rest of the rows that are on their way.
  void Finish();
  std::string BeginOf(Purpose purpose) const {
    std::string sql = purpose == Purpose::kRead ? "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY"
                                                : "BEGIN ISOLATION LEVEL READ COMMITTED READ WRITE";
    sql += "; SET LOCAL lock_timeout = " + std::to_string(patience_.count()) +
           "; SET LOCAL idle_in_transaction_session_timeout = '10min'";
    if (purpose == Purpose::kWrite) sql += std::string("; ") + kWriteLock;
    return sql;
  }

  const std::string address_;
  std::unique_ptr<PGconn, decltype(&PQfinish)> session_{nullptr, PQfinish};
  std::chrono::milliseconds patience_ = kPatience;
  PostgresStatement* reading_ = nullptr;  // whose rows are on their way
};

class PostgresStatement : public SqlStatement {
 public:
  PostgresStatement(PostgresDatabase& db, std::string sql) : db_(db), sql_(std::move(sql)) {}
  ~PostgresStatement() override { TakeRest(false); }

  void Bind(int place, const SqlValue& value) override;
  bool Step() override;
  void Reset() override {
    TakeRest(false);
    sent_ = false;
    row_.reset();
    rest_.clear();
  }

  int columns() const override { return PQnfields(row_.get()); }
  SqlValue Get(int column) const override {
    if (IsNull(column)) return {};
    const Oid type = PQftype(row_.get(), column);
    if (type == kInt8 || type == kInt4) return Integer(column);
    if (type == kFloat8) return Real(column);
    if (type == kBytea) return SqlBytes{Bytes(column)};
    return Text(column);
  }
  bool IsNull(int column) const override { return PQgetisnull(row_.get(), 0, column) != 0; }
  std::string Text(int column) const override {
    return {PQgetvalue(row_.get(), 0, column),
            static_cast<std::size_t>(PQgetlength(row_.get(), 0, column))};
  }
  std::string Bytes(int column) const override;
  std::int64_t Integer(int column) const override { return Number<std::int64_t>(column); }
  double Real(int column) const override {
    if (IsNull(column) || PQftype(row_.get(), column) != kFloat8)
      throw SqlError("a number is missing or not a real");
    return Number<double>(column);
  }

  // Keeps the rows that are still on their way, or drops them.
  void TakeRest(bool keep);

 private:
  template <class N>
  N Number(int column) const {
    N number = 0;
    const char* text = PQgetvalue(row_.get(), 0, column);
    std::from_chars(text, text + PQgetlength(row_.get(), 0, column), number);
    return number;
  }

  PostgresDatabase& db_;
  const std::string sql_;
  struct Bound {
    std::string text;
    bool is_binary = false;
  };
  std::vector<std::optional<Bound>> values_;
  bool sent_ = false, reading_ = false;
  Result row_{nullptr, PQclear};
  std::deque<Result> rest_;
};

// The places of values, each ? outside of quotation marks, as $1, $2, …
std::string WithNumberedPlaces(const std::string& sql) {
  std::string text;
  int places = 0;
  char quoted = 0;
  for (const char c : sql) {
    if (quoted != 0) {
      if (c == quoted) quoted = 0;
    } else if (c == '\'' || c == '"') {
      quoted = c;
    } else if (c == '?') {
      text += "$" + std::to_string(++places);
      continue;
    }
    text += c;
  }
  return text;
}

std::unique_ptr<SqlStatement> PostgresDatabase::Prepare(const std::string& sql) {
  return std::make_unique<PostgresStatement>(*this, WithNumberedPlaces(sql));
}

void PostgresDatabase::Open() {
  // libpq's own refusal repeats the address, with its password.
  if (!IsUnderstood(address_))
    throw SqlError("the address is not understood; it must be postgresql://user@host:port/database",
                   StoreFault::kStorage);
  reading_ = nullptr;
  const std::array<const char*, 9> values = {
      "5", "10", "5", "3", "20000", "UTF8", "plenum", address_.c_str(), nullptr};
  session_.reset(PQconnectdbParams(kNames.data(), values.data(), 1));
  if (PQstatus(session_.get()) == CONNECTION_OK) {
    PQsetNoticeProcessor(
        session_.get(), [](void*, const char*) {}, nullptr);
    return;
  }
  throw SqlError(FirstLine(PQerrorMessage(session_.get())), StoreFault::kAway, true);
}

void PostgresDatabase::Finish() {
  if (reading_ != nullptr) reading_->TakeRest(true);
}

void PostgresDatabase::Send(PostgresStatement& statement, const std::string& sql,
                            const SentValues& values) {
  Finish();
  const int sent =
      PQsendQueryParams(session_.get(), sql.c_str(), static_cast<int>(values.texts.size()), nullptr,
                        values.texts.data(), values.lengths.data(), values.formats.data(), 0);
  if (sent == 0 || PQsetSingleRowMode(session_.get()) == 0)
    throw SqlError("the connection to the server was lost", StoreFault::kAway, true);
  reading_ = &statement;
}

void PostgresDatabase::Check(const Result& result) const {
  const ExecStatusType status = PQresultStatus(result.get());
  if (status == PGRES_TUPLES_OK || status == PGRES_SINGLE_TUPLE || status == PGRES_COMMAND_OK)
    return;
  // Without a code it is libpq that speaks: the server is gone.
  const char* code = PQresultErrorField(result.get(), PG_DIAG_SQLSTATE);
  const char* message = PQresultErrorField(result.get(), PG_DIAG_MESSAGE_PRIMARY);
  if (code == nullptr || message == nullptr || PQstatus(session_.get()) == CONNECTION_BAD)
    throw SqlError("the connection to the server was lost", StoreFault::kAway, true);
  throw SqlError(FirstLine(message), FaultOf(code));
}

void PostgresStatement::Bind(int place, const SqlValue& value) {
  if (values_.size() < static_cast<std::size_t>(place)) values_.resize(place);
  std::optional<Bound>& bound = values_[place - 1];
  if (const auto* text = std::get_if<std::string>(&value)) {
    if (text->find('\0') != std::string::npos)
      throw SqlError("a text holds the character NUL, which PostgreSQL cannot keep");
    bound = {*text};
  } else if (const auto* real = std::get_if<double>(&value)) {
    char digits[32];
    bound = {std::string(digits, std::to_chars(digits, digits + sizeof digits, *real).ptr)};
  } else if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    bound = {std::to_string(*integer)};
  } else if (const auto* bytes = std::get_if<SqlBytes>(&value)) {
    bound = {bytes->bytes, true};
  } else {
    bound.reset();
  }
}

std::string PostgresStatement::Bytes(int column) const {
  std::size_t size = 0;
  const auto* text = reinterpret_cast<const unsigned char*>(PQgetvalue(row_.get(), 0, column));
  const std::unique_ptr<unsigned char, decltype(&PQfreemem)> bytes(PQunescapeBytea(text, &size),
                                                                   PQfreemem);
  if (!bytes) throw std::bad_alloc();
  return {reinterpret_cast<const char*>(bytes.get()), size};
}

bool PostgresStatement::Step() {
  if (!sent_) {
    SentValues values;
    for (const auto& value : values_) {
      values.texts.push_back(value ? value->text.c_str() : nullptr);
      values.lengths.push_back(value ? static_cast<int>(value->text.size()) : 0);
      values.formats.push_back(value && value->is_binary ? 1 : 0);
    }
    db_.Send(*this, sql_, values);
    sent_ = reading_ = true;
  }
  row_.reset();
  if (!rest_.empty()) {
    Result next = std::move(rest_.front());
    rest_.pop_front();
    db_.Check(next);
    row_ = std::move(next);
    return true;
  }
  if (!reading_) return false;
  Result next = db_.Next();
  if (PQresultStatus(next.get()) == PGRES_SINGLE_TUPLE) {
    row_ = std::move(next);
    return true;
  }
  TakeRest(false);
  db_.Check(next);
  return false;
}

void PostgresStatement::TakeRest(bool keep) {
  if (!reading_) return;
  reading_ = false;
  db_.Forget(*this);
  while (Result next = db_.Next()) {
    const ExecStatusType status = PQresultStatus(next.get());
    const bool ends = status == PGRES_TUPLES_OK || status == PGRES_COMMAND_OK;
    if (keep && !ends) rest_.push_back(std::move(next));  // a row, or an error in its place
  }
}

}  // namespace

std::unique_ptr<SqlDatabase> ConnectToServer(const std::string& address) {
  return std::make_unique<PostgresDatabase>(address);
}

}  // namespace plenum::catalog
