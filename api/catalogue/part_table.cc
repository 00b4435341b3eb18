#include "api/catalogue/part_table.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "catalog/check/coverage.h"

namespace plenum::api {
namespace {

constexpr std::string_view kDerivedFlags[] = {"priced", "documented"};
// In the order of catalog::ProvenanceNames().
constexpr std::string_view kShares[] = {"datasheet_share", "third_party_share", "derived_share",
                                        "estimated_share", "measured_share"};

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

// NaN where the part has no value at all.
std::vector<double> SharesOf(const catalog::Part& part) {
  const auto counts = catalog::CountValues(part);
  const double all = std::accumulate(counts.begin(), counts.end(), 0);
  std::vector<double> shares;
  shares.reserve(counts.size());
  for (const int count : counts) shares.push_back(count / all);
  return shares;
}

}  // namespace

std::span<const std::string_view> DerivedFlags() { return kDerivedFlags; }
std::span<const std::string_view> ProvenanceShares() { return kShares; }

PartTable::PartTable(const std::vector<catalog::Part>& parts) : parts_(parts) {
  std::unordered_map<std::string_view, std::vector<double>*> numbers;
  std::map<std::string, TextColumnBuilder, std::less<>> texts;
  const auto set_text = [&](const std::string& field, std::size_t part, std::string_view value) {
    texts.try_emplace(field, parts.size()).first->second.Set(part, value);
  };
  const auto set_number = [&](std::string_view field, std::size_t part, double value) {
    std::vector<double>*& column = numbers[field];
    if (column == nullptr)
      column = &numbers_
                    .try_emplace(std::string(field), parts.size(),
                                 std::numeric_limits<double>::quiet_NaN())
                    .first->second;
    (*column)[part] = value;
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
    for (const auto& [field, number] : part.numbers) set_number(field, i, number.value);
    set_text("priced", i, catalog::HasPrice(part) ? "true" : "false");
    set_text("documented", i, part.documents.empty() ? "false" : "true");
    const std::vector<double> shares = SharesOf(part);
    for (std::size_t k = 0; k < shares.size(); ++k) set_number(kShares[k], i, shares[k]);
  }
  for (auto& [field, builder] : texts) texts_.emplace(field, builder.Build());
}

std::vector<std::uint8_t> PartTable::Search(std::string_view text) const {
  std::call_once(search_made_, [&] { search_ = std::make_unique<const PartSearch>(parts_); });
  return search_->Find(text);
}

const std::vector<double>* PartTable::Numbers(const std::string& field) const {
  return Find(numbers_, field);
}

const TextColumn* PartTable::Texts(const std::string& field) const { return Find(texts_, field); }

}  // namespace plenum::api
