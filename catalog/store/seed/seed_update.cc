#include "catalog/store/seed/seed_update.h"

#include <system_error>

#include "catalog/store/connection.h"
#include "catalog/store/seed/seed_rows.h"
#include "catalog/store/sql/address.h"

namespace plenum::catalog {
namespace {

// What `action` gives, its errors with the name of the file.
template <class Action>
auto Named(const std::filesystem::path& file, const Action& action) {
  if (!IsServer(file) && !std::filesystem::exists(file))
    throw StoreError(file.string() + ": no such catalogue");
  try {
    return action();
  } catch (const SqlError& error) {
    throw ToStoreError(Shown(file), error);
  } catch (const StoreError& error) {
    throw StoreError(Shown(file) + " " + error.what(), error.fault());
  }
}

std::vector<Part> PartsOf(const std::filesystem::path& catalog) {
  const auto db = Connect(catalog.string(), Access::kRead);
  const SqlTransaction one_moment(*db, Purpose::kRead);
  return ReadParts(*db);
}

}  // namespace

SeedUpdate UpdateSeed(const std::filesystem::path& catalog, const std::filesystem::path& seed,
                      const std::string& who, bool dry_run) {
  std::error_code ignored;
  if (catalog == seed || std::filesystem::equivalent(catalog, seed, ignored))
    throw StoreError(Shown(seed) + ": is the catalogue itself");
  const std::vector<Part> parts = Named(seed, [&] { return SeedRows(PartsOf(seed)); });
  return Named(catalog, [&]() -> SeedUpdate {
    const auto db = Connect(catalog.string(), Access::kWrite);
    return UpdateSeedRows(*db, parts, who, dry_run);
  });
}

}  // namespace plenum::catalog
