#include "calibration/values/measured_place.h"

#include <utility>
#include <variant>

namespace plenum::calibration {

double& NumberAt(model::Rig& rig, const MeasuredPlace& place) {
  model::GroupRig& group = rig.groups.front();
  const auto fill = [&]() -> model::FlowElement& { return group.fill[place.piece]; };
  const auto exhaust = [&]() -> model::FlowElement& {
    return group.exhaust[group.exhaust.size() - 1 - place.piece];
  };
  switch (place.of) {
    case MeasuredPlace::Of::kFillConductance:
      return fill().sonic_conductance_m3_per_s_pa;
    case MeasuredPlace::Of::kFillRatio:
      return fill().critical_ratio;
    case MeasuredPlace::Of::kExhaustConductance:
      return exhaust().sonic_conductance_m3_per_s_pa;
    case MeasuredPlace::Of::kExhaustRatio:
      return exhaust().critical_ratio;
    case MeasuredPlace::Of::kVolume:
      break;
  }
  return group.chamber.rest_volume_m3;
}

std::vector<double> DeliveryOfFalls(std::span<const double> falls) {
  std::vector<double> delivery(falls.begin(), falls.end());
  for (std::size_t i = delivery.size(); i-- > 1;) delivery[i - 1] += delivery[i];
  return delivery;
}

std::vector<double> ValuesOf(const Dataset& dataset, const std::vector<double>& measured) {
  std::vector<double> values = measured;
  for (std::size_t i = values.size(); i-- > 1;) {
    const MeasuredNumber &here = dataset.measured[i], &before = dataset.measured[i - 1];
    const bool one_pump = here.kind == MeasuredNumber::Kind::kDelivery &&
                          before.kind == here.kind && before.part == here.part;
    if (one_pump) values[i - 1] += values[i];
  }
  return values;
}

void PutMeasured(const Run& run, const std::vector<double>& measured, model::Rig& rig) {
  for (const MeasuredPlace& place : run.measured.places)
    NumberAt(rig, place) = measured[place.number];
  auto* reservoir = std::get_if<model::ReservoirSource>(&rig.source);
  if (run.measured.delivery.empty() || reservoir == nullptr) return;
  std::vector<double> falls;
  falls.reserve(run.measured.delivery.size());
  for (const std::size_t number : run.measured.delivery) falls.push_back(measured[number]);
  const std::span<const double> pressure_pa = reservoir->compressor.free_air_m3_per_s.x();
  reservoir->compressor.free_air_m3_per_s =
      model::MonotoneCurve({pressure_pa.begin(), pressure_pa.end()}, DeliveryOfFalls(falls));
}

}  // namespace plenum::calibration
