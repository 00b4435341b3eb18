#include "catalog/fields/csv.h"

#include <algorithm>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "catalog/fields/csv_table.h"
#include "catalog/fields/fields.h"
#include "catalog/fields/part_lists.h"
#include "catalog/fields/row_reader.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kIdCompared = 200;
constexpr std::string_view kProvenance = ".provenance";
constexpr std::string_view kSource = ".source";
constexpr std::string_view kUncertainty = ".uncertainty";

// Beside the fields of a family.
constexpr std::string_view kPlainColumns[] = {"id",      "manufacturer", "part_number",
                                              "notes",   "series",       "orderable",
                                              "aliases", "offers",       "documents"};

// What a curve gives, each with an origin of its own.
constexpr std::string_view kCurveNumbers[] = {"free_air", "current"};

std::string Column(std::string_view field, std::string_view suffix) {
  return std::string(field) + std::string(suffix);
}

std::vector<CsvError> CheckHeader(const Family& family, const CsvRow& header, int row) {
  const std::vector<std::string> columns = CsvColumns(family);
  const std::vector<std::string_view> known(columns.begin(), columns.end());
  std::vector<CsvError> errors;
  std::set<std::string> seen;
  for (const std::string& name : header) {
    if (!seen.insert(name).second)
      errors.push_back({row, name, "column appears twice"});
    else if (std::find(known.begin(), known.end(), name) == known.end())
      errors.push_back({row, name,
                        "unknown column of family " + std::string(family.name) +
                            "; nearest: " + std::string(NearestName(name, known))});
  }
  return errors;
}

void Add(CsvError error, CsvErrors& errors) {
  if (++errors.count <= kCsvErrorsMax) errors.errors.push_back(std::move(error));
}

std::string FormatCurve(const Curve& curve) {
  std::string text;
  for (const CurvePoint& point : curve.points)
    text += (text.empty() ? "" : ";") + FormatNumber(point.pressure_kpa_gauge) + ":" +
            FormatNumber(point.free_air_l_per_min) + ":" + FormatNumber(point.current_a);
  return text;
}

CsvRow ToRow(const Family& family, const Part& part) {
  const std::string orderable = part.orderable ? (*part.orderable ? "true" : "false") : "";
  CsvRow row{part.id,   part.manufacturer,   part.part_number,   part.notes,           part.series,
             orderable, FormatAliases(part), FormatOffers(part), FormatDocuments(part)};
  const auto add_origin = [&](Provenance provenance, const std::string& source) {
    row.emplace_back(Name(provenance));
    row.push_back(source);
  };
  const auto add_uncertainty = [&](const std::optional<double>& uncertainty) {
    row.push_back(uncertainty ? FormatNumber(*uncertainty) : std::string());
  };
  for (const NumberField& field : family.numbers) {
    const auto found = part.numbers.find(std::string(field.name));
    if (found == part.numbers.end()) {
      row.resize(row.size() + 4);
      continue;
    }
    row.push_back(FormatNumber(found->second.value));
    add_origin(found->second.provenance, found->second.source);
    add_uncertainty(found->second.uncertainty);
  }
  for (const TextField& field : family.texts) {
    const auto found = part.texts.find(std::string(field.name));
    if (found == part.texts.end()) {
      row.resize(row.size() + 3);
      continue;
    }
    row.push_back(found->second.value);
    add_origin(found->second.provenance, found->second.source);
  }
  if (!family.has_curve()) return row;
  if (!part.curve) {
    row.resize(row.size() + 7);
    return row;
  }
  const Curve& curve = *part.curve;
  row.push_back(FormatCurve(curve));
  add_origin(curve.free_air_provenance, curve.free_air_source);
  add_uncertainty(curve.free_air_uncertainty);
  add_origin(curve.current_provenance, curve.current_source);
  add_uncertainty(curve.current_uncertainty);
  return row;
}

}  // namespace

