#include "api/catalogue/part_document.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "api/catalogue/part_details.h"
#include "api/catalogue/printed/printed_document.h"
#include "api/json/json.h"
#include "api/json/reader.h"
#include "api/json/request_limits.h"
#include "api/json/words.h"
#include "catalog/fields/fields.h"
#include "catalog/fields/price.h"
#include "catalog/store/store.h"

namespace plenum::api {
namespace {

constexpr std::size_t kIdMax = 100;
constexpr std::size_t kNotesMax = 4000;
constexpr double kUncertaintyMin = 1e-6;

const char* const kCurveProvenances[] = {"free_air", "current"};

Json RenderProvenance(catalog::Provenance provenance, const std::string& source,
                      const std::optional<double>& uncertainty = {}) {
  Json json = {{"kind", std::string(Name(provenance))}, {"source", source}};
  if (uncertainty) json["uncertainty"] = *uncertainty;
  return json;
}

// Lower case letters and digits of manufacturer and part number, joined by single hyphens.
std::string Slug(const std::string& text) {
  std::string slug;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      slug += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!slug.empty() && slug.back() != '-')
      slug += '-';
  }
  slug.resize(std::min(slug.size(), kIdMax));
  if (!slug.empty() && slug.back() == '-') slug.pop_back();
  return slug;
}

const catalog::Family* ReadFamily(Reader& reader) {
  std::vector<std::string> names;
  for (const catalog::Family& family : catalog::Families()) names.emplace_back(family.name);
  return catalog::FindFamily(reader.Choice("family", names));
}

void ReadNumbers(Reader& reader, const catalog::Family& family, catalog::Part& part) {
  for (const catalog::NumberField& field : family.numbers) {
    const std::string name(field.name);
    if (!reader.Has(name) || IsPrinted(reader, name)) continue;
    part.numbers[name] = {reader.Number(name, {field.min, field.max}),
                          catalog::Provenance::kThirdParty, "user"};
  }
}

void ReadTexts(Reader& reader, const catalog::Family& family, catalog::Part& part) {
  for (const catalog::TextField& field : family.texts) {
    const std::string name(field.name);
    if (!reader.Has(name)) continue;
    const std::vector<std::string> allowed(field.allowed.begin(), field.allowed.end());
    part.texts[name] = {allowed.empty() ? reader.Text(name) : reader.Choice(name, allowed),
                        catalog::Provenance::kThirdParty, "user"};
  }
}

void ReadCurve(Reader& reader, catalog::CurveKind kind, catalog::Part& part) {
  if (!reader.Has("curve")) return;
  if (IsPrinted(reader, "curve")) return DerivePrintedCurve(reader, part);
  const auto [lowest, highest] = catalog::CurvePressuresKpaGauge(kind);
  catalog::Curve curve;
  curve.free_air_source = curve.current_source = "user";
  for (const Element& element : reader.List("curve", 1, kTablePointsMax)) {
    Reader point(element, reader.errors());
    curve.points.push_back({point.Number("pressure_kpa_gauge", {lowest, highest}),
                            point.Number("free_air_l_per_min", {0, 1e6}),
                            point.Number("current_a", {0, 1e4})});
    point.Finish();
  }
  part.curve = std::move(curve);
}

// Provenance, source and uncertainty of a field of the part, null where it has none.
struct NumberOrigin {
  catalog::Provenance* provenance = nullptr;
  std::string* source = nullptr;
  std::optional<double>* uncertainty = nullptr;  // null for texts
  bool is_printed = false;                       // derived by this reading
};
NumberOrigin OriginOf(catalog::Part& part, const std::string& field) {
  if (const auto found = part.numbers.find(field); found != part.numbers.end()) {
    catalog::Number& number = found->second;
    return {&number.provenance, &number.source, &number.uncertainty};
  }
  if (const auto text = part.texts.find(field); text != part.texts.end())
    return {&text->second.provenance, &text->second.source};
  if (!part.curve) return {};
  catalog::Curve& curve = *part.curve;
  if (field == "free_air")
    return {&curve.free_air_provenance, &curve.free_air_source, &curve.free_air_uncertainty};
  if (field == "current")
    return {&curve.current_provenance, &curve.current_source, &curve.current_uncertainty};
  return {};
}

void ReadOrigin(Reader& given, const NumberOrigin& origin) {
  const auto known = catalog::ProvenanceNames();
  const std::string kind = given.Choice("kind", {known.begin(), known.end()}, "third_party");
  const Json* source = given.Raw("source");
  if (source != nullptr && !source->is_string())
    given.Fail("source", "must be a text, not " + KindOf(*source));
  if (origin.uncertainty != nullptr) {
    const auto uncertainty = given.OptionalNumber("uncertainty", {kUncertaintyMin, 1});
    // What was estimated here from what is printed keeps the error of its law.
    if (uncertainty || !origin.is_printed) *origin.uncertainty = uncertainty;
  }
  given.Finish();
  if (origin.source == nullptr) return;
  const bool has_source = source != nullptr && source->is_string();
  // What was derived here from what is printed stays so, and its formula stands before the source.
  if (origin.is_printed) {
    if (has_source) *origin.source += "; " + source->get<std::string>();
    return;
  }
  *origin.provenance = catalog::ProvenanceFromName(kind).value_or(catalog::Provenance::kThirdParty);
  *origin.source = has_source ? source->get<std::string>() : "user";
}

