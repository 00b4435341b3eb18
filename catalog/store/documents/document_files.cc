#include "catalog/store/documents/document_files.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "catalog/store/content_hash.h"
#include "catalog/store/store_session.h"
#include "catalog/store/tables/files.h"

namespace plenum::catalog {
namespace {

std::vector<FieldError> CheckNewDocument(const NewDocument& document, const std::string& sha256) {
  std::vector<FieldError> errors;
  const std::size_t bytes = document.content.size();
  if (bytes == 0 || bytes > kFileBytesMax)
    errors.push_back({"file", "must have 1 to " + std::to_string(kFileBytesMax) + " bytes, has " +
                                  std::to_string(bytes)});
  if (!document.sha256.empty() && document.sha256 != sha256)
    errors.push_back(
        {"sha256", "must be that of the file, " + sha256 + ", not \"" + document.sha256 + "\""});
  return errors;
}

// Whether the part refers to the content.
bool RefersTo(const Part& part, const std::string& sha256) {
  return std::any_of(part.documents.begin(), part.documents.end(),
                     [&](const Document& one) { return one.sha256 == sha256; });
}

void AddReference(Part& part, const std::string& link, const std::string& sha256) {
  const auto same =
      std::find_if(part.documents.begin(), part.documents.end(),
                   [&](const Document& one) { return one.sha256.empty() && one.link == link; });
  if (same != part.documents.end())
    same->sha256 = sha256;
  else
    part.documents.push_back({link, sha256});
  part.origin = "user";  // new seed rows do not take it back
}

}  // namespace

WriteResult DocumentFiles::Add(Store& store, const std::string& id, const NewDocument& document,
                               const Signature& by) {
  const std::string sha256 = Sha256(document.content);
  if (auto errors = CheckNewDocument(document, sha256); !errors.empty())
    return {WriteStatus::kInvalid, std::move(errors), {}};
  StoreSession& impl = *store.impl_;
  const auto add = [&](RevisionWriter& writer) -> WriteResult {
    const auto old = writer.Get(id);
    if (!old) return {WriteStatus::kNotFound, {}, {}};
    if (!RefersTo(*old, sha256)) {
      if (document.link.empty())
        return {WriteStatus::kInvalid,
                {{"link",
                  "is missing: a file name or an address, since the part has no document "
                  "with this hash yet"}},
                {}};
      Part part = *old;
      AddReference(part, document.link, sha256);
      if (auto errors = Validate(part); !errors.empty())
        return {WriteStatus::kInvalid, std::move(errors), {}};
      writer.Change(id, old, part);
    }
    const auto bytes = static_cast<std::int64_t>(document.content.size());
    InsertFile(*impl.db, {sha256, document.media_type, bytes}, document.content);
    return {};
  };
  return impl.Write(by, "add a document to " + id, add);
}

WriteResult DocumentFiles::Remove(Store& store, const std::string& id, const std::string& sha256,
                                  const Signature& by) {
  const auto remove = [&](RevisionWriter& writer) -> WriteResult {
    const auto old = writer.Get(id);
    if (!old || !RefersTo(*old, sha256)) return {WriteStatus::kNotFound, {}, {}};
    Part part = *old;
    std::erase_if(part.documents, [&](const Document& one) { return one.sha256 == sha256; });
    part.origin = "user";
    writer.Change(id, old, part);
    return {};
  };
  return store.impl_->Write(by, "remove a document of " + id, remove);
}

std::optional<KeptFile> DocumentFiles::Find(const Store& store, const std::string& sha256) {
  return store.impl_->Read([&](SqlDatabase& db) { return FindFile(db, sha256); });
}

std::optional<std::string> DocumentFiles::Content(const Store& store, const std::string& sha256) {
  return store.impl_->Read([&](SqlDatabase& db) -> std::optional<std::string> {
    const auto file = FindFile(db, sha256);
    return file ? std::optional(ReadFile(db, *file)) : std::nullopt;
  });
}

}  // namespace plenum::catalog
