#include "catalog/fields/csv.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "catalog/fields/csv_table.h"
#include "catalog/fields/fields.h"
#include "catalog/fields/part_lists.h"
#include "catalog/fields/price.h"
#include "catalog/units/printed_flow.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kIdCompared = 200;
constexpr std::string_view kProvenance = ".provenance";
constexpr std::string_view kSource = ".source";
constexpr std::string_view kUncertainty = ".uncertainty";
// Names whose ends give the units of a curve point.
constexpr std::string_view kPointUnits[] = {"_kpa_gauge", "_l_per_min", "_a"};

// Beside the fields of a family.
constexpr std::string_view kPlainColumns[] = {"id",      "manufacturer", "part_number",
                                              "notes",   "series",       "orderable",
                                              "aliases", "offers",       "documents"};

// What a curve gives, each with an origin of its own.
constexpr std::string_view kCurveNumbers[] = {"free_air", "current"};

std::string Column(std::string_view field, std::string_view suffix) {
  return std::string(field) + std::string(suffix);
}

// One row being turned into a part; collects what is wrong with it.
class RowReader {
 public:
  RowReader(const Family& family, const std::vector<std::string>& header, const CsvRow& cells,
            int row)
      : family_(family), row_(row) {
    for (std::size_t i = 0; i < header.size(); ++i) cells_[header[i]] = cells[i];
  }

  Part Read() {
    Part part;
    part.id = Cell("id");
    part.family = family_.name;
    part.manufacturer = Cell("manufacturer");
    part.part_number = Cell("part_number");
    part.notes = Cell("notes");
    part.series = Cell("series");
    ReadOrderable(part);
    ReadList("aliases", ReadAliases, part);
    ReadList("offers", ReadOffers, part);
    ReadList("documents", ReadDocuments, part);
    for (const NumberField& field : family_.numbers) ReadNumber(field.name, part);
    for (const TextField& field : family_.texts) ReadText(field.name, part);
    if (family_.has_curve()) ReadCurve(part);
    DerivePrice(part);

    // A cell that could not be read is reported once, not as a missing field as well.
    std::set<std::string> reported;
    for (const CsvError& error : errors_) reported.insert(error.column);
    for (FieldError& error : Validate(part))
      if (!reported.contains(error.field)) Fail(error.field, std::move(error.detail));
    return part;
  }

  std::vector<CsvError> TakeErrors() { return std::move(errors_); }

 private:
  std::string Cell(std::string_view column) const {
    const auto found = cells_.find(column);
    return found == cells_.end() ? std::string() : found->second;
  }

  void Fail(std::string column, std::string detail) {
    errors_.push_back({row_, std::move(column), std::move(detail)});
  }

  Provenance ReadProvenance(std::string_view field) {
    const std::string name = Cell(Column(field, kProvenance));
    if (name.empty()) return Provenance::kThirdParty;
    const auto provenance = ProvenanceFromName(name);
    if (!provenance) {
      std::string names;
      for (const std::string_view known : ProvenanceNames())
        names += (names.empty() ? "" : ", ") + std::string(known);
      Fail(Column(field, kProvenance), "must be one of: " + names + "; is \"" + name + "\"");
    }
    return provenance.value_or(Provenance::kThirdParty);
  }

  // Where a value comes from says nothing without the value.
  void CheckNoOrigin(std::string_view field) {
    for (std::string_view suffix : {kProvenance, kSource, kUncertainty})
      if (!Cell(Column(field, suffix)).empty())
        Fail(Column(field, suffix), "is given, but there is no value");
  }

  // A share, 0.05 or 5 %.
  std::optional<double> ReadUncertainty(std::string_view field) {
    const std::string column = Column(field, kUncertainty);
    const std::string cell = Cell(column);
    if (cell.empty()) return std::nullopt;
    const Quantity quantity = ParseQuantity(cell, "uncertainty");
    if (!quantity.value) Fail(column, quantity.error);
    return quantity.value;
  }

