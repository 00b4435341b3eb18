// Parts column by column, so that filters, sorts and counts over a long list read only what they
// ask for.
#ifndef PLENUM_API_CATALOGUE_PART_TABLE_H_
#define PLENUM_API_CATALOGUE_PART_TABLE_H_

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::api {

// One text field of all parts: its different values in order, and for each part which it has.
struct TextColumn {
  static constexpr std::uint32_t kNone = UINT32_MAX;  // also in the order the last
  std::vector<std::string_view> values;
  std::vector<std::uint32_t> place;
};

class PartTable {
 public:
  // `parts`, in order of id, must outlive the table.
  explicit PartTable(const std::vector<catalog::Part>& parts);

  const std::vector<catalog::Part>& parts() const { return parts_; }
  // A number a part, NaN where it has none; nullptr where no part has the field.
  const std::vector<double>* Numbers(const std::string& field) const;
  // Also family, manufacturer, part_number and origin; series and orderable where a part has them.
  const TextColumn* Texts(const std::string& field) const;
  // By name of the field.
  const std::map<std::string, std::vector<double>, std::less<>>& numbers() const {
    return numbers_;
  }
  const std::map<std::string, TextColumn, std::less<>>& texts() const { return texts_; }

 private:
  const std::vector<catalog::Part>& parts_;
  std::map<std::string, std::vector<double>, std::less<>> numbers_;
  std::map<std::string, TextColumn, std::less<>> texts_;
};

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PART_TABLE_H_
