#include "catalog/tables/heading.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "catalog/fields/csv.h"
#include "catalog/tables/heading_phrases.h"
#include "catalog/tables/heading_words.h"
#include "catalog/tables/printed/price_cells.h"
#include "catalog/tables/printed/printed_columns.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"
#include "catalog/units/unit_table.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kHeadingBytes = 120;
// Columns beside the fields of a family that headings may name in words.
constexpr std::string_view kPlainColumns[] = {"manufacturer", "part_number", "notes",    "series",
                                              "orderable",    "aliases",     "documents"};

const FlowNotationSpec& SpecOf(FlowNotation notation) {
  const auto& specs = FlowNotations();
  return *std::find_if(specs.begin(), specs.end(),
                       [&](const FlowNotationSpec& spec) { return spec.notation == notation; });
}

std::string_view FieldOfUnit(const Target& target) {
  return target.notation ? SpecOf(*target.notation).field : std::string_view(target.column);
}

bool HasUnit(const Target& target, std::string_view unit) {
  if (target.column == kOfferPrice) return !CurrencyOf(unit).empty();
  if (target.column == "c_rate") return unit == "C" || unit == "c" || unit == "1/h";
  return ParseQuantity("1 " + std::string(unit), FieldOfUnit(target), {.needs_unit = true})
      .value.has_value();
}

// "pressure_max_kpa_gauge" in words, without its unit.
std::vector<std::string> WordsOfField(std::string_view field) {
  std::string_view stem = field;
  stem.remove_suffix(DimensionOf(field).suffix.size());
  std::vector<std::string> words;
  for (const std::string_view word : Split(stem, '_')) words.emplace_back(word);
  std::sort(words.begin(), words.end());
  return words;
}

bool SayMore(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(),
                     [](const std::string& word) { return word != "max" && word != "min"; });
}

// Every column that the words may name: one of just these words, or else number fields of more.
std::vector<Target> NamedBy(const Family& family, const std::vector<std::string>& words) {
  if (words.empty() || !SayMore(words)) return {};
  std::vector<Target> whole, part;
  const auto look = [&](std::string_view column, bool is_number) {
    const auto known = WordsOfField(column);
    if (known == words)
      whole.push_back({std::string(column), ""});
    else if (is_number && std::includes(known.begin(), known.end(), words.begin(), words.end()))
      part.push_back({std::string(column), ""});
  };
  for (const NumberField& field : family.numbers) look(field.name, true);
  for (const TextField& field : family.texts) look(field.name, false);
  for (const std::string_view column : kPlainColumns) look(column, false);
  if (!whole.empty()) return whole;
  // What a sheet prints is the most that there is: "max. flow" is that against no pressure.
  std::vector<std::string> without_max = words;
  std::erase(without_max, "max");
  for (const PrintedColumn* column : PrintedColumns(family)) {
    const auto known = WordsOfField(column->field.name);
    const bool has_all =
        !without_max.empty() &&
        std::includes(known.begin(), known.end(), without_max.begin(), without_max.end());
    if (known == without_max)
      whole.push_back({std::string(column->field.name), ""});
    else if (has_all)
      part.push_back({std::string(column->field.name), ""});
  }
  return whole.empty() ? part : whole;
}

std::vector<Target> MeantBy(const Family& family, std::vector<std::string> words) {
  if (auto named = NamedBy(family, words); !named.empty()) return named;
  // In German a designation, but also the principle.
  if (words == std::vector<std::string>{"typ"}) return {{"part_number", ""}, {"type", ""}};
  const auto notation = TakeNotation(words);
  if (!notation) return {};
  for (const char* word : {"conductance", "sonic"})
    words.insert(std::lower_bound(words.begin(), words.end(), word), word);
  std::vector<Target> named;
  for (const Target& target : NamedBy(family, words))
    if (IsConductance(target.column)) named.push_back({target.column, "", notation});
  return named;
}

// The unit that the definition of a notation has: m³/h of Kv, gallons of Cv.
bool IsImplied(const Target& target, std::string_view unit) {
  return (target.notation == FlowNotation::kKv && (unit == "m3/h" || unit == "m³/h")) ||
         (target.notation == FlowNotation::kCv && (unit == "gpm" || unit == "US gal/min"));
}

// A normal litre without the temperature that it is counted at: one target for each of the two.
void SayTemperatures(std::string_view unit, std::vector<Target>& named) {
  std::vector<Target> said;
  for (const Target& target : named) {
    const std::string at = std::string(unit) + " (";
    if (HasUnit(target, unit) || !HasUnit(target, at + "0 °C)")) {
      said.push_back(target);
      continue;
    }
    for (const char* temperature : {"0 °C)", "20 °C)"}) {
      said.push_back(target);
      said.back().unit = at + temperature;
    }
  }
  named = std::move(said);
}

// Those that can have the unit, with it.
void KeepThoseWithUnit(const Family& family, std::string_view unit, std::vector<Target>& named) {
  std::erase_if(named, [&](const Target& target) {
    return !IsImplied(target, unit) && target.column != kOfferPrice && target.column != "c_rate" &&
           FindNumber(family, target.column) == nullptr;
  });
  SayTemperatures(unit, named);
  std::erase_if(named, [&](const Target& target) {
    return !IsImplied(target, unit) && target.unit.empty() && !HasUnit(target, unit);
  });
  for (Target& target : named)
    if (!IsImplied(target, unit) && target.unit.empty()) target.unit = unit;
}

