// The catalogue: reads and writes parts, and remembers every change. The only room that knows
// SQLite and PostgreSQL.
//
// It stands in a file of SQLite, or in a database on a server (sql/address.h), with the same
// tables. Every write is one transaction and becomes one revision. In a file, exactly one
// read-write connection per process writes, under a rollback journal, and readers open their own
// read-only connection, so the file alone is the catalogue and can be read where nothing can be
// written. One store may be used from several threads; its calls take turns.
#ifndef PLENUM_CATALOG_STORE_STORE_H_
#define PLENUM_CATALOG_STORE_STORE_H_

#include <chrono>
#include <climits>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catalog/fields/fields.h"
#include "catalog/fields/part.h"
#include "catalog/store/model_revision.h"
#include "catalog/store/revision.h"
#include "catalog/store/seed/seed_plan.h"
#include "catalog/store/store_error.h"
#include "catalog/store/write_result.h"

namespace plenum::catalog {

// What importing a list of parts does to each of them.
struct ImportPlan {
  std::vector<std::string> added, replaced, unchanged;  // ids
  std::vector<std::string> taken;  // ids of parts of another family: nothing can be imported
};
struct ImportResult {
  ImportPlan plan;
  WriteResult write;
};

// Calls `take` with each of a list of parts, the same ones whenever it is called; so a list need
// not be in memory at once.
using TakeEach = std::function<void(const Part&)>;
using PartSource = std::function<void(const TakeEach& take)>;

// Whether a write may go on, seen the part as it is stored; evaluated inside the transaction.
using Precondition = std::function<bool(const Part&)>;

struct StoreSession;

class Store {
 public:
  // Opens `path`, a file or an address. With kWrite the catalogue is created if missing. An older
  // schema is migrated to the newest in one transaction, also with kRead if the file can be
  // written; a newer one is refused.
  Store(const std::filesystem::path& path, Access access);
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;

  // How long calls wait for the locks of other connections; ten seconds unless set. Then they throw
  // StoreError (kBusy), and nothing was changed.
  void WaitForLocks(std::chrono::milliseconds patience);

  // Parts in order of id; of one family if given.
  std::vector<Part> List(const std::optional<std::string>& family = std::nullopt) const;
  std::optional<Part> Get(const std::string& id) const;

  // The newest revision, all of them from the newest on below `below`, and the state of one: parts
  // as they were, exactly. `number` must be one that FindRevision finds.
  Revision Head() const;
  std::optional<Revision> FindRevision(std::int64_t number) const;
  std::vector<Revision> Revisions(std::int64_t below, int limit) const;
  std::vector<Part> ListAt(std::int64_t number) const;
  std::optional<Part> GetAt(const std::string& id, std::int64_t number) const;
  // Changes of a part, newest first, in revisions below `below`; and of a revision, by id,
  std::vector<Change> History(const std::string& id, std::int64_t below, int limit) const;
  // the first `limit` with ids behind `after`.
  std::vector<Change> Changes(const Revision& revision, const std::string& after = "",
                              int limit = INT_MAX) const;
  // Parts together with the revision that they are.
  std::pair<Revision, std::vector<Part>> ListWithHead() const;

  // A revision, the newest where no number is given, and what parts of `known` are in it as far as
  // they differ. Nothing where there is no such revision, `known` is not what the catalogue holds
  // under its number, as after a restore, or more than `max` parts were written in between.
  std::optional<std::pair<Revision, PartChanges>> ChangesTo(std::optional<std::int64_t> number,
                                                            const Revision& known, int max) const;

  WriteResult Add(const Part& part, const Signature& by = {});
  WriteResult Replace(const Part& part, const Signature& by = {}, const Precondition& may = {});
  WriteResult Remove(const std::string& id, const Signature& by = {}, const Precondition& may = {});

  // Adds or replaces all of `parts`, which have different ids, or none. A part that is stored with
  // the same content but its origin is left alone.
  ImportPlan PlanImport(const PartSource& parts) const;
  ImportResult Import(const PartSource& parts, const Signature& by);

  // Brings every part that revision `number` changed back to what it was before, as a revision of
  // its own; all or none. Only where none of them was changed again since.
  WriteResult Undo(std::int64_t number, const Signature& by);

  // Saved model revisions: the newest of each name in order of name; all of one name, newest first;
  // one of them, the newest where no version is given. SaveModel adds a version, or gives the
  // newest where it holds the same document already; `name` must pass WhyInvalidModelName, a
  // document has 2 to 10,000,000 bytes. Parts, and so revisions of the catalogue, do not change.
  std::vector<ModelRevision> Models() const;
  std::vector<ModelRevision> ModelVersions(const std::string& name) const;
  std::optional<ModelRevision> FindModel(const std::string& name,
                                         std::optional<std::int64_t> version = {}) const;
  ModelRevision SaveModel(const std::string& name, const std::string& document,
                          const std::string& who);
  // Once for the signature's key: repeated, it gives the newest version that holds the document.
  // None: the key stands for another request.
  std::optional<ModelRevision> SaveModel(const std::string& name, const std::string& document,
                                         const Signature& by);

  // Replaces all seed rows by `parts` (origin set to "seed"); rows of users stay. All or nothing.
  // A user's row with the id of a seed row keeps its place and the seed row is left out.
  void ReplaceSeed(const std::vector<Part>& parts);
  // The same of the parts of another catalogue, as `who`: what UpdateSeed (seed/seed_update.h) does
  // and leaves alone. In a dry run nothing is written.
  SeedUpdate UpdateSeed(const std::vector<Part>& parts, const std::string& who, bool dry_run);

  // Of a file SQLite's own integrity and foreign-key check, Validate on every row, whether the
  // history agrees with the parts, saved models and files of documents with their hashes; empty:
  // all is well.
  std::vector<std::string> Check() const;

  // Begins to write, and takes it back: throws StoreError where a write would fail at once.
  // With kLock it only takes the turn of those who write and gives it back: kBusy where another has
  // it.
  enum class Try { kLock, kWrite };
  void TryToWrite(Try how = Try::kWrite);

 private:
  friend struct DocumentFiles;  // documents/document_files.h
  std::unique_ptr<StoreSession> impl_;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_STORE_H_
