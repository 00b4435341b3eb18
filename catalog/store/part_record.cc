#include "catalog/store/part_record.h"

#include "catalog/fields/csv_table.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

std::string Word(Provenance provenance) { return std::string(Name(provenance)); }

bool TakeNumber(const CsvRow& row, Part& part) {
  const auto value = ParseNumber(row[2]);
  const auto provenance = ProvenanceFromName(row[3]);
  if (!value || !provenance) return false;
  Number& number = part.numbers[row[1]] = {*value, *provenance, row[4]};
  if (row.size() == 5) return true;
  number.uncertainty = ParseNumber(row[5]);
  return number.uncertainty.has_value();
}

bool TakeText(const CsvRow& row, Part& part) {
  const auto provenance = ProvenanceFromName(row[3]);
  if (provenance) part.texts[row[1]] = {row[2], *provenance, row[4]};
  return provenance.has_value();
}

// An empty cell is no number.
bool TakeOptional(const std::string& cell, std::optional<double>& number) {
  number = ParseNumber(cell);
  return number || cell.empty();
}

bool TakeCurve(const CsvRow& row, Part& part) {
  const auto free_air = ProvenanceFromName(row[1]), current = ProvenanceFromName(row[3]);
  if (!free_air || !current) return false;
  Curve& curve = part.curve.emplace(Curve{{}, *free_air, row[2], *current, row[4]});
  return row.size() == 5 || (TakeOptional(row[5], curve.free_air_uncertainty) &&
                             TakeOptional(row[6], curve.current_uncertainty));
}

bool TakePoint(const CsvRow& row, Part& part) {
  const auto pressure = ParseNumber(row[1]), flow = ParseNumber(row[2]),
             current = ParseNumber(row[3]);
  if (!part.curve || !pressure || !flow || !current) return false;
  part.curve->points.push_back({*pressure, *flow, *current});
  return true;
}

bool TakeOffer(const CsvRow& row, Part& part) {
  const auto price = ParseNumber(row[2]), pack = ParseNumber(row[4]);
  if (!price || !pack) return false;
  part.offers.push_back({row[1], *price, row[3], *pack, row[5], row[6]});
  return true;
}

// Takes the cells of one line into `part`; false if they are none of the known lines.
bool Take(const CsvRow& row, Part& part) {
  const std::string& kind = row.front();
  const std::size_t size = row.size();
  if (kind == "part" && size == 7) {
    part.id = row[1];
    part.family = row[2];
    part.manufacturer = row[3];
    part.part_number = row[4];
    part.origin = row[5];
    part.notes = row[6];
    return true;
  }
  if (kind == "number" && (size == 5 || size == 6)) return TakeNumber(row, part);
  if (kind == "text" && size == 5) return TakeText(row, part);
  if (kind == "curve" && (size == 5 || size == 7)) return TakeCurve(row, part);
  if (kind == "point" && size == 4) return TakePoint(row, part);
  if (kind == "offer" && size == 7) return TakeOffer(row, part);
  if (kind == "document" && size == 3) {
    part.documents.push_back({row[1], row[2]});
    return true;
  }
  if (size != 2) return false;
  if (kind == "series") part.series = row[1];
  if (kind == "alias") part.aliases.push_back(row[1]);
  if (kind == "orderable") part.orderable = row[1] == "true";
  return kind == "series" || kind == "alias" ||
         (kind == "orderable" && (row[1] == "true" || row[1] == "false"));
}

std::string NumberOrEmpty(const std::optional<double>& number) {
  return number ? FormatNumber(*number) : std::string();
}

// What came after the first release: a part without it has the record that it had then.
std::string FormatDetails(const Part& part) {
  std::string record;
  if (!part.series.empty()) record += FormatRow({"series", part.series});
  if (part.orderable) record += FormatRow({"orderable", *part.orderable ? "true" : "false"});
  for (const std::string& alias : part.aliases) record += FormatRow({"alias", alias});
  for (const Offer& offer : part.offers)
    record += FormatRow({"offer", offer.supplier, FormatNumber(offer.price), offer.currency,
                         FormatNumber(offer.pack), offer.date, offer.link});
  for (const Document& document : part.documents)
    record += FormatRow({"document", document.link, document.sha256});
  return record;
}

}  // namespace

std::string FormatRecord(const Part& part) {
  std::string record = FormatRow(
      {"part", part.id, part.family, part.manufacturer, part.part_number, part.origin, part.notes});
  record += FormatDetails(part);
  for (const auto& [field, number] : part.numbers) {
    CsvRow row{"number", field, FormatNumber(number.value), Word(number.provenance), number.source};
    if (number.uncertainty) row.push_back(FormatNumber(*number.uncertainty));
    record += FormatRow(row);
  }
  for (const auto& [field, text] : part.texts)
    record += FormatRow({"text", field, text.value, Word(text.provenance), text.source});
  if (!part.curve) return record;
  const Curve& curve = *part.curve;
  CsvRow row{"curve", Word(curve.free_air_provenance), curve.free_air_source,
             Word(curve.current_provenance), curve.current_source};
  if (curve.free_air_uncertainty || curve.current_uncertainty) {
    row.push_back(NumberOrEmpty(curve.free_air_uncertainty));
    row.push_back(NumberOrEmpty(curve.current_uncertainty));
  }
  record += FormatRow(row);
  for (const CurvePoint& point : curve.points)
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
