// Documents of parts with their files, in a catalogue. A file is kept once under the hash of its
// content and never goes: older revisions refer to it.
#ifndef PLENUM_CATALOG_STORE_DOCUMENTS_DOCUMENT_FILES_H_
#define PLENUM_CATALOG_STORE_DOCUMENTS_DOCUMENT_FILES_H_

#include <optional>
#include <string>

#include "catalog/store/documents/kept_file.h"
#include "catalog/store/store.h"

namespace plenum::catalog {

struct DocumentFiles {
  // Adds the document to the part and keeps its file, in one transaction. A document of the part
  // with this hash stays as it is, and then the revision does, too; else the first with this link
  // and no hash gets the hash; else a document is appended.
  static WriteResult Add(Store& store, const std::string& id, const NewDocument& document,
                         const Signature& by = {});
  // Takes the documents with this hash off the part, or gives kNotFound where there is none. The
  // file stays.
  static WriteResult Remove(Store& store, const std::string& id, const std::string& sha256,
                            const Signature& by = {});
  // The file with this hash, where it is kept; and its content.
  static std::optional<KeptFile> Find(const Store& store, const std::string& sha256);
  static std::optional<std::string> Content(const Store& store, const std::string& sha256);
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_DOCUMENTS_DOCUMENT_FILES_H_
