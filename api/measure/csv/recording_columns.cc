#include "api/measure/csv/recording_columns.h"

#include <algorithm>
#include <set>
#include <utility>

#include "api/json/words.h"
#include "api/measure/csv/headings/recording_heading.h"
#include "catalog/tables/columns.h"
#include "catalog/tables/heading_phrases.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

using catalog::ColumnRead;
using catalog::CsvRow;
using catalog::FormatTarget;
using catalog::GivenFor;
using catalog::HeadingMatch;
using catalog::IsBlank;
using catalog::NumberKey;
using catalog::Question;
using catalog::TableOptions;
using catalog::TableReading;
using catalog::Target;

constexpr std::size_t kTypos = 2;  // letters in which a heading may miss the name of a field

std::string NameOf(const ColumnRead& column) {
  return column.heading.empty() ? "column " + column.key.substr(1) : Quoted(column.key);
}

// "(ms)" as "ms"; what is no text in brackets stays.
std::string_view WithoutBrackets(std::string_view cell) {
  cell = catalog::Trimmed(cell);
  const bool closed = (cell.starts_with('(') && cell.ends_with(')')) ||
                      (cell.starts_with('[') && cell.ends_with(']'));
  return closed ? cell.substr(1, cell.size() - 2) : cell;
}

// Headings with the units of the row below; none where that row holds anything else.
std::vector<std::string> WithUnits(const CsvRow& header, const CsvRow& below) {
  std::vector<std::string> headings(header.begin(), header.end());
  bool has_unit = false;
  for (std::size_t i = 0; i < std::min(header.size(), below.size()); ++i) {
    const std::string_view unit = WithoutBrackets(below[i]);
    if (IsBlank(unit) || unit == "-") continue;
    if (unit.size() > 20 || catalog::FrontOf(unit).is_bare() || ParseClock(unit)) return {};
    std::string whole = header[i];
    whole.append(" [").append(unit).append("]");
    if (!MatchRecordingHeading(header[i]).targets.empty()) {
      const auto targets = MatchRecordingHeading(whole).targets;
      if (targets.empty()) return {};
      has_unit = has_unit || !targets.front().unit.empty();
    }
    headings[i] = std::move(whole);
  }
  return has_unit ? headings : std::vector<std::string>{};
}

// The field that a heading misses by a few letters; empty: none.
std::string NearField(const std::string& heading) {
  const std::string nearest = Nearest(heading, RecordingFields());
  const bool is_near = nearest.size() > 2 * kTypos && heading.size() < 2 * nearest.size() &&
                       catalog::EditDistance(heading, nearest, kTypos + 1) <= kTypos;
  return is_near ? nearest : "";
}

void AskWhich(const ColumnRead& column, const HeadingMatch& match, TableReading& table) {
  if (!match.wrong_unit.empty()) {
    table.questions.push_back({"column",
                               column.key,
                               NameOf(column) + ": " + Quoted(match.wrong_unit) +
                                   " is no unit of the field that it names: which field and unit "
                                   "is it? An empty answer leaves it out",
                               {}});
  } else if (const std::string near = NearField(column.heading); !near.empty()) {
    table.questions.push_back(
        {"column",
         column.key,
         NameOf(column) + " is no field: is it " + near + "? An empty answer leaves it out",
         {near}});
  }
}

// Asks for a field that a measurement cannot be without.
void AskForField(std::string_view field, const char* what, const TableOptions& options,
                 Recording& recording) {
  TableReading& table = recording.table;
  if (recording.ColumnOf(field) >= 0) return;
  const bool asked = std::any_of(table.questions.begin(), table.questions.end(),
                                 [](const Question& one) { return one.option == "column"; });
  if (asked) return;  // the answer may give it
  Question question{
      "column", "", std::string("no column is known as the ") + what + ": which is it? ", {}};
  std::string keys;
  for (const ColumnRead& column : table.columns) {
    if (!column.targets.empty() || options.columns.contains(column.key)) continue;
    if (question.heading.empty()) question.heading = column.key;
    keys += (keys.empty() ? "" : ", ") + NameOf(column);
  }
  question.text += keys.empty() ? "All columns are something else" : "Not known: " + keys;
  question.answers.emplace_back(field);
  table.questions.push_back(std::move(question));
}

void AskForTwins(TableReading& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto &one = table.columns[k], &other = table.columns[i];
      if (one.targets.empty() || other.targets.empty()) continue;
      const std::string& field = other.targets.front().column;
      if (one.targets.front().column != field) continue;
      std::vector<std::string> answers = {""};
      if (IsPressureField(field))
        for (const std::string_view pressure : {kSourcePressureField, kInletPressureField})
          answers.push_back(FormatTarget({std::string(pressure), other.targets.front().unit}));
      table.questions.push_back({"column", other.key,
                                 NameOf(one) + " and " + NameOf(other) + " both give " + field +
                                     ": which one? An empty answer leaves a column out",
                                 std::move(answers)});
      return;
    }
}

