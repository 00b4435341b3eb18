#include "server/render/text/text_remarks.h"

#include <fmt/format.h>

namespace plenum::server {
namespace {

using api::Json;

// A part of an answer that may be missing.
const Json& ListOf(const Json& answer, const char* name) {
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

}  // namespace

std::string RemarksText(const Json& answer) {
  std::string text;
  for (const Json& warning : ListOf(answer, "warnings"))
    if (warning.is_object())
      text += fmt::format("Warning: {} {}\n", PlaceOf(warning), TextOf(warning.at("detail")));
  const Json& understood = ListOf(answer, "understood");
  if (!understood.empty()) text += "Understood:\n";
  for (const Json& row : understood) text += UnderstoodText(row);
  for (const Json& note : ListOf(answer, "notes"))
    text += fmt::format("Note {}: {}\n", PlaceOf(note), TextOf(note.at("note")));
  return text.empty() ? "" : "\n" + text;
}

}  // namespace plenum::server
