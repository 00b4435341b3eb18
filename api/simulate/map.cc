#include "api/simulate/map.h"

#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

#include "api/json/json.h"
#include "api/json/remarks.h"
#include "api/json/request_limits.h"
#include "api/json/shared_fields.h"
#include "api/json/version.h"
#include "api/json/words.h"
#include "model/simulate/simulate.h"
#include "model/strokes/closed_form.h"

namespace plenum::api {
namespace {

constexpr auto kTimeLimit = std::chrono::seconds(kMapSecondsMax);

using Deadline = std::chrono::steady_clock::time_point;
bool IsPast(Deadline deadline) { return std::chrono::steady_clock::now() > deadline; }

struct Grid {
  std::vector<double> source, operating, expansion, critical;
  std::vector<double> compressor_flow, reservoir_volume, count;  // empty: constant source pressure
  Fractions fractions;
  Remarks remarks;
};

struct MapPoint {
  double source, operating, expansion, critical;  // ratios
  std::optional<double> compressor_flow, reservoir_volume;
  int count = 1;
};

struct Times {
  double rise, fall;  // +∞ where never reached
};

Times ConstantSource(const MapPoint& point, const Fractions& fractions) {
  const model::NormalisedStroke stroke{point.operating, point.expansion, point.critical};
  const double span = point.operating - 1.0;
  return {model::NormalisedRiseTime(stroke, point.source, 1.0, 1.0 + fractions.rise * span),
          model::NormalisedFallTime(stroke, point.operating, 1.0 + fractions.fall * span)};
}

// A rig in which one second is one unit of normalised time: C·P0/V0 = 1/s at P0 and T0.
Times CompressorSource(const MapPoint& point, const Fractions& fractions, Deadline deadline) {
  constexpr double kNoLimitPa = 1e12;
  constexpr double kVolumeM3 = 1e-4;
  constexpr double kConductance = kVolumeM3 / model::kReferencePressurePa;
  const double ambient_pa = model::kReferencePressurePa;
  const double flow_m3_per_s = *point.compressor_flow * kConductance * ambient_pa;

  model::ReservoirSource source;
  source.volume_m3 = *point.reservoir_volume * kVolumeM3;
  source.initial_pressure_pa = point.source * ambient_pa;
  source.compressor.free_air_m3_per_s =
      model::MonotoneCurve({0.0, kNoLimitPa}, {flow_m3_per_s, flow_m3_per_s});
  source.compressor.current_a = model::MonotoneCurve({0.0}, {0.0});
  source.compressor.pressure_max_pa = kNoLimitPa;

  model::GroupRig group;
  group.count = point.count;
  group.chamber = {.rest_volume_m3 = kVolumeM3,
                   .expansion_ratio = point.expansion,
                   .operating_pressure_pa = point.operating * ambient_pa,
                   .volume_curve = {}};
  group.fill = group.exhaust = {
      {.sonic_conductance_m3_per_s_pa = kConductance, .critical_ratio = point.critical}};
  model::Rig rig;
  rig.source = source;
  rig.groups = {group};
  model::SimulateOptions options;
  options.rise_fraction = fractions.rise;
  options.fall_fraction = fractions.fall;
  options.cancelled = [deadline] { return IsPast(deadline); };
  const model::FullStroke stroke = model::FullStrokes(rig, options).front();
  return {stroke.rise_time_s, stroke.fall_time_s};
}

Json RenderPoint(const MapPoint& point, const Times& times) {
  Json row = {{"source_pressure_ratio", Number(point.source)},
              {"operating_pressure_ratio", Number(point.operating)},
              {"expansion_ratio", Number(point.expansion)},
              {"critical_ratio", Number(point.critical)}};
  if (point.compressor_flow) {
    row["compressor_flow_normalised"] = Number(*point.compressor_flow);
    row["reservoir_volume_normalised"] = Number(*point.reservoir_volume);
    row["actuator_count"] = point.count;
  }
  row["rise_time_normalised"] = Number(times.rise);
  row["fall_time_normalised"] = Number(times.fall);
  const bool reached = std::isfinite(times.rise + times.fall);
  row["frequency_max_normalised"] =
      reached ? Number(1.0 / (times.rise + times.fall)) : Json(nullptr);
  return row;
}

void ReadCompressorAxes(Reader& reader, Grid& grid) {
  if (!reader.Has("compressor_flow_normalised") && !reader.Has("reservoir_volume_normalised")) {
    if (reader.Has("actuator_count"))
      reader.Fail("actuator_count",
                  "is for the compressor source; give compressor_flow_normalised and "
                  "reservoir_volume_normalised too");
    return;
  }
  grid.compressor_flow = reader.Numbers("compressor_flow_normalised", kMapAxisMax, {0, 1e4});
  grid.reservoir_volume = reader.Numbers("reservoir_volume_normalised", kMapAxisMax, {0.01, 1e6});
  grid.count = {1.0};
  if (!reader.Has("actuator_count")) return;
  grid.count = reader.Numbers("actuator_count", kMapAxisMax, {1, kCountMax});
  for (const double count : grid.count)
    if (count != std::floor(count))
      reader.Fail("actuator_count", "must be whole numbers, not " + Decimal(count));
}

Parsed<Grid> ParseGrid(const Json& request) {
  Errors errors;
  Grid grid;
  RemarkRecorder recorder;
  Reader reader(request, "", errors);
  reader.Schema("map/1");
  reader.Text("name", "");
  grid.source = reader.Numbers("source_pressure_ratio", kMapAxisMax, {1, 1000});
  grid.operating = reader.Numbers("operating_pressure_ratio", kMapAxisMax, Above(1, 100));
  grid.expansion = reader.Numbers("expansion_ratio", kMapAxisMax, {1, kExpansionMax});
  grid.critical = reader.Numbers("critical_ratio", kMapAxisMax, {0, 0.95});
  ReadCompressorAxes(reader, grid);
  grid.fractions = ReadFractions(reader);
  reader.Finish();

  double points = 1.0;
  for (const auto* axis : {&grid.source, &grid.operating, &grid.expansion, &grid.critical})
    points *= static_cast<double>(axis->size());
  const bool has_compressor = !grid.count.empty();
  for (const auto* axis : {&grid.compressor_flow, &grid.reservoir_volume, &grid.count})
    if (has_compressor) points *= static_cast<double>(axis->size());
  const double most = has_compressor ? kMapPointsCompressorMax : kMapPointsMax;
  if (points > most)
    reader.FailHere("the grid must have at most " + Decimal(most) + " points" +
                    (has_compressor ? " with a compressor" : "") + ", not " + Decimal(points));
  if (!errors.empty()) return errors;
  grid.remarks = recorder.Take();
  return grid;
}

// Calls `visit` for every point, the last axis fastest.
void ForEachPoint(const Grid& grid, auto&& visit) {
  const bool has_compressor = !grid.count.empty();
  const std::vector<double> none{0.0};
  for (const double source : grid.source)
    for (const double operating : grid.operating)
      for (const double expansion : grid.expansion)
        for (const double critical : grid.critical)
          for (const double flow : has_compressor ? grid.compressor_flow : none)
            for (const double volume : has_compressor ? grid.reservoir_volume : none)
              for (const double count : has_compressor ? grid.count : none) {
                MapPoint point{source, operating, expansion, critical, {}, {}, 1};
                if (has_compressor) {
                  point.compressor_flow = flow;
                  point.reservoir_volume = volume;
                  point.count = static_cast<int>(count);
                }
                visit(point);
              }
}

}  // namespace

Parsed<Json> RunMap(const Json& request) {
  Parsed<Grid> parsed = ParseGrid(request);
  if (auto* errors = std::get_if<Errors>(&parsed)) return std::move(*errors);
  const Grid& grid = std::get<Grid>(parsed);
  const Deadline deadline = std::chrono::steady_clock::now() + kTimeLimit;
  Json rows = Json::array();
  ForEachPoint(grid, [&](const MapPoint& point) {
    if (IsPast(deadline)) return;
    const Times times = point.compressor_flow ? CompressorSource(point, grid.fractions, deadline)
                                              : ConstantSource(point, grid.fractions);
    rows.push_back(RenderPoint(point, times));
  });
  // The last point may have been cut short, so nothing of the grid is given.
  if (IsPast(deadline)) return Errors{{"", "the grid takes longer than 60 s; give fewer points"}};
  Json answer = AnswerDocument("map_answer/1");
  answer["rows"] = std::move(rows);
  grid.remarks.AddTo(answer);
  return answer;
}

}  // namespace plenum::api
