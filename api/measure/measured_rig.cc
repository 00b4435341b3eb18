#include "api/measure/measured_rig.h"

#include <algorithm>

#include "api/json/remarks.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/simulate/group_chamber.h"
#include "api/simulate/rig.h"

namespace plenum::api {
namespace {

using calibration::LinePiece;
using calibration::Supply;

constexpr std::size_t kElementsMax = 16;
constexpr double kSmallReservoirMl = 10.0;  // where a compressor feeds the line directly

constexpr const char* kRemarks[] = {"note",    "notes",  "comment", "description", "date",
                                    "license", "origin", "url",     "author"};

LinePiece ReadPairs(Reader& reader) {
  LinePiece piece;
  piece.fill = piece.exhaust = ReadPair(reader);
  if (auto exhaust = reader.OptionalObject("exhaust")) {
    piece.exhaust = ReadPair(*exhaust);
    exhaust->Finish();
  }
  return piece;
}

LinePiece ReadTube(Reader tube) {
  LinePiece piece;
  piece.tube = LinePiece::Tube();
  piece.tube->inner_diameter_m = MFromMm(tube.Number("inner_diameter_mm", {0.3, 30}));
  piece.tube->length_m = tube.Number("length_m", TubeLengthRange());
  tube.Finish();
  return piece;
}

std::vector<LinePiece> ReadPieces(Reader line) {
  std::vector<LinePiece> pieces;
  if (line.Has("elements")) {
    for (const Element& element : line.List("elements", 1, kElementsMax)) {
      Reader reader(element, line.errors());
      pieces.push_back(reader.Has("tube") ? ReadTube(reader.Object("tube")) : ReadPairs(reader));
      reader.Finish();
    }
  } else {
    pieces.push_back(ReadPairs(line));
    if (line.Has("tube")) pieces.push_back(ReadTube(line.Object("tube")));
  }
  line.Finish();
  return pieces;
}

void ReadSupply(Reader& rig, MeasuredRig& part) {
  auto supply = rig.OptionalObject("supply");
  if (!supply) return;
  const std::string kind = supply->Choice("kind", {"regulated", "measured", "compressor", "none"});
  if (kind == "regulated") part.supply = Supply::kRegulated;
  if (kind == "measured") part.supply = Supply::kMeasured;
  if (kind == "compressor") {
    part.supply = Supply::kCompressor;
    part.compressor = ReadPumpCurve(*supply, part.ambient);
    part.reservoir_volume_m3 =
        M3FromMl(supply->Number("reservoir_volume_ml", {1, 1e6}, kSmallReservoirMl));
  }
  if (const auto kpa = supply->OptionalNumber("source_pressure_kpa_gauge", {0, kGaugeMaxKpa}))
    part.source_pressure_pa = PaFromKpaGauge(*kpa, part.ambient);
  if (!kind.empty()) supply->Finish();
}

MeasuredRig ReadRig(const Json& document, const std::string& pointer, Errors& errors) {
  Reader reader(document, pointer, errors);
  MeasuredRig part;
  AllowRemarks(reader);
  part.ambient = ReadAmbient(reader);
  Reader actuator = reader.Object("actuator");
  AllowRemarks(actuator);
  part.chamber = ReadChamber(actuator, part.ambient);
  actuator.Finish();
  if (reader.Has("line")) part.line = ReadPieces(reader.Object("line"));
  ReadSupply(reader, part);
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
