#include "catalog/tables/heading.h"

#include <algorithm>

#include "catalog/fields/csv.h"
#include "catalog/tables/heading_phrases.h"
#include "catalog/tables/heading_words.h"
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
  return whole.empty() ? part : whole;
}

std::vector<Target> NamedBy(const Family& family, std::string_view phrase) {
  std::vector<std::string> words = FieldWords(phrase);
  if (auto named = NamedBy(family, words); !named.empty()) return named;
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

bool SaysNoUnit(std::string_view unit) { return unit.empty() || unit == "-" || unit == "1"; }

}  // namespace

std::string FormatTarget(const Target& target) {
  std::string inside;
  if (target.notation) inside = SpecOf(*target.notation).word;
  if (!target.unit.empty()) inside += (inside.empty() ? "" : " ") + target.unit;
  return target.column + (inside.empty() ? "" : " [" + inside + "]");
}

const NumberField* FindNumber(const Family& family, std::string_view column) {
  for (const NumberField& field : family.numbers)
    if (field.name == column) return &field;
  return nullptr;
}

HeadingMatch MatchHeading(const Family& family, std::string_view heading) {
  heading = Trimmed(heading);
  if (heading.empty()) return {};
  if (heading.size() > kHeadingBytes) return {};
  if (IsCsvColumn(family, heading)) return {{{std::string(heading), "", std::nullopt, true}}, ""};
  std::string wrong_unit;
  for (const HeadingPhrase& phrase : SplitHeading(heading)) {
    std::vector<Target> named = NamedBy(family, phrase.words);
    if (named.empty()) continue;
    if (phrase.in_brackets && SaysNoUnit(phrase.unit)) return {std::move(named), ""};
    std::erase_if(named, [&](const Target& target) {
      return !IsImplied(target, phrase.unit) &&
             (FindNumber(family, target.column) == nullptr || !HasUnit(target, phrase.unit));
    });
    for (Target& target : named)
      if (!IsImplied(target, phrase.unit)) target.unit = phrase.unit;
    if (!named.empty()) return {std::move(named), ""};
    if (phrase.in_brackets) wrong_unit = phrase.unit;
  }
  std::vector<Target> named = NamedBy(family, heading);
  if (!named.empty()) return {std::move(named), ""};
  return {{}, std::move(wrong_unit)};
}

GivenTarget ParseTarget(const Family& family, std::string_view text) {
  text = Trimmed(text);
  const std::size_t open = text.find('[');
  Target target{std::string(Trimmed(text.substr(0, open))), "", std::nullopt, false};
  if (!IsCsvColumn(family, target.column)) {
    const auto columns = CsvColumns(family);
    const std::vector<std::string_view> known(columns.begin(), columns.end());
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
  if (FindNumber(family, target.column) == nullptr && !unit.empty())
    return {{}, target.column + " has no unit"};
  if (!unit.empty() && !HasUnit(target, unit))
    return {{},
            Shown(unit) + " is no unit of " + target.column + "; units are " +
                UnitNames(FieldOfUnit(target))};
  return {std::move(target), ""};
}

}  // namespace plenum::catalog
