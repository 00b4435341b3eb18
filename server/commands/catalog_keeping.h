// What `plenum catalog` does beside reading and writing parts: history, copies, checks.
#ifndef PLENUM_SERVER_COMMANDS_CATALOG_KEEPING_H_
#define PLENUM_SERVER_COMMANDS_CATALOG_KEEPING_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/catalogue/table_reading.h"

namespace plenum::server {

// Which parts a list or a comparison holds, and what it shows of them.
struct ListOptions {
  std::string search, sort;
  std::vector<std::string> filters, columns, ids;
  bool facets = false;
};

// What was read by hand of a part.
struct ReadingOptions {
  std::vector<std::string> readings;
  std::string uncertainty, specimen, how;
  bool anyway = false;
};

// Options of all subcommands; each uses its own.
struct CatalogOptions {
  std::string catalog = catalog::DefaultCatalog();
  std::string family, file, id;
  ListOptions list;
  std::optional<std::int64_t> revision;
  int limit = 20;
  catalog::TableOptions table;  // of import
  std::vector<std::string> columns, set;
  ReadingOptions reading;  // of measured
  bool json = false, csv = false, dry_run = false;
};

void ShowHistory(const CatalogOptions& options);
void UndoWrite(const CatalogOptions& options);
// Numbers read by hand into a part, as measured.
void WriteMeasured(const CatalogOptions& options);
void BackupCatalog(const CatalogOptions& options);
void RestoreCatalog(const CatalogOptions& options);
// All of the catalogue `file` into `id`, which must hold none; tokens, too.
void CopyCatalog(const CatalogOptions& options);
// Takes over what the catalogue in `file`, without one the installed one, has newer.
void UpdateCatalog(const CatalogOptions& options);
// The exit status: faults make the catalogue unfit for use; what only looks wrong does not count.
int CheckCatalog(const CatalogOptions& options);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_CATALOG_KEEPING_H_
