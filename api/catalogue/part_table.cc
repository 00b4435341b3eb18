#include "api/catalogue/part_table.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace plenum::api {
namespace {

// Collects one text field part by part.
class TextColumnBuilder {
 public:
  explicit TextColumnBuilder(std::size_t parts) : place_(parts, TextColumn::kNone) {}

  void Set(std::size_t part, std::string_view value) {
    const auto next = static_cast<std::uint32_t>(number_.size());
    place_[part] = number_.emplace(value, next).first->second;
  }

  // With the values in order instead of as they came.
  TextColumn Build() {
    std::vector<std::pair<std::string_view, std::uint32_t>> sorted(number_.begin(), number_.end());
    std::sort(sorted.begin(), sorted.end());
    TextColumn column;
    std::vector<std::uint32_t> place_of(sorted.size());
    for (const auto& [value, number] : sorted) {
      place_of[number] = static_cast<std::uint32_t>(column.values.size());
      column.values.push_back(value);
    }
    for (std::uint32_t& place : place_)
      if (place != TextColumn::kNone) place = place_of[place];
    column.place = std::move(place_);
    return column;
  }

 private:
  std::unordered_map<std::string_view, std::uint32_t> number_;
  std::vector<std::uint32_t> place_;
};

template <typename Column>
const Column* Find(const std::map<std::string, Column, std::less<>>& columns,
                   const std::string& field) {
  const auto found = columns.find(field);
  return found == columns.end() ? nullptr : &found->second;
}

}  // namespace

PartTable::PartTable(const std::vector<catalog::Part>& parts) : parts_(parts) {
  std::unordered_map<std::string_view, std::vector<double>*> numbers;
  std::map<std::string, TextColumnBuilder, std::less<>> texts;
  const auto set_text = [&](const std::string& field, std::size_t part, std::string_view value) {
    texts.try_emplace(field, parts.size()).first->second.Set(part, value);
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const catalog::Part& part = parts[i];
    set_text("family", i, part.family);
    set_text("manufacturer", i, part.manufacturer);
    set_text("part_number", i, part.part_number);
    set_text("origin", i, part.origin);
    if (!part.series.empty()) set_text("series", i, part.series);
    if (part.orderable) set_text("orderable", i, *part.orderable ? "true" : "false");
    for (const auto& [field, text] : part.texts) set_text(field, i, text.value);
    for (const auto& [field, number] : part.numbers) {
      std::vector<double>*& column = numbers[field];
      if (column == nullptr)
        column =
            &numbers_.try_emplace(field, parts.size(), std::numeric_limits<double>::quiet_NaN())
                 .first->second;
      (*column)[i] = number.value;
    }
  }
  for (auto& [field, builder] : texts) texts_.emplace(field, builder.Build());
}

const std::vector<double>* PartTable::Numbers(const std::string& field) const {
  return Find(numbers_, field);
}

const TextColumn* PartTable::Texts(const std::string& field) const { return Find(texts_, field); }

}  // namespace plenum::api
