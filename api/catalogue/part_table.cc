#include "api/catalogue/part_table.h"

#include <utility>

namespace plenum::api {
namespace {

template <typename Column>
const Column* FindColumn(const std::map<std::string, Column, std::less<>>& columns,
                         const std::string& field) {
  const auto found = columns.find(field);
  return found == columns.end() ? nullptr : &found->second;
}

}  // namespace

PartTable::PartTable(PartVector parts)
    : rows_(std::move(parts)), columns_(ColumnsOf(rows_.rows())) {}

PartTable::PartTable(const std::vector<catalog::Part>& parts)
    : PartTable(PartVector(PartVector(), &parts)) {}

PartTable::PartTable(const PartTable& before, catalog::PartChanges changes)
    : PartTable(before, std::move(changes), std::vector<Run>()) {}

PartTable::PartTable(const PartTable& before, catalog::PartChanges changes, std::vector<Run> runs)
    : rows_(before.rows_, std::move(changes), runs),
      columns_(ColumnsAfter(before.columns_, before.rows_.size(), runs)) {}

const NumberColumn* PartTable::Numbers(const std::string& field) const {
  return FindColumn(columns_.numbers, field);
}

const TextColumn* PartTable::Texts(const std::string& field) const {
  return FindColumn(columns_.texts, field);
}

}  // namespace plenum::api
