#include "catalog/store/history.h"

#include <algorithm>
#include <map>

#include "catalog/store/part_record.h"

namespace plenum::catalog {
namespace {

constexpr char kNow[] = "strftime('%Y-%m-%dT%H:%M:%SZ', 'now')";
constexpr char kRevisionColumns[] = "number, coalesce(hash, ''), at, who, what";

Revision ReadRevision(SQLite::Statement& row) {
  return {row.getColumn(0).getInt64(), row.getColumn(1).getString(), row.getColumn(2).getString(),
          row.getColumn(3).getString(), row.getColumn(4).getString()};
}

std::optional<Part> ReadBefore(const SQLite::Column& column, const std::string& id) {
  if (column.isNull()) return std::nullopt;
  auto part = ParseRecord(column.getString());
  if (!part || part->id != id)
    throw SQLite::Exception("the history of part \"" + id + "\" cannot be read");
  return part;
}

std::optional<Part> PartNow(SQLite::Database& db, const std::string& id) {
  return PartReader(db, "id").One(id);
}

SetHash HashOf(const std::vector<Part>& parts) {
  SetHash hash;
  for (const Part& part : parts) hash.Add(FormatRecord(part));
  return hash;
}

}  // namespace

RevisionWriter::RevisionWriter(SQLite::Database& db)
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
  SQLite::Statement revision(db_,
                             std::string("INSERT INTO revision VALUES (?, ?, ") + kNow + ", ?, ?)");
  revision.bind(1, number);
  revision.bind(2, hash_.Digits());
  revision.bind(3, who);
  revision.bind(4, what);
  revision.exec();
  SQLite::Statement change(db_, "INSERT INTO change VALUES (?, ?, ?)");
  for (const auto& [id, before] : changes_) {
    change.reset();
    change.bind(1, number);
    change.bind(2, id);
    if (before)
      change.bind(3, *before);
    else
      change.bind(3);
    change.exec();
  }
  return Head(db_);
}

Revision Head(SQLite::Database& db) {
  std::vector<Revision> newest = ReadRevisions(db, INT64_MAX, 1);
  if (newest.empty()) throw SQLite::Exception("the catalogue has no revision");
  return std::move(newest.front());
}

std::optional<Revision> FindRevision(SQLite::Database& db, std::int64_t number) {
  SQLite::Statement query(
      db, std::string("SELECT ") + kRevisionColumns + " FROM revision WHERE number = ?");
  query.bind(1, number);
  if (!query.executeStep()) return std::nullopt;
  return ReadRevision(query);
}

std::vector<Revision> ReadRevisions(SQLite::Database& db, std::int64_t below, int limit) {
  SQLite::Statement query(db, std::string("SELECT ") + kRevisionColumns +
                                  " FROM revision WHERE number < ? ORDER BY number DESC LIMIT ?");
  query.bind(1, below);
  query.bind(2, limit);
  std::vector<Revision> revisions;
  while (query.executeStep()) revisions.push_back(ReadRevision(query));
  return revisions;
}

std::vector<Part> PartsAt(SQLite::Database& db, std::int64_t number) {
  std::map<std::string, Part> parts;
  for (Part& part : ReadParts(db)) parts.emplace(part.id, part);
  // SQLite takes `before` from the row that holds the minimum.
  SQLite::Statement query(
      db, "SELECT part_id, before, min(revision) FROM change WHERE revision > ? GROUP BY part_id");
  query.bind(1, number);
  while (query.executeStep()) {
    const std::string id = query.getColumn(0).getString();
    parts.erase(id);
    if (auto before = ReadBefore(query.getColumn(1), id)) parts.emplace(id, std::move(*before));
  }
  std::vector<Part> list;
  for (auto& [id, part] : parts) list.push_back(std::move(part));
  return list;
}

std::optional<Part> PartAt(SQLite::Database& db, const std::string& id, std::int64_t number) {
  SQLite::Statement query(db,
                          "SELECT before FROM change WHERE part_id = ? AND revision > ? "
                          "ORDER BY revision LIMIT 1");
  query.bind(1, id);
  query.bind(2, number);
  return query.executeStep() ? ReadBefore(query.getColumn(0), id) : PartNow(db, id);
}

