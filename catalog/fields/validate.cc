#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "catalog/fields/fields.h"
#include "catalog/fields/price.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kIdLongest = 100;
constexpr std::size_t kNameLongest = 200;
constexpr std::size_t kRemarkLongest = 4000;  // notes and sources
constexpr std::size_t kCurvePointsMost = 64;
constexpr double kCurveFlowMax = 1e6;
constexpr double kCurveCurrentMax = 1e3;
// With these the longest list still fits a cell of a CSV file (kCsvCellBytesMax).
constexpr std::size_t kListedMost = 16;
constexpr std::size_t kLinkLongest = 1000;
constexpr double kPriceMax = 1e9;
constexpr double kPackMax = 1e6;
constexpr double kUncertaintyMin = 1e-6, kUncertaintyMax = 1;

using Errors = std::vector<FieldError>;

// Refused input is quoted, but not at any length.
std::string Quoted(std::string_view text) {
  constexpr std::size_t kShown = 60;
  if (!IsCleanText(text)) return "text that is not clean UTF-8";
  if (text.size() <= kShown) return "\"" + std::string(text) + "\"";
  std::size_t end = kShown;
  while ((static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return "\"" + std::string(text.substr(0, end)) + "…\"";
}

std::string Range(double min, double max) {
  return "between " + FormatNumber(min) + " and " + FormatNumber(max);
}

std::string Joined(const std::vector<std::string_view>& names) {
  std::string joined;
  for (std::string_view name : names) joined += (joined.empty() ? "" : ", ") + std::string(name);
  return joined;
}

void CheckText(std::string field, const std::string& value, std::size_t shortest,
               std::size_t longest, Errors& errors) {
  if (!IsCleanText(value)) {
    errors.push_back({std::move(field), "must be UTF-8 without control characters"});
    return;
  }
  const std::size_t length = CountCharacters(value);
  if (length < shortest || length > longest)
    errors.push_back({std::move(field), "must have " + std::to_string(shortest) + " to " +
                                            std::to_string(longest) + " characters, has " +
                                            std::to_string(length)});
}

void CheckUncertainty(const std::string& field, const std::optional<double>& uncertainty,
                      Errors& errors) {
  if (uncertainty && !(*uncertainty >= kUncertaintyMin && *uncertainty <= kUncertaintyMax))
    errors.push_back({field + ".uncertainty",
                      "must be a share " + Range(kUncertaintyMin, kUncertaintyMax) +
                          " (one standard deviation), is " + FormatNumber(*uncertainty)});
}

// "/v1/parts/export" and its like, which stand where ids of parts do.
constexpr std::string_view kRouteWords[] = {"check", "compare", "export", "import"};

void CheckId(const std::string& id, Errors& errors) {
  const auto alphanumeric = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  const auto allowed = [&](char c) { return alphanumeric(c) || c == '.' || c == '_' || c == '-'; };
  if (id.empty() || id.size() > kIdLongest || !alphanumeric(id.front()) ||
      !std::all_of(id.begin(), id.end(), allowed))
    errors.push_back({"id",
                      "must be 1 to 100 of a-z, 0-9, '.', '_' and '-', the first a letter or "
                      "digit, is " +
                          Quoted(id)});
  else if (id == "custom")
    errors.push_back({"id", "\"custom\" stands for the made-to-measure reservoir"});
  else if (std::find(std::begin(kRouteWords), std::end(kRouteWords), id) != std::end(kRouteWords))
    errors.push_back(
        {"id", Quoted(id) + " is a path of the service, where no part could be found"});
}

std::vector<std::string_view> FieldNames(const Family& family) {
  std::vector<std::string_view> names;
  for (const NumberField& field : family.numbers) names.push_back(field.name);
  for (const TextField& field : family.texts) names.push_back(field.name);
  return names;
}

template <class Fields>
bool Contains(const Fields& fields, std::string_view name) {
  return std::any_of(fields.begin(), fields.end(),
                     [&](const auto& field) { return field.name == name; });
}

FieldError UnknownField(const Family& family, const std::string& name, std::string_view kind) {
  const std::vector<std::string_view> known = FieldNames(family);
  const bool other_kind = std::find(known.begin(), known.end(), name) != known.end();
  std::string detail =
      other_kind ? "is not a " + std::string(kind) + " of family " + std::string(family.name)
                 : "unknown field of family " + std::string(family.name) +
                       "; nearest: " + std::string(NearestName(name, known));
  return {name, std::move(detail)};
}

bool CountsPieces(std::string_view field) {
  return field == "channels" || field == "cells_series" || field == "stations";
}

void CheckNumbers(const Family& family, const Part& part, Errors& errors) {
  for (const NumberField& field : family.numbers) {
    const auto found = part.numbers.find(std::string(field.name));
    if (found == part.numbers.end()) {
      if (field.required)
        errors.push_back(
            {std::string(field.name), "is required, a number " + Range(field.min, field.max)});
      continue;
    }
    const double value = found->second.value;
    if (!(value >= field.min && value <= field.max))
      errors.push_back({std::string(field.name),
                        "must be " + Range(field.min, field.max) + ", is " + FormatNumber(value)});
    else if (CountsPieces(field.name) && value != std::floor(value))
      errors.push_back(
          {std::string(field.name), "must be a whole number, is " + FormatNumber(value)});
    CheckText(std::string(field.name) + ".source", found->second.source, 0, kRemarkLongest, errors);
    CheckUncertainty(std::string(field.name), found->second.uncertainty, errors);
  }
  for (const auto& [name, number] : part.numbers)
    if (!Contains(family.numbers, name)) errors.push_back(UnknownField(family, name, "number"));
}

void CheckTexts(const Family& family, const Part& part, Errors& errors) {
  for (const TextField& field : family.texts) {
    const auto found = part.texts.find(std::string(field.name));
    if (found == part.texts.end()) {
      if (field.required)
        errors.push_back(
            {std::string(field.name),
             "is required" +
                 (field.allowed.empty() ? std::string() : ", one of: " + Joined(field.allowed))});
      continue;
    }
    const std::string& value = found->second.value;
    if (!field.allowed.empty() &&
        std::find(field.allowed.begin(), field.allowed.end(), value) == field.allowed.end())
      errors.push_back({std::string(field.name),
                        "must be one of: " + Joined(field.allowed) + "; is " + Quoted(value)});
    else
      CheckText(std::string(field.name), value, 1, kNameLongest, errors);
    CheckText(std::string(field.name) + ".source", found->second.source, 0, kRemarkLongest, errors);
  }
  for (const auto& [name, text] : part.texts)
    if (!Contains(family.texts, name)) errors.push_back(UnknownField(family, name, "text"));
}

void CheckPoint(const Curve& curve, std::size_t i, CurveKind kind, Errors& errors) {
  const CurvePoint& point = curve.points[i];
  const std::string which = "point " + std::to_string(i + 1) + ": ";
  const auto check = [&](bool ok, std::string_view what, double value, const std::string& rule) {
    if (!ok)
      errors.push_back({"curve", which + std::string(what) + " must be " + rule + ", is " +
                                     FormatNumber(value)});
  };
  const double pressure = point.pressure_kpa_gauge, flow = point.free_air_l_per_min;
  const bool suction = kind == CurveKind::kSuction;
  const auto [lowest, highest] = CurvePressuresKpaGauge(kind);
  check(pressure >= lowest && pressure <= highest, "pressure in kPa gauge", pressure,
        Range(lowest, highest));
  check(flow >= 0 && flow <= kCurveFlowMax, "free air in L/min", flow, Range(0, kCurveFlowMax));
  check(point.current_a > 0 && point.current_a <= kCurveCurrentMax, "current in A", point.current_a,
        "> 0 and ≤ " + FormatNumber(kCurveCurrentMax));
  if (i == 0) return;
  const CurvePoint& last = curve.points[i - 1];
  check(!(pressure <= last.pressure_kpa_gauge), "pressure in kPa gauge", pressure,
        "above that of the point before, " + FormatNumber(last.pressure_kpa_gauge));
  const bool turned = suction ? flow < last.free_air_l_per_min : flow > last.free_air_l_per_min;
  check(!turned, "free air in L/min", flow,
        std::string(suction ? "at least" : "at most") + " that of the point before, " +
            FormatNumber(last.free_air_l_per_min));
}

void CheckCurve(const Family& family, const Part& part, Errors& errors) {
  if (!part.curve) {
    if (family.has_curve())
      errors.push_back({"curve", "is required: 1 to 64 points of pressure, free air and current"});
    return;
  }
  if (!family.has_curve()) {
    errors.push_back({"curve", "family " + std::string(family.name) + " has no curve"});
    return;
  }
  const std::size_t count = part.curve->points.size();
  if (count < 1 || count > kCurvePointsMost)
    errors.push_back({"curve", "must have 1 to 64 points, has " + std::to_string(count)});
  else
    for (std::size_t i = 0; i < count; ++i) CheckPoint(*part.curve, i, family.curve, errors);
  CheckText("free_air.source", part.curve->free_air_source, 0, kRemarkLongest, errors);
  CheckText("current.source", part.curve->current_source, 0, kRemarkLongest, errors);
  CheckUncertainty("free_air", part.curve->free_air_uncertainty, errors);
  CheckUncertainty("current", part.curve->current_uncertainty, errors);
}

// "2024", "2024-05" or "2024-05-31", a day that there is.
bool IsDate(std::string_view text) {
  const std::string_view form = "dddd-dd-dd";
  if (text.size() != 4 && text.size() != 7 && text.size() != 10) return false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (form[i] == 'd' ? text[i] < '0' || text[i] > '9' : text[i] != '-') return false;
  const auto part = [&](std::size_t at, std::size_t size, unsigned absent) {
    if (text.size() < at + size) return absent;
    return static_cast<unsigned>(ParseNumber(text.substr(at, size)).value());
  };
  using namespace std::chrono;
  return year_month_day{year{static_cast<int>(part(0, 4, 0))}, month{part(5, 2, 1)},
                        day{part(8, 2, 1)}}
      .ok();
}

void CheckOffer(const Offer& offer, const std::string& which, Errors& errors) {
  const auto fail = [&](const std::string& detail) {
    errors.push_back({"offers", which + detail});
  };
  const auto check_text = [&](const char* what, const std::string& text, std::size_t shortest,
                              std::size_t longest) {
    Errors found;
    CheckText("", text, shortest, longest, found);
    for (const FieldError& error : found) fail(std::string(what) + " " + error.detail);
  };
  check_text("supplier", offer.supplier, 1, kNameLongest);
  if (!(offer.price >= 0 && offer.price <= kPriceMax))
    fail("price must be " + Range(0, kPriceMax) + ", is " + FormatNumber(offer.price));
  if (!UnitsPerEuro(offer.currency, offer.date))
    fail("currency must be one of: " + Joined(Currencies()) + "; is " + Quoted(offer.currency));
  if (!(offer.pack > 0 && offer.pack <= kPackMax))
    fail("pack must be > 0 and at most " + FormatNumber(kPackMax) + ", is " +
         FormatNumber(offer.pack));
  if (!offer.date.empty() && !IsDate(offer.date))
    fail("date must be like 2024, 2024-05 or 2024-05-31, or empty; is " + Quoted(offer.date));
  if (offer.link.size() > kLinkLongest)
    fail("link must have at most " + std::to_string(kLinkLongest) + " bytes, has " +
         std::to_string(offer.link.size()));
  else
    check_text("link", offer.link, 0, kLinkLongest);
}

void CheckDocument(const Document& document, const std::string& which, Errors& errors) {
  const auto fail = [&](const std::string& detail) {
    errors.push_back({"documents", which + detail});
  };
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  const std::string& digest = document.sha256;
  if (document.link.empty() && digest.empty()) fail("needs a link or a sha256");
  if (document.link.size() > kLinkLongest)
    fail("link must have at most " + std::to_string(kLinkLongest) + " bytes, has " +
         std::to_string(document.link.size()));
  else if (!IsCleanText(document.link))
    fail("link must be UTF-8 without control characters");
  if (!digest.empty() &&
      (digest.size() != 64 || !std::all_of(digest.begin(), digest.end(), is_digit)))
    fail("sha256 must be 64 digits of 0-9 and a-f, or empty; is " + Quoted(digest));
}

template <class Items, class Check>
void CheckList(const char* field, const Items& items, const std::string& what, const Check& check,
               Errors& errors) {
  if (items.size() > kListedMost)
    errors.push_back({field, "must have at most " + std::to_string(kListedMost) + " items, has " +
                                 std::to_string(items.size())});
  else
    for (std::size_t i = 0; i < items.size(); ++i)
      check(items[i], what + " " + std::to_string(i + 1) + ": ", errors);
}

void CheckAlias(const std::string& alias, const std::string& which, Errors& errors) {
  Errors found;
  CheckText("aliases", alias, 1, kNameLongest, found);
  for (FieldError& error : found) errors.push_back({error.field, which + error.detail});
}

// Series, orderable and the lists.
void CheckDetails(const Part& part, Errors& errors) {
  CheckText("series", part.series, 0, kNameLongest, errors);
  if (part.manufacturer == "generic" && part.orderable.value_or(false))
    errors.push_back({"orderable",
                      "must not be true for manufacturer \"generic\": a class of parts is no "
                      "product; name the maker or leave it empty"});
  CheckList("aliases", part.aliases, "alias", CheckAlias, errors);
  if (const auto& names = part.aliases; std::set(names.begin(), names.end()).size() < names.size())
    errors.push_back({"aliases", "must be different from each other"});
  CheckList("offers", part.offers, "offer", CheckOffer, errors);
  CheckList("documents", part.documents, "document", CheckDocument, errors);
}

// `low` must not exceed `high` (or must be below it, if `strict`).
void CheckOrder(const Part& part, const char* low, const char* high, bool strict, Errors& errors) {
  const auto a = part.numbers.find(low), b = part.numbers.find(high);
  if (a == part.numbers.end() || b == part.numbers.end()) return;
  const double x = a->second.value, y = b->second.value;
  if (x > y || (strict && x == y))
    errors.push_back({low, std::string("must be ") + (strict ? "below " : "at most ") + high +
                               ", " + FormatNumber(y) + ", is " + FormatNumber(x)});
}

}  // namespace

std::vector<FieldError> Validate(const Part& part) {
  Errors errors;
  CheckId(part.id, errors);
  CheckText("manufacturer", part.manufacturer, 1, kNameLongest, errors);
  CheckText("part_number", part.part_number, 1, kNameLongest, errors);
  CheckText("notes", part.notes, 0, kRemarkLongest, errors);
  CheckDetails(part, errors);
  if (part.origin != "seed" && part.origin != "user")
    errors.push_back({"origin", "must be one of: seed, user; is " + Quoted(part.origin)});

  const Family* family = FindFamily(part.family);
  if (family == nullptr) {
    std::vector<std::string_view> names;
    for (const Family& known : Families()) names.push_back(known.name);
    errors.push_back(
        {"family", "must be one of: " + Joined(names) + "; is " + Quoted(part.family)});
    return errors;
  }
  CheckNumbers(*family, part, errors);
  CheckTexts(*family, part, errors);
  CheckCurve(*family, part, errors);
  CheckOrder(part, "inner_diameter_mm", "outer_diameter_mm", true, errors);
  CheckOrder(part, "outlet_pressure_min_kpa_gauge", "outlet_pressure_max_kpa_gauge", false, errors);
  CheckOrder(part, "relief_pressure_min_kpa_gauge", "relief_pressure_max_kpa_gauge", false, errors);
  CheckOrder(part, "inlet_pressure_min_kpa_gauge", "inlet_pressure_max_kpa_gauge", false, errors);
  return errors;
}

}  // namespace plenum::catalog
