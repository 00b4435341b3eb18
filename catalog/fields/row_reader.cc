#include "catalog/fields/row_reader.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "catalog/fields/laws/estimate_missing.h"
#include "catalog/fields/laws/printed_part.h"
#include "catalog/fields/part_lists.h"
#include "catalog/fields/price.h"
#include "catalog/units/printed_flow.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::string_view kProvenance = ".provenance";
constexpr std::string_view kSource = ".source";
constexpr std::string_view kUncertainty = ".uncertainty";
// Names whose ends give the units of a curve point.
constexpr std::string_view kPointUnits[] = {"_kpa_gauge", "_l_per_min", "_a"};
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

  Part Read(bool complete) {
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
    if (complete) EstimateMissing(part);

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
    if (field == "body_volume_ml" && IsPrintedBody(cell)) return ReadBody(field, cell, part);
    if (field == "current_max_a" && PrintedCRate(cell)) return ReadCRate(field, cell, part);
    if (field == "capacity_ah" && PrintedEnergy(cell)) return ReadEnergy(field, cell, part);
    const Quantity quantity = ParseQuantity(cell, field);
    const Provenance provenance = ReadProvenance(field);
    if (quantity.value)
      part.numbers[std::string(field)] = {*quantity.value, provenance, Cell(Column(field, kSource)),
                                          ReadUncertainty(field)};
    else
      Fail(std::string(field), quantity.error);
  }

  // What was printed is `derived`, with the formula before the source that the row gives.
  void TakeDerived(std::string_view field, const PrintedNumber& printed, Part& part) {
    ReadProvenance(field);  // so that a wrong one is told
    const std::string source = Cell(Column(field, kSource));
    part.numbers[std::string(field)] = {printed.value, Provenance::kDerived,
                                        printed.formula + (source.empty() ? "" : "; " + source),
                                        ReadUncertainty(field)};
  }

  void ReadBody(std::string_view field, const std::string& cell, Part& part) {
    PrintedBody body;
    if (std::string error = ReadPrintedBody(cell, body); !error.empty())
      return Fail(std::string(field), std::move(error));
    TakeDerived(field, BodyVolumeOf(body), part);
  }

  void ReadCRate(std::string_view field, const std::string& cell, Part& part) {
    const auto capacity = part.numbers.find("capacity_ah");  // which stands before it
    if (capacity == part.numbers.end())
      return Fail(std::string(field), "a C-rate needs capacity_ah, which the row lacks");
    TakeDerived(field, CurrentOfCRate(*PrintedCRate(cell), capacity->second.value), part);
  }

  void ReadEnergy(std::string_view field, const std::string& cell, Part& part) {
    const auto voltage = part.numbers.find("nominal_voltage_v");  // which stands before it
    if (voltage == part.numbers.end() || !(voltage->second.value > 0))
      return Fail(std::string(field), "an energy needs nominal_voltage_v, which the row lacks");
    TakeDerived(field, CapacityOfEnergy(*PrintedEnergy(cell), voltage->second.value), part);
  }

  void ReadPump(const std::string& cell, Part& part) {
    PrintedPump pump;
    std::string error = ReadPrintedPump(cell, pump);
    for (const std::string_view name : kCurveNumbers) ReadProvenance(name);
    if (error.empty()) error = DeriveCurve(pump, Cell("free_air.source"), part);
    if (!error.empty()) Fail("curve", std::move(error));
  }

  void ReadPrinted(std::string_view field, const std::string& cell, Part& part) {
    PrintedFlow printed;
    if (std::string error = ReadPrintedFlow(cell, printed); !error.empty())
      return Fail(std::string(field), std::move(error));
    const auto ratio = ParseQuantity(Cell(CriticalRatioOf(field)), CriticalRatioOf(field)).value;
    const DerivedFlow derived = ConductanceOf(printed, ratio);
    TakeDerived(field, {derived.conductance_dm3_per_s_bar, derived.formula}, part);
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
    if (IsPrintedPump(cell)) return ReadPump(cell, part);
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

}  // namespace

RowRead ReadRow(const Family& family, const std::vector<std::string>& header, const CsvRow& cells,
                int row, bool complete) {
  RowReader reader(family, header, cells, row);
  RowRead read;
  read.part = reader.Read(complete);
  read.errors = reader.TakeErrors();
  return read;
}

}  // namespace plenum::catalog
