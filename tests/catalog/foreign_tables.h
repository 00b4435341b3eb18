// Tables as people have them, and what is read of them.
#ifndef PLENUM_TESTS_CATALOG_FOREIGN_TABLES_H_
#define PLENUM_TESTS_CATALOG_FOREIGN_TABLES_H_

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "catalog/tables/part_rows.h"
#include "catalog/tables/reading.h"
#include "tests/support/places.h"

namespace plenum::catalog {
namespace foreign_tables {

inline std::string Bytes(const std::string& name) {
  std::ifstream file(test::SourceDir() / "tests/catalog/tables" / name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct Read {
  TableReading reading;
  std::vector<Part> parts;
  std::vector<int> rows;
  std::vector<CsvError> errors;
};

inline Read ReadAs(const std::string& family, const std::string& bytes,
                   const TableOptions& options = {}) {
  Read read{ReadTable(family, bytes, options), {}, {}, {}};
  if (!read.reading.errors.empty() || !read.reading.questions.empty()) return read;
  read.errors = ReadRows(family, RowsOf(read.reading, bytes), [&](Part part, int row) {
                  read.parts.push_back(std::move(part));
                  read.rows.push_back(row);
                }).errors;
  return read;
}

struct Fact {  // of the part in this place
  std::size_t part;
  const char* field;
  double value;
};

struct ForeignTable {
  const char* file;
  const char* family;
  std::vector<std::string> ids;
  std::vector<Fact> facts;
  TableOptions options = {};
};

inline std::ostream& operator<<(std::ostream& out, const ForeignTable& table) {
  return out << table.file;
}

inline void ExpectReadWithoutAnEdit(const ForeignTable& table) {
  const Read read =
      ReadAs(table.family, Bytes(std::string("foreign/") + table.file), table.options);
  for (const Question& question : read.reading.questions) ADD_FAILURE() << question.text;
  for (const auto& errors : {read.reading.errors, read.errors})
    for (const CsvError& error : errors)
      ADD_FAILURE() << error.row << " " << error.column << ": " << error.detail;
  std::vector<std::string> ids;
  for (const Part& part : read.parts) ids.push_back(part.id);
  EXPECT_EQ(ids, table.ids);
  ASSERT_EQ(read.parts.size(), table.ids.size());
  for (const auto& [at, field, value] : table.facts) {
    const auto number = read.parts.at(at).numbers.find(field);
    ASSERT_NE(number, read.parts[at].numbers.end()) << field;
    EXPECT_NEAR(number->second.value, value, 1e-9 * std::abs(value)) << field;
  }
}

inline TableOptions BySetting(std::map<std::string, std::string> columns,
                              std::map<std::string, std::string> set) {
  TableOptions options;
  options.columns = std::move(columns);
  options.set = std::move(set);
  return options;
}

inline constexpr char kVolume[] = "internal_volume_ml", kMass[] = "mass_kg",
                      kBody[] = "body_volume_ml", kPressure[] = "pressure_max_kpa_gauge",
                      kOuter[] = "outer_diameter_mm", kInner[] = "inner_diameter_mm",
                      kPerMetre[] = "mass_kg_per_m", kC[] = "sonic_conductance_dm3_per_s_bar";

}  // namespace foreign_tables
}  // namespace plenum::catalog

#endif  // PLENUM_TESTS_CATALOG_FOREIGN_TABLES_H_
