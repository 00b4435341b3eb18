#include "server/resources/history_resource.h"

#include <charconv>
#include <cstdint>

#include "api/catalogue/part_document.h"
#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "server/call/signature.h"
#include "server/resources/import_parts.h"

namespace plenum::server {
namespace {

constexpr int kLimitDefault = 100;
constexpr int kLimitMax = 1000;

std::optional<std::int64_t> Whole(const std::string& text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

// How many entries, and the cursor: the number of the last revision seen, or the last id.
struct Page {
  int limit = kLimitDefault;
  std::int64_t below = INT64_MAX;
  std::string after;
  api::Errors errors;
};

enum class CursorIs { kRevision, kPart };

Page ReadPage(const Call& call, CursorIs cursor = CursorIs::kRevision) {
  Page page;
  page.errors = CheckQuery(call, {"limit", "cursor"});
  if (const auto text = QueryValue(call, "limit")) {
    const auto limit = Whole(*text);
    if (limit && *limit >= 1 && *limit <= kLimitMax)
      page.limit = static_cast<int>(*limit);
    else
      page.errors.push_back({"/limit", "must be an integer ≥ 1 and ≤ " + std::to_string(kLimitMax) +
                                           ", not \"" + *text + "\""});
  }
  if (cursor == CursorIs::kPart) {
    page.after = QueryValue(call, "cursor").value_or("");
  } else if (const auto text = QueryValue(call, "cursor"); text && !text->empty()) {
    const auto below = Whole(*text);
    page.below = below.value_or(0);
    if (!below)
      page.errors.push_back(
          {"/cursor", "must be the next_cursor of the page before, not \"" + *text + "\""});
  }
  return page;
}

Reply NoRevision(const std::string& number) {
  return ProblemReply(404, "the catalogue has no revision " + number);
}

}  // namespace

Reply PartHistory(SharedCatalog& catalog, const Call& call) {
  const Page page = ReadPage(call);
  if (!page.errors.empty()) return ProblemReply(422, page.errors);
  return catalog.past().With([&](const catalog::Store& store) {
    const auto changes = store.History(call.argument, page.below, page.limit + 1);
    if (changes.empty() && page.below == INT64_MAX && !store.Get(call.argument))
      return ProblemReply(404, "no part has or had the id " + call.argument);
    api::Json history = api::Json::array(), next_cursor;
    for (const catalog::Change& change : changes) {
      if (static_cast<int>(history.size()) == page.limit) {
        next_cursor = std::to_string(history.back()["revision"]["number"].get<std::int64_t>());
        break;
      }
      api::Json entry = {{"revision", api::RenderRevision(change.revision)}};
      entry.update(api::RenderChange(change));
      entry.erase("id");
      history.push_back(std::move(entry));
    }
    return JsonReply(200, {{"id", call.argument},
                           {"history", std::move(history)},
                           {"next_cursor", std::move(next_cursor)},
                           {"catalogue_revision", api::RenderRevisionName(store.Head())}});
  });
}

Reply ListRevisions(SharedCatalog& catalog, const Call& call) {
  const Page page = ReadPage(call);
  if (!page.errors.empty()) return ProblemReply(422, page.errors);
  const auto revisions = catalog.past().With(
      [&](const catalog::Store& store) { return store.Revisions(page.below, page.limit + 1); });
  api::Json list = api::Json::array(), next_cursor;
  for (const catalog::Revision& revision : revisions) {
    if (static_cast<int>(list.size()) == page.limit) {
      next_cursor = std::to_string(list.back()["number"].get<std::int64_t>());
      break;
    }
    list.push_back(api::RenderRevision(revision));
  }
  return JsonReply(200, {{"revisions", std::move(list)}, {"next_cursor", std::move(next_cursor)}});
}

Reply GetRevision(SharedCatalog& catalog, const Call& call) {
  const Page page = ReadPage(call, CursorIs::kPart);
  if (!page.errors.empty()) return ProblemReply(422, page.errors);
  const auto number = Whole(call.argument);
  std::optional<catalog::Revision> revision;
  const auto changes = catalog.past().With([&](const catalog::Store& store) {
    revision = number ? store.FindRevision(*number) : std::nullopt;
    return revision ? store.Changes(*revision, page.after, page.limit + 1)
                    : std::vector<catalog::Change>();
  });
  if (!revision) return NoRevision(call.argument);
  api::Json document = api::RenderRevision(*revision), next_cursor;
  api::Json& list = document["changes"] = api::Json::array();
  for (const catalog::Change& change : changes) {
    if (static_cast<int>(list.size()) == page.limit) {
      next_cursor = list.back()["id"];
      break;
    }
    list.push_back(api::RenderChange(change));
  }
  document["next_cursor"] = std::move(next_cursor);
  return JsonReply(200, document);
}

Reply UndoRevision(SharedCatalog& catalog, const Call& call) {
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  const auto number = Whole(call.argument);
  if (!number) return NoRevision(call.argument);
  const auto written = catalog.WithLong([&](catalog::Store& store) {
    return store.Undo(*number, std::get<catalog::Signature>(signature));
  });
  switch (written.status) {
    case catalog::WriteStatus::kNotFound:
      return NoRevision(call.argument);
    case catalog::WriteStatus::kSuperseded:
      return ProblemReply(409, FieldErrors(written.errors));
    case catalog::WriteStatus::kInvalid:
      return ProblemReply(422, FieldErrors(written.errors));
    case catalog::WriteStatus::kKeyReused:
      return KeyReused();
    default:
      return JsonReply(200, api::RenderRevision(written.revision));
  }
}

}  // namespace plenum::server
