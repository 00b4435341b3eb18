// Fields of parts column by column: numbers, texts, and what is known of each part beside its
// fields.
#ifndef PLENUM_API_CATALOGUE_ROWS_PART_COLUMNS_H_
#define PLENUM_API_CATALOGUE_ROWS_PART_COLUMNS_H_

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/catalogue/rows/revision_rows.h"
#include "catalog/fields/part.h"

namespace plenum::api {

// One text field of all parts: different values in order, and for each part which it has. A value
// that a write took away may stay without a part.
struct TextColumn {
  static constexpr std::uint32_t kNone = UINT32_MAX;  // also in the order the last
  std::vector<std::string_view> values;               // of the parts, which outlive the column
  std::vector<std::uint32_t> place;
};

// A number a part, NaN where it has none.
using NumberColumn = std::vector<double>;

struct PartColumns {
  std::map<std::string, NumberColumn, std::less<>> numbers;
  std::map<std::string, TextColumn, std::less<>> texts;
};

// Beside the fields of parts: what the table knows of each, "true" or "false", …
std::span<const std::string_view> DerivedFlags();
// … and which share of its numbers and texts has each provenance (catalog/check/coverage.h).
std::span<const std::string_view> ProvenanceShares();

PartColumns ColumnsOf(std::span<const catalog::Part* const> parts);
// Those of a list that came of another one of `rows` rows by `runs`.
PartColumns ColumnsAfter(const PartColumns& before, std::size_t rows, const std::vector<Run>& runs);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_ROWS_PART_COLUMNS_H_
