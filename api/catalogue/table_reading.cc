#include "api/catalogue/table_reading.h"

#include "api/json/words.h"

namespace plenum::api {
namespace {

using catalog::ColumnRead;
using catalog::Question;
using catalog::TableReading;

Json RenderColumn(const ColumnRead& column) {
  Json targets = Json::array();
  for (const catalog::Target& target : column.targets)
    targets.push_back(catalog::FormatTarget(target));
  const char* mark = column.decimal == catalog::Decimal::kComma ? "comma" : "point";
  return {{"key", column.key},
          {"heading", column.heading},
          {"targets", std::move(targets)},
          {"decimal", column.has_decimals ? Json(mark) : Json(nullptr)},
          {"samples", column.samples}};
}

}  // namespace

void ReadTableColumns(const std::vector<std::string>& given, catalog::TableOptions& options,
                      Errors& errors) {
  for (const std::string& text : given) {
    const std::size_t at = text.rfind('=');  // a heading may have one, a column has none
    if (at == std::string::npos || at == 0)
      errors.push_back({"/column",
                        "must be HEADING=COLUMN, HEADING=COLUMN [UNIT], or HEADING= to "
                        "leave the column out; is " +
                            Quoted(text)});
    else
      options.columns[text.substr(0, at)] = text.substr(at + 1);
  }
}

void ReadTableSet(const std::vector<std::string>& given, catalog::TableOptions& options,
                  Errors& errors) {
  for (const std::string& text : given) {
    const std::size_t at = text.find('=');
    if (at == std::string::npos || at == 0)
      errors.push_back({"/set", "must be COLUMN=VALUE; is " + Quoted(text)});
    else
      options.set[text.substr(0, at)] = text.substr(at + 1);
  }
}

Errors ErrorsOf(const TableReading& reading) {
  Errors errors;
  for (const catalog::CsvError& error : reading.errors)
    errors.push_back({"/" + error.column, error.detail});
  for (const Question& question : reading.questions)
    errors.push_back({"/" + question.option +
                          (question.heading.empty() ? std::string() : "/" + question.heading),
                      question.text});
  return errors;
}

Json RenderQuestions(const TableReading& reading) {
  Json questions = Json::array();
  for (const Question& question : reading.questions)
    questions.push_back({{"option", question.option},
                         {"heading", TextOrNull(question.heading)},
                         {"question", question.text},
                         {"answers", question.answers}});
  return questions;
}

Json RenderUnderstood(const TableReading& reading) {
  Json columns = Json::array(), left_out = Json::array();
  for (const ColumnRead& column : reading.columns) columns.push_back(RenderColumn(column));
  for (const catalog::RowLeftOut& one : reading.left_out)
    left_out.push_back({{"row", one.row}, {"why", one.why}});
  Json set = Json::object();
  for (const auto& [column, value] : reading.set) set[column] = value;
  return {{"as_exported", reading.as_exported},
          {"encoding", TextOrNull(reading.encoding)},
          {"delimiter", TextOrNull(reading.delimiter)},
          {"header_row", RowOrNull(reading.header_row)},
          {"units_row", RowOrNull(reading.units_row)},
          {"ids", reading.makes_ids ? "made of manufacturer and part_number" : "given"},
          {"columns", std::move(columns)},
          {"set", std::move(set)},
          {"left_out", std::move(left_out)},
          {"left_out_count", reading.left_out_count}};
}

}  // namespace plenum::api
