#include "server/render/text/text_remarks.h"

#include <fmt/format.h>

#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

using api::Json;

// A part of an answer that may be missing.
const Json& RemarksNamed(const Json& answer, const char* name) {
  static const Json kNone = Json::array();
  const auto found = answer.find(name);
  return found == answer.end() ? kNone : *found;
}

std::string TextOf(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string PlaceOf(const Json& remark) {
  const std::string pointer = remark.at("pointer").get<std::string>();
  return pointer.empty() ? "on the whole" : pointer;
}

std::string UnderstoodText(const Json& row) {
  const std::string pointer = PlaceOf(row);
  const std::string unit = row.at("unit").get<std::string>();
  const std::string value =
      fmt::format("{:.6g}{}{}", row.at("value").get<double>(), unit.empty() ? "" : " ", unit);
  if (row.contains("formula"))
    return fmt::format("  {} {} = {}: {}\n", pointer, TextOf(row.at("name")), value,
                       TextOf(row.at("formula")));
  return fmt::format("  {} \"{}\" = {}{}\n", pointer, TextOf(row.at("given")), value,
                     row.contains("condition") ? ", at " + TextOf(row.at("condition")) : "");
}

std::string WordsOf(const Json& value) { return value.is_string() ? value.get<std::string>() : ""; }

std::string TableText(const Json& understood) {
  using enum Table::Align;
  std::string text =
      fmt::format("read {} as {}, columns by {}", understood.value("file", "the table"),
                  WordsOf(understood.at("encoding")), WordsOf(understood.at("delimiter")));
  if (understood.at("decimal").is_string())
    text += fmt::format(", decimal {}", WordsOf(understood.at("decimal")));
  if (understood.at("heading_line").is_number())
    text += fmt::format(", headings in line {}", understood.at("heading_line").get<int>());
  text += "\n";
  Table table({{"heading", kLeft}, {"field", kLeft}, {"unit", kLeft}, {"", kLeft}}, 2);
  for (const Json& column : understood.at("columns"))
    table.Add({WordsOf(column.at("key")),
               column.at("field").is_string() ? WordsOf(column.at("field")) : "left out",
               WordsOf(column.at("unit")), WordsOf(column.at("meaning"))});
  text += table.Text();
  if (understood.at("ambient_kpa_abs").is_number())
    text += fmt::format("  absolute pressures are gauge with an ambient of {:g} kPa\n",
                        understood.at("ambient_kpa_abs").get<double>());
  for (const Json& run : understood.at("runs"))
    text += fmt::format("  run {}: {} readings from {:g} to {:g} s, {} missing\n",
                        WordsOf(run.at("id")), run.at("readings").get<std::size_t>(),
                        run.at("begin_s").get<double>(), run.at("end_s").get<double>(),
                        run.at("missing").get<std::size_t>());
  for (const Json& note : understood.at("notes")) text += "  " + WordsOf(note) + "\n";
  return text + "\n";
}

}  // namespace

std::string RemarksText(const Json& answer) {
  std::string text;
  for (const Json& warning : RemarksNamed(answer, "warnings"))
    if (warning.is_object())
      text += fmt::format("Warning: {} {}\n", PlaceOf(warning), TextOf(warning.at("detail")));
  const Json& understood = RemarksNamed(answer, "understood");
  if (!understood.empty()) text += "Understood:\n";
  for (const Json& row : understood) text += UnderstoodText(row);
  for (const Json& note : RemarksNamed(answer, "notes"))
    text += fmt::format("Note {}: {}\n", PlaceOf(note), TextOf(note.at("note")));
  return text.empty() ? "" : "\n" + text;
}

std::string RecordingText(const Json& diagnosis) {
  std::string text;
  if (!diagnosis.contains("measurement")) return text;
  const Json& measurement = diagnosis.at("measurement");
  if (!measurement.is_object() || !measurement.contains("understood")) return text;
  for (const Json& understood : measurement.at("understood")) try {
      text += TableText(understood);
    } catch (const Json::exception&) {
      continue;  // a person may have written anything under that name
    }
  return text;
}

}  // namespace plenum::server