void AskForUnit(const ColumnRead& column, TableReading& table) {
  const Target& target = column.targets.front();
  const MarkedText marked = TakeGaugeMark(target.unit);
  const bool scaled = target.unit.find('=') != std::string::npos;
  if (IsPressureField(target.column) && !scaled && IsRawUnit(SpelledUnit(marked.text))) {
    const std::string unit = SpelledUnit(marked.text);
    table.questions.push_back(
        {"column",
         column.key,
         NameOf(column) + " is in " + unit +
             ": which pressures are two values of it? Give the scale of the sensor",
         {target.column + " [0.5 " + unit + " = 0 bar; 4.5 " + unit + " = 10 bar]"}});
    return;
  }
  const bool share = target.column == kOpeningField;
  const bool has_unit = !share && (target.column == kTimeField || IsReadingField(target.column));
  if (!has_unit || !marked.text.empty() || target.by_full_name) return;
  Question question{"column", column.key, "", {}};
  question.text = NameOf(column) + ": in which unit is it? Units of " + target.column + " are " +
                  catalog::UnitNames(target.column);
  const std::string units = catalog::UnitNames(target.column);
  for (const std::string_view unit : catalog::Split(units, ','))
    question.answers.push_back(FormatTarget(
        {target.column, std::string(catalog::Trimmed(unit)) + std::string(MarkOf(marked.gauge))}));
  table.questions.push_back(std::move(question));
}

// An answer for a column that is not there would be lost.
void CheckNamed(const TableOptions& options, TableReading& table) {
  std::set<std::string> keys = {"*"};
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    keys.insert(table.columns[i].heading);
    keys.insert(NumberKey(i));
  }
  for (const auto& [key, target] : options.columns)
    if (!keys.contains(key))
      table.errors.push_back({0, "column", "the table has no column " + Quoted(key)});
}

// A time of clocks has no unit: what the first cells show.
bool ShowsClock(const TableReading& table, std::size_t index) {
  bool is_clock = false, seen = false;
  catalog::ForEachRow(
      std::string_view(table.text).substr(0, 64 << 10),
      [&](const CsvRow& cells, int row) {
        if (seen || row <= std::max(table.header_row, table.units_row)) return;
        if (index >= cells.size() || IsBlank(cells[index])) return;
        seen = true;
        is_clock = ParseClock(cells[index]).has_value();
      },
      [](const catalog::CsvError&) {}, catalog::DelimiterOf(TableDelimiter(table)));
  return is_clock;
}

void TakeGiven(const std::string& given, const std::string& heading, ColumnRead& column,
               TableReading& table) {
  if (IsBlank(given)) return;
  catalog::GivenTarget target = ParseRecordingTarget(given);
  if (!target.error.empty()) {
    table.errors.push_back({0, "column", Quoted(column.key) + ": " + target.error});
    return;
  }
  // The heading's own unit, where the answer names none.
  if (target.target.unit.empty() && !heading.empty()) {
    for (const catalog::HeadingPhrase& phrase : catalog::SplitHeading(heading))
      if (const std::string unit = SpelledUnit(phrase.unit);
          phrase.in_brackets && IsUnitOf(target.target.column, unit))
        target.target.unit = unit;
    for (const Target& found : MatchRecordingHeading(heading).targets)
      if (found.column == target.target.column) target.target = found;
  }
  column.targets = {std::move(target.target)};
}

}  // namespace

std::string_view TableDelimiter(const TableReading& table) {
  return table.delimiter == kBlanks ? "tab" : std::string_view(table.delimiter);
}

void MapRecordingColumns(const CsvRow& header, const catalog::Record& below,
                         const TableOptions& options, Recording& recording) {
  TableReading& table = recording.table;
  std::vector<std::string> headings = WithUnits(header, below.cells);
  if (headings.empty())
    headings = header;
  else
    table.units_row = below.row;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < header.size(); ++i) {
    ColumnRead column;
    column.heading = catalog::Trimmed(header[i]);
    const bool own_key = !column.heading.empty() && seen.insert(column.heading).second;
    column.key = own_key ? column.heading : NumberKey(i);
    HeadingMatch match = MatchRecordingHeading(headings[i]);
    if (const std::string* given = GivenFor(column, i, options))
      TakeGiven(*given, headings[i], column, table);
    else if (!match.targets.empty())
      column.targets = {std::move(match.targets.front())};
    else
      AskWhich(column, match, table);
    table.columns.push_back(std::move(column));
  }
  CheckNamed(options, table);
  AskForTwins(table);
  AskForField(kTimeField, "time", options, recording);
  AskForField(kPressureField, "pressure", options, recording);
  recording.meanings.resize(table.columns.size());
  recording.scales.resize(table.columns.size());
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    ColumnRead& column = table.columns[i];
    if (column.targets.empty()) continue;
    const Target& target = column.targets.front();
    if (target.column == kTimeField && ShowsClock(table, i)) {
      recording.meanings[i] = "clock times, from the first reading of the run";
      continue;
    }
    const std::size_t before = table.questions.size();
    AskForUnit(column, table);
    if (table.questions.size() > before || IsValveField(target.column)) continue;
    ScaleOrError scale = ScaleOf(target.column, target.unit, recording.ambient_kpa_abs);
    if (!scale.error.empty())
      table.errors.push_back({0, "column", Quoted(column.key) + ": " + scale.error});
    recording.scales[i] = scale.scale;
  }
}

}  // namespace plenum::api