void ReadProvenance(Reader& reader, const catalog::Family& family, catalog::Part& part) {
  auto provenance = reader.OptionalObject("provenance");
  if (!provenance) return;
  std::vector<std::string> fields;
  for (const catalog::NumberField& field : family.numbers) fields.emplace_back(field.name);
  for (const catalog::TextField& field : family.texts) fields.emplace_back(field.name);
  if (family.has_curve())
    fields.insert(fields.end(), std::begin(kCurveProvenances), std::end(kCurveProvenances));
  for (const std::string& field : fields) {
    auto given = provenance->OptionalObject(field);
    if (!given) continue;
    NumberOrigin origin = OriginOf(part, field);
    const std::string given_as = field == "free_air" || field == "current" ? "curve" : field;
    origin.is_printed = reader.Has(given_as) && IsPrinted(reader, given_as);
    ReadOrigin(*given, origin);
    if (origin.source == nullptr) provenance->Fail(field, "the part has no value of " + field);
  }
  provenance->Finish();
}

// Where a field of Validate is in the document: "x" is a value, "x.source" and
// "x.uncertainty" belong to its provenance.
std::string PointerTo(std::string_view field) {
  if (field.empty()) return "";
  for (const std::string_view suffix : {".source", ".uncertainty"}) {
    if (!field.ends_with(suffix)) continue;
    field.remove_suffix(suffix.size());
    return "/provenance/" + EscapePointer(field) + "/" + std::string(suffix.substr(1));
  }
  return "/" + EscapePointer(field);
}

// What Validate finds beyond what reading has reported for the same field.
void AddFieldErrors(const catalog::Part& part, Errors& errors) {
  const Errors read = errors;
  for (const catalog::FieldError& error : catalog::Validate(part)) {
    const std::string pointer = PointerTo(error.field);
    const bool reported =
        !pointer.empty() && std::any_of(read.begin(), read.end(), [&](const Error& other) {
          return other.pointer == pointer || other.pointer.starts_with(pointer + "/");
        });
    if (!reported) errors.push_back({pointer, error.detail});
  }
}

}  // namespace

Json RenderPart(const catalog::Part& part) {
  Json document = {{"id", part.id},
                   {"family", part.family},
                   {"manufacturer", part.manufacturer},
                   {"part_number", part.part_number},
                   {"origin", part.origin},
                   {"notes", part.notes}};
  RenderDetails(part, document);
  Json provenance = Json::object();
  for (const auto& [field, number] : part.numbers) {
    document[field] = number.value;
    provenance[field] = RenderProvenance(number.provenance, number.source, number.uncertainty);
  }
  for (const auto& [field, text] : part.texts) {
    document[field] = text.value;
    provenance[field] = RenderProvenance(text.provenance, text.source);
  }
  if (part.curve) {
    Json& points = document["curve"] = Json::array();
    for (const catalog::CurvePoint& point : part.curve->points)
      points.push_back({{"pressure_kpa_gauge", point.pressure_kpa_gauge},
                        {"free_air_l_per_min", point.free_air_l_per_min},
                        {"current_a", point.current_a}});
    provenance["free_air"] =
        RenderProvenance(part.curve->free_air_provenance, part.curve->free_air_source,
                         part.curve->free_air_uncertainty);
    provenance["current"] =
        RenderProvenance(part.curve->current_provenance, part.curve->current_source,
                         part.curve->current_uncertainty);
  }
  document["provenance"] = std::move(provenance);
  return document;
}

Parsed<catalog::Part> ParsePart(const Json& request) {
  Errors errors;
  Reader reader(request, "", errors);
  catalog::Part part;
  const catalog::Family* family = ReadFamily(reader);
  // Without its family no other field of the part can be judged.
  if (family == nullptr) return errors;
  part.family = family->name;
  part.manufacturer = reader.Text("manufacturer");
  part.part_number = reader.Text("part_number");
  part.id = reader.Text("id", Slug(part.manufacturer + "-" + part.part_number));
  for (const char* of_answers : {"origin", "understood", "warnings"}) reader.Raw(of_answers);
  part.notes = ReadFreeText(reader, "notes", kNotesMax);
  ReadDetails(reader, part);
  ReadNumbers(reader, *family, part);
  DerivePrinted(reader, *family, part);
  ReadTexts(reader, *family, part);
  if (family->has_curve()) ReadCurve(reader, family->curve, part);
  ReadProvenance(reader, *family, part);
  reader.Finish();
  catalog::DerivePrice(part);
  AddFieldErrors(part, errors);
  if (!errors.empty()) return errors;
  return part;
}

Json RenderRevisionName(const catalog::Revision& revision) {
  return {{"number", revision.number}, {"hash", revision.hash}};
}

Json RenderRevision(const catalog::Revision& revision) {
  Json document = RenderRevisionName(revision);
  document["at"] = revision.at;
  document["who"] = revision.who;
  document["what"] = revision.what;
  return document;
}

Json RenderChange(const catalog::Change& change) {
  return {{"id", change.id},
          {"before", change.before ? RenderPart(*change.before) : Json()},
          {"after", change.after ? RenderPart(*change.after) : Json()}};
}

}  // namespace plenum::api
