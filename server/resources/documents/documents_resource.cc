#include "server/resources/documents/documents_resource.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "api/catalogue/documents/part_files.h"
#include "api/catalogue/part_document.h"
#include "api/catalogue/part_query.h"
#include "server/call/entity_tag.h"
#include "server/call/lower_case.h"
#include "server/call/signature.h"
#include "server/resources/import_parts.h"

namespace plenum::server {
namespace {

using catalog::DocumentFiles;
using catalog::WriteStatus;

Reply NoSuchPart(const std::string& id) { return ProblemReply(404, "no part has the id " + id); }

Reply NoDocument(const std::string& id, const std::string& sha256) {
  return ProblemReply(404, "the part " + id + " has no document with the hash " + sha256);
}

std::pair<std::string, std::string> PartAndHash(const Call& call) {
  const auto slash = call.argument.find('/');
  return {call.argument.substr(0, slash), call.argument.substr(slash + 1)};
}

// Runs `answer(store, part, revision)` with the part as it is in the revision that the query names.
template <class Answer>
Reply WithPart(SharedCatalog& catalog, const Call& call, const std::string& id,
               const Answer& answer) {
  if (const auto errors = CheckQuery(call, {"revision"}); !errors.empty())
    return ProblemReply(422, errors);
  const auto parsed = api::ParsePartQuery(call.query);
  if (const auto* wrong = std::get_if<api::Errors>(&parsed)) return ProblemReply(422, *wrong);
  const auto number = std::get<api::PartQuery>(parsed).revision;
  return catalog.past().With([&](const catalog::Store& store) -> Reply {
    const auto revision = number ? store.FindRevision(*number) : store.Head();
    if (!revision)
      return ProblemReply(404, "the catalogue has no revision " + std::to_string(*number));
    const auto part = store.GetAt(id, revision->number);
    return part ? answer(store, *part, *revision) : NoSuchPart(id);
  });
}

// RFC 6266: a name in ASCII, and the whole one in UTF-8.
std::string Attachment(const std::string& name) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string plain, coded;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_word =
        byte < 0x80 && (std::isalnum(byte) != 0 || c == '.' || c == '-' || c == '_');
    plain += is_word || c == ' ' ? c : '_';
    coded += is_word ? std::string(1, c) : std::string{'%', kHex[byte >> 4], kHex[byte & 15]};
  }
  return "attachment; filename=\"" + plain + "\"; filename*=UTF-8''" + coded;
}

// What the client says of the body, or, where it says nothing, what the link ends with.
std::string MediaTypeOf(const Call& call, const std::string& link) {
  const std::string given = call.header("Content-Type").value_or(api::kAnyMediaType);
  std::string type = LowerCase(given.substr(0, given.find(';')));
  type.erase(type.find_last_not_of(" \t") + 1);
  return type == api::kAnyMediaType ? api::MediaTypeOf(link) : type;
}

Reply Refused(const catalog::WriteResult& written, const std::string& id) {
  if (written.status == WriteStatus::kNotFound) return NoSuchPart(id);
  if (written.status == WriteStatus::kKeyReused) return KeyReused();
  return ProblemReply(422, FieldErrors(written.errors));
}

// The file, without its content where the client has it.
Reply FileReply(const Call& call, const catalog::Store& store, const catalog::Document& document,
                const catalog::KeptFile& file) {
  const std::string etag = "\"" + file.sha256 + "\"";
  Reply reply{200,
              file.media_type,
              "",
              {{"ETag", etag},
               {"Content-Disposition", Attachment(api::FileNameOf(document))},
               {"X-Content-Type-Options", "nosniff"},
               {"Content-Security-Policy", "default-src 'none'; sandbox"}},
              {}};
  if (IsKnown(call, etag))
    reply.status = 304;
  else
    reply.body = DocumentFiles::Content(store, file.sha256).value();
  return reply;
}

}  // namespace

Reply ListDocuments(SharedCatalog& catalog, const Call& call) {
  return WithPart(catalog, call, call.argument,
                  [](const catalog::Store& store, const catalog::Part& part,
                     const catalog::Revision& revision) {
                    return JsonReply(200, api::RenderDocuments(store, part, revision));
                  });
}

