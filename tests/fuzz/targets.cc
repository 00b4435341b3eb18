#include "tests/fuzz/targets.h"

#include <map>
#include <string>
#include <vector>

#include "api/catalogue/part_query.h"
#include "api/catalogue/stores.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "api/measure/measurement.h"
#include "catalog/fields/csv.h"
#include "catalog/fields/fields.h"
#include "catalog/tables/part_rows.h"
#include "catalog/tables/reading.h"
#include "server/wire/request_frame.h"

namespace plenum::fuzz {

void Requirements(std::string_view text) {
  const auto json = api::ParseJson(text);
  if (const auto* document = std::get_if<api::Json>(&json)) {
    document->dump(-1, ' ', false, api::Json::error_handler_t::replace);
    const auto parsed = api::ParseRequirements(*document, {});
    if (const auto* errors = std::get_if<api::Errors>(&parsed)) Require(!errors->empty());
  }
}

void Measurement(std::string_view text) {
  const auto json = api::ParseJson(text);
  if (const auto* document = std::get_if<api::Json>(&json)) api::ParseMeasurement(*document);
}

// As a table of any dialect: parts that are right, or errors, or questions.
void Table(std::string_view family, std::string_view bytes) {
  const auto reading = catalog::ReadTable(family, bytes);
  if (!reading.questions.empty() || !reading.errors.empty()) return;
  std::vector<catalog::Part> parts;
  const auto errors =
      catalog::ReadRows(family, catalog::RowsOf(reading, bytes),
                        [&](catalog::Part part, int) { parts.push_back(std::move(part)); });
  if (errors.count > 0) return;
  for (const catalog::Part& part : parts) Require(catalog::Validate(part).empty());
}

void Csv(std::string_view text) {
  if (text.empty()) return;
  const auto families = catalog::Families();
  const auto& family = families[static_cast<unsigned char>(text[0]) % families.size()];
  Table(family.name, text.substr(1));
  const auto csv = catalog::ReadCsv(std::string(family.name), text.substr(1));
  if (!csv.errors.empty()) return;
  // What was read without an error is written and read again as it was.
  const std::string written = catalog::WriteCsv(std::string(family.name), csv.parts);
  const auto again = catalog::ReadCsv(std::string(family.name), written);
  Require(again.errors.empty() && again.parts == csv.parts);
}

void Query(std::string_view text) {
  std::multimap<std::string, std::string> query;
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(text.size(), pair.size() + 1));
    const auto equals = std::min(pair.find('='), pair.size());
    query.emplace(pair.substr(0, equals), pair.substr(std::min(pair.size(), equals + 1)));
  }
  const auto parsed = api::ParsePartQuery(query);
  static const std::vector<catalog::Part> kNone;
  static const api::PartTable kTable(kNone);
  if (const auto* found = std::get_if<api::PartQuery>(&parsed)) api::RenderPage(*found, {}, kTable);
}

void Frame(std::string_view text) {
  using server::RequestFrame;
  // The same end is found however the bytes come.
  RequestFrame whole, piecewise;
  const auto state = whole.Look(text);
  auto last = RequestFrame::State::kHead;
  for (std::size_t size = 1; size <= text.size() && last < RequestFrame::State::kComplete; ++size)
    last = piecewise.Look(text.substr(0, size));
  if (state == RequestFrame::State::kComplete) {
    Require(last == state && whole.size() == piecewise.size() && whole.size() <= text.size());
    std::string bytes(text);
    const std::size_t head = whole.head_size();
    whole.TakeHead(bytes);
    Require(whole.TakeBody(bytes).size() + head <= whole.size());
    Require(bytes == text.substr(whole.size()));
  }
}

}  // namespace plenum::fuzz
