#include "catalog/fields/laws/laws.h"

#include <algorithm>
#include <stdexcept>

#include "catalog/fields/csv_table.h"
#include "catalog/fields/laws/laws_csv.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

// "mass_kg^1.09 power_w^0.4"
std::vector<LawPower> ReadPowers(std::string_view text) {
  std::vector<LawPower> powers;
  for (const std::string_view piece : Split(text, ' ')) {
    if (piece.empty()) continue;
    const std::size_t at = piece.find('^');
    powers.push_back({std::string(piece.substr(0, at)), ParseNumber(piece.substr(at + 1)).value()});
  }
  return powers;
}

std::vector<FieldLaw> ReadLaws() {
  std::vector<FieldLaw> laws;
  for (const CsvRow& row : ParseTable(LawsCsv()).rows)
    if (const auto factor = ParseNumber(row.at(3)))  // none in the header
      laws.push_back({row[0], row[1], row[2], *factor, ReadPowers(row.at(4)),
                      ParseNumber(row.at(5)), row.at(6)});
  return laws;
}

}  // namespace

const std::vector<FieldLaw>& FieldLaws() {
  static const std::vector<FieldLaw> laws = ReadLaws();
  return laws;
}

const FieldLaw& PumpCoefficient(std::string_view name) {
  const auto& laws = FieldLaws();
  const auto found = std::find_if(laws.begin(), laws.end(), [&](const FieldLaw& law) {
    return law.family == "pump" && law.field == name;
  });
  if (found == laws.end())
    throw std::logic_error("laws.csv has no coefficient " + std::string(name) + " of pumps");
  return *found;
}

}  // namespace plenum::catalog
