// Saved model revisions to and from their table. Internal to the store; the caller owns
// the transaction.
#ifndef PLENUM_CATALOG_STORE_TABLES_MODELS_H_
#define PLENUM_CATALOG_STORE_TABLES_MODELS_H_

#include <optional>
#include <string>
#include <vector>

#include "catalog/store/model_revision.h"
#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

// The newest of each name, in order of name; or all of one name, newest first.
std::vector<ModelRevision> ReadModels(SqlDatabase& db);
std::vector<ModelRevision> ReadVersions(SqlDatabase& db, const std::string& name);
// A version of a name, the newest if none is asked for.
std::optional<ModelRevision> ReadModel(SqlDatabase& db, const std::string& name,
                                       std::optional<std::int64_t> version);
// Adds the document as the next version of the name; the newest if it holds the same document.
ModelRevision InsertModel(SqlDatabase& db, const std::string& name, const std::string& document,
                          const std::string& who);
// The newest version of the name that holds the document.
std::optional<ModelRevision> FindDocument(SqlDatabase& db, const std::string& name,
                                          const std::string& document);
// Faults in what is stored.
std::vector<std::string> CheckModels(SqlDatabase& db);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_TABLES_MODELS_H_
