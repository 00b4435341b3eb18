#include "catalog/fields/quantity.h"

#include <charconv>
#include <cmath>
#include <vector>

#include "catalog/fields/text.h"

namespace plenum::catalog {
namespace {

// One of this unit is numerator / denominator of the field's. Both are exact where the definition
// allows, so that 350 g becomes the double nearest to 0.35.
struct Unit {
  std::string_view name;
  double numerator = 1, denominator = 1;
};

struct Dimension {
  std::string_view suffix;  // of the field's name
  std::vector<Unit> units;
};

// Longer suffixes come before those that they end in.
const std::vector<Dimension>& Dimensions() {
  static const std::vector<Dimension> kDimensions = {
      {"_dm3_per_s_bar",
       {{"dm3/(sbar)"}, {"dm3/sbar"}, {"L/(sbar)"}, {"L/(minbar)", 1, 60}, {"m3/(sPa)", 1e8}}},
      {"_kg_per_m", {{"kg/m"}, {"g/m", 1, 1000}, {"lb/ft", 0.45359237, 0.3048}}},
      {"_eur_per_m", {{"EUR/m"}, {"€/m"}}},
      {"_l_per_min_anr", {{"L/min"}, {"L/s", 60}, {"m3/h", 1000, 60}}},
      {"_l_per_min", {{"L/min"}, {"L/s", 60}, {"m3/h", 1000, 60}}},
      {"_kpa_gauge",
       {{"kPa"},
        {"Pa", 1, 1000},
        {"mbar", 1, 10},
        {"bar", 100},
        {"MPa", 1000},
        {"psi", 6.894757293168361}}},
      {"_kg", {{"kg"}, {"g", 1, 1000}, {"mg", 1, 1e6}, {"lb", 0.45359237}, {"oz", 0.45359237, 16}}},
      {"_ml",
       {{"mL"}, {"cm3"}, {"cc"}, {"L", 1000}, {"dm3", 1000}, {"m3", 1e6}, {"in3", 16.387064}}},
      {"_mm", {{"mm"}, {"um", 1, 1000}, {"cm", 10}, {"m", 1000}, {"in", 25.4}}},
      {"_ms", {{"ms"}, {"us", 1, 1000}, {"s", 1000}}},
      {"_eur", {{"EUR"}, {"€"}}},
      {"_ah", {{"Ah"}, {"mAh", 1, 1000}}},
      {"_l",
       {{"L"},
        {"dm3"},
        {"mL", 1, 1000},
        {"cm3", 1, 1000},
        {"cc", 1, 1000},
        {"m3", 1000},
        {"in3", 16.387064, 1000}}},
      {"_v", {{"V"}, {"mV", 1, 1000}, {"kV", 1000}}},
      {"_a", {{"A"}, {"mA", 1, 1000}}},
      {"_w", {{"W"}, {"mW", 1, 1000}, {"kW", 1000}}},
      {"", {{"%", 1, 100}}},
  };
  return kDimensions;
}

const Dimension& DimensionOf(std::string_view field) {
  for (const Dimension& dimension : Dimensions())
    if (field.ends_with(dimension.suffix)) return dimension;
  return Dimensions().back();
}

std::string Replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// "dm³ / (s · bar)" as "dm3/(sbar)", "l/min ANR" as "L/min", "bar(g)" as "bar".
std::string Normalized(std::string_view unit, std::string_view suffix) {
  std::string text(unit);
  const auto drop = [&](std::string_view mark) {
    if (text.size() > mark.size() && text.ends_with(mark)) text.resize(text.size() - mark.size());
  };
  for (const std::string_view nothing : {" ", "\t", "\u00A0", "·", "⋅", "*"})
    text = Replaced(std::move(text), nothing, "");
  text = Replaced(std::move(text), "³", "3");
  text = Replaced(std::move(text), "^3", "3");
  text = Replaced(std::move(text), "µ", "u");  // U+00B5, micro sign
  text = Replaced(std::move(text), "μ", "u");  // U+03BC, Greek letter
  if (suffix.starts_with("_l_per_min"))
    for (const std::string_view mark : {"(ANR)", "ANR"}) drop(mark);
  if (suffix == "_kpa_gauge")
    for (const std::string_view mark : {"(g)", "gauge", "g"}) drop(mark);
  if (text.starts_with("l/") || text == "l") text[0] = 'L';
  if (text == "ml") text = "mL";
  return text;
}

std::string Names(const Dimension& dimension) {
  std::string names;
  for (const Unit& unit : dimension.units)
    names += (names.empty() ? "" : ", ") + std::string(unit.name);
  return names;
}

std::string Shown(std::string_view text) {
  constexpr std::size_t kShown = 60;
  if (text.size() <= kShown) return "\"" + std::string(text) + "\"";
  std::size_t end = kShown;
  while ((static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return "\"" + std::string(text.substr(0, end)) + "…\"";
}

}  // namespace

Quantity ParseQuantity(std::string_view text, std::string_view field) {
  if (const auto bare = ParseNumber(text)) return {bare, ""};
  const Dimension& dimension = DimensionOf(field);
  const Quantity refused{std::nullopt, "must be a finite number, alone or with one of " +
                                           Names(dimension) + "; is " + Shown(text)};
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return refused;
  text.remove_prefix(first);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return refused;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  const std::string name = Normalized(text, dimension.suffix);
  for (const Unit& unit : dimension.units) {
    if (unit.name != name) continue;
    const double converted =
        unit.denominator == 1 ? value * unit.numerator : value * unit.numerator / unit.denominator;
    if (std::isfinite(converted)) return {converted, ""};
  }
  return refused;
}

}  // namespace plenum::catalog
