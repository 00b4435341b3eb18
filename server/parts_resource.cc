#include "server/parts_resource.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "api/services.h"
#include "server/import_parts.h"

namespace plenum::server {
namespace {

constexpr int kLimitDefault = 100;
constexpr int kLimitMax = 1000;

std::string ETag(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  char digits[17] = {};
  std::to_chars(digits, digits + 16, hash, 16);
  return "\"" + std::string(digits) + "\"";
}

std::string ETag(const catalog::Part& part) { return ETag(Dump(api::RenderPart(part))); }

// Whether a list of entity tags, as in If-Match, holds `etag`. Weak tags never match.
bool Holds(const std::string& list, const std::string& etag) {
  for (std::size_t start = 0; start <= list.size();) {
    std::size_t end = std::min(list.find(',', start), list.size());
    std::string item = list.substr(start, end - start);
    item.erase(0, item.find_first_not_of(" \t"));
    item.erase(item.find_last_not_of(" \t") + 1);
    if (item == "*" || item == etag) return true;
    start = end + 1;
  }
  return false;
}

Reply NoPart(const std::string& id) { return ProblemReply(404, "no part has the id " + id); }

Reply PartReply(int status, const catalog::Part& part) {
  auto reply = JsonReply(status, api::RenderPart(part));
  reply.headers.emplace_back("ETag", ETag(part));
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

int ReadLimit(const Call& call, api::Errors& errors) {
  const auto text = QueryValue(call, "limit");
  if (!text) return kLimitDefault;
  int limit = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), limit);
  if (error != std::errc() || end != text->data() + text->size() || limit < 1 ||
      limit > kLimitMax) {
    errors.push_back({"/limit", "must be an integer ≥ 1 and ≤ " + std::to_string(kLimitMax) +
                                    ", not \"" + *text + "\""});
  }
  return limit;
}

}  // namespace

Reply ListParts(SharedCatalog& catalog, const Call& call) {
  auto errors = CheckQuery(call, {"family", "limit", "cursor"});
  const auto family = QueryValue(call, "family");
  CheckFamily(family, errors);
  const int limit = ReadLimit(call, errors);
  if (!errors.empty()) return ProblemReply(422, errors);
  const std::string cursor = QueryValue(call, "cursor").value_or("");

  const Parts parts = catalog.Snapshot();
  api::Json list = api::Json::array();
  api::Json next_cursor;
  for (const auto& part : *parts) {
    if (part.id <= cursor || (family && part.family != *family)) continue;
    if (static_cast<int>(list.size()) == limit) {
      next_cursor = list.back().at("id");
      break;
    }
    list.push_back(api::RenderPart(part));
  }
  return JsonReply(200, {{"parts", std::move(list)}, {"next_cursor", std::move(next_cursor)}});
}

Reply GetPart(SharedCatalog& catalog, const Call& call) {
  const auto part = catalog.With([&](auto& store) { return store.Get(call.argument); });
  if (!part) return NoPart(call.argument);
  auto reply = PartReply(200, *part);
  const auto condition = call.header("If-None-Match");
  if (condition && Holds(*condition, ETag(*part))) {
    reply.status = 304;
    reply.body.clear();
  }
  return reply;
}

Reply AddPart(SharedCatalog& catalog, const Call& call) {
  auto body = PartInBody(call);
  if (auto* reply = std::get_if<Reply>(&body)) return std::move(*reply);
  const auto& part = std::get<catalog::Part>(body);
  return catalog.With([&](catalog::Store& store) {
    const auto written = store.Add(part);
    if (written.status == catalog::WriteStatus::kExists) {
      return ProblemReply(409, "the id " + part.id + " is taken; PUT replaces a part");
    }
    if (written.status == catalog::WriteStatus::kInvalid) {
      return ProblemReply(422, FieldErrors(written.errors));
    }
    auto reply = PartReply(201, store.Get(part.id).value_or(part));
    reply.headers.emplace_back("Location", Location(part.id));
    return reply;
  });
}

Reply ReplacePart(SharedCatalog& catalog, const Call& call) {
  auto body = PartInBody(call);
  if (auto* reply = std::get_if<Reply>(&body)) return std::move(*reply);
  const auto& part = std::get<catalog::Part>(body);
  if (part.id != call.argument) {
    return ProblemReply(422, api::Errors{{"/id", "must be the id in the path, " + call.argument +
                                                     ", not " + part.id}});
  }
  return catalog.With([&](catalog::Store& store) {
    const auto old = store.Get(part.id);
    if (!old) return NoPart(part.id);
    const auto condition = call.header("If-Match");
    if (!condition) {
      return ProblemReply(412, "If-Match is missing: send the ETag of the part to be replaced");
    }
    if (!Holds(*condition, ETag(*old))) {
      return ProblemReply(412, "the part was changed: its ETag is now " + ETag(*old));
    }
    const auto written = store.Replace(part);
    if (written.status == catalog::WriteStatus::kInvalid) {
      return ProblemReply(422, FieldErrors(written.errors));
    }
    if (written.status == catalog::WriteStatus::kNotFound) return NoPart(part.id);
    return PartReply(200, store.Get(part.id).value_or(part));
  });
}

Reply RemovePart(SharedCatalog& catalog, const Call& call) {
  return catalog.With([&](catalog::Store& store) {
    const auto old = store.Get(call.argument);
    if (!old) return NoPart(call.argument);
    const auto condition = call.header("If-Match");
    if (condition && !Holds(*condition, ETag(*old))) {
      return ProblemReply(412, "the part was changed: its ETag is now " + ETag(*old));
    }
    if (store.Remove(call.argument).status == catalog::WriteStatus::kNotFound) {
      return NoPart(call.argument);
    }
    return Reply{204, "", "", {}, {}};
  });
}

Reply ExportParts(SharedCatalog& catalog, const Call& call) {
  auto errors = CheckQuery(call, {"family"});
  const auto family = QueryValue(call, "family");
  if (!family) errors.push_back({"/family", "is missing; one of " + FamilyNames()});
  CheckFamily(family, errors);
  if (!errors.empty()) return ProblemReply(422, errors);
  const auto parts = catalog.With([&](auto& store) { return store.List(*family); });
  return {200,
          "text/csv; charset=utf-8; header=present",
          catalog::WriteCsv(*family, parts),
          {{"Content-Disposition", "attachment; filename=\"" + *family + ".csv\""}},
          {}};
}

Reply ImportParts(SharedCatalog& catalog, const Call& call) {
  auto errors = CheckQuery(call, {"family"});
  const auto family = QueryValue(call, "family");
  if (!family) errors.push_back({"/family", "is missing; one of " + FamilyNames()});
  if (!errors.empty()) return ProblemReply(422, errors);
  const auto result =
      catalog.With([&](auto& store) { return ImportCsv(store, *family, call.body, false); });
  if (!result.errors.empty()) return ProblemReply(422, result.errors);
  return JsonReply(200, ToJson(result));
}

}  // namespace plenum::server
