#include "api/measure/measurement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "api/json/reader.h"
#include "api/json/schema_recorder.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/measure/measured_rig.h"
#include "api/measure/measured_run.h"
#include "api/measure/time_limit.h"
#include "calibration/learn/slip_kinds.h"

namespace plenum::api {
namespace {

using calibration::Dataset;
using calibration::Declared;

constexpr double kBeyondRange = 0.01;  // of the range: readings that no sensor gives

void ReadUncertainty(Reader& document, Dataset& dataset) {
  auto reader = document.OptionalObject("relative_uncertainty");
  if (!reader) return;
  for (int k = 0; k < calibration::kOfTheRig; ++k) {
    const auto name = calibration::Name(static_cast<Declared>(k));
    double& uncertainty = dataset.relative_uncertainty[static_cast<std::size_t>(k)];
    reader->Describe(name, {{"anyOf", {NumberForm({0, 10}), {{"const", "unknown"}}}}});
    if (!reader->Has(name)) continue;
    const Json& value = *reader->Raw(name);
    if (value.is_string() && value.get_ref<const std::string&>() == "unknown")
      uncertainty = calibration::kUnknown;
    else if (value.is_string())
      reader->Fail(name, "must be a number or \"unknown\", not " + KindOf(value));
    else
      uncertainty = reader->Number(name, {0, 10});
  }
  reader->Finish();
}

// A conductance, or what a pump delivers, is known only as well as the volume behind it: where
// nothing is said of that, an uncertainty is assumed.
void AssumeVolume(const Json& document, Dataset& dataset) {
  using Kind = calibration::MeasuredNumber::Kind;
  double& uncertainty =
      dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)];
  const Json stated = document.value("relative_uncertainty", Json::object());
  const bool has = std::any_of(dataset.runs.begin(), dataset.runs.end(), [](const auto& run) {
    return calibration::Has(run, Declared::kRestVolume);
  });
  const bool needs = std::any_of(
      dataset.measured.begin(), dataset.measured.end(), [](const calibration::MeasuredNumber& one) {
        return one.kind == Kind::kConductance || one.kind == Kind::kDelivery;
      });
  if (!has || !needs || !stated.is_object() || stated.contains("rest_volume")) return;
  uncertainty = kAssumedVolumeShare;
  if (RemarkRecorder* recorder = RemarkRecorder::Current())
    recorder->Warn("/relative_uncertainty/rest_volume",
                   "is not stated: 2 % is assumed, and what is measured is no better known than "
                   "that. Weigh the bottle empty and full of water, and state 0.002");
}

// A pump that is measured has one curve, whose points are those of all runs.
void CheckDelivery(Reader& document, const Dataset& dataset) {
  const std::vector<std::size_t>* first = nullptr;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const std::vector<std::size_t>& points = dataset.runs[i].measured.delivery;
    if (points.empty()) continue;
    if (first != nullptr && points != *first)
      document.FailAt("runs/" + std::to_string(i) + "/rig",
                      "measures another pump or another curve than an earlier run");
    first = &points;
  }
}

// Names that no run gives are none. A volume that runs measure is that of one piece.
void TakeSpecimens(Reader& document, Dataset& dataset) {
  if (dataset.specimens.size() == 1 && dataset.specimens.front().empty()) dataset.specimens.clear();
  std::map<std::size_t, std::size_t> measured_in;  // by number the run
  for (std::size_t i = 0; i < dataset.runs.size(); ++i)
    for (const calibration::MeasuredPlace& place : dataset.runs[i].measured.places) {
      if (place.of != calibration::MeasuredPlace::Of::kVolume) continue;
      const std::size_t first = measured_in.try_emplace(place.number, i).first->second;
      if (dataset.runs[first].specimen == dataset.runs[i].specimen) continue;
      document.FailAt("runs/" + std::to_string(i) + "/specimen",
                      "must be that of run " + Quoted(dataset.runs[first].id) +
                          ": the rig measures internal_volume, which is written into a part from "
                          "one piece; measure each piece by itself");
    }
}

std::vector<std::string> NamesOf(const calibration::Several& several) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < several.pieces(); ++i) names.push_back(several.piece(i).name);
  return names;
}

