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
                                             : run.chamber.operating_pressure_pa - ambient_pa;
    const auto raise = [&](Declared number, double share) {
      double& uncertainty = dataset.relative_uncertainty[static_cast<std::size_t>(number)];
      uncertainty = std::max(uncertainty, share);
    };
    raise(Declared::kSensorZero, sensor.accuracy_pa / calibration::kSensorZeroPa);
    raise(Declared::kSensorGain, sensor.accuracy_pa / full_pa);
  }
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
    document.FailAt("runs/" + std::to_string(i) + "/pressure_kpa_gauge/" +
                        std::to_string(off - run.pressure_pa.begin()),
                    "is " + kpa(*off) + " kPa, beyond the sensor's range_kpa_gauge of " +
                        kpa(sensor.low_pa) + " to " + kpa(sensor.high_pa));
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
  reader.Schema("measurement/1");
  dataset.name = reader.Text("name", "measurement");
  static const Json kNoRig = Json::object();
  const Json* shared = reader.Has("rig") ? reader.Raw("rig") : &kNoRig;
  ReadUncertainty(reader, dataset);
  std::set<std::string> ids;
  for (const Element& element : reader.List("runs", 1, kRunsMax))
    dataset.runs.push_back(ReadRun(element, *shared, ids, dataset, errors));
  TakeSpecimens(reader, dataset);
  CheckDelivery(reader, dataset);
  dataset.holdout = reader.Texts("holdout", 0, kRunsMax);
  CheckHoldout(reader, ids, dataset);
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
