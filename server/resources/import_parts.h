// Rows of a CSV file into the catalogue; shared by the command and the service.
#ifndef PLENUM_SERVER_RESOURCES_IMPORT_PARTS_H_
#define PLENUM_SERVER_RESOURCES_IMPORT_PARTS_H_

#include <string>
#include <string_view>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/json/json.h"

namespace plenum::server {

struct CsvImport {
  catalog::ImportPlan plan;
  // Not empty: nothing was written. Pointers are /row/column, row 1 the header.
  api::Errors errors;
  catalog::WriteStatus status = catalog::WriteStatus::kDone;  // or kRepeated, kKeyReused
  catalog::Revision revision;  // that holds the rows; of a dry run the one it was compared with
};

// What is wrong with `text` as parts of `family`. Needs no store.
api::Errors CheckCsv(const std::string& family, std::string_view text);

// Reads `text`, in which CheckCsv finds nothing wrong, as parts of `family` and writes them as a
// user's rows, all in one transaction. A row that equals the stored one is left alone, so that an
// exported file goes back in without turning seed rows into a user's. A dry run finds the same
// errors and the same plan and writes nothing.
CsvImport ImportCsv(catalog::Store& store, const std::string& family, std::string_view text,
                    bool dry_run, const catalog::Signature& by);

// Names of all families, for messages.
std::string FamilyNames();

// The catalogue's errors on a part as the errors of a request.
api::Errors FieldErrors(const std::vector<catalog::FieldError>& errors);

// { added, replaced, unchanged, dry_run, catalogue_revision }.
api::Json ToJson(const CsvImport& import, bool dry_run);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_IMPORT_PARTS_H_
