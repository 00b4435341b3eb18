#include "api/design/sweep/sweep_table.h"

#include <array>
#include <string_view>

#include "api/design/given/requirement_words.h"
#include "api/json/problem_document.h"
#include "api/json/version.h"
#include "api/json/words.h"
#include "catalog/fields/csv_table.h"

namespace plenum::api {
namespace {

constexpr std::array kTotals = {"mass_kg", "volume_l", "cost_eur", "energy_wh"};
constexpr std::array kColumns = {"outcome",     "configuration", "objective", "mass_kg",
                                 "volume_l",    "cost_eur",      "energy_wh", "parts",
                                 "lower_bound", "gap",           "conflict",  "seconds"};

// "6 × valve ASCO RHB20 of leg", "1.2 m tubing SMC TU0425 of leg"
std::string PartWords(const Json& part) {
  const double quantity = part.at("quantity").get<double>();
  std::string words;
  if (part.at("unit") == "m")
    words = Significant(quantity) + " m ";
  else if (quantity != 1.0)
    words = Decimal(quantity) + " × ";
  words += part.at("family").get<std::string>() + " " + part.at("manufacturer").get<std::string>();
  if (part.at("part_number") != part.at("id") || part.at("manufacturer") != "made to measure")
    words += " " + part.at("part_number").get<std::string>();
  if (part.at("group").is_string()) words += " of " + part.at("group").get<std::string>();
  return words;
}

// "mass: 0.2 kg asked, 0.31 kg reached; rise time of leg: 0.2 s asked; excluded parts"
std::string ConflictWords(const Json& conflict, const Json& request) {
  std::string words;
  for (const Json& entry : conflict) {
    const auto [name, unit] = DemandInWords(entry.at("requirement").get<std::string>(), request);
    words += (words.empty() ? "" : "; ") + name;
    if (!entry.at("required").is_number()) continue;
    words += ": " + Decimal(entry.at("required").get<double>()) + unit + " asked";
    if (entry.at("best").is_number())
      words += ", " + Told(entry.at("best").get<double>()) + unit + " reached";
  }
  return words;
}

bool LooksLikeAFormula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != text.npos;
}

std::string Cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_array()) {
    std::string list;
    for (const Json& entry : value) list += (list.empty() ? "" : "; ") + Cell(entry);
    return list;
  }
  if (!value.is_string()) return value.dump();
  const auto& text = value.get_ref<const std::string&>();
  return LooksLikeAFormula(text) ? "'" + text : text;
}

Json RowOf(const Json& patch, const SweptAnswer& answer) {
  Json row = {{"name", patch.at("name")},
              {"status", answer.status.empty() ? Json() : Json(answer.status)},
              {"values", patch.at("values")}};
  for (const char* column : kColumns)
    row[column] = answer.row.is_object() ? answer.row.at(column) : Json();
  row["detail"] = answer.failure.empty() ? Json() : Json(answer.failure);
  row["link"] = answer.link.empty() ? Json() : Json(answer.link);
  return row;
}

}  // namespace

Json SweepRow(const Json& answer) {
  const Json& designs = answer.at("designs");
  const Json& proof = answer.at("proof");
  const Json* first = designs.empty() ? nullptr : &designs.front();
  Json row = {{"outcome", answer.at("status")},
              {"configuration", first != nullptr ? first->at("configuration") : Json()},
              {"objective", first != nullptr ? first->at("objective") : Json()}};
  for (const char* total : kTotals)
    row[total] = first != nullptr ? first->at("totals").at(total) : Json();
  row["parts"] = nullptr;
  if (first != nullptr) {
    row["parts"] = Json::array();
    for (const Json& part : first->at("parts")) row["parts"].push_back(PartWords(part));
  }
  row["lower_bound"] = proof.at("lower_bound");
  row["gap"] = proof.at("gap");
  const auto conflict = answer.find("conflict");
  row["conflict"] =
      conflict != answer.end()
          ? Json(ConflictWords(*conflict, answer.value("requirements", Json::object())))
          : Json();
  row["seconds"] = answer.at("seconds");
  return row;
}

Json RenderSweepTable(const Json& plan, const std::vector<SweptAnswer>& answers) {
  Json table = AnswerDocument("sweep_table/1");
  for (const char* field : {"name", "objective", "varied"}) table[field] = plan.at(field);
  Json& rows = table["rows"] = Json::array();
  const Json& patches = plan.at("patches");
  for (std::size_t i = 0; i < answers.size(); ++i) rows.push_back(RowOf(patches.at(i), answers[i]));
  return table;
}

std::string SweepCsv(const Json& table) {
  catalog::CsvRow header = {"name", "status"};
  for (const Json& pointer : table.at("varied")) header.push_back(Cell(pointer));
  header.insert(header.end(), kColumns.begin(), kColumns.end());
  for (const char* last : {"detail", "link"}) header.emplace_back(last);
  std::string csv = catalog::FormatRow(header);
  for (const Json& row : table.at("rows")) {
    catalog::CsvRow cells = {Cell(row.at("name")), Cell(row.at("status"))};
    for (const Json& value : row.at("values")) cells.push_back(Cell(value));
    for (const char* column : kColumns) cells.push_back(Cell(row.at(column)));
    for (const char* last : {"detail", "link"}) cells.push_back(Cell(row.at(last)));
    csv += catalog::FormatRow(cells);
  }
  return csv;
}

}  // namespace plenum::api
