// Parts of a list, row by row and column by column, so that filters, sorts and counts over a long
// list read only what they ask for.
#ifndef PLENUM_API_CATALOGUE_PART_TABLE_H_
#define PLENUM_API_CATALOGUE_PART_TABLE_H_

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "api/catalogue/rows/part_columns.h"
#include "api/catalogue/rows/revision_rows.h"
#include "catalog/fields/part.h"
#include "catalog/store/revision.h"

namespace plenum::api {

class PartTable {
 public:
  // In order of id.
  explicit PartTable(PartVector parts);
  // `parts` must outlive the table.
  explicit PartTable(const std::vector<catalog::Part>& parts);
  // The table of the parts of `before` with `changes`: what a write costs the next list.
  PartTable(const PartTable& before, catalog::PartChanges changes);

  const PartRows& rows() const { return rows_; }
  // nullptr where no part has the field.
  const NumberColumn* Numbers(const std::string& field) const;
  // Also family, manufacturer, part_number, origin and the derived flags; series and orderable
  // where a part has them.
  const TextColumn* Texts(const std::string& field) const;
  // By name of the field.
  const std::map<std::string, NumberColumn, std::less<>>& numbers() const {
    return columns_.numbers;
  }
  const std::map<std::string, TextColumn, std::less<>>& texts() const { return columns_.texts; }

 private:
  PartTable(const PartTable& before, catalog::PartChanges changes, std::vector<Run> runs);

  const PartRows rows_;
  const PartColumns columns_;
};

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PART_TABLE_H_
