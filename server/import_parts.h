// Rows of a CSV file into the catalogue; shared by the command and the service.
#ifndef PLENUM_SERVER_IMPORT_PARTS_H_
#define PLENUM_SERVER_IMPORT_PARTS_H_

#include <string>
#include <string_view>
#include <vector>

#include "api/json.h"
#include "api/services.h"

namespace plenum::server {

struct ImportResult {
  std::vector<std::string> added, replaced, unchanged;  // ids
  api::Errors errors;  // not empty: nothing was written; pointers are /row/column, row 1 the header
};

// Reads `text` as parts of `family` and writes them as a user's rows. A row that equals the stored
// one is left alone, so that an exported file goes back in without turning seed rows into a user's.
ImportResult ImportCsv(catalog::Store& store, const std::string& family, std::string_view text,
                       bool dry_run);

// Names of all families, for messages.
std::string FamilyNames();

// The catalogue's errors on a part as the errors of a request.
api::Errors FieldErrors(const std::vector<catalog::FieldError>& errors);

api::Json ToJson(const ImportResult& result);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_IMPORT_PARTS_H_
