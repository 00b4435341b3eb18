#include "server/resources/parts_resource.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "api/catalogue/catalog_check.h"
#include "api/catalogue/part_comparison.h"
#include "api/catalogue/part_document.h"
#include "api/catalogue/part_query.h"
#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/problem_document.h"
#include "api/json/remarks.h"
#include "api/json/request_limits.h"
#include "api/protocol/protocol_document.h"
#include "server/call/entity_tag.h"
#include "server/call/service_limits.h"
#include "server/call/signature.h"
#include "server/resources/import_parts.h"

namespace plenum::server {
namespace {

std::string ETagOf(const catalog::Part& part) { return ETag(Dump(api::RenderPart(part))); }

Reply NoPart(const std::string& id) { return ProblemReply(404, "no part has the id " + id); }

// `revision` is one in which the part is as shown.
Reply PartReply(int status, const catalog::Part& part, const catalog::Revision& revision) {
  auto reply = JsonReply(status, api::RenderPart(part));
  reply.headers.emplace_back("ETag", ETagOf(part));
  reply.headers.emplace_back("Catalogue-Revision",
                             std::to_string(revision.number) + " " + revision.hash);
  return reply;
}

// 304 where If-None-Match holds the reply's tag.
Reply UnlessKnown(const Call& call, const std::string& etag, Reply reply) {
  if (!IsKnown(call, etag)) return reply;
  reply.status = 304;
  reply.body.clear();
  return reply;
}

std::string Location(const std::string& id) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string path = "/v1/parts/";
  for (const char c : id) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        byte < 0x80 && (std::isalnum(byte) != 0 || c == '-' || c == '_' || c == '.' || c == '~');
    if (plain) {
      path += c;
    } else {
      path += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return path;
}

// The reply of a write, with what was understood of its body. A part's notes are its own.
Reply WrittenReply(int status, const catalog::Part& part, const catalog::Revision& revision,
                   const api::Remarks& remarks) {
  auto reply = PartReply(status, part, revision);
  api::Json document = api::RenderPart(part);
  if (!remarks.understood.empty()) document["understood"] = remarks.understood;
  if (!remarks.warnings.empty()) document["warnings"] = remarks.warnings;
  reply.body = JsonReply(status, document).body;
  return reply;
}

// The part in the body, or the reply that says what is wrong with it.
std::variant<catalog::Part, Reply> PartInBody(const Call& call) {
  auto json = api::ParseJson(call.body);
  if (auto* errors = std::get_if<api::Errors>(&json)) return ProblemReply(400, *errors);
  auto part = api::ParsePart(std::get<api::Json>(json));
  if (auto* errors = std::get_if<api::Errors>(&part)) return ProblemReply(422, *errors);
  return std::get<catalog::Part>(std::move(part));
}

void CheckFamily(const std::optional<std::string>& family, api::Errors& errors) {
  if (family && catalog::FindFamily(*family) == nullptr) {
    errors.push_back({"/family", "must be one of " + FamilyNames() + ", not \"" + *family + "\""});
  }
}

// Evaluated on the part as it is stored; writes its tag to `etag`.
catalog::Precondition IfMatch(const std::string& condition, std::string& etag) {
  return [&condition, &etag](const catalog::Part& stored) {
    etag = ETagOf(stored);
    return Holds(condition, etag, Compare::kStrong);
  };
}

Reply NoCondition(const char* what) {
  return ProblemReply(412,
                      std::string("If-Match is missing: send the ETag of the part to be ") + what);
}

Reply Changed(const std::string& etag) {
  return ProblemReply(412, "the part was changed: its ETag is now " + etag);
}

}  // namespace

Reply ListParts(SharedCatalog& catalog, const Call& call) {
  const auto parsed = api::ParsePartQuery(call.query);
  if (const auto* errors = std::get_if<api::Errors>(&parsed)) return ProblemReply(422, *errors);
  const auto& query = std::get<api::PartQuery>(parsed);

  auto number = query.revision;
  if (!number && query.cursor) number = query.cursor->revision;
  const auto view = number ? catalog.ViewAt(*number) : catalog.View();
  if (!view) return ProblemReply(404, "the catalogue has no revision " + std::to_string(*number));
  const auto page = api::RenderPage(query, view->revision, *view->table);
  if (const auto* errors = std::get_if<api::Errors>(&page)) return ProblemReply(422, *errors);
  Reply reply{200, "application/json", std::get<std::string>(page) + "\n", {}, {}};
  const std::string etag = ETag(reply.body);
  reply.headers.emplace_back("ETag", etag);
  return UnlessKnown(call, etag, std::move(reply));
}

namespace {

Reply GetNewest(SharedCatalog& catalog, const Call& call) {
  auto shown = catalog.replies().Find(catalog.Head(), call.argument);
  if (const auto view = shown ? std::nullopt : catalog.ViewMeanwhile()) {
    const auto* part = view->rows().Find(call.argument);
    if (part == nullptr) return NoPart(call.argument);
    shown = std::make_shared<const Reply>(PartReply(200, *part, view->revision));
  }
  if (!shown) {
    catalog.With([&](const catalog::Store& store) {
      const auto revision = store.Head();
      const auto part = store.GetAt(call.argument, revision.number);
      if (!part) return;
      shown = std::make_shared<const Reply>(PartReply(200, *part, revision));
      catalog.replies().Keep(revision, call.argument, *shown);
    });
  }
  if (!shown) return NoPart(call.argument);
  return UnlessKnown(call, shown->headers.front().second, *shown);
}

}  // namespace

Reply GetPart(SharedCatalog& catalog, const Call& call) {
  const auto errors = CheckQuery(call, {"revision"});
  if (!errors.empty()) return ProblemReply(422, errors);
  // The same reading of the number as in a list.
  const auto parsed = api::ParsePartQuery(call.query);
  if (const auto* wrong = std::get_if<api::Errors>(&parsed)) return ProblemReply(422, *wrong);
  const auto number = std::get<api::PartQuery>(parsed).revision;
  if (!number) return GetNewest(catalog, call);
  return catalog.past().With([&](const catalog::Store& store) {
    const auto revision = store.FindRevision(*number);
    if (!revision) {
      return ProblemReply(404, "the catalogue has no revision " + std::to_string(*number));
    }
    const auto part = store.GetAt(call.argument, revision->number);
    if (!part) return NoPart(call.argument);
    return UnlessKnown(call, ETagOf(*part), PartReply(200, *part, *revision));
  });
}

Reply GetProtocol(SharedCatalog& catalog, const Call& call) {
  const auto errors = CheckQuery(call, {"sensor_noise_kpa", "sensor_resolution_kpa", "sampling_hz",
                                        "bottle_l", "bottle_uncertainty"});
  if (!errors.empty()) return ProblemReply(422, errors);
  const auto sensor = api::ParseTestSensor(call.query);
  if (const auto* wrong = std::get_if<api::Errors>(&sensor)) return ProblemReply(422, *wrong);
  const CatalogView view = catalog.View();
  const catalog::Part* part = view.rows().Find(call.argument);
  if (part == nullptr) return NoPart(call.argument);
  return JsonReply(200, api::RenderProtocol(*part, std::get<api::TestSensor>(sensor)));
}

Reply AddPart(SharedCatalog& catalog, const Call& call) {
  api::RemarkRecorder recorder;
  auto body = PartInBody(call);
  if (auto* reply = std::get_if<Reply>(&body)) return std::move(*reply);
  const auto& part = std::get<catalog::Part>(body);
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  return catalog.With([&](catalog::Store& store) {
    const auto written = store.Add(part, std::get<catalog::Signature>(signature));
    switch (written.status) {
      case catalog::WriteStatus::kExists:
        return ProblemReply(409, "the id " + part.id + " is taken; PUT replaces a part");
      case catalog::WriteStatus::kInvalid:
        return ProblemReply(422, FieldErrors(written.errors));
      case catalog::WriteStatus::kKeyReused:
        return KeyReused();
      default:
        break;
    }
    // As it was added, also if it was changed between the request and its repetition.
    const auto added = store.GetAt(part.id, written.revision.number).value_or(part);
    auto reply = WrittenReply(201, added, written.revision, recorder.Take());
    reply.headers.emplace_back("Location", Location(part.id));
    return reply;
  });
}

Reply ReplacePart(SharedCatalog& catalog, const Call& call) {
  api::RemarkRecorder recorder;
  auto body = PartInBody(call);
  if (auto* reply = std::get_if<Reply>(&body)) return std::move(*reply);
  const auto& part = std::get<catalog::Part>(body);
  if (part.id != call.argument) {
    return ProblemReply(422, api::Errors{{"/id", "must be the id in the path, " + call.argument +
                                                     ", not " + part.id}});
  }
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  auto by = std::get<catalog::Signature>(signature);
  by.key.clear();  // If-Match makes it act once
  return catalog.With([&](catalog::Store& store) {
    if (!store.Get(part.id)) return NoPart(part.id);
    const auto condition = call.header("If-Match");
    if (!condition) return NoCondition("replaced");
    std::string etag;
    const auto written = store.Replace(part, by, IfMatch(*condition, etag));
    switch (written.status) {
      case catalog::WriteStatus::kInvalid:
        return ProblemReply(422, FieldErrors(written.errors));
      case catalog::WriteStatus::kNotFound:
        return NoPart(part.id);
      case catalog::WriteStatus::kChanged:
        return Changed(etag);
      default:
        return WrittenReply(200, part, written.revision, recorder.Take());
    }
  });
}

Reply RemovePart(SharedCatalog& catalog, const Call& call) {
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  auto by = std::get<catalog::Signature>(signature);
  by.key.clear();  // If-Match makes it act once
  return catalog.With([&](catalog::Store& store) {
    if (!store.Get(call.argument)) return NoPart(call.argument);
    const auto condition = call.header("If-Match");
    if (!condition) return NoCondition("removed");
    std::string etag;
    const auto written = store.Remove(call.argument, by, IfMatch(*condition, etag));
    if (written.status == catalog::WriteStatus::kNotFound) return NoPart(call.argument);
    if (written.status == catalog::WriteStatus::kChanged) return Changed(etag);
    return Reply{204, "", "", {}, {}};
  });
}

Reply ExportParts(SharedCatalog& catalog, const Call& call) {
  auto errors = CheckQuery(call, {"family"});
  const auto family = QueryValue(call, "family");
  if (!family) errors.push_back({"/family", "is missing; one of " + FamilyNames()});
  CheckFamily(family, errors);
  if (!errors.empty()) return ProblemReply(422, errors);
  Reply reply{200,
              "text/csv; charset=utf-8; header=present",
              "",
              {{"Content-Disposition", "attachment; filename=\"" + *family + ".csv\""}},
              {}};
  reply.produce = [view = catalog.View(), family = *family, next = std::size_t{0},
                   begun = false](std::string& piece) mutable {
    if (!std::exchange(begun, true)) piece = catalog::WriteCsv(family, {});
    const api::PartRows& all = view.rows();
    for (; next < all.size() && piece.size() < kPieceBytes; ++next)
      if (all[next].family == family) piece += catalog::WriteCsvRow(all[next]);
    return next < all.size() ? Flow::kMore : Flow::kEnds;
  };
  return reply;
}

Reply GetPartsCheck(SharedCatalog& catalog, const Call& call) {
  if (const auto errors = CheckQuery(call, {}); !errors.empty()) return ProblemReply(422, errors);
  const auto view = catalog.View();
  api::Json json = {{"parts", view.rows().size()}};
  json.update(api::RenderCheck(api::CheckParts(*view.parts())));
  json["catalogue_revision"] = api::RenderRevisionName(view.revision);
  return JsonReply(200, json);
}

Reply GetPartsComparison(SharedCatalog& catalog, const Call& call) {
  if (const auto errors = CheckQuery(call, {"ids"}); !errors.empty())
    return ProblemReply(422, errors);
  const auto ids = api::SplitIds(QueryValue(call, "ids").value_or(""));
  if (const auto wrong = api::CheckCompared(ids); !wrong.empty()) return ProblemReply(422, wrong);
  const auto view = catalog.View();
  std::vector<catalog::Part> parts;
  parts.reserve(ids.size());
  for (const auto& id : ids) {
    const catalog::Part* part = view.rows().Find(id);
    if (part == nullptr) return NoPart(id);
    parts.push_back(*part);
  }
  api::Json json = api::RenderComparison(parts);
  json["catalogue_revision"] = api::RenderRevisionName(view.revision);
  return JsonReply(200, json);
}

namespace {

std::optional<Reply> RefuseTable(std::string_view text) {
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  if (lines <= kImportRowsMax) return std::nullopt;
  return LimitReply(413, "import_rows_max", kImportRowsMax,
                    "the table has too many rows; send it in parts");
}

std::vector<std::string> QueryValues(const Call& call, const std::string& name) {
  std::vector<std::string> values;
  const auto [begin, end] = call.query.equal_range(name);
  for (auto it = begin; it != end; ++it) values.push_back(it->second);
  return values;
}

catalog::TableOptions ReadTableOptions(const Call& call, api::Errors& errors) {
  catalog::TableOptions options;
  options.encoding = QueryValue(call, "encoding").value_or("");
  options.delimiter = QueryValue(call, "delimiter").value_or("");
  options.decimal = QueryValue(call, "decimal").value_or("");
  if (const auto row = QueryValue(call, "header_row")) {
    const auto [end, error] =
        std::from_chars(row->data(), row->data() + row->size(), options.header_row);
    if (error != std::errc() || end != row->data() + row->size() || options.header_row < 1)
      errors.push_back({"/header_row", "must be a row of the table, from 1, not " + *row});
  }
  api::ReadTableColumns(QueryValues(call, "column"), options, errors);
  api::ReadTableSet(QueryValues(call, "set"), options, errors);
  return options;
}

// With what is asked and what was understood so far.
Reply TableProblem(const api::Errors& errors, const catalog::TableReading& reading) {
  api::Json problem = api::ProblemDocument(422, errors);
  problem["questions"] = api::RenderQuestions(reading);
  problem["understood"] = api::RenderUnderstood(reading);
  Reply reply = JsonReply(422, problem);
  reply.content_type = "application/problem+json";
  return reply;
}

}  // namespace

Reply ImportParts(SharedCatalog& catalog, const Call& call) {
  auto errors =
      CheckQuery(call, {"family", "dry_run", "encoding", "delimiter", "decimal", "header_row"},
                 {"column", "set"});
  const auto family = QueryValue(call, "family");
  if (!family) errors.push_back({"/family", "is missing; one of " + FamilyNames()});
  const bool dry_run = ReadFlag(call, "dry_run", errors);
  const auto options = ReadTableOptions(call, errors);
  if (!errors.empty()) return ProblemReply(422, errors);
  if (auto refused = RefuseTable(call.body)) return *refused;
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  // Without the store: others may have it meanwhile.
  const auto reading = catalog::ReadTable(*family, call.body, options);
  const auto wrong = CheckTable(reading, call.body);
  if (!wrong.empty()) return TableProblem(wrong, reading);
  const auto result = catalog.WithLong([&](catalog::Store& store) {
    return ImportTable(store, reading, call.body, dry_run, std::get<catalog::Signature>(signature));
  });
  if (!result.errors.empty()) return TableProblem(result.errors, reading);
  if (result.status == catalog::WriteStatus::kKeyReused) return KeyReused();
  return JsonReply(200, ToJson(result, reading, dry_run));
}

}  // namespace plenum::server
