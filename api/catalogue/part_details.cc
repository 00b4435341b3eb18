#include "api/catalogue/part_details.h"

#include <string>
#include <vector>

#include "api/json/request_limits.h"
#include "api/json/schema_recorder.h"
#include "api/json/words.h"
#include "catalog/fields/price.h"

namespace plenum::api {
namespace {

// The catalogue's own limits, so that a request is refused with pointers to each item.
constexpr std::size_t kListedMax = 16;
constexpr std::size_t kLinkMax = 1000;
constexpr std::size_t kDateMax = 10;
constexpr std::size_t kDigestMax = 64;
constexpr Range kPrice{0, 1e9};
const Range kPack = Above(0, 1e6);

std::vector<std::string> CurrencyNames() {
  const std::vector<std::string_view> known = catalog::Currencies();
  return {known.begin(), known.end()};
}

std::optional<bool> ReadOrderable(Reader& reader) {
  const Json* orderable = reader.Raw("orderable");
  if (orderable == nullptr || orderable->is_null()) return std::nullopt;
  if (orderable->is_boolean()) return orderable->get<bool>();
  reader.Fail("orderable",
              "must be true, false, or null where it is not known, not " + KindOf(*orderable));
  return std::nullopt;
}

catalog::Offer ReadOffer(Reader reader) {
  catalog::Offer offer;
  offer.supplier = reader.Text("supplier");
  offer.price = reader.Number("price", kPrice);
  offer.currency = reader.Choice("currency", CurrencyNames());
  offer.pack = reader.Number("pack", kPack, 1.0);
  offer.date = ReadFreeText(reader, "date", kDateMax);
  offer.link = ReadFreeText(reader, "link", kLinkMax);
  reader.Finish();
  return offer;
}

catalog::Document ReadDocument(Reader reader) {
  catalog::Document document;
  document.link = ReadFreeText(reader, "link", kLinkMax);
  document.sha256 = ReadFreeText(reader, "sha256", kDigestMax);
  reader.Finish();
  return document;
}

Json NullOr(Json form) { return {{"anyOf", {std::move(form), {{"type", "null"}}}}}; }

Json FreeText(std::size_t longest, const char* description) {
  return {{"type", {"string", "null"}}, {"maxLength", longest}, {"description", description}};
}

Json ListForm(Json item, const char* description) {
  return NullOr({{"type", "array"},
                 {"maxItems", kListedMax},
                 {"items", std::move(item)},
                 {"description", description}});
}

Json ObjectForm(Json properties, Json required) {
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

}  // namespace

std::string ReadFreeText(Reader& reader, std::string_view name, std::size_t longest) {
  const Json* text = reader.Raw(name);
  if (text == nullptr || text->is_null()) return "";
  if (text->is_string() && CountCharacters(text->get_ref<const std::string&>()) <= longest)
    return text->get<std::string>();
  reader.Fail(name, "must be a text of at most " + std::to_string(longest) + " characters");
  return "";
}

void ReadDetails(Reader& reader, catalog::Part& part) {
  part.series = ReadFreeText(reader, "series", kTextCharactersMax);
  part.orderable = ReadOrderable(reader);
  if (reader.Has("aliases")) part.aliases = reader.Texts("aliases", 0, kListedMax);
  if (reader.Has("offers"))
    for (const Element& element : reader.List("offers", 0, kListedMax))
      part.offers.push_back(ReadOffer({element, reader.errors()}));
  if (reader.Has("documents"))
    for (const Element& element : reader.List("documents", 0, kListedMax))
      part.documents.push_back(ReadDocument({element, reader.errors()}));
}

void RenderDetails(const catalog::Part& part, Json& document) {
  document["series"] = part.series;
  document["orderable"] = part.orderable ? Json(*part.orderable) : Json(nullptr);
  document["aliases"] = part.aliases;
  Json& offers = document["offers"] = Json::array();
  for (const catalog::Offer& offer : part.offers)
    offers.push_back({{"supplier", offer.supplier},
                      {"price", offer.price},
                      {"currency", offer.currency},
                      {"pack", offer.pack},
                      {"date", offer.date},
                      {"link", offer.link}});
  Json& documents = document["documents"] = Json::array();
  for (const catalog::Document& given : part.documents)
    documents.push_back({{"link", given.link}, {"sha256", given.sha256}});
}

Json DetailForms() {
  const Json text = {{"type", "string"}, {"minLength", 1}, {"maxLength", kTextCharactersMax}};
  const Json offer =
      ObjectForm({{"supplier", text},
                  {"price", NumberForm(kPrice)},
                  {"currency", {{"enum", CurrencyNames()}}},
                  {"pack", NullOr(NumberForm(kPack))},
                  {"date", FreeText(kDateMax, "2024, 2024-05 or 2024-05-31; empty: not known")},
                  {"link", FreeText(kLinkMax, "where it is offered")}},
                 {"supplier", "price", "currency"});
  const Json document =
      ObjectForm({{"link", FreeText(kLinkMax, "an address, or where the document is found")},
                  {"sha256", FreeText(kDigestMax, "64 hexadecimal digits")}},
                 Json::array());
  return {
      {"series", FreeText(kTextCharactersMax, "what variants of one part share")},
      {"orderable",
       {{"type", {"boolean", "null"}}, {"description", "a product one can order; null: unknown"}}},
      {"aliases", ListForm(text, "other names and numbers of the same part")},
      {"offers", ListForm(offer, "net of tax; the newest makes the price of a piece")},
      {"documents", ListForm(document, "data sheets and the like")}};
}

}  // namespace plenum::api
