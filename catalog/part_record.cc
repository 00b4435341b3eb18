#include "catalog/part_record.h"

#include "catalog/csv_table.h"
#include "catalog/text.h"

namespace plenum::catalog {
namespace {

std::string Word(Provenance provenance) { return std::string(Name(provenance)); }

// Takes the cells of one line into `part`; false if they are none of the known lines.
bool Take(const CsvRow& row, Part& part) {
  const std::string& kind = row.front();
  if (kind == "part" && row.size() == 7) {
    part.id = row[1];
    part.family = row[2];
    part.manufacturer = row[3];
    part.part_number = row[4];
    part.origin = row[5];
    part.notes = row[6];
    return true;
  }
  if ((kind == "number" || kind == "text") && row.size() == 5) {
    const auto provenance = ProvenanceFromName(row[3]);
    if (!provenance) return false;
    if (kind == "text") {
      part.texts[row[1]] = {row[2], *provenance, row[4]};
      return true;
    }
    const auto value = ParseNumber(row[2]);
    if (value) part.numbers[row[1]] = {*value, *provenance, row[4]};
    return value.has_value();
  }
  if (kind == "curve" && row.size() == 5) {
    const auto free_air = ProvenanceFromName(row[1]), current = ProvenanceFromName(row[3]);
    if (!free_air || !current) return false;
    part.curve = Curve{{}, *free_air, row[2], *current, row[4]};
    return true;
  }
  if (kind == "point" && row.size() == 4 && part.curve) {
    const auto pressure = ParseNumber(row[1]), flow = ParseNumber(row[2]),
               current = ParseNumber(row[3]);
    if (!pressure || !flow || !current) return false;
    part.curve->points.push_back({*pressure, *flow, *current});
    return true;
  }
  return false;
}

}  // namespace

std::string FormatRecord(const Part& part) {
  std::string record = FormatRow(
      {"part", part.id, part.family, part.manufacturer, part.part_number, part.origin, part.notes});
  for (const auto& [field, number] : part.numbers)
    record += FormatRow(
        {"number", field, FormatNumber(number.value), Word(number.provenance), number.source});
  for (const auto& [field, text] : part.texts)
    record += FormatRow({"text", field, text.value, Word(text.provenance), text.source});
  if (!part.curve) return record;
  record += FormatRow({"curve", Word(part.curve->free_air_provenance), part.curve->free_air_source,
                       Word(part.curve->current_provenance), part.curve->current_source});
  for (const CurvePoint& point : part.curve->points)
    record += FormatRow({"point", FormatNumber(point.pressure_kpa_gauge),
                         FormatNumber(point.free_air_l_per_min), FormatNumber(point.current_a)});
  return record;
}

std::optional<Part> ParseRecord(std::string_view text) {
  const CsvTable table = ParseTable(text);
  if (!table.errors.empty() || table.rows.empty() || table.rows.front().front() != "part")
    return std::nullopt;
  Part part;
  for (const CsvRow& row : table.rows)
    if (!Take(row, part)) return std::nullopt;
  return part;
}

}  // namespace plenum::catalog
