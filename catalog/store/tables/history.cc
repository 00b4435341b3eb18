#include "catalog/store/tables/history.h"

#include <algorithm>
#include <climits>
#include <map>

#include "catalog/store/part_record.h"

namespace plenum::catalog {
namespace {

constexpr char kRevisionColumns[] = "number, coalesce(hash, ''), at, who, what";

Revision ReadRevision(const SqlStatement& row) {
  return {row.Integer(0), row.Text(1), row.Text(2), row.Text(3), row.Text(4)};
}

std::optional<Part> ReadBefore(const SqlStatement& row, int column, const std::string& id) {
  if (row.IsNull(column)) return std::nullopt;
  auto part = ParseRecord(row.Text(column));
  if (!part || part->id != id) throw SqlError("the history of part \"" + id + "\" cannot be read");
  return part;
}

std::optional<Part> PartAt(SqlDatabase& db, PartReader& reader, const std::string& id,
                           std::int64_t number) {
  const auto query = Query(db,
                           "SELECT before FROM change WHERE part_id = ? AND revision > ? "
                           "ORDER BY revision LIMIT 1",
                           id, number);
  return query->Step() ? ReadBefore(*query, 0, id) : reader.One(id);
}

SetHash HashOf(const std::vector<Part>& parts) {
  SetHash hash;
  for (const Part& part : parts) hash.Add(FormatRecord(part));
  return hash;
}

}  // namespace

RevisionWriter::RevisionWriter(SqlDatabase& db)
    : db_(db), head_(Head(db)), hash_(head_.hash), reader_(db, "id"), rows_(db) {}

std::optional<Part> RevisionWriter::Get(const std::string& id) { return reader_.One(id); }

void RevisionWriter::Change(const std::string& id, const std::optional<Part>& before,
                            const std::optional<Part>& after) {
  if (before == after) return;
  std::optional<std::string> record;
  if (before) {
    record = FormatRecord(*before);
    hash_.Remove(*record);
    rows_.Delete(id);
  }
  if (after) {
    hash_.Add(FormatRecord(*after));
    rows_.Insert(*after);
  }
  changes_.emplace_back(id, std::move(record));
}

Revision RevisionWriter::Record(const std::string& who, const std::string& what) {
  if (changes_.empty()) return head_;
  const std::int64_t number = head_.number + 1;
  Run(db_, std::string("INSERT INTO revision VALUES (?, ?, ") + db_.words().now + ", ?, ?)", number,
      hash_.Digits(), who, what);
  const auto change = db_.Prepare("INSERT INTO change VALUES (?, ?, ?)");
  for (const auto& [id, before] : changes_) Run(*change, number, id, before);
  return Head(db_);
}

Revision Head(SqlDatabase& db) {
  std::vector<Revision> newest = ReadRevisions(db, INT64_MAX, 1);
  if (newest.empty()) throw SqlError("the catalogue has no revision");
  return std::move(newest.front());
}

std::optional<Revision> FindRevision(SqlDatabase& db, std::int64_t number) {
  const auto query = Query(
      db, std::string("SELECT ") + kRevisionColumns + " FROM revision WHERE number = ?", number);
  if (!query->Step()) return std::nullopt;
  return ReadRevision(*query);
}

std::vector<Revision> ReadRevisions(SqlDatabase& db, std::int64_t below, int limit) {
  const auto query = Query(db,
                           std::string("SELECT ") + kRevisionColumns +
                               " FROM revision WHERE number < ? ORDER BY number DESC LIMIT ?",
                           below, limit);
  std::vector<Revision> revisions;
  while (query->Step()) revisions.push_back(ReadRevision(*query));
  return revisions;
}

std::vector<Part> PartsAt(SqlDatabase& db, std::int64_t number) {
  std::map<std::string, Part> parts;
  for (Part& part : ReadParts(db)) parts.emplace(part.id, part);
  const auto query = Query(db,
                           "SELECT part_id, before FROM change JOIN (SELECT part_id AS id, "
                           "min(revision) AS next FROM change WHERE revision > ? GROUP BY part_id) "
                           "AS earliest ON part_id = id AND revision = next",
                           number);
  while (query->Step()) {
    const std::string id = query->Text(0);
    parts.erase(id);
    if (auto before = ReadBefore(*query, 1, id)) parts.emplace(id, std::move(*before));
  }
  std::vector<Part> list;
  list.reserve(parts.size());
  for (auto& [id, part] : parts) list.push_back(std::move(part));
  return list;
}

std::optional<Part> PartAt(SqlDatabase& db, const std::string& id, std::int64_t number) {
  PartReader reader(db, "id");
  return PartAt(db, reader, id, number);
}

std::vector<Change> ChangesOf(SqlDatabase& db, const std::string& id, std::int64_t below,
                              int limit) {
  const auto query = Query(db,
                           std::string("SELECT ") + kRevisionColumns +
                               ", before FROM change JOIN revision ON number = revision "
                               "WHERE part_id = ? AND number < ? ORDER BY number DESC LIMIT ?",
                           id, below, limit);
  std::vector<Change> changes;
  while (query->Step()) {
    Change& change = changes.emplace_back();
    change.revision = ReadRevision(*query);
    change.id = id;
    change.before = ReadBefore(*query, 5, id);
  }
  if (changes.empty()) return changes;
  changes.front().after = PartAt(db, id, changes.front().revision.number);
  for (std::size_t i = 1; i < changes.size(); ++i) changes[i].after = changes[i - 1].before;
  return changes;
}

std::vector<Change> ChangesIn(SqlDatabase& db, const Revision& revision, const std::string& after,
                              int limit) {
  const auto query = Query(db,
                           "SELECT part_id, before FROM change WHERE revision = ? AND part_id > ? "
                           "ORDER BY part_id LIMIT ?",
                           revision.number, after, limit);
  std::vector<Change> changes;
  while (query->Step()) {
    const std::string id = query->Text(0);
    changes.push_back({revision, id, ReadBefore(*query, 1, id), std::nullopt});
  }
  PartReader reader(db, "id");
  for (Change& change : changes) change.after = PartAt(db, reader, change.id, revision.number);
  return changes;
}

std::optional<PartChanges> ChangesBetween(SqlDatabase& db, const Revision& known,
                                          std::int64_t number, int max) {
  if (FindRevision(db, known.number) != known) return std::nullopt;
  const auto [first, last] = std::minmax(known.number, number);
  const auto query = Query(db,
                           "SELECT DISTINCT part_id FROM change WHERE revision > ? AND revision "
                           "<= ? LIMIT ?",
                           first, last, max + 1);
  std::vector<std::string> ids;
  while (query->Step()) ids.push_back(query->Text(0));
  if (ids.size() > static_cast<std::size_t>(max)) return std::nullopt;
  PartChanges changes;
  if (ids.empty()) return changes;
  PartReader reader(db, "id");
  for (const std::string& id : ids) changes.emplace(id, PartAt(db, reader, id, number));
  return changes;
}

void SealHead(SqlDatabase& db) {
  Run(db, "UPDATE revision SET hash = ? WHERE hash IS NULL", HashOf(ReadParts(db)).Digits());
}

// Walks from the parts as they are back to the first revision, undoing changes in the hash.
std::vector<std::string> CheckHistory(SqlDatabase& db) {
  std::map<std::string, std::optional<std::string>> records;  // as of the revision walked to
  for (const Part& part : ReadParts(db)) records[part.id] = FormatRecord(part);
  SetHash hash;
  for (const auto& [id, record] : records) hash.Add(*record);

  std::vector<std::string> faults;
  const auto changes = db.Prepare("SELECT part_id, before FROM change WHERE revision = ?");
  for (const Revision& revision : ReadRevisions(db, INT64_MAX, INT_MAX)) {
    if (revision.hash != hash.Digits()) {
      faults.push_back("revision " + std::to_string(revision.number) +
                       ": its hash does not agree with the parts and their history");
      return faults;  // what lies before cannot agree either
    }
    changes->Reset();
    changes->Bind(1, revision.number);
    while (changes->Step()) {
      std::optional<std::string>& record = records[changes->Text(0)];
      if (record) hash.Remove(*record);
      record.reset();
      if (!changes->IsNull(1)) hash.Add(record.emplace(changes->Text(1)));
    }
  }
  return faults;
}

std::optional<KeptKey> FindKey(SqlDatabase& db, const std::string& key) {
  const auto query =
      Query(db, "SELECT request, base, revision FROM request_key WHERE key = ?", key);
  if (!query->Step()) return std::nullopt;
  return KeptKey{query->Text(0), query->Integer(1), query->Integer(2)};
}

void KeepKey(SqlDatabase& db, const Signature& by, std::int64_t base, std::int64_t revision) {
  db.Execute(std::string("DELETE FROM request_key WHERE at < ") + db.words().week_ago);
  Run(db, std::string("INSERT INTO request_key VALUES (?, ?, ?, ?, ") + db.words().now + ")",
      by.key, by.request, base, revision);
}

}  // namespace plenum::catalog
