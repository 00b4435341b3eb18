// Where a catalogue is: the path of a file of SQLite, or the address of a database of PostgreSQL,
// postgresql://[user[:password]@][host][:port]/database[?name=value&…] (libpq 15, 34.1.1.2). In a
// program that is built without libpq without_libpq.cc stands in.
#ifndef PLENUM_CATALOG_STORE_SQL_ADDRESS_H_
#define PLENUM_CATALOG_STORE_SQL_ADDRESS_H_

#include <filesystem>
#include <string>

namespace plenum::catalog {

// Whether the place is an address, good or bad.
inline bool IsServer(const std::filesystem::path& place) {
  return place.native().starts_with("postgresql://") || place.native().starts_with("postgres://");
}

// Whether this program was built with libpq, without which no address can be opened.
bool KnowsServers();

// Whether libpq can make something of the address.
bool IsUnderstood(const std::string& address);

// The place as people and logs may see it: an address without its password.
std::string Shown(const std::filesystem::path& place);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SQL_ADDRESS_H_
