#include "api/measure/csv/gauge_check.h"

#include <algorithm>

#include "api/json/json.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

constexpr double kNearAmbient = 0.8;

double LowestKpa(const Recording& recording, const std::string& field) {
  double low = std::numeric_limits<double>::infinity();
  for (const RecordedRun& run : recording.runs)
    for (const double kpa : run.readings.at(field))
      if (std::isfinite(kpa)) low = std::min(low, kpa);
  return low;
}

void Ask(const catalog::ColumnRead& column, const std::string& why, Recording& recording) {
  const catalog::Target& target = column.targets.front();
  recording.table.questions.push_back(
      {"column",
       column.key,
       Quoted(column.key) + ": are its pressures absolute or gauge (above ambient)? " + why,
       {catalog::FormatTarget({target.column, target.unit + " abs"}),
        catalog::FormatTarget({target.column, target.unit + " gauge"})}});
}

}  // namespace

void CheckGauge(bool is_settled, Recording& recording) {
  const auto& columns = recording.table.columns;
  std::string absolute;
  for (const auto& column : columns)
    if (!column.targets.empty() && IsPressureField(column.targets.front().column) &&
        TakeGaugeMark(column.targets.front().unit).gauge == Gauge::kAbsolute)
      absolute = column.key;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].targets.empty()) continue;
    const catalog::Target& target = columns[i].targets.front();
    const bool says = target.by_full_name || target.unit.find('=') != std::string::npos ||
                      TakeGaugeMark(target.unit).gauge != Gauge::kUnsaid;
    if (says || !IsPressureField(target.column)) continue;
    const double low = LowestKpa(recording, target.column);
    if (!absolute.empty()) {
      Ask(columns[i], "The heading " + Quoted(absolute) + " says absolute, this one says neither",
          recording);
    } else if (target.column == kPressureField && !is_settled && std::isfinite(low) &&
               low >= kNearAmbient * recording.ambient_kpa_abs) {
      Ask(columns[i],
          "No reading is below " + Decimal(Rounded(low)) + " kPa, and ambient is " +
              Decimal(Rounded(recording.ambient_kpa_abs)) + " kPa absolute",
          recording);
    } else {
      recording.meanings[i] = "taken as gauge: the heading does not say absolute";
    }
  }
}

}  // namespace plenum::api
