// The tables of a catalogue on a server: made, brought to the newest schema or refused.
#ifndef PLENUM_CATALOG_STORE_SQL_POSTGRES_SCHEMA_H_
#define PLENUM_CATALOG_STORE_SQL_POSTGRES_SCHEMA_H_

#include <functional>
#include <memory>
#include <string>

#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

// A connection to a database of the newest schema. One that is empty becomes a catalogue where it
// is opened for writing; `fill` is called in that transaction, when the tables are there. Throws
// SqlError, and StoreError where the database is another's or has a newer schema.
std::unique_ptr<SqlDatabase> OpenServer(const std::string& address, Access access,
                                        const std::function<void(SqlDatabase&)>& fill);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SQL_POSTGRES_SCHEMA_H_
