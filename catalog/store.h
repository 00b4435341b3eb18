// catalog.db: opens, migrates, reads and writes parts. The only room that knows SQLite.
//
// Exactly one read-write connection per process writes; readers open their own read-only
// connection. Every write is one transaction under a rollback journal, so the file alone is the
// catalogue and can be read where nothing can be written. One store may be used from several
// threads; its calls take turns.
#ifndef PLENUM_CATALOG_STORE_H_
#define PLENUM_CATALOG_STORE_H_

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "catalog/fields.h"
#include "catalog/part.h"

namespace plenum::catalog {

enum class Access { kRead, kWrite };

// Thrown when the database cannot be opened, read or written; the message names the file and what
// to do. (I/O is the one place of plenum where exceptions carry an outcome.)
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class WriteStatus { kDone, kInvalid, kExists, kNotFound };
struct WriteResult {
  WriteStatus status = WriteStatus::kDone;
  std::vector<FieldError> errors;
};

class Store {
 public:
  // Opens `path`. With kWrite the file is created if missing and migrated to the newest schema in
  // one transaction per migration; with kRead an older schema is refused with a StoreError.
  Store(const std::filesystem::path& path, Access access);
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;

  // Parts in order of id; of one family if given.
  std::vector<Part> List(const std::optional<std::string>& family = std::nullopt) const;
  std::optional<Part> Get(const std::string& id) const;

  WriteResult Add(const Part& part);      // kExists if the id is taken, kInvalid with the reasons
  WriteResult Replace(const Part& part);  // kNotFound if there is none
  WriteResult Remove(const std::string& id);

  // Replaces all seed rows by `parts` (origin set to "seed"); rows of users stay. All or nothing.
  // A user's row with the id of a seed row keeps its place and the seed row is left out.
  void ReplaceSeed(const std::vector<Part>& parts);

  // SQLite's own integrity and foreign-key check plus Validate on every row; empty: all is well.
  std::vector<std::string> Check() const;

  // Changes with every committed write, by any process: part of ETags and cache keys.
  long long DataVersion() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_H_
