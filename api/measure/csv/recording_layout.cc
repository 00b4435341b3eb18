#include "api/measure/csv/recording_layout.h"

#include <algorithm>
#include <set>
#include <utility>

#include "api/json/words.h"
#include "api/measure/csv/headings/recording_heading.h"
#include "api/measure/csv/recording_columns.h"
#include "api/measure/csv/recording_text.h"
#include "catalog/tables/cell_evidence.h"
#include "catalog/tables/encoding.h"
#include "catalog/tables/heading_phrases.h"
#include "catalog/tables/layout.h"

namespace plenum::api {
namespace {

using catalog::ColumnEvidence;
using catalog::CsvRow;
using catalog::Decimal;
using catalog::Record;
using catalog::TableOptions;
using catalog::TableReading;

bool IsKnown(const std::string& heading) {
  return heading.find_first_of(";|\t") == std::string::npos &&
         !MatchRecordingHeading(heading).targets.empty();
}

void CheckOptions(const TableOptions& options, TableReading& table) {
  const auto check = [&](const char* name, const std::string& given,
                         const std::vector<std::string>& allowed) {
    if (given.empty() || std::find(allowed.begin(), allowed.end(), given) != allowed.end()) return;
    std::string names;
    for (const std::string& one : allowed) names += (names.empty() ? "" : ", ") + one;
    table.errors.push_back({0, name, "must be one of: " + names + "; is " + Quoted(given)});
  };
  check("encoding", options.encoding, catalog::EncodingNames());
  check("delimiter", options.delimiter, RecordingDelimiters());
  check("decimal", options.decimal, {"point", "comma"});
}

int CountKnown(std::string_view text, std::string_view delimiter, const TableOptions& options) {
  const auto records = catalog::FirstRecords(text, catalog::DelimiterOf(delimiter));
  return catalog::FindHeader(IsKnown, records, options).known;
}

// Sets the delimiter, or asks. With blanks between columns the text gets tabs.
void FindRecordingDelimiter(const TableOptions& options, TableReading& table) {
  if (options.delimiter == kBlanks) {
    table.text = WithTabs(table.text);
    table.delimiter = kBlanks;
    return;
  }
  catalog::FindDelimiter(IsKnown, table.text, options, table);
  if (!options.delimiter.empty()) return;
  std::string best;
  int most = 0, of_best = 0;
  for (const std::string& name : catalog::DelimiterNames()) {
    const int known = CountKnown(table.text, name, options);
    if (known > most) most = known, best = name, of_best = 0;
    if (known == most) ++of_best;
  }
  std::string tabs;
  if (most < 2) tabs = WithTabs(table.text);
  if (!tabs.empty() && CountKnown(tabs, "tab", options) > std::max(most, 1)) {
    table.text = std::move(tabs);
    table.delimiter = kBlanks;
    table.questions.clear();
  } else if (table.delimiter.empty() && of_best == 1) {
    table.delimiter = best;
    table.questions.clear();
  }
}

bool IsReading(const std::string& cell) {
  return catalog::FrontOf(cell).is_bare() || ParseClock(cell).has_value();
}

bool HasNoWords(const CsvRow& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) {
    return catalog::IsBlank(cell) || IsReading(cell);
  });
}

// What all cells with numbers show of the mark before decimals.
ColumnEvidence LookAtNumbers(const TableReading& table) {
  ColumnEvidence evidence;
  std::vector<bool> has_numbers;
  for (const auto& column : table.columns)
    has_numbers.push_back(!column.targets.empty() &&
                          (column.targets.front().column == kTimeField ||
                           IsReadingField(column.targets.front().column)));
  catalog::ForEachRow(
      table.text,
      [&](const CsvRow& cells, int row) {
        if (row <= std::max(table.header_row, table.units_row)) return;
        for (std::size_t i = 0; i < std::min(cells.size(), has_numbers.size()); ++i)
          if (has_numbers[i]) catalog::NoteCell(cells[i], evidence);
      },
      [](const catalog::CsvError&) {}, catalog::DelimiterOf(TableDelimiter(table)));
  return evidence;
}

// A table has one decimal mark, so that what one column shows holds for all.
void FindDecimal(const TableOptions& options, TableReading& table) {
  const ColumnEvidence shown = LookAtNumbers(table);
  const bool comma = !shown.comma.empty(), point = !shown.point.empty();
  Decimal decimal = comma ? Decimal::kComma : Decimal::kPoint;
  std::string why;
  if (!options.decimal.empty())
    decimal = options.decimal == "comma" ? Decimal::kComma : Decimal::kPoint;
  else if (comma && point)
    why = "cells are written " + Quoted(shown.point) + " and " + Quoted(shown.comma) +
          ": does a point or a comma stand before decimals?";
  else if (!comma && !point && !shown.either_comma.empty())
    why = "is " + Quoted(shown.either_comma) + " a number with decimals or with thousands?";
  else if (!comma && !point && !shown.either_point.empty() && table.delimiter != "comma")
    why = "is " + Quoted(shown.either_point) + " a number with decimals or with thousands?";
  if (!why.empty()) table.questions.push_back({"decimal", "", why, {"point", "comma"}});
  for (auto& column : table.columns) {
    column.decimal = decimal;
    column.has_decimals =
        comma || point || !shown.either_comma.empty() || !shown.either_point.empty();
  }
}

void ReadHeadings(const TableOptions& options, Recording& recording) {
  TableReading& table = recording.table;
  const auto records =
      catalog::FirstRecords(table.text, catalog::DelimiterOf(TableDelimiter(table)));
  const catalog::Header header = catalog::FindHeader(IsKnown, records, options);
  if (header.index >= records.size()) {
    table.errors.push_back(
        {0, "header_row",
         records.empty() ? "the table is empty" : "is no row of the table with cells"});
    return;
  }
  const Record& found = records[header.index];
  recording.has_headings = options.header_row > 0 || !HasNoWords(found.cells);
  table.header_row = recording.has_headings ? found.row : found.row - 1;
  const bool has_next = header.index + 1 < records.size() && recording.has_headings;
  const CsvRow none(found.cells.size());
  MapRecordingColumns(recording.has_headings ? found.cells : none,
                      has_next ? records[header.index + 1] : Record{}, options, recording);
}

}  // namespace

const std::vector<std::string>& RecordingDelimiters() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names = catalog::DelimiterNames();
    names.emplace_back(kBlanks);
    return names;
  }();
  return kNames;
}

void ReadRecordingLayout(std::string_view bytes, const TableOptions& options,
                         Recording& recording) {
  TableReading& table = recording.table;
  CheckOptions(options, table);
  if (!table.errors.empty()) return;
  catalog::Decoded decoded = catalog::Decode(bytes, options.encoding);
  table.encoding = decoded.encoding;
  if (!decoded.error.empty()) table.errors.push_back({0, "encoding", decoded.error});
  if (!decoded.question.empty())
    table.questions.push_back(
        {"encoding", "", "which encoding is it? " + decoded.question, catalog::EncodingNames()});
  if (decoded.encoding.empty()) return;
  table.text = WithoutComments(decoded.text);
  if (catalog::IsBlank(table.text)) {
    table.errors.push_back({0, "", "the table is empty"});
    return;
  }
  FindRecordingDelimiter(options, table);
  if (table.delimiter.empty()) return;
  ReadHeadings(options, recording);
  if (!table.errors.empty()) return;
  FindDecimal(options, table);
}

}  // namespace plenum::api