// Several chambers stand where specimens would, and the runs of their gauges behind all others.
void TakeSeveral(Reader& document, std::vector<calibration::Run>& of_gauges, Dataset& dataset) {
  const auto& runs = dataset.runs;
  if (std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.several.empty(); }))
    return;
  const std::vector<std::string> names = NamesOf(runs.front().several);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string place = "runs/" + std::to_string(i);
    if (NamesOf(runs[i].several) != names)
      document.FailAt(place + "/rig", "must have the chambers of the first run");
    if (runs[i].id.find('[') != std::string::npos)
      document.FailAt(place + "/id", "must not hold [ where the rig has several chambers");
  }
  if (!dataset.specimens.empty())
    document.Fail("runs", "must not name specimens where the rig has several chambers");
  dataset.specimens = names;
  dataset.several = true;
  const std::vector<std::string> held_out = dataset.holdout;
  for (calibration::Run& run : of_gauges) {
    if (std::find(held_out.begin(), held_out.end(), run.several.shot) != held_out.end())
      dataset.holdout.push_back(run.id);
    dataset.runs.push_back(std::move(run));
  }
}

void CheckHoldout(Reader& document, const std::set<std::string>& ids, const Dataset& dataset) {
  for (std::size_t i = 0; i < dataset.holdout.size(); ++i) {
    if (ids.contains(dataset.holdout[i])) continue;
    const std::vector<std::string> known(ids.begin(), ids.end());
    const std::string nearest = Nearest(dataset.holdout[i], known);
    document.FailAt("holdout/" + std::to_string(i),
                    "no run " + Quoted(dataset.holdout[i]) +
                        (nearest.empty() ? "" : "; nearest id: " + nearest));
  }
  if (!ids.empty() && dataset.holdout.size() >= ids.size())
    document.Fail("holdout", "must leave at least one run to fit");
}

// The gauge's zero and gain are known as well as its data sheet says: the gain to the accuracy at
// the far end of its range, or at the operating pressure where the range is not stated.
void TakeAccuracy(Dataset& dataset) {
  for (const calibration::Run& run : dataset.runs) {
    const calibration::Sensor& sensor = run.sensor;
    if (!(sensor.accuracy_pa > 0.0)) continue;
    const double ambient_pa = run.ambient.pressure_pa;
    const double full_pa = sensor.HasRange() ? std::max(std::abs(sensor.high_pa - ambient_pa),
                                                        std::abs(sensor.low_pa - ambient_pa))
                                             : model::Span(run.chamber);
    const auto raise = [&](Declared number, double share) {
      double& uncertainty = dataset.relative_uncertainty[static_cast<std::size_t>(number)];
      uncertainty = std::max(uncertainty, share);
    };
    raise(Declared::kSensorZero, sensor.accuracy_pa / calibration::kSensorZeroPa);
    raise(Declared::kSensorGain, sensor.accuracy_pa / full_pa);
  }
}

// Of the readings of a run in the document.
std::string PlaceOfReadings(const Dataset& dataset, std::size_t index) {
  const calibration::Run& run = dataset.runs[index];
  const calibration::Several& several = run.several;
  std::size_t shot = 0;
  while (shot < index && dataset.runs[shot].id != several.shot) ++shot;
  const std::string place = "runs/" + std::to_string(shot);
  if (several.empty() || shot == index)
    return "runs/" + std::to_string(index) + "/pressure_kpa_gauge";
  return place + "/channels/chambers/" + several.all[several.gauge].name;
}

// Readings far beyond the range are of another sensor, or in another unit.
void CheckRanges(Reader& document, const Dataset& dataset) {
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const calibration::Run& run = dataset.runs[i];
    const calibration::Sensor& sensor = run.sensor;
    if (!sensor.HasRange()) continue;
    const double beyond_pa = kBeyondRange * (sensor.high_pa - sensor.low_pa) + sensor.resolution_pa;
    const auto off = std::find_if(run.pressure_pa.begin(), run.pressure_pa.end(), [&](double pa) {
      return pa < sensor.low_pa - beyond_pa || pa > sensor.high_pa + beyond_pa;
    });
    if (off == run.pressure_pa.end()) continue;
    const auto kpa = [&](double pa) { return Decimal(Rounded(KpaGaugeFromPa(pa, run.ambient))); };
    document.FailAt(
        PlaceOfReadings(dataset, i) + "/" + std::to_string(off - run.pressure_pa.begin()),
        "is " + kpa(*off) + " kPa, beyond the sensor's range_kpa_gauge of " + kpa(sensor.low_pa) +
            " to " + kpa(sensor.high_pa));
  }
}

