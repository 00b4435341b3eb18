#include "server/text_catalog.h"

#include <fmt/format.h>

#include "server/text_table.h"

namespace plenum::server {
namespace {

using catalog::Part;

std::string NumberOrDash(const Part& part, const char* field) {
  const auto it = part.numbers.find(field);
  return it == part.numbers.end() ? "–" : Short(it->second.value);
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

}  // namespace

std::string PartsText(const std::vector<Part>& parts) {
  using enum Table::Align;
  Table table({{"id", kLeft},
               {"family", kLeft},
               {"manufacturer", kLeft},
               {"part number", kLeft},
               {"mass kg"},
               {"C dm³/(s·bar)"},
               {"origin", kLeft}});
  for (const auto& part : parts) {
    table.Add({part.id, part.family, Cut(part.manufacturer, 24), Cut(part.part_number, 28),
               Mass(part), Conductance(part), part.origin});
  }
  return table.Text() + fmt::format("{} parts\n", parts.size());
}

std::string PartText(const Part& part) {
  using enum Table::Align;
  std::string text = fmt::format("{}\n  {}, {} {}, {} row\n", part.id, part.family,
                                 part.manufacturer, part.part_number, part.origin);
  if (!part.notes.empty()) text += "  " + part.notes + "\n";
  Table table({{"field", kLeft}, {"value"}, {"data", kLeft}, {"source", kLeft}}, 2);
  for (const auto& [name, value] : part.texts) {
    table.Add({name, value.value, std::string(Name(value.provenance)), Cut(value.source, 60)});
  }
  for (const auto& [name, value] : part.numbers) {
    table.Add({name, fmt::format("{:.10g}", value.value), std::string(Name(value.provenance)),
               Cut(value.source, 60)});
  }
  text += "\n" + table.Text();
  if (!part.curve) return text;
  Table curve({{"kPa gauge"}, {"free air L/min"}, {"current A"}}, 2);
  for (const auto& point : part.curve->points) {
    curve.Add(
        {Short(point.pressure_kpa_gauge), Short(point.free_air_l_per_min), Short(point.current_a)});
  }
  return text + "\n" + curve.Text() +
         fmt::format("  flow: {} {}\n  current: {} {}\n", Name(part.curve->free_air_provenance),
                     part.curve->free_air_source, Name(part.curve->current_provenance),
                     part.curve->current_source);
}

}  // namespace plenum::server
