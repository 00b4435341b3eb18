#include "catalog/store/tables/rows.h"

#include <stdexcept>

namespace plenum::catalog {
namespace {

std::optional<double> OptionalReal(const SqlStatement& row, int column) {
  if (row.IsNull(column)) return std::nullopt;
  return row.Real(column);
}

Provenance ReadProvenance(const SqlStatement& row, int column) {
  const auto provenance = ProvenanceFromName(row.Text(column));
  if (!provenance) throw SqlError("unknown provenance \"" + row.Text(column) + "\"");
  return *provenance;
}

std::string Word(Provenance provenance) { return std::string(Name(provenance)); }

// Hands each row of a table to its part. Rows and parts are both in order of id, so one walk along
// both suffices.
template <class Take>
void Distribute(SqlStatement& query, std::vector<Part>& parts, const Take& take) {
  auto part = parts.begin();
  while (query.Step()) {
    const std::string id = query.Text(0);
    while (part != parts.end() && part->id < id) ++part;
    if (part == parts.end() || part->id != id)
      throw SqlError("a row belongs to no part: \"" + id + "\"");
    take(query, *part);
  }
}

}  // namespace

PartWriter::PartWriter(SqlDatabase& db)
    : part_(db.Prepare("INSERT INTO part VALUES (?, ?, ?, ?, ?, ?, ?, ?)")),
      number_(db.Prepare("INSERT INTO number VALUES (?, ?, ?, ?, ?, ?)")),
      text_(db.Prepare("INSERT INTO text VALUES (?, ?, ?, ?, ?)")),
      curve_(db.Prepare("INSERT INTO curve VALUES (?, ?, ?, ?, ?, ?, ?)")),
      point_(db.Prepare("INSERT INTO curve_point VALUES (?, ?, ?, ?)")),
      alias_(db.Prepare("INSERT INTO alias VALUES (?, ?, ?)")),
      offer_(db.Prepare("INSERT INTO offer VALUES (?, ?, ?, ?, ?, ?, ?, ?)")),
      document_(db.Prepare("INSERT INTO document VALUES (?, ?, ?, ?)")),
      delete_(db.Prepare("DELETE FROM part WHERE id = ?")) {}

void PartWriter::Insert(const Part& part) {
  Run(*part_, part.id, part.family, part.manufacturer, part.part_number, part.origin, part.notes,
      part.series, part.orderable ? std::optional(*part.orderable ? 1 : 0) : std::nullopt);
  for (const auto& [field, number] : part.numbers)
    Run(*number_, part.id, field, number.value, Word(number.provenance), number.source,
        number.uncertainty);
  for (const auto& [field, text] : part.texts)
    Run(*text_, part.id, field, text.value, Word(text.provenance), text.source);
  for (int i = 0; const std::string& alias : part.aliases) Run(*alias_, part.id, i++, alias);
  for (int i = 0; const Offer& offer : part.offers)
    Run(*offer_, part.id, i++, offer.supplier, offer.price, offer.currency, offer.pack, offer.date,
        offer.link);
  for (int i = 0; const Document& document : part.documents)
    Run(*document_, part.id, i++, document.link, document.sha256);
  if (!part.curve) return;
  const Curve& curve = *part.curve;
  Run(*curve_, part.id, Word(curve.free_air_provenance), curve.free_air_source,
      Word(curve.current_provenance), curve.current_source, curve.free_air_uncertainty,
      curve.current_uncertainty);
  for (const CurvePoint& point : curve.points)
    Run(*point_, part.id, point.pressure_kpa_gauge, point.free_air_l_per_min, point.current_a);
}

void PartWriter::Delete(const std::string& id) { Run(*delete_, id); }

PartReader::PartReader(SqlDatabase& db, const std::optional<std::string>& column)
    : filtered_(column),
      part_(db.Prepare("SELECT id, family, manufacturer, part_number, origin, notes, series, "
                       "orderable FROM part" +
                       (column ? " WHERE " + *column + " = ?" : std::string()) + " ORDER BY id")),
      number_(db.Prepare(
          Select("field, value, provenance, source, uncertainty FROM number", "field", column))),
      text_(db.Prepare(Select("field, value, provenance, source FROM text", "field", column))),
      curve_(db.Prepare(Select("free_air_provenance, free_air_source, current_provenance, "
                               "current_source, free_air_uncertainty, current_uncertainty "
                               "FROM curve",
                               "part_id", column))),
      point_(db.Prepare(Select("pressure_kpa_gauge, free_air_l_per_min, current_a FROM curve_point",
                               "pressure_kpa_gauge", column))),
      alias_(db.Prepare(Select("alias FROM alias", "place", column))),
      offer_(db.Prepare(
          Select("supplier, price, currency, pack, date, link FROM offer", "place", column))),
      document_(db.Prepare(Select("link, sha256 FROM document", "place", column))) {}

std::string PartReader::Select(const std::string& what, const std::string& order,
                               const std::optional<std::string>& column) {
  return "SELECT part_id, " + what +
         (column ? " WHERE part_id IN (SELECT id FROM part WHERE " + *column + " = ?)" : "") +
         " ORDER BY part_id, " + order;
}

void PartReader::ReadBasics(std::vector<Part>& parts) {
  while (part_->Step()) {
    Part& part = parts.emplace_back();
    part.id = part_->Text(0);
    part.family = part_->Text(1);
    part.manufacturer = part_->Text(2);
    part.part_number = part_->Text(3);
    part.origin = part_->Text(4);
    part.notes = part_->Text(5);
    part.series = part_->Text(6);
    if (!part_->IsNull(7)) part.orderable = part_->Integer(7) != 0;
  }
}

void PartReader::ReadLists(std::vector<Part>& parts) {
  Distribute(*alias_, parts,
             [](SqlStatement& row, Part& part) { part.aliases.push_back(row.Text(1)); });
  Distribute(*offer_, parts, [](SqlStatement& row, Part& part) {
    part.offers.push_back(
        {row.Text(1), row.Real(2), row.Text(3), row.Real(4), row.Text(5), row.Text(6)});
  });
  Distribute(*document_, parts, [](SqlStatement& row, Part& part) {
    part.documents.push_back({row.Text(1), row.Text(2)});
  });
}

std::vector<Part> PartReader::Read(const std::string& value) {
  for (const auto* query :
       {&part_, &number_, &text_, &curve_, &point_, &alias_, &offer_, &document_}) {
    (*query)->Reset();
    if (filtered_) (*query)->Bind(1, value);
  }
  std::vector<Part> parts;
  ReadBasics(parts);
  if (filtered_ && parts.empty()) return parts;
  Distribute(*number_, parts, [](SqlStatement& row, Part& part) {
    part.numbers[row.Text(1)] = {row.Real(2), ReadProvenance(row, 3), row.Text(4),
                                 OptionalReal(row, 5)};
  });
  Distribute(*text_, parts, [](SqlStatement& row, Part& part) {
    part.texts[row.Text(1)] = {row.Text(2), ReadProvenance(row, 3), row.Text(4)};
  });
  Distribute(*curve_, parts, [](SqlStatement& row, Part& part) {
    Curve& curve = part.curve.emplace();
    curve.free_air_provenance = ReadProvenance(row, 1);
    curve.free_air_source = row.Text(2);
    curve.current_provenance = ReadProvenance(row, 3);
    curve.current_source = row.Text(4);
    curve.free_air_uncertainty = OptionalReal(row, 5);
    curve.current_uncertainty = OptionalReal(row, 6);
  });
  Distribute(*point_, parts, [](SqlStatement& row, Part& part) {
    if (!part.curve) throw SqlError("a curve point belongs to no curve");
    part.curve->points.push_back({row.Real(1), row.Real(2), row.Real(3)});
  });
  ReadLists(parts);
  return parts;
}

std::optional<Part> PartReader::One(const std::string& value) {
  std::vector<Part> found = Read(value);
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

std::vector<Part> ReadParts(SqlDatabase& db) { return PartReader(db, std::nullopt).Read(); }

}  // namespace plenum::catalog
