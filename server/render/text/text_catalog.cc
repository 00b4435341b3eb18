#include "server/render/text/text_catalog.h"

#include <fmt/format.h>

#include "server/call/reply.h"
#include "server/render/text/text_table.h"

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

// "mass_kg: 0.003 → 0.004" for every field of the document that differs.
std::string DifferenceText(const api::Json& before, const api::Json& after) {
  std::string text;
  const auto line = [&](const std::string& field, const std::string& from, const std::string& to) {
    text += fmt::format("    {}: {} → {}\n", field, Cut(from, 60), Cut(to, 60));
  };
  for (const auto& [field, value] : before.items()) {
    const bool kept = after.contains(field);
    if (!kept || after[field] != value)
      line(field, Dump(value), kept ? Dump(after[field]) : std::string("none"));
  }
  for (const auto& [field, value] : after.items())
    if (!before.contains(field)) line(field, "none", Dump(value));
  return text;
}

std::string Uncertainty(const std::optional<double>& share) {
  return share ? fmt::format("{} %", Short(100.0 * *share)) : "–";
}

// A list may be long; nothing of it is cut.
std::string OffersText(const Part& part) {
  using enum Table::Align;
  if (part.offers.empty()) return "";
  Table table({{"supplier", kLeft}, {"price"}, {"pack"}, {"date", kLeft}, {"link", kLeft}}, 2);
  for (const auto& offer : part.offers) {
    table.Add({offer.supplier, Short(offer.price) + " " + offer.currency, Short(offer.pack),
               offer.date.empty() ? "–" : offer.date, offer.link});
  }
  return "\n" + table.Text();
}

// What a part has beside its fields, a line each.
std::string DetailsText(const Part& part) {
  std::string text;
  if (!part.series.empty()) text += "  series: " + part.series + "\n";
  if (part.orderable) text += *part.orderable ? "  can be ordered\n" : "  cannot be ordered\n";
  for (const auto& alias : part.aliases) text += "  also: " + alias + "\n";
  for (const auto& document : part.documents) {
    text += "  document: " + document.link;
    if (!document.sha256.empty()) text += " (sha256 " + document.sha256 + ")";
    text += "\n";
  }
  return text;
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
  text += DetailsText(part);
  Table table({{"field", kLeft}, {"value"}, {"±"}, {"data", kLeft}, {"source", kLeft}}, 2);
  for (const auto& [name, value] : part.texts) {
    table.Add({name, value.value, "", std::string(Name(value.provenance)), Cut(value.source, 60)});
  }
  for (const auto& [name, value] : part.numbers) {
    table.Add({name, fmt::format("{:.10g}", value.value), Uncertainty(value.uncertainty),
               std::string(Name(value.provenance)), Cut(value.source, 60)});
  }
  text += "\n" + table.Text() + OffersText(part);
  if (!part.curve) return text;
  Table curve({{"kPa gauge"}, {"free air L/min"}, {"current A"}}, 2);
  for (const auto& point : part.curve->points) {
    curve.Add(
        {Short(point.pressure_kpa_gauge), Short(point.free_air_l_per_min), Short(point.current_a)});
  }
  const auto origin = [](const char* what, catalog::Provenance provenance,
                         const std::string& source, const std::optional<double>& uncertainty) {
    return fmt::format("  {}: {} {}{}\n", what, Name(provenance), source,
                       uncertainty ? ", ± " + Uncertainty(uncertainty) : "");
  };
  return text + "\n" + curve.Text() +
         origin("flow", part.curve->free_air_provenance, part.curve->free_air_source,
                part.curve->free_air_uncertainty) +
         origin("current", part.curve->current_provenance, part.curve->current_source,
                part.curve->current_uncertainty);
}

std::string RevisionsText(const std::vector<catalog::Revision>& revisions) {
  using enum Table::Align;
  Table table({{"revision"}, {"at", kLeft}, {"who", kLeft}, {"what", kLeft}, {"hash", kLeft}});
  for (const auto& revision : revisions) {
    table.Add({std::to_string(revision.number), revision.at, Cut(revision.who, 30),
               Cut(revision.what, 60), revision.hash.substr(0, 16)});
  }
  return table.Text();
}

std::string HistoryText(const std::vector<catalog::Change>& changes) {
  std::string text;
  for (const auto& change : changes) {
    const auto& revision = change.revision;
    text += fmt::format("revision {}, {}, {}: {}\n", revision.number, revision.at, revision.who,
                        revision.what);
    if (change.before && change.after) {
      text += DifferenceText(api::RenderPart(*change.before), api::RenderPart(*change.after));
    } else {
      text += change.after ? "    the part was added\n" : "    the part was removed\n";
    }
  }
  return text;
}

std::string PlausibilityText(const std::vector<catalog::Outlier>& outliers,
                             const std::vector<catalog::Gap>& gaps) {
  using enum Table::Align;
  std::string text;
  if (!outliers.empty()) {
    Table table({{"id", kLeft}, {"field", kLeft}, {"value"}, {"family median"}, {"robust z"}}, 2);
    for (const auto& outlier : outliers) {
      table.Add({outlier.id, outlier.field, Short(outlier.value), Short(outlier.median),
                 fmt::format("{:+.1f}", outlier.robust_z)});
    }
    text += "\nFar from the rest of their family, worth a second look:\n" + table.Text();
  }
  if (!gaps.empty()) {
    Table table({{"family", kLeft}, {"field", kLeft}, {"missing"}, {"of"}, {"blocks", kLeft}}, 2);
    for (const auto& gap : gaps) {
      table.Add({gap.family, gap.field, std::to_string(gap.ids.size()), std::to_string(gap.parts),
                 gap.blocks});
    }
    text +=
        "\nMissing, which keeps parts out of rankings by what the field blocks:\n" + table.Text();
  }
  return text;
}

}  // namespace plenum::server
