#include "calibration/values/dataset.h"

#include <algorithm>

namespace plenum::calibration {

std::string_view Name(Declared number) {
  static constexpr std::array<std::string_view, kDeclaredCount> kNames = {
      "rest_volume",       "expansion_ratio", "operating_pressure",  "source_pressure",
      "sonic_conductance", "critical_ratio",  "tube_inner_diameter", "reservoir_volume"};
  return kNames[static_cast<std::size_t>(number)];
}

bool Has(const Run& run, Declared number) {
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
    case Declared::kCriticalRatio:
      return any(false);
    case Declared::kTubeInnerDiameter:
      return any(true);
    case Declared::kReservoirVolume:
      return run.supply == Supply::kCompressor;
    case Declared::kRestVolume:
      break;
  }
  return true;
}

}  // namespace plenum::calibration
