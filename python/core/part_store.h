// Parts of a catalogue as JSON text. All throw Refused or catalog::StoreError.
#ifndef PLENUM_PYTHON_CORE_PART_STORE_H_
#define PLENUM_PYTHON_CORE_PART_STORE_H_

#include <optional>
#include <string>

#include "api/catalogue/stores.h"

namespace plenum::python {

// The catalogue at `path`; that of DefaultCatalog where it is empty. The seed of a user's own is
// `seed`, or what is installed where that is empty.
std::string LocateCatalogue(const std::string& path, const std::string& seed);
catalog::Store OpenCatalogue(const std::string& path, catalog::Access access);

std::string Parts(const std::string& path, const std::optional<std::string>& family);
std::string Families();
std::string Head(const std::string& path);  // the newest revision
// What was written as a revision. `replace`: a part of that id may be there.
std::string AddPart(const std::string& path, const std::string& part, bool replace,
                    const std::string& who);
std::string RemovePart(const std::string& path, const std::string& id, const std::string& who);
// A table in any dialect (docs/reference/tables.md), all of its parts or none:
// { "added", "replaced", "unchanged" }, ids. `dry_run` writes nothing.
std::string ImportTable(const std::string& path, const std::string& family,
                        const std::string& table, bool dry_run, const std::string& who);
std::string SaveModel(const std::string& path, const std::string& name, const std::string& model,
                      const std::string& who);
std::string Models(const std::string& path);

}  // namespace plenum::python

#endif  // PLENUM_PYTHON_CORE_PART_STORE_H_
