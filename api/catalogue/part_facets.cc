#include "api/catalogue/part_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace plenum::api {
namespace {

// Which no facet counts: part numbers are all different.
constexpr std::string_view kUncounted = "part_number";
constexpr int kRanges = 10;
constexpr double kLogarithmicFrom = 20.0;  // greatest over least

struct Range {
  int count = 0;
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();

  void Add(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
    ++count;
  }
};

Json Render(const Range& range) {
  return {{"count", range.count}, {"min", range.least}, {"max", range.greatest}};
}

void RenderCounts(const std::string& field, const TextColumn& column,
                  const std::vector<std::uint32_t>& rows, Json& facets) {
  std::vector<int> counts(column.values.size());
  for (const std::uint32_t row : rows)
    if (column.place[row] != TextColumn::kNone) ++counts[column.place[row]];
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) held.push_back(i);
  if (held.empty()) return;
  if (held.size() > kFacetValuesMax) {
    facets["more"][field] = held.size() - kFacetValuesMax;
    std::stable_sort(held.begin(), held.end(),
                     [&](std::size_t a, std::size_t b) { return counts[a] > counts[b]; });
    held.resize(kFacetValuesMax);
  }
  Json& values = facets["texts"][field] = Json::object();
  for (const std::size_t i : held) values[std::string(column.values[i])] = counts[i];
}

// Where one range ends and the next begins.
std::array<double, kRanges - 1> EdgesOf(const Range& all) {
  const bool logarithmic = all.least > 0.0 && all.greatest >= kLogarithmicFrom * all.least;
  std::array<double, kRanges - 1> edges{};
  for (int i = 1; i < kRanges; ++i) {
    const double share = static_cast<double>(i) / kRanges;
    edges[i - 1] = logarithmic ? all.least * std::pow(all.greatest / all.least, share)
                               : std::lerp(all.least, all.greatest, share);
  }
  return edges;
}

void RenderRanges(const std::string& field, const std::vector<double>& column,
                  const std::vector<std::uint32_t>& rows, Json& facets) {
  Range all;
  std::vector<double> values;
  values.reserve(rows.size());
  for (const std::uint32_t row : rows) {
    if (std::isnan(column[row])) continue;
    values.push_back(column[row]);
    all.Add(column[row]);
  }
  if (values.empty()) return;
  const auto edges = EdgesOf(all);
  std::array<Range, kRanges> ranges;
  for (const double value : values) {
    std::size_t range = 0;  // no branch, whose way no processor could guess
    for (const double edge : edges) range += value >= edge;
    ranges[range].Add(value);
  }
  Json& spread = facets["numbers"][field] = Render(all);
  spread["ranges"] = Json::array();
  for (const Range& range : ranges)
    if (range.count > 0) spread["ranges"].push_back(Render(range));
}

}  // namespace

Json RenderFacets(const std::vector<std::uint32_t>& rows, const PartTable& table) {
  Json facets = {{"texts", Json::object()}, {"more", Json::object()}, {"numbers", Json::object()}};
  for (const auto& [field, column] : table.texts())
    if (field != kUncounted) RenderCounts(field, column, rows, facets);
  for (const auto& [field, column] : table.numbers()) RenderRanges(field, column, rows, facets);
  return facets;
}

}  // namespace plenum::api
