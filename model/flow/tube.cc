#include "model/flow/tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plenum::model {

FlowElement TubeElement(double inner_diameter_m, double length_m) {
  const double square = inner_diameter_m * inner_diameter_m;
  FlowElement tube;
  tube.sonic_conductance_m3_per_s_pa =
      0.029 * square / std::sqrt(length_m / std::pow(inner_diameter_m, 1.25) + 510.0);
  tube.critical_ratio = std::clamp(474.0 * tube.sonic_conductance_m3_per_s_pa / square, 0.0, 0.528);
  return tube;
}

double BoreVolume(double inner_diameter_m, double length_m) {
  return std::numbers::pi / 4.0 * inner_diameter_m * inner_diameter_m * length_m;
}

}  // namespace plenum::model