std::vector<std::string> CsvColumns(const Family& family) {
  std::vector<std::string> columns(std::begin(kPlainColumns), std::end(kPlainColumns));
  const auto add_origin = [&](std::string_view name) {
    columns.push_back(Column(name, kProvenance));
    columns.push_back(Column(name, kSource));
  };
  for (const NumberField& field : family.numbers) {
    columns.emplace_back(field.name);
    add_origin(field.name);
    columns.push_back(Column(field.name, kUncertainty));
  }
  for (const TextField& field : family.texts) {
    columns.emplace_back(field.name);
    add_origin(field.name);
  }
  if (family.has_curve()) {
    columns.emplace_back("curve");
    for (const std::string_view name : kCurveNumbers) {
      add_origin(name);
      columns.push_back(Column(name, kUncertainty));
    }
  }
  return columns;
}

bool IsCsvColumn(const Family& family, std::string_view name) {
  const std::size_t dot = name.find('.');
  const std::string_view field = name.substr(0, dot), suffix = name.substr(field.size());
  const bool of_text = suffix.empty() || suffix == kProvenance || suffix == kSource;
  const bool of_number = of_text || suffix == kUncertainty;
  const auto is_field = [&](const auto& one) { return one.name == field; };
  if (suffix.empty() && std::find(std::begin(kPlainColumns), std::end(kPlainColumns), field) !=
                            std::end(kPlainColumns))
    return true;
  if (std::any_of(family.numbers.begin(), family.numbers.end(), is_field)) return of_number;
  if (std::any_of(family.texts.begin(), family.texts.end(), is_field)) return of_text;
  if (!family.has_curve()) return false;
  if (name == "curve") return true;
  return std::find(std::begin(kCurveNumbers), std::end(kCurveNumbers), field) !=
             std::end(kCurveNumbers) &&
         !suffix.empty() && of_number;
}

CsvErrors ReadRows(std::string_view family_name, const RowSource& rows, const TakePart& take,
                   bool complete) {
  const Family* family = FindFamily(family_name);
  if (family == nullptr)
    return {{{1, "", "unknown family \"" + std::string(family_name) + "\""}}, 1};
  std::optional<CsvRow> header;
  std::unordered_map<std::string, int> row_of_id;
  CsvErrors of_table, of_rows;
  const auto read_row = [&](CsvRow cells, int row) {
    if (!header) {
      header = std::move(cells);
      for (CsvError& error : CheckHeader(*family, *header, row)) Add(std::move(error), of_rows);
      return;
    }
    if (of_table.count > 0) return;  // what its cells are is uncertain
    if (cells.size() != header->size()) {
      Add({row, "",
           "has " + std::to_string(cells.size()) + " cells, the header has " +
               std::to_string(header->size())},
          of_rows);
      return;
    }
    RowRead read = ReadRow(*family, *header, cells, row, complete);
    Part part = std::move(read.part);
    for (CsvError& error : read.errors) Add(std::move(error), of_rows);
    // Of one that is too long, an error already, the beginning is enough.
    const auto [first, is_new] = row_of_id.emplace(part.id.substr(0, kIdCompared), row);
    if (!is_new)
      Add({row, "id", "\"" + first->first + "\" is in row " + std::to_string(first->second)},
          of_rows);
    take(std::move(part), row);
  };
  rows(read_row, [&](CsvError error) { Add(std::move(error), of_table); });
  if (of_table.count > 0) return of_table;
  if (!header) return {{{1, "", "the header row is missing"}}, 1};
  return of_rows;
}

CsvErrors ReadCsv(std::string_view family, std::string_view text, const TakePart& take) {
  const RowSource rows = [&](const TakeRow& take_row, const TakeError& fail) {
    ForEachRow(text, take_row, fail);
  };
  return ReadRows(family, rows, take, false);
}

CsvParts ReadCsv(std::string_view family, std::string_view text) {
  CsvParts result;
  result.errors = ReadCsv(family, text, [&](Part part, int row) {
                    result.parts.push_back(std::move(part));
                    result.rows.push_back(row);
                  }).errors;
  return result;
}

std::string WriteCsv(std::string_view family_name, const std::vector<Part>& parts) {
  const Family* family = FindFamily(family_name);
  if (family == nullptr) return {};
  std::string text = FormatRow(CsvColumns(*family));
  for (const Part& part : parts) text += FormatRow(ToRow(*family, part));
  return text;
}

std::string WriteCsvRow(const Part& part) {
  const Family* family = FindFamily(part.family);
  return family == nullptr ? "" : FormatRow(ToRow(*family, part));
}

}  // namespace plenum::catalog