  void ReadOrderable(Part& part) {
    std::string cell = Cell("orderable");
    for (char& c : cell) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (cell == "true" || cell == "yes")
      part.orderable = true;
    else if (cell == "false" || cell == "no")
      part.orderable = false;
    else if (!cell.empty())
      Fail("orderable", "must be true, false or empty; is \"" + Cell("orderable") + "\"");
  }

  void ReadList(const char* column, std::string (*read)(std::string_view, Part&), Part& part) {
    const std::string cell = Cell(column);
    if (cell.empty()) return;
    if (std::string error = read(cell, part); !error.empty()) Fail(column, std::move(error));
  }

  void ReadNumber(std::string_view field, Part& part) {
    const std::string cell = Cell(field);
    if (cell.empty()) return CheckNoOrigin(field);
    if (IsConductance(field) && IsPrintedFlow(cell)) return ReadPrinted(field, cell, part);
    const Quantity quantity = ParseQuantity(cell, field);
    const Provenance provenance = ReadProvenance(field);
    if (quantity.value)
      part.numbers[std::string(field)] = {*quantity.value, provenance, Cell(Column(field, kSource)),
                                          ReadUncertainty(field)};
    else
      Fail(std::string(field), quantity.error);
  }

  // Derived, with the formula before the source that the row gives.
  void ReadPrinted(std::string_view field, const std::string& cell, Part& part) {
    PrintedFlow printed;
    if (std::string error = ReadPrintedFlow(cell, printed); !error.empty())
      return Fail(std::string(field), std::move(error));
    ReadProvenance(field);  // so that a wrong one is told
    const std::string source = Cell(Column(field, kSource));
    const auto ratio = ParseQuantity(Cell(CriticalRatioOf(field)), CriticalRatioOf(field)).value;
    const DerivedFlow derived = ConductanceOf(printed, ratio);
    part.numbers[std::string(field)] = {derived.conductance_dm3_per_s_bar, Provenance::kDerived,
                                        derived.formula + (source.empty() ? "" : "; " + source),
                                        ReadUncertainty(field)};
  }

  void ReadText(std::string_view field, Part& part) {
    const std::string cell = Cell(field);
    if (cell.empty()) return CheckNoOrigin(field);
    part.texts[std::string(field)] = {cell, ReadProvenance(field), Cell(Column(field, kSource))};
  }

  void ReadCurve(Part& part) {
    const std::string cell = Cell("curve");
    if (cell.empty()) {
      for (const std::string_view name : kCurveNumbers) CheckNoOrigin(name);
      return;
    }
    Curve curve;
    curve.free_air_provenance = ReadProvenance("free_air");
    curve.free_air_source = Cell("free_air.source");
    curve.current_provenance = ReadProvenance("current");
    curve.current_source = Cell("current.source");
    curve.free_air_uncertainty = ReadUncertainty("free_air");
    curve.current_uncertainty = ReadUncertainty("current");
    for (std::string_view point : Split(cell, ';')) {
      const auto numbers = Split(point, ':');
      std::vector<double> values;
      for (std::size_t i = 0; i < std::min(numbers.size(), std::size(kPointUnits)); ++i)
        if (const auto value = ParseQuantity(numbers[i], kPointUnits[i]).value)
          values.push_back(*value);
      if (values.size() != 3 || numbers.size() != 3) {
        Fail("curve", "must be points \"kPa gauge:L/min:A\" joined by ';', has \"" +
                          std::string(point.substr(0, 100)) + "\"");
        return;
      }
      curve.points.push_back({values[0], values[1], values[2]});
    }
    part.curve = std::move(curve);
  }

  const Family& family_;
  int row_;
  std::map<std::string, std::string, std::less<>> cells_;
  std::vector<CsvError> errors_;
};

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

CsvErrors ReadRows(std::string_view family_name, const RowSource& rows, const TakePart& take) {
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
    RowReader reader(*family, *header, cells, row);
    Part part = reader.Read();
    for (CsvError& error : reader.TakeErrors()) Add(std::move(error), of_rows);
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
  return ReadRows(family, rows, take);
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
