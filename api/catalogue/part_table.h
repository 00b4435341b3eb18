// Parts column by column, so that filters, sorts and counts over a long list read only what they
// ask for.
#ifndef PLENUM_API_CATALOGUE_PART_TABLE_H_
#define PLENUM_API_CATALOGUE_PART_TABLE_H_

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/catalogue/part_search.h"
#include "catalog/fields/part.h"

namespace plenum::api {

// One text field of all parts: its different values in order, and for each part which it has.
struct TextColumn {
  static constexpr std::uint32_t kNone = UINT32_MAX;  // also in the order the last
  std::vector<std::string_view> values;
  std::vector<std::uint32_t> place;
};

// Beside the fields of parts: what the table knows of each, "true" or "false", …
std::span<const std::string_view> DerivedFlags();
// … and which share of its numbers and texts has each provenance (catalog/check/coverage.h).
std::span<const std::string_view> ProvenanceShares();

class PartTable {
 public:
  // `parts`, in order of id, must outlive the table.
  explicit PartTable(const std::vector<catalog::Part>& parts);

  const std::vector<catalog::Part>& parts() const { return parts_; }
  // A number a part, NaN where it has none; nullptr where no part has the field.
  const std::vector<double>* Numbers(const std::string& field) const;
  // Also family, manufacturer, part_number, origin and the derived flags; series and orderable
  // where a part has them.
  const TextColumn* Texts(const std::string& field) const;
  // By name of the field.
  const std::map<std::string, std::vector<double>, std::less<>>& numbers() const {
    return numbers_;
  }
  const std::map<std::string, TextColumn, std::less<>>& texts() const { return texts_; }

  // Its index is made when a search first needs it.
  std::vector<std::uint8_t> Search(std::string_view text) const;

 private:
  const std::vector<catalog::Part>& parts_;
  std::map<std::string, std::vector<double>, std::less<>> numbers_;
  std::map<std::string, TextColumn, std::less<>> texts_;
  mutable std::once_flag search_made_;
  mutable std::unique_ptr<const PartSearch> search_;
};

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PART_TABLE_H_