std::vector<Change> ChangesOf(SQLite::Database& db, const std::string& id, std::int64_t below,
                              int limit) {
  SQLite::Statement query(db, std::string("SELECT ") + kRevisionColumns +
                                  ", before FROM change JOIN revision ON number = revision "
                                  "WHERE part_id = ? AND number < ? ORDER BY number DESC LIMIT ?");
  query.bind(1, id);
  query.bind(2, below);
  query.bind(3, limit);
  std::vector<Change> changes;
  while (query.executeStep()) {
    Change& change = changes.emplace_back();
    change.revision = ReadRevision(query);
    change.id = id;
    change.before = ReadBefore(query.getColumn(5), id);
  }
  if (changes.empty()) return changes;
  changes.front().after = PartAt(db, id, changes.front().revision.number);
  for (std::size_t i = 1; i < changes.size(); ++i) changes[i].after = changes[i - 1].before;
  return changes;
}

std::vector<Change> ChangesIn(SQLite::Database& db, const Revision& revision) {
  SQLite::Statement query(db,
                          "SELECT part_id, before FROM change WHERE revision = ? ORDER BY part_id");
  query.bind(1, revision.number);
  std::vector<Change> changes;
  while (query.executeStep()) {
    const std::string id = query.getColumn(0).getString();
    changes.push_back({revision, id, ReadBefore(query.getColumn(1), id), std::nullopt});
  }
  for (Change& change : changes) change.after = PartAt(db, change.id, revision.number);
  return changes;
}

void SealHead(SQLite::Database& db) {
  SQLite::Statement seal(db, "UPDATE revision SET hash = ? WHERE hash IS NULL");
  seal.bind(1, HashOf(ReadParts(db)).Digits());
  seal.exec();
}

// Walks from the parts as they are back to the first revision, undoing changes in the hash.
std::vector<std::string> CheckHistory(SQLite::Database& db) {
  std::map<std::string, std::optional<std::string>> records;  // as of the revision walked to
  for (const Part& part : ReadParts(db)) records[part.id] = FormatRecord(part);
  SetHash hash;
  for (const auto& [id, record] : records) hash.Add(*record);

  std::vector<std::string> faults;
  SQLite::Statement changes(db, "SELECT part_id, before FROM change WHERE revision = ?");
  for (const Revision& revision : ReadRevisions(db, INT64_MAX, -1)) {
    if (revision.hash != hash.Digits()) {
      faults.push_back("revision " + std::to_string(revision.number) +
                       ": its hash does not agree with the parts and their history");
      return faults;  // what lies before cannot agree either
    }
    changes.reset();
    changes.bind(1, revision.number);
    while (changes.executeStep()) {
      std::optional<std::string>& record = records[changes.getColumn(0).getString()];
      if (record) hash.Remove(*record);
      record.reset();
      if (!changes.getColumn(1).isNull()) hash.Add(record.emplace(changes.getColumn(1)));
    }
  }
  return faults;
}

std::optional<KeptKey> FindKey(SQLite::Database& db, const std::string& key) {
  SQLite::Statement query(db, "SELECT request, base, revision FROM request_key WHERE key = ?");
  query.bind(1, key);
  if (!query.executeStep()) return std::nullopt;
  return KeptKey{query.getColumn(0).getString(), query.getColumn(1).getInt64(),
                 query.getColumn(2).getInt64()};
}

void KeepKey(SQLite::Database& db, const Signature& by, std::int64_t base, std::int64_t revision) {
  db.exec("DELETE FROM request_key WHERE at < strftime('%Y-%m-%dT%H:%M:%SZ', 'now', '-7 days')");
  SQLite::Statement insert(
      db, std::string("INSERT INTO request_key VALUES (?, ?, ?, ?, ") + kNow + ")");
  insert.bind(1, by.key);
  insert.bind(2, by.request);
  insert.bind(3, base);
  insert.bind(4, revision);
  insert.exec();
}

}  // namespace plenum::catalog
