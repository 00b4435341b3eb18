// What the catalogue remembers of every write: revisions and the changes they made.
#ifndef PLENUM_CATALOG_STORE_REVISION_H_
#define PLENUM_CATALOG_STORE_REVISION_H_

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// One committed state of all parts. Number and hash together name the data exactly: a catalogue
// that was restored from a backup may give a number a second time, never with the same hash for
// other parts.
struct Revision {
  std::int64_t number = 0;
  std::string hash;  // of all parts (SetHash over their records)
  std::string at;    // UTC, ISO 8601
  std::string who;
  std::string what;  // "add bench-f1", "import valve", "undo 7", …
  bool operator==(const Revision&) const = default;
};

// One part in one revision; none stands for no such part.
struct Change {
  Revision revision;
  std::string id;
  std::optional<Part> before, after;
  bool operator==(const Change&) const = default;
};

// Parts by id, as they are in another revision; none stands for no such part.
using PartChanges = std::map<std::string, std::optional<Part>>;

// Who asks for a write. `key` is chosen by a client that may send a request again without knowing
// whether it was done; `request` is a digest of that request. Within a week the same key and
// request act once; the same key with another request is refused.
struct Signature {
  std::string who;  // at most 200 characters
  std::string key;  // empty: none
  std::string request;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_REVISION_H_