// The word for what a unit measures, where fields of parts have one; empty: none.
std::string_view QuantityOf(std::string_view unit) {
  constexpr std::pair<std::string_view, std::string_view> kQuantities[] = {
      {"_kpa_gauge", "pressure"}, {"_l_per_min", "flow"}, {"_ah", "capacity"},
      {"_wh", "energy"},          {"_v", "voltage"},      {"_w", "power"},
      {"_a", "current"},          {"_kg", "mass"},        {"_kg_per_m", "mass"}};
  for (const auto& [field, word] : kQuantities)
    if (ParseQuantity("1 " + std::string(unit), field, {.needs_unit = true}).value) return word;
  return "";
}

// "max psi", "psi (max)", "mAh": a unit names its quantity. One letter alone may be anything, but
// for V.
std::vector<Target> NamedByUnit(const Family& family, std::string_view heading) {
  std::vector<std::string> words;
  std::string_view unit;
  for (std::string_view piece : Split(heading, ' ')) {
    while (!piece.empty() && (piece.front() == '(' || piece.front() == '[')) piece.remove_prefix(1);
    while (!piece.empty() && std::string_view(")].,").find(piece.back()) != std::string_view::npos)
      piece.remove_suffix(1);
    const auto said = FieldWords(family.name, piece);
    if (said.empty()) continue;
    if (!SayMore(said))
      words.insert(words.end(), said.begin(), said.end());
    else if (unit.empty())
      unit = piece;
    else
      return {};
  }
  const std::string_view quantity = QuantityOf(unit);
  if (quantity.empty() || (words.empty() && unit.size() < 2 && unit != "V")) return {};
  words.emplace_back(quantity);
  std::sort(words.begin(), words.end());
  std::vector<Target> named = NamedBy(family, words);
  KeepThoseWithUnit(family, unit, named);
  return named;
}

bool SaysNoUnit(std::string_view unit) { return unit.empty() || unit == "-" || unit == "1"; }

}  // namespace

std::string FormatTarget(const Target& target) {
  std::string inside;
  if (target.notation) inside = SpecOf(*target.notation).word;
  if (!target.unit.empty()) inside += (inside.empty() ? "" : " ") + target.unit;
  return target.column + (inside.empty() ? "" : " [" + inside + "]");
}

bool AreEnds(const Target& low, const Target& high) {
  const std::size_t at = low.column.find("_min");
  if (at == std::string::npos || low.notation || high.notation) return false;
  std::string other = low.column;
  return other.replace(at, 4, "_max") == high.column;
}

const NumberField* FindNumber(const Family& family, std::string_view column) {
  for (const NumberField& field : family.numbers)
    if (field.name == column) return &field;
  const PrintedColumn* printed = FindPrinted(family, column);
  return printed != nullptr && printed->is_number ? &printed->field : nullptr;
}

HeadingMatch MatchHeading(const Family& family, std::string_view heading) {
  heading = Trimmed(heading);
  if (heading.empty()) return {};
  if (heading.size() > kHeadingBytes) return {};
  if (IsCsvColumn(family, heading)) return {{{std::string(heading), "", std::nullopt, true}}, ""};
  std::string wrong_unit;
  for (const HeadingPhrase& phrase : SplitHeading(heading)) {
    std::vector<Target> named = MeantBy(family, FieldWords(family.name, phrase.words));
    if (phrase.in_brackets && SaysNoUnit(phrase.unit) && !named.empty())
      return {std::move(named), ""};
    const bool has_words = !named.empty();
    KeepThoseWithUnit(family, phrase.unit, named);
    if (named.empty()) {
      named = MeantBy(family, WordsWithUnit(family.name, phrase.words));
      KeepThoseWithUnit(family, phrase.unit, named);
    }
    if (!named.empty()) return {std::move(named), ""};
    if (phrase.in_brackets && has_words) wrong_unit = phrase.unit;
  }
  std::vector<Target> named = MeantBy(family, FieldWords(family.name, heading));
  if (named.empty()) named = NamedByUnit(family, heading);
  if (!named.empty()) return {std::move(named), ""};
  return {{}, std::move(wrong_unit)};
}

GivenTarget ParseTarget(const Family& family, std::string_view text) {
  text = Trimmed(text);
  const std::size_t open = text.find('[');
  Target target{std::string(Trimmed(text.substr(0, open))), "", std::nullopt, false};
  if (!IsCsvColumn(family, target.column) && FindPrinted(family, target.column) == nullptr) {
    const auto columns = CsvColumns(family);
    std::vector<std::string_view> known(columns.begin(), columns.end());
    for (const PrintedColumn* column : PrintedColumns(family)) known.push_back(column->field.name);
    return {{},
            Shown(target.column) + " is no column of family " + std::string(family.name) +
                "; nearest: " + std::string(NearestName(target.column, known))};
  }
  if (open == std::string_view::npos) return {std::move(target), ""};
  if (!text.ends_with("]")) return {{}, "the bracket behind " + target.column + " is not closed"};
  std::string_view unit = Trimmed(text.substr(open + 1, text.size() - open - 2));
  if (IsConductance(target.column)) {
    for (const FlowNotationSpec& spec : FlowNotations()) {
      if (unit != spec.word && !unit.starts_with(std::string(spec.word) + " ")) continue;
      target.notation = spec.notation;
      unit = Trimmed(unit.substr(spec.word.size()));
      break;
    }
  }
  target.unit = unit;
  if (target.column == kOfferPrice) {
    if (unit.empty() || !CurrencyOf(unit).empty()) return {std::move(target), ""};
    return {{}, Shown(unit) + " is no currency that can be converted"};
  }
  if (FindNumber(family, target.column) == nullptr && !unit.empty())
    return {{}, target.column + " has no unit"};
  if (!unit.empty() && !HasUnit(target, unit))
    return {{},
            Shown(unit) + " is no unit of " + target.column + "; units are " +
                UnitNames(FieldOfUnit(target))};
  return {std::move(target), ""};
}

}  // namespace plenum::catalog
