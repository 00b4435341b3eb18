#include "api/catalogue/rows/part_columns.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "catalog/check/coverage.h"

namespace plenum::api {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
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

// NaN where the part has no value at all.
std::vector<double> SharesOf(const catalog::Part& part) {
  const auto counts = catalog::CountValues(part);
  const double all = std::accumulate(counts.begin(), counts.end(), 0);
  std::vector<double> shares;
  shares.reserve(counts.size());
  for (const int count : counts) shares.push_back(count / all);
  return shares;
}

// Places of `values` in the ordered list of both; the list of `column` takes them in.
std::vector<std::uint32_t> TakeIn(const std::vector<std::string_view>& values, TextColumn& column) {
  std::vector<std::string_view> all;
  all.reserve(column.values.size() + values.size());
  std::set_union(column.values.begin(), column.values.end(), values.begin(), values.end(),
                 std::back_inserter(all));
  const auto places_in_all = [&](const std::vector<std::string_view>& some) {
    std::vector<std::uint32_t> places;
    places.reserve(some.size());
    std::uint32_t place = 0;
    for (const std::string_view value : some) {
      while (all[place] != value) ++place;
      places.push_back(place);
    }
    return places;
  };
  if (all.size() > column.values.size()) {
    const auto moved = places_in_all(column.values);
    for (std::uint32_t& place : column.place)
      if (place != TextColumn::kNone) place = moved[place];
    column.values = all;
  }
  return places_in_all(values);
}

// The value in `column` of each part of a run, one after the other.
template <typename Column>
auto OneByOne(const Column& column) {
  return [next = column.begin()](const catalog::Part&) mutable { return *next++; };
}

}  // namespace

std::span<const std::string_view> DerivedFlags() { return kDerivedFlags; }
std::span<const std::string_view> ProvenanceShares() { return kShares; }

PartColumns ColumnsOf(std::span<const catalog::Part* const> parts) {
  PartColumns columns;
  std::unordered_map<std::string_view, NumberColumn*> numbers;
  std::map<std::string, TextColumnBuilder, std::less<>> texts;
  const auto set_text = [&](const std::string& field, std::size_t part, std::string_view value) {
    texts.try_emplace(field, parts.size()).first->second.Set(part, value);
  };
  const auto set_number = [&](std::string_view field, std::size_t part, double value) {
    NumberColumn*& column = numbers[field];
    if (column == nullptr)
      column =
          &columns.numbers.try_emplace(std::string(field), parts.size(), kNoNumber).first->second;
    (*column)[part] = value;
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const catalog::Part& part = *parts[i];
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
  for (auto& [field, builder] : texts) columns.texts.emplace(field, builder.Build());
  return columns;
}

PartColumns ColumnsAfter(const PartColumns& before, std::size_t rows,
                         const std::vector<Run>& runs) {
  std::vector<const catalog::Part*> parts;
  for (const Run& run : runs)
    if (run.part != nullptr) parts.push_back(run.part);
  const PartColumns now = ColumnsOf(parts);
  PartColumns after;
  const auto no_number = [](const catalog::Part&) { return kNoNumber; };
  const auto no_text = [](const catalog::Part&) { return TextColumn::kNone; };
  for (const auto& [field, column] : before.numbers) {
    const auto found = now.numbers.find(field);
    after.numbers[field] = found == now.numbers.end()
                               ? Splice(column, runs, no_number)
                               : Splice(column, runs, OneByOne(found->second));
  }
  for (const auto& [field, column] : now.numbers)
    if (!before.numbers.contains(field))
      after.numbers[field] = Splice(NumberColumn(rows, kNoNumber), runs, OneByOne(column));
  for (const auto& [field, column] : before.texts) {
    TextColumn& merged = after.texts[field];
    const auto found = now.texts.find(field);
    if (found == now.texts.end()) {
      merged = {column.values, Splice(column.place, runs, no_text)};
      continue;
    }
    merged = column;
    std::vector<std::uint32_t> places = found->second.place;
    const auto moved = TakeIn(found->second.values, merged);
    for (std::uint32_t& place : places)
      if (place != TextColumn::kNone) place = moved[place];
    merged.place = Splice(merged.place, runs, OneByOne(places));
  }
  for (const auto& [field, column] : now.texts)
    if (!before.texts.contains(field))
      after.texts[field] = {column.values,
                            Splice(std::vector<std::uint32_t>(rows, TextColumn::kNone), runs,
                                   OneByOne(column.place))};
  return after;
}

}  // namespace plenum::api
