#include "server/render/text/text_catalog.h"

#include <fmt/format.h>

#include "server/call/reply.h"
#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using catalog::Part;

constexpr std::size_t kAnswersShown = 6;

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

std::string TargetsText(const catalog::ColumnRead& column) {
  std::string text;
  for (const auto& target : column.targets)
    text += (text.empty() ? "" : " + ") + FormatTarget(target);
  return text.empty() ? "left out" : text;
}

std::string DecimalText(const catalog::ColumnRead& column) {
  if (!column.has_decimals) return "";
  return column.decimal == catalog::Decimal::kComma ? "decimal comma" : "decimal point";
}

// "--column 'Druck=pressure_max_kpa_gauge [bar]'"
std::string AnswerText(const catalog::Question& question, const std::string& answer) {
  if (question.option == "header_row") return "--header-row " + answer;
  if (question.option != "column") return "--" + question.option + " " + answer;
  return fmt::format("--column '{}={}'", question.heading, answer);
}

std::string OutliersText(const std::vector<catalog::Outlier>& outliers) {
  using enum Table::Align;
  if (outliers.empty()) return "";
  Table table({{"id", kLeft}, {"field", kLeft}, {"value"}, {"family median"}, {"robust z"}}, 2);
  for (const auto& outlier : outliers) {
    table.Add({outlier.id, outlier.field, Short(outlier.value), Short(outlier.median),
               fmt::format("{:+.1f}", outlier.robust_z)});
  }
  return "\nFar from the rest of their family, worth a second look:\n" + table.Text();
}

std::string DuplicatesText(const std::vector<catalog::Duplicates>& all) {
  using enum Table::Align;
  if (all.empty()) return "";
  Table table({{"family", kLeft}, {"parts", kLeft}, {"why", kLeft}}, 2);
  for (const auto& duplicates : all) {
    std::string ids;
    for (const auto& id : duplicates.ids) ids += (ids.empty() ? "" : ", ") + id;
    table.Add({duplicates.family, Cut(ids, 80), duplicates.why});
  }
  return "\nMaybe one part under several names:\n" + table.Text();
}

std::string GapsText(const std::vector<catalog::Gap>& gaps) {
  using enum Table::Align;
  if (gaps.empty()) return "";
  Table table({{"family", kLeft}, {"field", kLeft}, {"missing"}, {"of"}, {"blocks", kLeft}}, 2);
  for (const auto& gap : gaps) {
    table.Add({gap.family, gap.field, std::to_string(gap.ids.size()), std::to_string(gap.parts),
               gap.blocks});
  }
  return "\nMissing, which keeps parts out of rankings by what the field blocks:\n" + table.Text();
}

std::string CoverageText(const std::vector<catalog::Coverage>& families) {
  using enum Table::Align;
  Table table(
      {{"family", kLeft}, {"parts"}, {"no price"}, {"no document"}, {"values"}, {"estimated"}}, 2);
  catalog::Coverage all;
  std::size_t no_price = 0, no_document = 0;
  const auto share = [](const catalog::Coverage& of) {
    return of.values > 0 ? fmt::format("{:.0f} %", 100.0 * of.estimated / of.values) : "–";
  };
  for (const auto& family : families) {
    table.Add({family.family, std::to_string(family.parts),
               std::to_string(family.without_price.size()),
               std::to_string(family.without_document.size()), std::to_string(family.values),
               share(family)});
    all.parts += family.parts, all.values += family.values, all.estimated += family.estimated;
    no_price += family.without_price.size(), no_document += family.without_document.size();
  }
  table.Add({"all", std::to_string(all.parts), std::to_string(no_price),
             std::to_string(no_document), std::to_string(all.values), share(all)});
  return "\nHow much is known, and how much of that is estimated:\n" + table.Text();
}

}  // namespace

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

std::string CheckText(const api::CatalogCheck& check) {
  return DuplicatesText(check.duplicates) + OutliersText(check.outliers) + GapsText(check.gaps) +
         CoverageText(check.coverage);
}

std::string UnderstoodText(const catalog::TableReading& reading) {
  using enum Table::Align;
  if (reading.as_exported) return "";
  std::string text = fmt::format("read as {}, {}-delimited, header in row {}{}\n", reading.encoding,
                                 reading.delimiter, reading.header_row,
                                 reading.makes_ids ? ", ids made of maker and part number" : "");
  Table table({{"heading", kLeft}, {"column", kLeft}, {"", kLeft}, {"first cell", kLeft}}, 2);
  for (const auto& column : reading.columns)
    if (!column.samples.empty())
      table.Add({Cut(column.key, 40), TargetsText(column), DecimalText(column),
                 Cut(column.samples.front(), 30)});
  text += table.Text();
  for (const auto& [column, value] : reading.set)
    text += fmt::format("  {} is {} for all rows\n", column, value);
  for (const auto& one : reading.left_out)
    text += fmt::format("  row {} left out: {}\n", one.row, one.why);
  if (reading.left_out_count > reading.left_out.size())
    text +=
        fmt::format("  {} more rows left out\n", reading.left_out_count - reading.left_out.size());
  return text;
}

std::string QuestionsText(const catalog::TableReading& reading) {
  std::string text;
  for (const auto& error : reading.errors)
    text += fmt::format("{}: {}\n", error.column, error.detail);
  for (const auto& question : reading.questions) {
    text += question.text + "\n";
    std::vector<std::string> answers = question.answers;
    if (answers.empty()) answers = {"COLUMN [UNIT]", ""};
    for (std::size_t i = 0; i < answers.size() && i < kAnswersShown; ++i)
      text += "  " + AnswerText(question, answers[i]) + "\n";
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace plenum::server
