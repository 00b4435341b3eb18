#include "api/measure/measured_rig.h"

#include <algorithm>

#include "api/json/remarks.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/measure/rig/several_chambers.h"
#include "api/simulate/group_chamber.h"
#include "api/simulate/rig.h"

namespace plenum::api {
namespace {

using calibration::MeasuredNumber;
using calibration::MeasuredPlace;
using calibration::Supply;

constexpr double kFlowPressurePa = 1e8;      // up to which a flow controller lets its flow in
constexpr double kSensorLowestKpa = -200.0;  // gauge; sensors of absolute pressure begin below 0
constexpr double kNothingPa = 1e-3;          // absolute: a vacuum that simulations can take
constexpr double kSensorErrorMaxKpa = 1e4;
constexpr double kCoarsest = 0.5;           // of the range
constexpr double kSmallReservoirMl = 10.0;  // where a compressor feeds the line directly

using Of = MeasuredPlace::Of;
using MeasuredKind = MeasuredNumber::Kind;

constexpr const char* kRemarks[] = {"note",    "notes",  "comment", "description", "date",
                                    "license", "origin", "url",     "author"};

// What the pump's delivery falls by from each point of its table to the next.
void ReadMeasuredDelivery(Reader& supply, MeasuredRig& rig) {
  const Measure measure = ReadMeasure(supply, {"free_air"});
  const model::MonotoneCurve& curve = rig.compressor.free_air_m3_per_s;
  if (measure.names.empty() || curve.empty()) return;
  if (!(curve.y().front() > 0.0)) supply.Fail("curve", "must deliver something to be measured");
  for (std::size_t i = 0; i < curve.x().size(); ++i) {
    const double next = i + 1 < curve.y().size() ? curve.y()[i + 1] : 0.0;
    rig.measured.push_back({{.part = measure.part,
                             .name = "free_air",
                             .kind = MeasuredKind::kDelivery,
                             .declared = curve.y()[i] - next,
                             .pressure_pa = curve.x()[i]},
                            {}});
  }
}

void ReadMeasuredVolume(Reader& actuator, MeasuredRig& rig) {
  const Measure measure = ReadMeasure(actuator, {"internal_volume"});
  if (measure.names.empty()) return;
  if (rig.chamber.expansion_ratio != 1.0 || !rig.chamber.volume_curve.empty())
    actuator.Fail("expansion_ratio", "must be 1, without another volume, to be measured");
  MeasuredInRig& volume = rig.measured.emplace_back();
  volume.number.part = measure.part;
  volume.number.name = "internal_volume";
  volume.number.kind = MeasuredKind::kVolume;
  volume.number.declared = rig.chamber.rest_volume_m3;
  volume.places.push_back({.of = Of::kVolume});
}

void ReadSupply(Reader& rig, MeasuredRig& part) {
  auto supply = rig.OptionalObject("supply");
  if (!supply) return;
  const std::string kind =
      supply->Choice("kind", {"regulated", "measured", "compressor", "flow", "none"});
  if (kind == "regulated") part.supply = Supply::kRegulated;
  if (kind == "measured") part.supply = Supply::kMeasured;
  if (kind == "flow") {
    part.supply = Supply::kFlow;
    const double flow = M3PerSFromLPerMin(supply->Number("flow_l_per_min_anr", Above(0, 1e6)));
    part.compressor.free_air_m3_per_s = model::MonotoneCurve({0.0, kFlowPressurePa}, {flow, flow});
    part.compressor.pressure_max_pa = kFlowPressurePa;
  }
  if (kind == "compressor") {
    part.supply = Supply::kCompressor;
    part.compressor = ReadPumpCurve(*supply, part.ambient);
    ReadMeasuredDelivery(*supply, part);
    part.reservoir_volume_m3 =
        M3FromMl(supply->Number("reservoir_volume_ml", {1, 1e6}, kSmallReservoirMl));
  }
  if (const auto kpa = supply->OptionalNumber(
          "source_pressure_kpa_gauge",
          kind == "regulated" ? PressuresFrom0(part.ambient) : Range{0, kRigGaugeMaxKpa}))
    part.source_pressure_pa = PaFromKpaGaugeOf(*kpa, part.ambient);
  if (!kind.empty()) supply->Finish();
}

// The gauge in the chamber, from its data sheet.
calibration::Sensor ReadSensor(Reader& rig, const model::Ambient& ambient) {
  calibration::Sensor sensor;
  auto reader = rig.OptionalObject("sensor");
  if (!reader) return sensor;
  if (reader->Has("range_kpa_gauge")) {
    const std::vector<double> ends =
        reader->Numbers("range_kpa_gauge", 2, {kSensorLowestKpa, kRigGaugeMaxKpa});
    if (ends.size() != 2 || !(ends[0] < ends[1])) {
      reader->Fail("range_kpa_gauge", "must be two pressures, the lower one first");
    } else {
      sensor.low_pa = PaFromKpaGauge(ends[0], ambient);
      sensor.high_pa = PaFromKpaGauge(ends[1], ambient);
    }
  }
  const Range small = {0, kSensorErrorMaxKpa};
  sensor.resolution_pa = reader->Number("resolution_kpa", small, 0.0) * kPaPerKpa;
  sensor.accuracy_pa = reader->Number("accuracy_kpa", small, 0.0) * kPaPerKpa;
  if (sensor.HasRange() && sensor.resolution_pa > kCoarsest * (sensor.high_pa - sensor.low_pa))
    reader->Fail("resolution_kpa", "must be less than half of range_kpa_gauge");
  reader->Finish();
  return sensor;
}

MeasuredRig ReadRig(const Json& document, const std::string& pointer, Errors& errors) {
  Reader reader(document, pointer, errors);
  MeasuredRig part;
  AllowRemarks(reader);
  part.ambient = ReadAmbient(reader);
  if (reader.Has("chambers")) {
    part.several = ReadSeveral(reader, part.ambient);
    if (!part.several.empty()) part.chamber = part.several.all[part.several.gauge].chamber;
  } else {
    Reader actuator = reader.Object("actuator");
    AllowRemarks(actuator);
    part.chamber = model::Unmirrored(ReadChamber(actuator, part.ambient, Vacuum::kAllowed));
    ReadMeasuredVolume(actuator, part);
    actuator.Finish();
  }
  if (reader.Has("line")) part.line = ReadPieces(reader.Object("line"), part.measured);
  part.gas = ReadGas(reader);
  ReadSupply(reader, part);
  if (const auto kpa =
          reader.OptionalNumber("exhaust_pressure_kpa_gauge", PressuresFrom0(part.ambient)))
    part.exhaust_pressure_pa = PaFromKpaGaugeOf(*kpa, part.ambient);
  part.sensor = ReadSensor(reader, part.ambient);
  if (!part.several.empty() && !part.measured.empty())
    reader.Fail("chambers", "must not stand in a rig that measures numbers of parts");
  reader.Finish();
  return part;
}

// An error of a merged rig belongs to the shared one if the run's own does not hold the place.
std::string PlaceInShared(const std::string& pointer, const std::string& own_pointer,
                          const Json& own, const Json& shared) {
  const Json::json_pointer path(pointer.substr(own_pointer.size()));
  for (auto at = path; !at.empty(); at = at.parent_pointer()) {
    if (own.contains(at)) return pointer;
    if (shared.contains(at)) return "/rig" + path.to_string();
  }
  return pointer;
}

void AddOnce(Error error, Errors& errors) {
  if (std::find(errors.begin(), errors.end(), error) == errors.end())
    errors.push_back(std::move(error));
}

}  // namespace

Range PressuresFrom0(const model::Ambient& ambient) {
  return {-ambient.pressure_pa / kPaPerKpa, kRigGaugeMaxKpa};
}

double PaFromKpaGaugeOf(double kpa, const model::Ambient& ambient) {
  return std::max(kNothingPa, PaFromKpaGauge(kpa, ambient));
}

void AllowRemarks(Reader& reader) {
  for (const char* remark : kRemarks) reader.Raw(remark);
}

MeasuredRig ReadRigOfRun(const Json& shared, const Json* own, const std::string& own_pointer,
                         Errors& errors) {
  Errors found;
  MeasuredRig part;
  RemarkRecorder recorder;
  if (own == nullptr || !own->is_object() || !shared.is_object()) {
    if (own != nullptr && !own->is_object())
      found.push_back({own_pointer, "must be an object, not " + KindOf(*own)});
    part = ReadRig(shared, "/rig", found);
    recorder.TellOuter([](const std::string& pointer) { return pointer; });
  } else {
    Json merged = shared;
    merged.merge_patch(*own);
    part = ReadRig(merged, own_pointer, found);
    for (Error& error : found)
      error.pointer = PlaceInShared(error.pointer, own_pointer, *own, shared);
    recorder.TellOuter([&](const std::string& pointer) {
      return PlaceInShared(pointer, own_pointer, *own, shared);
    });
  }
  for (Error& error : found) AddOnce(std::move(error), errors);
  return part;
}

}  // namespace plenum::api
