#include "calibration/values/dataset.h"

namespace plenum::calibration {

std::string_view Name(Declared number) {
  static constexpr std::array<std::string_view, kDeclaredCount> kNames = {
      "rest_volume",       "expansion_ratio", "operating_pressure",  "source_pressure",
      "sonic_conductance", "critical_ratio",  "tube_inner_diameter", "reservoir_volume"};
  return kNames[static_cast<std::size_t>(number)];
}

}  // namespace plenum::calibration
