#include "api/protocol/read_by_hand.h"

#include <optional>

#include "api/json/words.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

std::optional<double> ShareOf(std::string text) {
  const std::size_t last = text.find_last_not_of(' ');
  const bool percent = last != std::string::npos && text[last] == '%';
  if (percent) text.erase(last);
  const auto share = catalog::ParseNumber(text);
  if (!share) return std::nullopt;
  return percent ? *share / 100.0 : *share;
}

std::string FieldsOf(const catalog::Part& part) {
  std::string names;
  for (const auto& [field, number] : part.numbers) names += (names.empty() ? "" : ", ") + field;
  return names;
}

// Adds the row of one reading, or what is wrong with it.
void ReadOne(const catalog::Part& part, const std::string& text, double share, Json& rows,
             Errors& errors) {
  const std::size_t equals = text.find('=');
  const std::string field = text.substr(0, equals);
  if (equals == std::string::npos || !part.numbers.contains(field)) {
    errors.push_back({"READING", "must be FIELD=VALUE with a number of " + part.id + ", one of " +
                                     FieldsOf(part) + "; not " + Quoted(text)});
    return;
  }
  const auto value = catalog::ParseQuantity(text.substr(equals + 1), field);
  if (!value.value || !(*value.value > 0.0)) {
    errors.push_back({field, value.error.empty() ? "must be a number above 0, not " + Quoted(text)
                                                 : value.error});
    return;
  }
  rows.push_back({{"part", part.id},
                  {"number", field},
                  {"field", field},
                  {"fitted", *value.value},
                  {"uncertainty", share},
                  {"refused", nullptr}});
}

}  // namespace

Parsed<Json> ReadByHandAnswer(const catalog::Part& part, const std::vector<std::string>& readings,
                              const std::string& uncertainty, const std::string& note) {
  Errors errors;
  const std::optional<double> share = ShareOf(uncertainty);
  if (!share || !(*share >= kLeastReadShare && *share <= kMostReadShare))
    errors.push_back({"--uncertainty",
                      "must be a share from 0.00001 to 0.25, or in %, of one standard deviation; "
                      "not " +
                          Quoted(uncertainty)});
  Json rows = Json::array();
  for (const std::string& reading : readings)
    ReadOne(part, reading, share.value_or(0.0), rows, errors);
  if (!errors.empty()) return errors;
  return Json{{"measured", std::move(rows)},
              {"measured_refused", Json::array()},
              {"by_hand", note.empty() ? "read by hand" : "read by hand: " + note}};
}

}  // namespace plenum::api
