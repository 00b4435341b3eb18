#include "catalog/store/seed/seed_update.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <system_error>

#include "catalog/store/connection.h"
#include "catalog/store/seed/seed_rows.h"

namespace plenum::catalog {
namespace {

// What `action` gives, its errors with the name of the file.
template <class Action>
auto Named(const std::filesystem::path& file, const Action& action) {
  if (!std::filesystem::exists(file)) throw StoreError(file.string() + ": no such catalogue");
  try {
    return action();
  } catch (const SQLite::Exception& error) {
    throw ToStoreError(file.string(), error);
  } catch (const StoreError& error) {
    throw StoreError(file.string() + " " + error.what(), error.fault());
  }
}

std::vector<Part> PartsOf(const std::filesystem::path& catalog) {
  SQLite::Database db = Connect(catalog.string(), Access::kRead);
  SQLite::Transaction one_moment(db);
  return ReadParts(db);
}

}  // namespace

SeedUpdate UpdateSeed(const std::filesystem::path& catalog, const std::filesystem::path& seed,
                      const std::string& who, bool dry_run) {
  std::error_code ignored;
  if (std::filesystem::equivalent(catalog, seed, ignored))
    throw StoreError(seed.string() + ": is the catalogue itself");
  const std::vector<Part> parts = Named(seed, [&] { return SeedRows(PartsOf(seed)); });
  return Named(catalog, [&]() -> SeedUpdate {
    SQLite::Database db = Connect(catalog.string(), Access::kWrite);
    return UpdateSeedRows(db, parts, who, dry_run);
  });
}

}  // namespace plenum::catalog