// One name or a list of them: slips of the pen that are undone in the data set.
void ReadAssumptions(Reader& document, Dataset& dataset) {
  const Json text = {{"type", "string"}};
  document.Describe("assume", {{"anyOf", {text, {{"type", "array"}, {"items", text}}}}});
  if (!document.Has("assume")) return;
  const Json* given = document.Raw("assume");
  const bool listed = given->is_array();
  const Json names = listed ? *given : Json::array({*given});
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string place = listed ? "assume/" + std::to_string(i) : "assume";
    if (!names[i].is_string()) {
      document.FailAt(place, "must be a name or a list of names, not " + KindOf(names[i]));
      continue;
    }
    const auto& assumption = names[i].get_ref<const std::string&>();
    const std::string why = calibration::Settle(assumption, dataset);
    if (!why.empty()) document.FailAt(place, Quoted(assumption) + " " + why);
    if (why.empty() && RemarkRecorder::Current() != nullptr)
      RemarkRecorder::Current()->Warn(document.Pointer(place),
                                      "is taken as said: " + calibration::InWords(assumption));
  }
}

// What tables were understood to say (api/measure/csv): for people.
void PassUnderstood(Reader& document) {
  document.Describe("understood", {{"type", "array"}, {"items", {{"type", "object"}}}});
  const Json* given = document.Raw("understood");
  if (given == nullptr) return;
  if (!given->is_array())
    return document.FailAt("understood", "must be a list of objects, not " + KindOf(*given));
  for (std::size_t i = 0; i < given->size(); ++i)
    if (!given->at(i).is_object())
      document.FailAt("understood/" + std::to_string(i),
                      "must be an object, not " + KindOf(given->at(i)));
}

}  // namespace

Parsed<Dataset> ParseMeasurement(const Json& document, Remarks* remarks) {
  Errors errors;
  RemarkRecorder recorder;
  Dataset dataset;
  Reader reader(document, "", errors);
  AllowRemarks(reader);
  PassUnderstood(reader);
  reader.Number(kTimeLimitField, {0.01, kDiagnosisTimeMaxS}, kDiagnosisTimeS);  // of its diagnosis
  reader.Schema("measurement/1");
  dataset.name = reader.Text("name", "measurement");
  static const Json kNoRig = Json::object();
  const Json* shared = reader.Has("rig") ? reader.Raw("rig") : &kNoRig;
  ReadUncertainty(reader, dataset);
  std::set<std::string> ids;
  std::vector<calibration::Run> of_gauges;
  for (const Element& element : reader.List("runs", 1, kRunsMax))
    dataset.runs.push_back(ReadRun(element, *shared, ids, dataset, of_gauges, errors));
  TakeSpecimens(reader, dataset);
  CheckDelivery(reader, dataset);
  if (document.is_object()) AssumeVolume(document, dataset);
  dataset.holdout = reader.Texts("holdout", 0, kRunsMax);
  CheckHoldout(reader, ids, dataset);
  TakeSeveral(reader, of_gauges, dataset);
  ReadAssumptions(reader, dataset);
  TakeAccuracy(dataset);
  CheckRanges(reader, dataset);
  reader.Finish();
  if (!errors.empty()) return errors;
  if (remarks != nullptr) *remarks = recorder.Take();
  return dataset;
}

Parsed<Json> MergeMeasurements(const std::vector<Json>& documents) {
  Json merged = documents.front();
  Errors errors;
  for (std::size_t d = 1; d < documents.size(); ++d) {
    const Json& document = documents[d];
    if (!document.is_object() || !merged.is_object()) {
      errors.push_back({"", "document " + std::to_string(d + 1) + " is not an object"});
      continue;
    }
    if (document.value("relative_uncertainty", Json::object()) !=
        merged.value("relative_uncertainty", Json::object()))
      errors.push_back({"/relative_uncertainty",
                        "differs between the files; one factor serves "
                        "all runs, so it must be the same in all"});
    const bool same_rig = document.value("rig", Json()) == merged.value("rig", Json());
    for (Json run : document.value("runs", Json::array())) {
      if (!same_rig && run.is_object()) {
        Json rig = document.value("rig", Json::object());
        rig.merge_patch(run.value("rig", Json::object()));
        run["rig"] = std::move(rig);
      }
      merged["runs"].push_back(std::move(run));
    }
    for (const char* list : {"holdout", "assume", "understood"})
      if (!merged.contains(list) || merged[list].is_array())  // else it is refused when it is read
        for (const Json& one : document.value(list, Json::array())) merged[list].push_back(one);
  }
  if (!errors.empty()) return errors;
  return merged;
}

}  // namespace plenum::api
