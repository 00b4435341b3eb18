#include "catalog/rows.h"

#include <stdexcept>

namespace plenum::catalog {
namespace {

template <class... Values>
void Run(SQLite::Statement& statement, const Values&... values) {
  statement.reset();
  int index = 0;
  (statement.bind(++index, values), ...);
  statement.exec();
}

// A missing number would read as 0.0.
double Real(const SQLite::Column& column) {
  if (!column.isFloat()) throw SQLite::Exception("a number is missing or not a real");
  return column.getDouble();
}

Provenance ReadProvenance(const SQLite::Column& column) {
  const auto provenance = ProvenanceFromName(column.getString());
  if (!provenance) throw SQLite::Exception("unknown provenance \"" + column.getString() + "\"");
  return *provenance;
}

std::string Word(Provenance provenance) { return std::string(Name(provenance)); }

// Hands each row of a table to its part. Rows and parts are both in order of id, so one walk along
// both suffices.
template <class Take>
void Distribute(SQLite::Database& db, const std::string& select, const std::string& order,
                const std::optional<Filter>& filter, std::vector<Part>& parts, const Take& take) {
  const std::string where =
      filter ? " WHERE part_id IN (SELECT id FROM part WHERE " + filter->column + " = ?)" : "";
  SQLite::Statement query(db, select + where + " ORDER BY " + order);
  if (filter) query.bind(1, filter->value);
  auto part = parts.begin();
  while (query.executeStep()) {
    const std::string id = query.getColumn(0).getString();
    while (part != parts.end() && part->id < id) ++part;
    if (part == parts.end() || part->id != id)
      throw SQLite::Exception("a row belongs to no part: \"" + id + "\"");
    take(query, *part);
  }
}

}  // namespace

PartWriter::PartWriter(SQLite::Database& db)
    : part_(db, "INSERT INTO part VALUES (?, ?, ?, ?, ?, ?)"),
      number_(db, "INSERT INTO number VALUES (?, ?, ?, ?, ?)"),
      text_(db, "INSERT INTO text VALUES (?, ?, ?, ?, ?)"),
      curve_(db, "INSERT INTO curve VALUES (?, ?, ?, ?, ?)"),
      point_(db, "INSERT INTO curve_point VALUES (?, ?, ?, ?)"),
      delete_(db, "DELETE FROM part WHERE id = ?") {}

void PartWriter::Insert(const Part& part) {
  Run(part_, part.id, part.family, part.manufacturer, part.part_number, part.origin, part.notes);
  for (const auto& [field, number] : part.numbers)
    Run(number_, part.id, field, number.value, Word(number.provenance), number.source);
  for (const auto& [field, text] : part.texts)
    Run(text_, part.id, field, text.value, Word(text.provenance), text.source);
  if (!part.curve) return;
  const Curve& curve = *part.curve;
  Run(curve_, part.id, Word(curve.free_air_provenance), curve.free_air_source,
      Word(curve.current_provenance), curve.current_source);
  for (const CurvePoint& point : curve.points)
    Run(point_, part.id, point.pressure_kpa_gauge, point.free_air_l_per_min, point.current_a);
}

void PartWriter::Delete(const std::string& id) { Run(delete_, id); }

std::vector<Part> ReadParts(SQLite::Database& db, const std::optional<Filter>& filter) {
  std::vector<Part> parts;
  SQLite::Statement query(
      db, "SELECT id, family, manufacturer, part_number, origin, notes FROM part" +
              (filter ? " WHERE " + filter->column + " = ?" : std::string()) + " ORDER BY id");
  if (filter) query.bind(1, filter->value);
  while (query.executeStep()) {
    Part& part = parts.emplace_back();
    part.id = query.getColumn(0).getString();
    part.family = query.getColumn(1).getString();
    part.manufacturer = query.getColumn(2).getString();
    part.part_number = query.getColumn(3).getString();
    part.origin = query.getColumn(4).getString();
    part.notes = query.getColumn(5).getString();
  }
  Distribute(db, "SELECT part_id, field, value, provenance, source FROM number", "part_id, field",
             filter, parts, [](SQLite::Statement& row, Part& part) {
               part.numbers[row.getColumn(1).getString()] = {Real(row.getColumn(2)),
                                                             ReadProvenance(row.getColumn(3)),
                                                             row.getColumn(4).getString()};
             });
  Distribute(db, "SELECT part_id, field, value, provenance, source FROM text", "part_id, field",
             filter, parts, [](SQLite::Statement& row, Part& part) {
               part.texts[row.getColumn(1).getString()] = {row.getColumn(2).getString(),
                                                           ReadProvenance(row.getColumn(3)),
                                                           row.getColumn(4).getString()};
             });
  Distribute(db,
             "SELECT part_id, free_air_provenance, free_air_source, current_provenance, "
             "current_source FROM curve",
             "part_id", filter, parts, [](SQLite::Statement& row, Part& part) {
               Curve& curve = part.curve.emplace();
               curve.free_air_provenance = ReadProvenance(row.getColumn(1));
               curve.free_air_source = row.getColumn(2).getString();
               curve.current_provenance = ReadProvenance(row.getColumn(3));
               curve.current_source = row.getColumn(4).getString();
             });
  Distribute(db,
             "SELECT part_id, pressure_kpa_gauge, free_air_l_per_min, current_a FROM curve_point",
             "part_id, pressure_kpa_gauge", filter, parts, [](SQLite::Statement& row, Part& part) {
               if (!part.curve) throw SQLite::Exception("a curve point belongs to no curve");
               part.curve->points.push_back(
                   {Real(row.getColumn(1)), Real(row.getColumn(2)), Real(row.getColumn(3))});
             });
  return parts;
}

}  // namespace plenum::catalog
