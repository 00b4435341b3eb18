// What stands in for address.cc and postgres_database.cc in a program that is built without libpq.
#include "catalog/store/sql/address.h"
#include "catalog/store/sql/postgres_database.h"

namespace plenum::catalog {

bool KnowsServers() { return false; }

bool IsUnderstood(const std::string& address) { return !IsServer(address); }

std::string Shown(const std::filesystem::path& place) {
  return IsServer(place) ? "postgresql://" : place.string();
}

std::unique_ptr<SqlDatabase> ConnectToServer(const std::string&) {
  throw SqlError(
      "this plenum was built without PostgreSQL; install libpq-dev, configure and build it anew",
      StoreFault::kStorage);
}

}  // namespace plenum::catalog
