#include "server/render/text/text_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "server/call/reply.h"
#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using catalog::Part;

constexpr std::size_t kValuesShown = 8;
constexpr std::size_t kCellWidth = 28;

std::string Marked(const std::string& value, bool is_estimated) {
  return (is_estimated ? "~" : "") + value;
}

std::string NumberOrDash(const Part& part, const std::string& field) {
  const auto it = part.numbers.find(field);
  if (it == part.numbers.end()) return "–";
  return Marked(Short(it->second.value), it->second.provenance == catalog::Provenance::kEstimated);
}

std::string Mass(const Part& part) {
  if (part.numbers.count("mass_kg_per_m") > 0) return NumberOrDash(part, "mass_kg_per_m") + " /m";
  return NumberOrDash(part, "mass_kg");
}

// Of a valve, filling and venting.
std::string Conductance(const Part& part) {
  if (part.numbers.count("sonic_conductance_fill_dm3_per_s_bar") == 0) {
    return NumberOrDash(part, "sonic_conductance_dm3_per_s_bar");
  }
  return NumberOrDash(part, "sonic_conductance_fill_dm3_per_s_bar") + " / " +
         NumberOrDash(part, "sonic_conductance_exhaust_dm3_per_s_bar");
}

std::string CellOf(const api::Json& value) {
  if (value.is_null()) return "–";
  if (value.is_number()) return Short(value);
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_array()) return fmt::format("{} points", value.size());  // of a curve
  return Cut(value.get<std::string>(), kCellWidth);
}

// A field of a part by its name; of documents the link of the first, which is not cut.
std::string CellOf(const Part& part, const std::string& column) {
  if (column == "documents") return part.documents.empty() ? "–" : part.documents.front().link;
  const auto document = api::RenderPart(part);
  const auto found = document.find(column);
  if (found == document.end() || *found == api::Json("")) return "–";
  const auto from = document.at("provenance").find(column);
  return Marked(CellOf(*found),
                from != document.at("provenance").end() && from->at("kind") == "estimated");
}

std::string ChosenText(const std::vector<Part>& parts, const std::vector<std::string>& columns) {
  using enum Table::Align;
  std::vector<Table::Column> heads = {{"id", kLeft}};
  for (const auto& column : columns) {
    const bool is_number = std::any_of(parts.begin(), parts.end(), [&](const Part& part) {
      return part.numbers.count(column) > 0;
    });
    heads.push_back({column, is_number ? kRight : kLeft});
  }
  Table table(std::move(heads));
  for (const auto& part : parts) {
    std::vector<std::string> cells = {part.id};
    for (const auto& column : columns) cells.push_back(CellOf(part, column));
    table.Add(std::move(cells));
  }
  return table.Text();
}

// "Festo 40, SMC 30, 12 more", the most frequent first.
std::string ValuesText(const api::Json& counts, std::size_t left_out) {
  std::vector<std::pair<int, std::string>> values;
  for (const auto& [value, count] : counts.items()) values.emplace_back(-count.get<int>(), value);
  std::sort(values.begin(), values.end());
  const std::size_t shown = std::min(values.size(), kValuesShown);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", Cut(values[i].second, kCellWidth),
                        -values[i].first);
  const std::size_t more = values.size() - shown + left_out;
  return more > 0 ? text + fmt::format(", {} more", more) : text;
}

}  // namespace

std::string PartsText(const std::vector<Part>& parts, const std::vector<std::string>& columns) {
  using enum Table::Align;
  const std::string count = fmt::format("{} parts\n", parts.size());
  if (!columns.empty()) return ChosenText(parts, columns) + count;
  Table table({{"id", kLeft},
               {"family", kLeft},
               {"manufacturer", kLeft},
               {"part number", kLeft},
               {"mass kg"},
               {"C dm³/(s·bar)"},
               {"origin", kLeft}});
  for (const auto& part : parts) {
    table.Add({part.id, part.family, Cut(part.manufacturer, 24), Cut(part.part_number, kCellWidth),
               Mass(part), Conductance(part), part.origin});
  }
  return table.Text() + count;
}

std::string FacetsText(const api::Json& facets) {
  using enum Table::Align;
  Table texts({{"field", kLeft}, {"values and parts", kLeft}}, 2);
  for (const auto& [field, counts] : facets.at("texts").items())
    texts.Add({field, ValuesText(counts, facets.at("more").value(field, 0))});
  Table numbers({{"field", kLeft}, {"parts"}, {"least"}, {"greatest"}, {"in ranges", kLeft}}, 2);
  for (const auto& [field, spread] : facets.at("numbers").items()) {
    std::string ranges;
    for (const auto& range : spread.at("ranges"))
      ranges += fmt::format("{}{}", ranges.empty() ? "" : ", ", range.at("count").get<int>());
    numbers.Add({field, Grouped(spread.at("count")), Short(spread.at("min")),
                 Short(spread.at("max")), ranges});
  }
  return "\n" + texts.Text() + "\n" + numbers.Text();
}

std::string ComparisonText(const api::Json& comparison) {
  using enum Table::Align;
  std::vector<Table::Column> heads = {{"", kLeft}, {"field", kLeft}};
  for (const auto& part : comparison.at("parts"))
    heads.push_back({Cut(part.at("id").get<std::string>(), kCellWidth)});
  Table table(std::move(heads));
  for (const auto& field : comparison.at("fields")) {
    std::vector<std::string> cells = {field.at("differs").get<bool>() ? "≠" : "",
                                      field.at("field").get<std::string>()};
    for (std::size_t i = 0; i < field.at("values").size(); ++i)
      cells.push_back(
          Marked(CellOf(field.at("values")[i]), field.at("provenance")[i] == "estimated"));
    table.Add(std::move(cells));
  }
  return table.Text() + "≠ differs, ~ estimated\n";
}

}  // namespace plenum::server
