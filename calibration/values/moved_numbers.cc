#include "calibration/values/moved_numbers.h"

#include <algorithm>
#include <span>
#include <variant>

#include "calibration/values/measured_place.h"

namespace plenum::calibration {

std::vector<const double*> NumbersMovedBy(const Run& run, std::size_t number, model::Rig& rig) {
  std::vector<const double*> moved;
  for (const MeasuredPlace& place : run.measured.places)
    if (place.number == number) moved.push_back(&NumberAt(rig, place));
  const auto* reservoir = std::get_if<model::ReservoirSource>(&rig.source);
  const std::vector<std::size_t>& falls = run.measured.delivery;
  const auto at = std::find(falls.begin(), falls.end(), number);
  if (at == falls.end() || reservoir == nullptr) return moved;
  const std::span<const double> delivery = reservoir->compressor.free_air_m3_per_s.y();
  for (const double& flow : delivery.first(static_cast<std::size_t>(at - falls.begin()) + 1))
    moved.push_back(&flow);
  return moved;
}

}  // namespace plenum::calibration
