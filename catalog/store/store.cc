#include "catalog/store/store.h"

#include <algorithm>
#include <utility>

#include "catalog/store/seed/seed_rows.h"
#include "catalog/store/sql/address.h"
#include "catalog/store/store_session.h"
#include "catalog/store/tables/files.h"
#include "catalog/store/tables/history.h"
#include "catalog/store/tables/models.h"
#include "catalog/store/tables/rows.h"

namespace plenum::catalog {
namespace {

// Equal but for the origin, which a CSV file does not carry.
bool SameContent(Part a, const Part& b) {
  a.origin = b.origin;
  return a == b;
}

// Enters the part in the plan beside what is stored under its id.
void Enter(const Part& part, const std::optional<Part>& stored, ImportPlan& plan) {
  if (!stored)
    plan.added.push_back(part.id);
  else if (stored->family != part.family)
    plan.taken.push_back(part.id);
  else
    (SameContent(part, *stored) ? plan.unchanged : plan.replaced).push_back(part.id);
}

// `stored(id)` gives the part as it was when the import began.
template <class Stored>
ImportPlan Plan(const PartSource& parts, const Stored& stored) {
  ImportPlan plan;
  parts([&](const Part& part) { Enter(part, stored(part.id), plan); });
  return plan;
}

}  // namespace

Store::Store(const std::filesystem::path& path, Access access) {
  try {
    impl_ = std::make_unique<StoreSession>(path, access);
  } catch (const SqlError& error) {
    throw ToStoreError(
        Shown(path) + ": cannot be opened for " + (access == Access::kRead ? "reading" : "writing"),
        error);
  } catch (const StoreError& error) {
    throw StoreError(Shown(path) + " " + error.what());
  }
}

Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

void Store::WaitForLocks(std::chrono::milliseconds patience) {
  impl_->Do([&](SqlDatabase& db) { db.WaitForLocks(patience); });
}

void Store::TryToWrite(Try how) {
  impl_->Do([how](SqlDatabase& db) {
    if (how == Try::kWrite) return db.TryToWrite();
    const SqlTransaction taken_back(db, Purpose::kWrite);
  });
}

std::vector<Part> Store::List(const std::optional<std::string>& family) const {
  return impl_->Read([&](SqlDatabase& db) {
    return family ? PartReader(db, "family").Read(*family) : ReadParts(db);
  });
}

std::pair<Revision, std::vector<Part>> Store::ListWithHead() const {
  return impl_->Read([](SqlDatabase& db) { return std::pair(catalog::Head(db), ReadParts(db)); });
}

std::optional<Part> Store::Get(const std::string& id) const { return GetAt(id, INT64_MAX); }

Revision Store::Head() const {
  return impl_->Read([](SqlDatabase& db) { return catalog::Head(db); });
}

std::optional<Revision> Store::FindRevision(std::int64_t number) const {
  return impl_->Read([&](SqlDatabase& db) { return catalog::FindRevision(db, number); });
}

std::vector<Revision> Store::Revisions(std::int64_t below, int limit) const {
  return impl_->Read([&](SqlDatabase& db) { return ReadRevisions(db, below, limit); });
}

std::vector<Part> Store::ListAt(std::int64_t number) const {
  return impl_->Read([&](SqlDatabase& db) { return PartsAt(db, number); });
}

std::optional<Part> Store::GetAt(const std::string& id, std::int64_t number) const {
  return impl_->Read([&](SqlDatabase& db) { return PartAt(db, id, number); });
}

std::vector<Change> Store::History(const std::string& id, std::int64_t below, int limit) const {
  return impl_->Read([&](SqlDatabase& db) { return ChangesOf(db, id, below, limit); });
}

std::vector<Change> Store::Changes(const Revision& revision, const std::string& after,
                                   int limit) const {
  return impl_->Read([&](SqlDatabase& db) { return ChangesIn(db, revision, after, limit); });
}

std::optional<std::pair<Revision, PartChanges>> Store::ChangesTo(std::optional<std::int64_t> number,
                                                                 const Revision& known,
                                                                 int max) const {
  return impl_->Read([&](SqlDatabase& db) -> std::optional<std::pair<Revision, PartChanges>> {
    auto to = number ? catalog::FindRevision(db, *number) : catalog::Head(db);
    if (!to) return std::nullopt;
    auto changes = ChangesBetween(db, known, to->number, max);
    if (!changes) return std::nullopt;
    return std::pair(*std::move(to), *std::move(changes));
  });
}

WriteResult Store::Add(const Part& part, const Signature& by) {
  if (auto errors = Validate(part); !errors.empty())
    return {WriteStatus::kInvalid, std::move(errors), {}};
  return impl_->Write(by, "add " + part.id, [&](RevisionWriter& writer) -> WriteResult {
    if (writer.Get(part.id)) return {WriteStatus::kExists, {}, {}};
    writer.Change(part.id, std::nullopt, part);
    return {};
  });
}

WriteResult Store::Replace(const Part& part, const Signature& by, const Precondition& may) {
  if (auto errors = Validate(part); !errors.empty())
    return {WriteStatus::kInvalid, std::move(errors), {}};
  return impl_->Write(by, "replace " + part.id, [&](RevisionWriter& writer) -> WriteResult {
    const auto old = writer.Get(part.id);
    if (!old) return {WriteStatus::kNotFound, {}, {}};
    if (may && !may(*old)) return {WriteStatus::kChanged, {}, {}};
    writer.Change(part.id, old, part);
    return {};
  });
}

WriteResult Store::Remove(const std::string& id, const Signature& by, const Precondition& may) {
  return impl_->Write(by, "remove " + id, [&](RevisionWriter& writer) -> WriteResult {
    const auto old = writer.Get(id);
    if (!old) return {WriteStatus::kNotFound, {}, {}};
    if (may && !may(*old)) return {WriteStatus::kChanged, {}, {}};
    writer.Change(id, old, std::nullopt);
    return {};
  });
}

ImportPlan Store::PlanImport(const PartSource& parts) const {
  return impl_->Read([&](SqlDatabase& db) {
    PartReader reader(db, "id");
    return Plan(parts, [&](const std::string& id) { return reader.One(id); });
  });
}

ImportResult Store::Import(const PartSource& parts, const Signature& by) {
  ImportResult result;
  std::string what = "import nothing";
  result.write = impl_->Write(by, what, [&](RevisionWriter& writer) -> WriteResult {
    WriteResult written;
    parts([&](const Part& part) {
      what = "import " + part.family;
      for (const FieldError& error : Validate(part))
        written.errors.push_back({error.field, part.id + ": " + error.detail});
      if (!written.errors.empty()) return;
      const auto old = writer.Get(part.id);
      Enter(part, old, result.plan);
      if (!old || !SameContent(part, *old)) writer.Change(part.id, old, part);
    });
    // Then nothing of it is committed.
    if (!written.errors.empty())
      written.status = WriteStatus::kInvalid;
    else if (!result.plan.taken.empty())
      written.status = WriteStatus::kExists;
    return written;
  });
  if (result.write.status == WriteStatus::kRepeated)
    result.plan = impl_->Read([&](SqlDatabase& db) {
      const std::int64_t base = FindKey(db, by.key).value().base;
      return Plan(parts, [&](const std::string& id) { return PartAt(db, id, base); });
    });
  return result;
}

WriteResult Store::Undo(std::int64_t number, const Signature& by) {
  const auto revision = FindRevision(number);
  if (!revision) return {WriteStatus::kNotFound, {}, {}};
  const std::vector<Change> changes = Changes(*revision);
  WriteResult refused;
  for (const Change& change : changes)
    if (change.before)
      for (FieldError& error : Validate(*change.before)) refused.errors.push_back(std::move(error));
  if (!refused.errors.empty()) {
    refused.status = WriteStatus::kInvalid;
    return refused;
  }
  const std::string what = "undo " + std::to_string(number);
  return impl_->Write(by, what, [&](RevisionWriter& writer) -> WriteResult {
    for (const Change& change : changes)
      if (writer.Get(change.id) != change.after)
        refused.errors.push_back(
            {"", change.id + " was changed since revision " + std::to_string(number)});
    if (!refused.errors.empty()) return {WriteStatus::kSuperseded, refused.errors, {}};
    for (const Change& change : changes) writer.Change(change.id, change.after, change.before);
    return {};
  });
}

std::vector<ModelRevision> Store::Models() const {
  return impl_->Read([](SqlDatabase& db) { return ReadModels(db); });
}

std::vector<ModelRevision> Store::ModelVersions(const std::string& name) const {
  return impl_->Read([&](SqlDatabase& db) { return ReadVersions(db, name); });
}

std::optional<ModelRevision> Store::FindModel(const std::string& name,
                                              std::optional<std::int64_t> version) const {
  return impl_->Read([&](SqlDatabase& db) { return ReadModel(db, name, version); });
}

ModelRevision Store::SaveModel(const std::string& name, const std::string& document,
                               const std::string& who) {
  return SaveModel(name, document, Signature{who, {}, {}}).value();
}

std::optional<ModelRevision> Store::SaveModel(const std::string& name, const std::string& document,
                                              const Signature& by) {
  return impl_->Do([&](SqlDatabase& db) -> std::optional<ModelRevision> {
    SqlTransaction transaction(db, Purpose::kWrite);
    if (const auto kept = by.key.empty() ? std::nullopt : FindKey(db, by.key))
      return kept->request == by.request ? FindDocument(db, name, document) : std::nullopt;
    ModelRevision saved = InsertModel(db, name, document, by.who);
    if (!by.key.empty()) {
      const std::int64_t head = catalog::Head(db).number;  // which models do not change
      KeepKey(db, by, head, head);
    }
    transaction.Commit();
    return saved;
  });
}

void Store::ReplaceSeed(const std::vector<Part>& parts) {
  std::vector<Part> seed;
  try {
    seed = SeedRows(parts);
  } catch (const StoreError& error) {
    throw StoreError(impl_->shown + ": " + error.what());
  }
  impl_->Do([&](SqlDatabase& db) {
    SqlTransaction transaction(db, Purpose::kWrite);
    RevisionWriter writer(db);
    ReplaceSeedRows(db, seed, writer);
    writer.Record("build_catalog", std::string(kSeedWrite));
    transaction.Commit();
    db.Compact();
  });
}

SeedUpdate Store::UpdateSeed(const std::vector<Part>& parts, const std::string& who, bool dry_run) {
  const std::vector<Part> seed = SeedRows(parts);
  return impl_->Do([&](SqlDatabase& db) { return UpdateSeedRows(db, seed, who, dry_run); });
}

std::vector<std::string> Store::Check() const {
  return impl_->Read([](SqlDatabase& db) {
    std::vector<std::string> faults = db.CheckStorage();
    if (!faults.empty()) return faults;  // what is damaged cannot be read part by part
    for (const Part& part : ReadParts(db))
      for (const FieldError& error : Validate(part))
        faults.push_back(part.id + ", " + error.field + ": " + error.detail);
    for (std::string& fault : CheckHistory(db)) faults.push_back(std::move(fault));
    for (std::string& fault : CheckModels(db)) faults.push_back(std::move(fault));
    for (std::string& fault : CheckFiles(db)) faults.push_back(std::move(fault));
    return faults;
  });
}

}  // namespace plenum::catalog
