#include "api/measure/curves.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "api/json/reader.h"
#include "api/json/remarks.h"
#include "api/json/units.h"
#include "api/json/version.h"
#include "api/json/words.h"
#include "api/measure/inputs_document.h"
#include "api/measure/measurement.h"
#include "api/measure/stated_document.h"
#include "calibration/judge/curve.h"

namespace plenum::api {
namespace {

using calibration::Curve;
using calibration::Run;
using calibration::Squares;

struct Request {
  Json answer;
  std::string run, model;  // run: empty for all
  calibration::Dataset dataset;
  StatedAnswer stated;
};

template <typename T>
bool Take(Parsed<T> parsed, const std::string& pointer, T& value, Errors& errors) {
  if (auto* found = std::get_if<Errors>(&parsed)) {
    errors = std::move(*found);
    PutUnder(pointer, errors);
    return false;
  }
  value = std::get<T>(std::move(parsed));
  return true;
}

void CheckRun(Reader& reader, const Request& request) {
  const auto& runs = request.dataset.runs;
  if (request.run.empty() ||
      std::any_of(runs.begin(), runs.end(), [&](const Run& r) { return r.id == request.run; }))
    return;
  std::vector<std::string> ids;
  ids.reserve(runs.size());
  for (const Run& run : runs) ids.push_back(run.id);
  const std::string nearest = Nearest(request.run, ids);
  reader.Fail(
      "run", "no run " + Quoted(request.run) + (nearest.empty() ? "" : "; nearest id: " + nearest));
}

Parsed<Request> ParseCurves(const Json& document) {
  Errors errors;
  Request request;
  Reader reader(document, "", errors);
  reader.Schema("simulation/1");
  reader.Text("name", "");
  request.run = reader.Text("run", "");
  const std::vector<std::string> models(std::begin(kModelsOfADiagnosis),
                                        std::end(kModelsOfADiagnosis));
  request.model = reader.Choice("model", models, "after");
  const Json* measurement = reader.Has("measurement") ? reader.Raw("measurement") : nullptr;
  const Json* from = reader.Has("from") ? reader.Raw("from") : nullptr;
  if (from == nullptr || !from->is_object() || from->value("schema", Json()) != "diagnosis/1")
    reader.Fail("from", "must be an answer with schema \"diagnosis/1\"");
  else if (!from->contains("measurement") || !from->contains("runs"))
    reader.Fail("from",
                "does not state its models: it was made by an older program; diagnose the "
                "measurement again");
  reader.Finish();
  if (!errors.empty()) return errors;
  request.answer = *from;
  Json inputs;
  if (!Take(WithReadings(from->at("measurement"), measurement), "/from", inputs, errors) ||
      !Take(ParseMeasurement(inputs), "/from/measurement", request.dataset, errors) ||
      !Take(ParseStatedModel(*from, request.model, request.dataset), "/from", request.stated,
            errors))
    return errors;
  CheckRun(reader, request);
  if (!errors.empty()) return errors;
  return request;
}

Json Gauge(const std::vector<double>& pressure_pa, const model::Ambient& ambient) {
  Json list = Json::array();
  for (const double pa : pressure_pa) list.push_back(Number(KpaGaugeFromPa(pa, ambient)));
  return list;
}

Json Channels(const calibration::Channels& channels, const Run& run) {
  const auto scaled = [](const std::vector<double>& values, double unit) {
    Json list = Json::array();
    for (const double value : values) list.push_back(Number(value / unit));
    return list;
  };
  const calibration::Channels& recorded = run.channels;
  Json document = Json::object();
  if (!recorded.source_pressure_pa.empty())
    document["source_pressure_kpa_gauge"] = Gauge(channels.source_pressure_pa, run.ambient);
  if (!recorded.inlet_pressure_pa.empty())
    document["inlet_pressure_kpa_gauge"] = Gauge(channels.inlet_pressure_pa, run.ambient);
  if (!recorded.temperature_k.empty())
    document["temperature_k"] = scaled(channels.temperature_k, 1.0);
  if (!recorded.volume_m3.empty()) document["volume_ml"] = scaled(channels.volume_m3, kM3PerMl);
  if (!recorded.flow_m3_per_s.empty())
    document["flow_l_per_min_anr"] = scaled(channels.flow_m3_per_s, kM3PerSPerLPerMin);
  return document;
}

Json RenderCurve(const Curve& curve, const Run& run, bool held_out) {
  const bool done = curve.status == model::SimulateStatus::kDone;
  Json document = {{"id", run.id}, {"held_out", held_out}, {"status", done ? "done" : "failed"}};
  if (!done) {
    document["detail"] = curve.detail;
    return document;
  }
  document["rms_kpa"] = Number(curve.error.Rms() / kPaPerKpa);
  document["peak_kpa"] = Number(curve.error.peak / kPaPerKpa);
  document["t_s"] = Json::array();
  for (const double t_s : run.t_s) document["t_s"].push_back(Number(t_s));
  document["pressure_kpa_gauge"] = Gauge(curve.reading.pressure_pa, run.ambient);
  document["channels"] = Channels(curve.reading.channels, run);
  return document;
}

Json Rms(const Squares& squares) {
  return squares.count == 0 ? Json() : Number(squares.Rms() / kPaPerKpa);
}

}  // namespace

bool AsksForCurves(const Json& request) { return request.is_object() && request.contains("from"); }

Parsed<Json> RunCurves(const Json& request, double seconds_max) {
  Parsed<Request> parsed = ParseCurves(request);
  if (auto* errors = std::get_if<Errors>(&parsed)) return std::move(*errors);
  const auto& [answer, asked, model, dataset, stated] = std::get<Request>(parsed);
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds_max);
  const auto cancelled = [end] { return Clock::now() > end; };
  const calibration::ForwardModel forward(dataset);
  Json document = AnswerDocument("curves/1");
  document["model"] = model;
  Json runs = Json::array();
  Squares fitted, held_out;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Run& run = dataset.runs[i];
    if (!asked.empty() && run.id != asked) continue;
    const Curve curve = CurveOf(forward, stated.model, i, stated.runs[i], cancelled);
    const bool unseen =
        std::find(dataset.holdout.begin(), dataset.holdout.end(), run.id) != dataset.holdout.end();
    if (!stated.runs[i].copy_of) (unseen ? held_out : fitted).Add(curve.error);
    runs.push_back(RenderCurve(curve, run, unseen));
    const Json& of_run = answer.at(model).at("runs");
    runs.back()["stated_rms_kpa"] = of_run.value(run.id, Json());
  }
  document["rms_kpa"] = Rms(fitted);
  document["holdout_rms_kpa"] = Rms(held_out);
  if (asked.empty()) document["stated_rms_kpa"] = answer.at(model).value("rms_kpa", Json());
  document["runs"] = std::move(runs);
  return document;
}

}  // namespace plenum::api
