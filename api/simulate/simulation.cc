#include "api/simulate/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>

#include "api/json/json.h"
#include "api/json/remarks.h"
#include "api/json/request_limits.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/version.h"
#include "api/json/words.h"
#include "api/simulate/effects.h"
#include "api/simulate/group_chamber.h"
#include "api/simulate/rig.h"

namespace plenum::api {
namespace {

constexpr double kSamplesMax = kSimulationSamplesMax;
constexpr double kSampleHzDefault = 100;
constexpr double kEndMaxS = 1e6;

struct Simulation {
  model::Rig rig;
  model::SimulateOptions options;
  Remarks remarks;
};

// Every actuator at the start; the temperature matters only to heat_transfer, 0 is the ambient's.
struct Initial {
  double pressure_pa = 0.0;
  double temperature_k = 0.0;
};

Initial ReadInitial(Reader& request, const model::Ambient& ambient, Side side) {
  auto reader = request.OptionalObject("initial");
  if (!reader) return {.pressure_pa = ambient.pressure_pa};
  const double lowest_kpa = -ambient.pressure_pa / kPaPerKpa;
  const Range pressures = side == Side::kVacuum ? Range{DeepestKpaGauge(ambient), 0}
                                                : Above(lowest_kpa, kRigGaugeMaxKpa);
  const double gauge = reader->Number("pressure_kpa_gauge", pressures, 0.0);
  const std::optional<double> temperature_k = reader->OptionalNumber("temperature_k", {200, 400});
  reader->Finish();
  return {PaFromKpaGauge(gauge, ambient, side), temperature_k.value_or(0.0)};
}

// Where the actuator rests below ambient, and what it empties into.
void ReadLow(Reader& reader, const model::Ambient& ambient, model::GroupRig& group) {
  ReadLowPressure(reader, ambient, false, group.chamber);
  const bool low = group.chamber.low_pressure_pa > 0.0;
  group.close_at_low = reader.Bool("close_at_low_pressure", false);
  if (group.close_at_low && !low)
    reader.Fail("close_at_low_pressure", "needs a low_pressure_kpa_gauge below 0");
  const auto kpa =
      reader.OptionalNumber("exhaust_pressure_kpa_gauge", {DeepestKpaGauge(ambient), 0});
  if (low && !kpa)
    reader.Fail("exhaust_pressure_kpa_gauge", "is required by low_pressure_kpa_gauge");
  if (!kpa || *kpa == 0.0) return;
  if (!low)
    return reader.Fail("exhaust_pressure_kpa_gauge",
                       "is a vacuum for actuators with a low_pressure_kpa_gauge below 0");
  group.chamber.exhaust_pressure_pa = PaFromKpaGauge(*kpa, ambient);
}

model::GroupRig ReadGroup(const Element& element, std::size_t index, const Simulation& simulation,
                          const std::vector<catalog::Part>& parts,
                          const std::optional<Schedule>& shared,
                          const std::vector<model::Effect>& shared_effects,
                          std::vector<std::string>& names, double& duration_s, Errors& errors) {
  Reader reader(element, errors);
  model::GroupRig group;
  group.name = ReadName(reader, index, names);
  group.count = reader.Integer("count", 1, kCountMax, 1);
  group.chamber = ReadChamber(reader, simulation.rig.ambient, Vacuum::kAllowed);
  ReadLow(reader, simulation.rig.ambient, group);
  Line line = ReadLine(reader, parts);
  group.chamber.dead_volume_m3 = line.bore_volume_m3;
  group.fill = std::move(line.fill);
  group.exhaust = std::move(line.exhaust);
  if (group.chamber.evacuated) {  // crossed the other way round
    std::reverse(group.fill.begin(), group.fill.end());
    std::reverse(group.exhaust.begin(), group.exhaust.end());
  }
  const std::optional<Schedule> own = ReadSchedule(reader);
  if (!own && !shared)
    reader.Fail("valve", "is required: commands of the group or of the whole request, or a cycle");
  else
    group.schedule = (own ? own : shared)->commands;
  group.blocked = reader.Bool("blocked", false);
  group.close_at_operating = reader.Bool("close_at_operating_pressure", false);
  group.effects = ReadEffects(reader, shared_effects);
  group.effects.insert(group.effects.end(), shared_effects.begin(), shared_effects.end());
  if (group.chamber.low_pressure_pa > 0.0 && !group.effects.empty())
    reader.Fail("effects",
                "are those of actuators that stay above ambient, and this one has a "
                "low_pressure_kpa_gauge");
  if (group.chamber.evacuated && !group.effects.empty())
    reader.Fail("effects", "are those of actuators under pressure, not of evacuated ones");
  if (index > 0 && group.chamber.evacuated != simulation.rig.groups.front().chamber.evacuated)
    reader.Fail("operating_pressure_kpa_gauge",
                "must be on the same side of ambient pressure as that of the first group, whose "
                "source is the same");
  duration_s = std::max(duration_s, own ? own->duration_s.value_or(0.0) : 0.0);
  reader.Finish();
  return group;
}

// End and sampling; `duration_s` is how long the longest cycle schedule lasts, 0 without one.
void ReadTimes(Reader& request, double duration_s, model::SimulateOptions& options) {
  const Range range = Above(0, kEndMaxS);
  options.end_s = duration_s > 0.0 ? request.Number("t_end_s", range, duration_s)
                                   : request.Number("t_end_s", range);
  const double sample_hz_max = std::floor(kSamplesMax / options.end_s * 1e6) / 1e6;
  const double fallback = std::fmin(kSampleHzDefault, sample_hz_max);
  options.sample_hz = request.Number("sample_hz", Above(0, 1e6), fallback);
  if (options.sample_hz * options.end_s > kSamplesMax * (1 + 1e-9))
    request.Fail("sample_hz", "must be > 0 and ≤ " + Decimal(sample_hz_max) + " with t_end_s " +
                                  Decimal(options.end_s) + " (at most " + Decimal(kSamplesMax) +
                                  " samples), not " + Decimal(options.sample_hz));
}

Side SideOf(const model::Rig& rig) {
  return !rig.groups.empty() && rig.groups.front().chamber.evacuated ? Side::kVacuum
                                                                     : Side::kPressure;
}

bool ActOnSupply(const model::Rig& rig) {
  for (const model::GroupRig& group : rig.groups)
    for (const model::Effect& effect : group.effects)
      if (effect.spec->place == model::EffectPlace::kSupply) return true;
  return false;
}

Parsed<Simulation> ParseSimulation(const Json& request, const std::vector<catalog::Part>& parts) {
  Errors errors;
  Simulation simulation;
  RemarkRecorder recorder;
  Reader reader(request, "", errors);
  reader.Schema("simulation/1");
  reader.Text("name", "");
  simulation.rig.ambient = ReadAmbient(reader);
  simulation.rig.gas = ReadGas(reader);
  const std::optional<Schedule> shared = ReadSchedule(reader);
  double duration_s = shared ? shared->duration_s.value_or(0.0) : 0.0;
  const std::vector<model::Effect> effects = ReadEffects(reader);
  std::vector<std::string> names;
  for (const Element& element : reader.List("actuators", 1, kGroupsMax))
    simulation.rig.groups.push_back(ReadGroup(element, simulation.rig.groups.size(), simulation,
                                              parts, shared, effects, names, duration_s, errors));
  const Side side = SideOf(simulation.rig);
  simulation.rig.source = ReadSource(reader, simulation.rig.ambient, side);
  if (std::holds_alternative<model::PumpSource>(simulation.rig.source) &&
      ActOnSupply(simulation.rig))
    reader.FailAt("source/kind",
                  "must be other than direct_pump with an effect on the supply: pumps without a "
                  "reservoir have no pressure of their own that it could change");
  const Initial initial = ReadInitial(reader, simulation.rig.ambient, side);
  for (model::GroupRig& group : simulation.rig.groups) {
    group.initial_pressure_pa = initial.pressure_pa;
    group.initial_temperature_k = initial.temperature_k;
  }
  simulation.rig.dense = model::IsDense(simulation.rig);
  const Fractions fractions = ReadFractions(reader);
  simulation.options.rise_fraction = fractions.rise;
  simulation.options.fall_fraction = fractions.fall;
  ReadTimes(reader, duration_s, simulation.options);
  reader.Finish();
  if (!errors.empty()) return errors;
  simulation.remarks = recorder.Take();
  return simulation;
}

const char* StatusName(model::SimulateStatus status) {
  switch (status) {
    case model::SimulateStatus::kDone:
      return "done";
    case model::SimulateStatus::kCancelled:
      return "out_of_time";
    case model::SimulateStatus::kTooManySteps:
      return "too_many_steps";
    case model::SimulateStatus::kNotFinite:
      return "not_finite";
    case model::SimulateStatus::kInvalid:
      return "invalid";
    case model::SimulateStatus::kNotRun:
      break;
  }
  return "not_run";
}

using Arrays = std::vector<std::vector<double>>;

// In JSON, or in `arrays` where they are asked for.
Json Series(std::vector<double> values, Arrays* arrays, auto&& convert) {
  for (double& value : values) value = convert(value);
  if (arrays != nullptr) {
    arrays->push_back(std::move(values));
    return {{"$array", arrays->size() - 1}};
  }
  Json list = Json::array();
  for (const double value : values) list.push_back(Number(value));
  return list;
}

Json RenderPerformance(const std::vector<model::FullStroke>& strokes, const model::Rig& rig) {
  Json groups = Json::array();
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const model::FullStroke& stroke = strokes[i];
    groups.push_back(
        {{"name", rig.groups[i].name},
         {"rise_time_s", Number(stroke.rise_time_s)},
         {"fall_time_s", Number(stroke.fall_time_s)},
         {"frequency_hz_max",
          stroke.frequency_max_hz > 0.0 ? Number(stroke.frequency_max_hz) : Json(nullptr)}});
    // A null is then not known, rather than never reached.
    if (stroke.status != model::SimulateStatus::kDone)
      groups.back()["status"] = StatusName(stroke.status);
  }
  return {{"groups", groups}};
}

Json RenderResponse(const model::Response& response, const std::vector<model::FullStroke>& strokes,
                    const model::Rig& rig, Arrays* arrays) {
  const Side side = SideOf(rig);
  const auto gauge = [&](double pa) { return KpaGaugeFromPa(pa, rig.ambient, side); };
  Json groups = Json::array();
  for (const model::GroupResponse& group : response.groups) {
    // What fills an evacuated actuator is the lack of air.
    const bool vacuum = side == Side::kVacuum;
    const double in_m3 = vacuum ? group.air_out_m3 : group.air_in_m3,
                 out_m3 = vacuum ? group.air_in_m3 : group.air_out_m3;
    const bool measured = !group.reading_pa.empty();
    Json rendered = {{"name", group.name},
                     {"pressure_kpa_gauge",
                      Series(measured ? group.reading_pa : group.pressure_pa, arrays, gauge)},
                     {"volume_ml", Series(group.volume_m3, arrays, MlFromM3)},
                     {"air_in_l_anr", Number(LFromM3(in_m3))},
                     {"air_out_l_anr", Number(LFromM3(out_m3))}};
    if (measured)
      rendered["actuator_pressure_kpa_gauge"] = Series(group.pressure_pa, arrays, gauge);
    if (!group.temperature_k.empty())
      rendered["temperature_k"] = Series(group.temperature_k, arrays, std::identity());
    groups.push_back(std::move(rendered));
  }
  Json document = AnswerDocument("response/1");
  document["status"] = StatusName(response.status);
  if (response.status != model::SimulateStatus::kDone) document["detail"] = response.detail;
  document["t_s"] = Series(response.t_s, arrays, std::identity());
  document["groups"] = std::move(groups);
  document["source_pressure_kpa_gauge"] = Series(response.source_pressure_pa, arrays, gauge);
  document["performance"] = RenderPerformance(strokes, rig);
  return document;
}

Parsed<Json> Run(const Json& request, const std::vector<catalog::Part>& parts, double seconds_max,
                 Arrays* arrays) {
  Parsed<Simulation> parsed = ParseSimulation(request, parts);
  if (auto* errors = std::get_if<Errors>(&parsed)) return std::move(*errors);
  auto& [rig, options, remarks] = std::get<Simulation>(parsed);
  using Clock = std::chrono::steady_clock;
  const auto limit = std::chrono::duration<double>(seconds_max);
  options.cancelled = [start = Clock::now(), limit] { return Clock::now() - start > limit; };
  model::Response response = model::Simulate(rig, options);
  if (response.status == model::SimulateStatus::kInvalid) return Errors{{"", response.detail}};
  const std::vector<model::FullStroke> strokes = model::FullStrokes(rig, options);
  if (options.cancelled()) {
    if (response.status == model::SimulateStatus::kDone)
      response.status = model::SimulateStatus::kCancelled;
    if (!response.detail.empty()) response.detail += "; ";
    response.detail += "out of time: what performance gives as null is not known";
  }
  Json document = RenderResponse(response, strokes, rig, arrays);
  remarks.AddTo(document);
  return document;
}

}  // namespace

bool NamesAnyPart(const Json& request) {
  if (request.is_object() && request.contains("part")) return true;
  return std::any_of(request.begin(), request.end(), [](const Json& child) {
    return child.is_structured() && NamesAnyPart(child);
  });
}

Parsed<Json> RunSimulation(const Json& request, const std::vector<catalog::Part>& parts,
                           double seconds_max) {
  return Run(request, parts, seconds_max, nullptr);
}

Parsed<ResponseWithArrays> RunSimulationToArrays(const Json& request,
                                                 const std::vector<catalog::Part>& parts,
                                                 double seconds_max) {
  ResponseWithArrays response;
  auto document = Run(request, parts, seconds_max, &response.arrays);
  if (auto* errors = std::get_if<Errors>(&document)) return std::move(*errors);
  response.document = std::get<Json>(std::move(document));
  return response;
}

}  // namespace plenum::api
