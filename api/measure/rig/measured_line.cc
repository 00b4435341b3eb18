#include "api/measure/rig/measured_line.h"

#include <algorithm>

#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/simulate/rig.h"

namespace plenum::api {
namespace {

using calibration::LinePiece;
using Of = calibration::MeasuredPlace::Of;
using MeasuredKind = calibration::MeasuredNumber::Kind;

constexpr std::size_t kElementsMax = 16;

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

struct PairNumber {
  const char* name;
  MeasuredKind kind;
  std::vector<Of> places;
};

// Of an element with one pair for both directions, and of one with a pair for each.
const std::vector<PairNumber>& PairNumbers(bool directed) {
  static const std::vector<PairNumber> kBoth = {
      {"sonic_conductance",
       MeasuredKind::kConductance,
       {Of::kFillConductance, Of::kExhaustConductance}},
      {"critical_ratio", MeasuredKind::kRatio, {Of::kFillRatio, Of::kExhaustRatio}}};
  static const std::vector<PairNumber> kDirected = {
      {"sonic_conductance_fill", MeasuredKind::kConductance, {Of::kFillConductance}},
      {"critical_ratio_fill", MeasuredKind::kRatio, {Of::kFillRatio}},
      {"sonic_conductance_exhaust", MeasuredKind::kConductance, {Of::kExhaustConductance}},
      {"critical_ratio_exhaust", MeasuredKind::kRatio, {Of::kExhaustRatio}}};
  return directed ? kDirected : kBoth;
}

double DeclaredAt(const LinePiece& piece, Of of) {
  const bool fill = of == Of::kFillConductance || of == Of::kFillRatio;
  const model::FlowElement& pair = fill ? piece.fill : piece.exhaust;
  return of == Of::kFillConductance || of == Of::kExhaustConductance
             ? pair.sonic_conductance_m3_per_s_pa
             : pair.critical_ratio;
}

void ReadMeasuredPair(Reader& reader, const LinePiece& piece, std::size_t at,
                      std::vector<MeasuredInRig>& measured) {
  const std::vector<PairNumber>& numbers = PairNumbers(reader.Has("exhaust"));
  std::vector<std::string> allowed;
  allowed.reserve(numbers.size());
  for (const PairNumber& number : numbers) allowed.emplace_back(number.name);
  const Measure measure = ReadMeasure(reader, allowed);
  for (const PairNumber& number : numbers) {
    if (std::count(measure.names.begin(), measure.names.end(), number.name) == 0) continue;
    MeasuredInRig& in_rig = measured.emplace_back();
    in_rig.number = {.part = measure.part,
                     .name = number.name,
                     .kind = number.kind,
                     .declared = DeclaredAt(piece, number.places.front())};
    for (const Of of : number.places) in_rig.places.push_back({.of = of, .piece = at});
  }
}

}  // namespace

Measure ReadMeasure(Reader& reader, const std::vector<std::string>& allowed) {
  Measure measure;
  measure.part = reader.Text("part", "");
  if (!reader.Has("measure")) return measure;
  measure.names = reader.Texts("measure", 1, allowed.size());
  if (measure.part.empty()) reader.Fail("part", "is required with measure: the id of the part");
  for (std::size_t i = 0; i < measure.names.size(); ++i)
    if (std::find(allowed.begin(), allowed.end(), measure.names[i]) == allowed.end())
      reader.FailAt("measure/" + std::to_string(i),
                    "must be " + OneOf(allowed) + ", not " + Quoted(measure.names[i]));
  return measure;
}

std::vector<LinePiece> ReadPieces(Reader line, std::vector<MeasuredInRig>& measured) {
  std::vector<LinePiece> pieces;
  if (line.Has("elements")) {
    for (const Element& element : line.List("elements", 1, kElementsMax)) {
      Reader reader(element, line.errors());
      if (reader.Has("tube")) {
        pieces.push_back(ReadTube(reader.Object("tube")));
      } else {
        pieces.push_back(ReadPairs(reader));
        ReadMeasuredPair(reader, pieces.back(), pieces.size() - 1, measured);
      }
      reader.Finish();
    }
  } else {
    pieces.push_back(ReadPairs(line));
    if (line.Has("tube")) pieces.push_back(ReadTube(line.Object("tube")));
  }
  line.Finish();
  return pieces;
}

}  // namespace plenum::api
