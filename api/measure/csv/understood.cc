#include "api/measure/csv/understood.h"

#include <algorithm>

#include "api/catalogue/table_reading.h"
#include "api/json/words.h"
#include "catalog/units/quantity.h"

namespace plenum::api {
namespace {

Json ColumnOf(const Recording& recording, std::size_t i) {
  const catalog::ColumnRead& column = recording.table.columns[i];
  const std::string field = column.targets.empty() ? "" : column.targets.front().column;
  const bool has_numbers =
      i < recording.scales.size() && (IsReadingField(field) || field == kTimeField);
  const std::string unit = column.targets.empty() ? "" : column.targets.front().unit;
  return {
      {"key", column.key},
      {"heading", column.heading},
      {"field", TextOrNull(field)},
      {"unit",
       TextOrNull(unit.empty() && has_numbers ? std::string(catalog::UnitOf(field)) : unit)},
      {"factor", has_numbers ? Json(recording.scales[i].numerator / recording.scales[i].denominator)
                             : Json(nullptr)},
      {"offset", has_numbers ? Json(recording.scales[i].offset) : Json(nullptr)},
      {"meaning", TextOrNull(i < recording.meanings.size() ? recording.meanings[i] : "")},
      {"first", column.samples}};
}

Json RunOf(const RecordedRun& run) {
  const auto pressure = run.readings.find(std::string(kPressureField));
  std::ptrdiff_t missing = 0;
  if (pressure != run.readings.end())
    missing = std::count_if(pressure->second.begin(), pressure->second.end(),
                            [](double kpa) { return !std::isfinite(kpa); });
  return {{"id", run.id},
          {"readings", run.t_s.size()},
          {"missing", missing},
          {"begin_s", run.t_s.empty() ? Json(nullptr) : Json(run.t_s.front())},
          {"end_s", run.t_s.empty() ? Json(nullptr) : Json(run.t_s.back())}};
}

}  // namespace

Json UnderstoodOf(const Recording& recording) {
  const catalog::TableReading& table = recording.table;
  Json columns = Json::array(), runs = Json::array();
  bool is_absolute = false, has_decimals = false, has_comma = false;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    columns.push_back(ColumnOf(recording, i));
    const auto& column = table.columns[i];
    has_decimals = has_decimals || column.has_decimals;
    has_comma = has_comma || column.decimal == catalog::Decimal::kComma;
    for (const catalog::Target& target : column.targets)
      is_absolute = is_absolute || (IsPressureField(target.column) &&
                                    TakeGaugeMark(target.unit).gauge == Gauge::kAbsolute);
  }
  for (const RecordedRun& run : recording.runs) runs.push_back(RunOf(run));
  return {{"encoding", TextOrNull(table.encoding)},
          {"delimiter", TextOrNull(table.delimiter)},
          {"decimal", has_decimals ? Json(has_comma ? "comma" : "point") : Json(nullptr)},
          {"heading_line", RowOrNull(recording.has_headings ? table.header_row : 0)},
          {"units_line", RowOrNull(table.units_row)},
          {"ambient_kpa_abs", is_absolute ? Json(recording.ambient_kpa_abs) : Json(nullptr)},
          {"columns", std::move(columns)},
          {"runs", std::move(runs)},
          {"notes", recording.notes}};
}

}  // namespace plenum::api