Reply AddDocument(SharedCatalog& catalog, const Call& call) {
  if (const auto errors = CheckQuery(call, {"link", "sha256"}); !errors.empty())
    return ProblemReply(422, errors);
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  const std::string& id = call.argument;
  const std::string link = QueryValue(call, "link").value_or("");
  const catalog::NewDocument document{link, MediaTypeOf(call, link), call.body,
                                      QueryValue(call, "sha256").value_or("")};
  const std::string sha256 = catalog::Sha256(call.body);
  return catalog.WithLong([&](catalog::Store& store) -> Reply {
    const catalog::Revision before = store.Head();
    const bool was_kept = DocumentFiles::Find(store, sha256).has_value();
    const auto written =
        DocumentFiles::Add(store, id, document, std::get<catalog::Signature>(signature));
    if (written.status != WriteStatus::kDone && written.status != WriteStatus::kRepeated)
      return Refused(written, id);
    const auto part = store.GetAt(id, written.revision.number);
    if (!part) return NoSuchPart(id);
    const auto added =
        std::find_if(part->documents.begin(), part->documents.end(),
                     [&](const catalog::Document& one) { return one.sha256 == sha256; });
    if (added == part->documents.end()) return NoDocument(id, sha256);
    api::Json json = api::RenderDocument(store, id, *added);
    json["catalogue_revision"] = api::RenderRevisionName(written.revision);
    const bool is_new = written.status == WriteStatus::kRepeated || !was_kept ||
                        written.revision.number != before.number;
    Reply reply = JsonReply(is_new ? 201 : 200, json);
    reply.headers.emplace_back("Location", "/v1/parts/" + id + "/documents/" + sha256);
    return reply;
  });
}

Reply GetDocument(SharedCatalog& catalog, const Call& call) {
  const auto [id, sha256] = PartAndHash(call);
  const auto give = [&, id = id, hash = sha256](const catalog::Store& store,
                                                const catalog::Part& part,
                                                const catalog::Revision&) -> Reply {
    const auto found =
        std::find_if(part.documents.begin(), part.documents.end(),
                     [&](const catalog::Document& one) { return one.sha256 == hash; });
    if (hash.empty() || found == part.documents.end()) return NoDocument(id, hash);
    const auto file = DocumentFiles::Find(store, hash);
    if (!file)
      return ProblemReply(404, "the file with the hash " + hash +
                                   " is not kept; POST it to /v1/parts/" + id + "/documents");
    return FileReply(call, store, *found, *file);
  };
  return WithPart(catalog, call, id, give);
}

Reply RemoveDocument(SharedCatalog& catalog, const Call& call) {
  if (const auto errors = CheckQuery(call, {}); !errors.empty()) return ProblemReply(422, errors);
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  auto by = std::get<catalog::Signature>(signature);
  by.key.clear();  // it is there once
  const auto [id, sha256] = PartAndHash(call);
  const auto written = catalog.With([&, id = id, hash = sha256](catalog::Store& store) {
    return DocumentFiles::Remove(store, id, hash, by);
  });
  return written.status == WriteStatus::kNotFound ? NoDocument(id, sha256)
                                                  : Reply{204, "", "", {}, {}};
}

std::vector<Route> DocumentRoutes(SharedCatalog& catalog) {
  const auto answer = [&](Reply (*give)(SharedCatalog&, const Call&)) {
    return [&catalog, give](const Call& call) { return give(catalog, call); };
  };
  const std::string all = "/v1/parts/{id}/documents", one = all + "/{sha256}";
  return {{"GET", all, "documents of a part and which of their files are kept; query revision",
           Access::kRead, answer(ListDocuments)},
          {"POST", all, "adds a document with its file, at most 20 MiB; query link, sha256",
           Access::kWrite, answer(AddDocument), api::DocumentTypes()},
          {"GET", one, "the file of a document, to be saved; query revision", Access::kRead,
           answer(GetDocument)},
          {"DELETE", one, "takes a document off the part; its file stays for older revisions",
           Access::kWrite, answer(RemoveDocument)}};
}

}  // namespace plenum::server
