#include "catalog/tables/reading.h"

#include <algorithm>
#include <set>
#include <utility>

#include "catalog/tables/cell_evidence.h"
#include "catalog/tables/columns.h"
#include "catalog/tables/encoding.h"
#include "catalog/tables/layout.h"
#include "catalog/tables/printed/printed_columns.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kHeaderBytes = 64 << 10;

// The project's own CSV: UTF-8, commas, a header of names of columns in the first row, the id among
// them. A few names that are wrong do not make it foreign: ReadCsv says what they should be.
bool IsExported(const Family& family, std::string_view bytes) {
  if (IsBlank(bytes.substr(0, kHeaderBytes))) return true;
  const std::string_view line = bytes.substr(0, std::min(bytes.find('\n'), kHeaderBytes));
  CsvRow header;
  ForEachRow(
      line, [&](CsvRow cells, int row) { header = row == 1 ? std::move(cells) : header; },
      [](const CsvError&) {});
  const auto known = std::count_if(header.begin(), header.end(), [&](const std::string& name) {
    return IsCsvColumn(family, name);
  });
  return std::find(header.begin(), header.end(), "id") != header.end() &&
         2 * known >= std::ssize(header);
}

void CheckOptions(const Family& family, const TableOptions& options, TableReading& reading) {
  const auto check = [&](const char* name, const std::string& given,
                         const std::vector<std::string>& allowed) {
    if (given.empty() || std::find(allowed.begin(), allowed.end(), given) != allowed.end()) return;
    std::string names;
    for (const std::string& one : allowed) names += (names.empty() ? "" : ", ") + one;
    reading.errors.push_back({0, name, "must be one of: " + names + "; is " + Shown(given)});
  };
  check("encoding", options.encoding, EncodingNames());
  check("delimiter", options.delimiter, DelimiterNames());
  check("decimal", options.decimal, {"point", "comma"});
  const auto columns = CsvColumns(family);
  const std::vector<std::string_view> known(columns.begin(), columns.end());
  for (const auto& [column, value] : options.set)
    if (!IsCsvColumn(family, column) && FindPrinted(family, column) == nullptr)
      reading.errors.push_back({0, "set",
                                Shown(column) + " is no column of family " +
                                    std::string(family.name) +
                                    "; nearest: " + std::string(NearestName(column, known))});
  if (const auto rest = options.columns.find("*");
      rest != options.columns.end() && !rest->second.empty())
    reading.errors.push_back({0, "column", "\"*\" can only be left out: give it no column"});
}

// An answer for a column that is not there would be lost.
void CheckNamed(const TableOptions& options, TableReading& reading) {
  std::set<std::string> keys = {"*"};
  for (std::size_t i = 0; i < reading.columns.size(); ++i) {
    keys.insert(reading.columns[i].heading);
    keys.insert("#" + std::to_string(i + 1));
  }
  for (const auto& [key, target] : options.columns)
    if (!keys.contains(key))
      reading.errors.push_back({0, "column", "the header has no column " + Shown(key)});
}

void ReadLayout(const Family& family, const TableOptions& options, TableReading& reading) {
  FindDelimiter(HeadingsOf(family), reading.text, options, reading);
  if (reading.delimiter.empty()) return;
  const auto records = FirstRecords(reading.text, DelimiterOf(reading.delimiter));
  const Header header = FindHeader(HeadingsOf(family), records, options);
  if (header.index >= records.size()) {
    reading.errors.push_back(
        {0, "header_row",
         records.empty() ? "the table is empty" : "is no row of the table with cells"});
    return;
  }
  reading.header_row = records[header.index].row;
  const bool has_next =
      header.index + 1 < records.size() && records[header.index + 1].row == reading.header_row + 1;
  const auto open =
      MapColumns(family, records[header.index].cells,
                 has_next ? records[header.index + 1].cells : CsvRow{}, options, reading);
  CheckNamed(options, reading);
  const auto evidence = LookAtCells(family, reading.text, reading);
  AskForColumns(family, open, options, reading);
  FindDecimals(evidence, options, reading);
  AskForUnits(family, evidence, reading);
  AskForCurrency(family, evidence, reading);
  const auto gives_id = [](const ColumnRead& column) {
    return std::any_of(column.targets.begin(), column.targets.end(),
                       [](const Target& target) { return target.column == "id"; });
  };
  reading.makes_ids = !reading.set.contains("id") &&
                      std::none_of(reading.columns.begin(), reading.columns.end(), gives_id);
}

}  // namespace

TableReading ReadTable(std::string_view family_name, std::string_view bytes,
                       const TableOptions& options) {
  TableReading reading;
  reading.family = family_name;
  const Family* family = FindFamily(family_name);
  if (family == nullptr) {
    reading.errors.push_back({0, "family", "unknown family " + Shown(family_name)});
    return reading;
  }
  if (options == TableOptions{} && IsExported(*family, bytes)) {
    reading.as_exported = true;
    reading.encoding = "utf-8";
    reading.delimiter = "comma";
    reading.header_row = 1;
    return reading;
  }
  CheckOptions(*family, options, reading);
  if (!reading.errors.empty()) return reading;
  reading.set = options.set;
  Decoded decoded = Decode(bytes, options.encoding);
  reading.encoding = decoded.encoding;
  if (!decoded.error.empty()) reading.errors.push_back({0, "encoding", decoded.error});
  if (!decoded.question.empty())
    reading.questions.push_back(
        {"encoding", "", "which encoding is it? " + decoded.question, EncodingNames()});
  if (decoded.encoding.empty()) return reading;
  reading.text = std::move(decoded.text);
  ReadLayout(*family, options, reading);
  return reading;
}

}  // namespace plenum::catalog
