#include "calibration/values/dataset.h"

#include <algorithm>

namespace plenum::calibration {

std::string_view Name(Declared number) {
  static constexpr std::array<std::string_view, kDeclaredCount> kNames = {
      "rest_volume",       "expansion_ratio", "operating_pressure",  "source_pressure",
      "sonic_conductance", "critical_ratio",  "tube_inner_diameter", "reservoir_volume"};
  return kNames[static_cast<std::size_t>(number)];
}

namespace {

// Whether the line has a pair whose number at one of both places is not measured.
bool HasUnmeasured(const Run& run, MeasuredPlace::Of fill, MeasuredPlace::Of exhaust) {
  const auto measures = [&](std::size_t piece, MeasuredPlace::Of of) {
    return std::any_of(
        run.measured.places.begin(), run.measured.places.end(),
        [&](const MeasuredPlace& place) { return place.of == of && place.piece == piece; });
  };
  for (std::size_t i = 0; i < run.line.size(); ++i)
    if (!run.line[i].tube && !(measures(i, fill) && measures(i, exhaust))) return true;
  return false;
}

}  // namespace

bool Has(const Run& run, Declared number) {
  using Of = MeasuredPlace::Of;
  const auto any = [&](bool tube) {
    return std::any_of(run.line.begin(), run.line.end(),
                       [&](const LinePiece& piece) { return piece.tube.has_value() == tube; });
  };
  switch (number) {
    case Declared::kExpansionRatio:
    case Declared::kOperatingPressure:
      return !run.blocked && run.chamber.expansion_ratio > 1.0;
    case Declared::kSourcePressure:
      return run.supply != Supply::kNone;
    case Declared::kSonicConductance:
      return HasUnmeasured(run, Of::kFillConductance, Of::kExhaustConductance);
    case Declared::kCriticalRatio:
      return HasUnmeasured(run, Of::kFillRatio, Of::kExhaustRatio);
    case Declared::kTubeInnerDiameter:
      return any(true);
    case Declared::kReservoirVolume:
      return run.supply == Supply::kCompressor;
    case Declared::kRestVolume:
      break;
  }
  return std::none_of(run.measured.places.begin(), run.measured.places.end(),
                      [](const MeasuredPlace& place) { return place.of == Of::kVolume; });
}

}  // namespace plenum::calibration
