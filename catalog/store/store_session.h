// What a store holds, and how its calls reach the tables: one at a time, each write a transaction.
// Internal to the room.
#ifndef PLENUM_CATALOG_STORE_STORE_SESSION_H_
#define PLENUM_CATALOG_STORE_STORE_SESSION_H_

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "catalog/store/connection.h"
#include "catalog/store/sql/address.h"
#include "catalog/store/tables/history.h"
#include "catalog/store/write_result.h"

namespace plenum::catalog {

struct StoreSession {
  StoreSession(const std::filesystem::path& place, Access access)
      : shown(Shown(place)), db(Connect(place.string(), access)) {}

  // Runs `action` with the connection to itself and names the catalogue in every error.
  template <class Action>
  auto Do(const Action& action) {
    const std::lock_guard lock(mutex);
    try {
      return action(*db);
    } catch (const SqlError& error) {
      ThrowStoreError(shown, error);
    } catch (const StoreError& error) {
      throw StoreError(shown + " " + error.what(), error.fault());
    }
  }

  // Runs `action(writer)` in one transaction; only if it answers kDone, what it changed is recorded
  // as a revision and committed. A request that was done before under its key is not done again.
  template <class Action>
  WriteResult Write(const Signature& by, const std::string& what, const Action& action) {
    return Do([&](SqlDatabase& connection) -> WriteResult {
      SqlTransaction transaction(connection, Purpose::kWrite);
      if (const auto kept = by.key.empty() ? std::nullopt : FindKey(connection, by.key)) {
        if (kept->request != by.request) return {WriteStatus::kKeyReused, {}, {}};
        return {
            WriteStatus::kRepeated, {}, catalog::FindRevision(connection, kept->revision).value()};
      }
      RevisionWriter writer(connection);
      WriteResult result = action(writer);
      if (result.status != WriteStatus::kDone) return result;
      result.revision = writer.Record(by.who, what);
      if (!by.key.empty()) KeepKey(connection, by, writer.head().number, result.revision.number);
      transaction.Commit();
      return result;
    });
  }

  // Runs `action` on tables that are all of one moment; once more where the connection to a server
  // was lost in between.
  template <class Action>
  auto Read(const Action& action) {
    const auto read = [&](SqlDatabase& connection) {
      const SqlTransaction one_moment(connection, Purpose::kRead);
      return action(connection);
    };
    return Do([&](SqlDatabase& connection) {
      try {
        return read(connection);
      } catch (const SqlError& error) {
        if (!error.lost()) throw;
      }
      return read(connection);
    });
  }

  const std::string shown;
  const std::unique_ptr<SqlDatabase> db;
  std::mutex mutex;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_STORE_SESSION_H_
