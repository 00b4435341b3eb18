// Revisions and changes to and from their tables. Internal to the store; the caller
// owns the transaction.
#ifndef PLENUM_CATALOG_STORE_TABLES_HISTORY_H_
#define PLENUM_CATALOG_STORE_TABLES_HISTORY_H_

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catalog/store/content_hash.h"
#include "catalog/store/revision.h"
#include "catalog/store/tables/rows.h"

namespace plenum::catalog {

// Parts that one write changes, in the tables at once, and then recorded as one revision.
class RevisionWriter {
 public:
  explicit RevisionWriter(SqlDatabase& db);

  std::optional<Part> Get(const std::string& id);
  // Makes the part with id `id` what `after` says. `before` is what Get gave. Each id at most once.
  void Change(const std::string& id, const std::optional<Part>& before,
              const std::optional<Part>& after);
  const Revision& head() const { return head_; }  // before this write
  // The new revision, or the head if nothing was changed.
  Revision Record(const std::string& who, const std::string& what);

 private:
  SqlDatabase& db_;
  Revision head_;
  SetHash hash_;
  PartReader reader_;
  PartWriter rows_;
  std::vector<std::pair<std::string, std::optional<std::string>>> changes_;  // id, before
};

Revision Head(SqlDatabase& db);
std::optional<Revision> FindRevision(SqlDatabase& db, std::int64_t number);
// Newest first, below `below`, at most `limit`.
std::vector<Revision> ReadRevisions(SqlDatabase& db, std::int64_t below, int limit);

// Parts as they were after revision `number`, in order of id.
std::vector<Part> PartsAt(SqlDatabase& db, std::int64_t number);
std::optional<Part> PartAt(SqlDatabase& db, const std::string& id, std::int64_t number);

// Changes of one part, newest first, and of one revision, in order of id, behind `after`.
std::vector<Change> ChangesOf(SqlDatabase& db, const std::string& id, std::int64_t below,
                              int limit);
std::vector<Change> ChangesIn(SqlDatabase& db, const Revision& revision, const std::string& after,
                              int limit);

// Of the parts that were written between the two revisions, as they are in `number`. Nothing where
// `known` is no revision of these tables or they are more than `max`.
std::optional<PartChanges> ChangesBetween(SqlDatabase& db, const Revision& known,
                                          std::int64_t number, int max);

// Gives the newest revision the hash of the parts, where the migration left it open.
void SealHead(SqlDatabase& db);

// What does not agree between the parts, the hashes of the revisions and the changes between them.
std::vector<std::string> CheckHistory(SqlDatabase& db);

// The revisions before and after the write that was done under a key.
struct KeptKey {
  std::string request;
  std::int64_t base = 0, revision = 0;
};
std::optional<KeptKey> FindKey(SqlDatabase& db, const std::string& key);
// Also forgets keys of more than a week ago.
void KeepKey(SqlDatabase& db, const Signature& by, std::int64_t base, std::int64_t revision);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_TABLES_HISTORY_H_
