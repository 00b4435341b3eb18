#include "model/physics/actuator_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plenum::model {
namespace {

double Disc(double diameter_m) { return std::numbers::pi / 4.0 * diameter_m * diameter_m; }

ActuatorVolumes FlatAtRest(double operating_m3) {
  return {kFlatShare * operating_m3, operating_m3};
}

}  // namespace

ActuatorVolumes CylinderVolumes(double bore_m, double stroke_m, double dead_m3) {
  return {dead_m3, dead_m3 + Disc(bore_m) * stroke_m};
}

ActuatorVolumes RodSideVolumes(double bore_m, double rod_m, double stroke_m, double dead_m3) {
  return {dead_m3, dead_m3 + (Disc(bore_m) - Disc(rod_m)) * stroke_m};
}

ActuatorVolumes MuscleVolumes(double length_m, double diameter_m, double braid_angle_rad,
                              double contraction) {
  const double rest_m3 = Disc(diameter_m) * length_m;
  const double shortened = 1.0 - contraction;
  const double cosine = std::cos(braid_angle_rad), sine = std::sin(braid_angle_rad);
  const double widened = (1.0 - shortened * shortened * cosine * cosine) / (sine * sine);
  return {rest_m3, rest_m3 * shortened * widened};
}

double GreatestContraction(double braid_angle_rad) {
  return 1.0 - 1.0 / (std::numbers::sqrt3 * std::cos(braid_angle_rad));
}

ActuatorVolumes PouchVolumes(double width_m, double length_m) {
  const double w = std::min(width_m, length_m), h = std::max(width_m, length_m);
  const double ends = 0.142 * (1.0 - std::pow(10.0, -h / w));
  return FlatAtRest(w * w * w * (h / (std::numbers::pi * w) - ends));
}

ActuatorVolumes BodyVolumes(double diameter_m, double length_m) {
  return FlatAtRest(Disc(diameter_m) * length_m);
}

}  // namespace plenum::model
