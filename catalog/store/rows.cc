#include "catalog/store/rows.h"

#include <stdexcept>

namespace plenum::catalog {
namespace {

template <class Value>
void Bind(SQLite::Statement& statement, int index, const Value& value) {
  statement.bind(index, value);
}
template <class Value>
void Bind(SQLite::Statement& statement, int index, const std::optional<Value>& value) {
  if (value)
    statement.bind(index, *value);
  else
    statement.bind(index);
}

template <class... Values>
void Run(SQLite::Statement& statement, const Values&... values) {
  statement.reset();
  int index = 0;
  (Bind(statement, ++index, values), ...);
  statement.exec();
}

// A missing number would read as 0.0.
double Real(const SQLite::Column& column) {
  if (!column.isFloat()) throw SQLite::Exception("a number is missing or not a real");
  return column.getDouble();
}

std::optional<double> OptionalReal(const SQLite::Column& column) {
  if (column.isNull()) return std::nullopt;
  return Real(column);
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
void Distribute(SQLite::Statement& query, std::vector<Part>& parts, const Take& take) {
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
    : part_(db, "INSERT INTO part VALUES (?, ?, ?, ?, ?, ?, ?, ?)"),
      number_(db, "INSERT INTO number VALUES (?, ?, ?, ?, ?, ?)"),
      text_(db, "INSERT INTO text VALUES (?, ?, ?, ?, ?)"),
      curve_(db, "INSERT INTO curve VALUES (?, ?, ?, ?, ?, ?, ?)"),
      point_(db, "INSERT INTO curve_point VALUES (?, ?, ?, ?)"),
      alias_(db, "INSERT INTO alias VALUES (?, ?, ?)"),
      offer_(db, "INSERT INTO offer VALUES (?, ?, ?, ?, ?, ?, ?, ?)"),
      document_(db, "INSERT INTO document VALUES (?, ?, ?, ?)"),
      delete_(db, "DELETE FROM part WHERE id = ?") {}

void PartWriter::Insert(const Part& part) {
  Run(part_, part.id, part.family, part.manufacturer, part.part_number, part.origin, part.notes,
      part.series, part.orderable ? std::optional(*part.orderable ? 1 : 0) : std::nullopt);
  for (const auto& [field, number] : part.numbers)
    Run(number_, part.id, field, number.value, Word(number.provenance), number.source,
        number.uncertainty);
  for (const auto& [field, text] : part.texts)
    Run(text_, part.id, field, text.value, Word(text.provenance), text.source);
  for (int i = 0; const std::string& alias : part.aliases) Run(alias_, part.id, i++, alias);
  for (int i = 0; const Offer& offer : part.offers)
    Run(offer_, part.id, i++, offer.supplier, offer.price, offer.currency, offer.pack, offer.date,
        offer.link);
  for (int i = 0; const Document& document : part.documents)
    Run(document_, part.id, i++, document.link, document.sha256);
  if (!part.curve) return;
  const Curve& curve = *part.curve;
  Run(curve_, part.id, Word(curve.free_air_provenance), curve.free_air_source,
      Word(curve.current_provenance), curve.current_source, curve.free_air_uncertainty,
      curve.current_uncertainty);
  for (const CurvePoint& point : curve.points)
    Run(point_, part.id, point.pressure_kpa_gauge, point.free_air_l_per_min, point.current_a);
}

void PartWriter::Delete(const std::string& id) { Run(delete_, id); }

PartReader::PartReader(SQLite::Database& db, const std::optional<std::string>& column)
    : filtered_(column),
      part_(db,
            "SELECT id, family, manufacturer, part_number, origin, notes, series, orderable "
            "FROM part" +
                (column ? " WHERE " + *column + " = ?" : std::string()) + " ORDER BY id"),
      number_(db,
              Select("field, value, provenance, source, uncertainty FROM number", "field", column)),
      text_(db, Select("field, value, provenance, source FROM text", "field", column)),
      curve_(db, Select("free_air_provenance, free_air_source, current_provenance, "
                        "current_source, free_air_uncertainty, current_uncertainty FROM curve",
                        "part_id", column)),
      point_(db, Select("pressure_kpa_gauge, free_air_l_per_min, current_a FROM curve_point",
                        "pressure_kpa_gauge", column)),
      alias_(db, Select("alias FROM alias", "place", column)),
      offer_(db, Select("supplier, price, currency, pack, date, link FROM offer", "place", column)),
      document_(db, Select("link, sha256 FROM document", "place", column)) {}

std::string PartReader::Select(const std::string& what, const std::string& order,
                               const std::optional<std::string>& column) {
  return "SELECT part_id, " + what +
         (column ? " WHERE part_id IN (SELECT id FROM part WHERE " + *column + " = ?)" : "") +
         " ORDER BY part_id, " + order;
}

void PartReader::ReadBasics(std::vector<Part>& parts) {
  while (part_.executeStep()) {
    Part& part = parts.emplace_back();
    part.id = part_.getColumn(0).getString();
    part.family = part_.getColumn(1).getString();
    part.manufacturer = part_.getColumn(2).getString();
    part.part_number = part_.getColumn(3).getString();
    part.origin = part_.getColumn(4).getString();
    part.notes = part_.getColumn(5).getString();
    part.series = part_.getColumn(6).getString();
    if (const SQLite::Column orderable = part_.getColumn(7); !orderable.isNull())
      part.orderable = orderable.getInt() != 0;
  }
}

void PartReader::ReadLists(std::vector<Part>& parts) {
  Distribute(alias_, parts, [](SQLite::Statement& row, Part& part) {
    part.aliases.push_back(row.getColumn(1).getString());
  });
  Distribute(offer_, parts, [](SQLite::Statement& row, Part& part) {
    part.offers.push_back({row.getColumn(1).getString(), Real(row.getColumn(2)),
                           row.getColumn(3).getString(), Real(row.getColumn(4)),
                           row.getColumn(5).getString(), row.getColumn(6).getString()});
  });
  Distribute(document_, parts, [](SQLite::Statement& row, Part& part) {
    part.documents.push_back({row.getColumn(1).getString(), row.getColumn(2).getString()});
  });
}

std::vector<Part> PartReader::Read(const std::string& value) {
  for (SQLite::Statement* query :
       {&part_, &number_, &text_, &curve_, &point_, &alias_, &offer_, &document_}) {
    query->reset();
    if (filtered_) query->bind(1, value);
  }
  std::vector<Part> parts;
  ReadBasics(parts);
  if (filtered_ && parts.empty()) return parts;
  Distribute(number_, parts, [](SQLite::Statement& row, Part& part) {
    part.numbers[row.getColumn(1).getString()] = {
        Real(row.getColumn(2)), ReadProvenance(row.getColumn(3)), row.getColumn(4).getString(),
        OptionalReal(row.getColumn(5))};
  });
  Distribute(text_, parts, [](SQLite::Statement& row, Part& part) {
    part.texts[row.getColumn(1).getString()] = {row.getColumn(2).getString(),
                                                ReadProvenance(row.getColumn(3)),
                                                row.getColumn(4).getString()};
  });
  Distribute(curve_, parts, [](SQLite::Statement& row, Part& part) {
    Curve& curve = part.curve.emplace();
    curve.free_air_provenance = ReadProvenance(row.getColumn(1));
    curve.free_air_source = row.getColumn(2).getString();
    curve.current_provenance = ReadProvenance(row.getColumn(3));
    curve.current_source = row.getColumn(4).getString();
    curve.free_air_uncertainty = OptionalReal(row.getColumn(5));
    curve.current_uncertainty = OptionalReal(row.getColumn(6));
  });
  Distribute(point_, parts, [](SQLite::Statement& row, Part& part) {
    if (!part.curve) throw SQLite::Exception("a curve point belongs to no curve");
    part.curve->points.push_back(
        {Real(row.getColumn(1)), Real(row.getColumn(2)), Real(row.getColumn(3))});
  });
  ReadLists(parts);
  return parts;
}

std::optional<Part> PartReader::One(const std::string& value) {
  std::vector<Part> found = Read(value);
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

std::vector<Part> ReadParts(SQLite::Database& db) { return PartReader(db, std::nullopt).Read(); }

}  // namespace plenum::catalog
