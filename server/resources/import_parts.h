// Rows of a table into the catalogue; shared by the command and the service.
#ifndef PLENUM_SERVER_RESOURCES_IMPORT_PARTS_H_
#define PLENUM_SERVER_RESOURCES_IMPORT_PARTS_H_

#include <string>
#include <string_view>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/catalogue/table_reading.h"
#include "api/json/json.h"

namespace plenum::server {

struct TableImport {
  catalog::ImportPlan plan;
  // Not empty: nothing was written. Pointers are /row/column, the row as in the file, the column as
  // it calls it.
  api::Errors errors;
  catalog::WriteStatus status = catalog::WriteStatus::kDone;  // or kRepeated, kKeyReused
  catalog::Revision revision;  // that holds the rows; of a dry run the one it was compared with
};

// What is wrong with the table, or open, as `reading` understands it. Needs no store.
api::Errors CheckTable(const catalog::TableReading& reading, std::string_view bytes);

// Reads a table in which CheckTable finds nothing wrong and writes its parts as a user's rows, all
// in one transaction. A row that equals the stored one is left alone, so that an exported file goes
// back in without turning seed rows into a user's. A dry run finds the same errors and the same
// plan and writes nothing.
TableImport ImportTable(catalog::Store& store, const catalog::TableReading& reading,
                        std::string_view bytes, bool dry_run, const catalog::Signature& by);

// Names of all families, for messages.
std::string FamilyNames();

// The catalogue's errors on a part as the errors of a request.
api::Errors FieldErrors(const std::vector<catalog::FieldError>& errors);

// { added, replaced, unchanged, dry_run, catalogue_revision, understood }.
api::Json ToJson(const TableImport& import, const catalog::TableReading& reading, bool dry_run);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_IMPORT_PARTS_H_
