#include "optimizer/evaluate/source_options.h"

#include "model/physics/storage.h"
#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {
namespace {

// Of a candidate that may be const.
template <class Candidates>
auto& PlaceOf(Candidates& candidate, Family family) {
  switch (family) {
    case Family::kVacuumPump:
      return IsVacuum(candidate.configuration) ? candidate.compressor : candidate.rail.pump;
    case Family::kVacuumReservoir:
      return candidate.rail.reservoir;
    case Family::kCompressor:
    case Family::kEjector:
      return candidate.compressor;
    case Family::kBattery:
      return candidate.battery;
    case Family::kRegulator:
      return candidate.regulator;
    case Family::kReservoir:
      return candidate.reservoir;
    default:
      return candidate.bottle;
  }
}

}  // namespace

Option& OptionOf(Candidate& candidate, Family family) { return PlaceOf(candidate, family); }
const Option& OptionOf(const Candidate& candidate, Family family) {
  return PlaceOf(candidate, family);
}

double ChargeKg(const Problem& problem, Family family, int part) {
  if (family == Family::kCylinder) {
    const model::Cylinder& cylinder = problem.parts.cylinders[part];
    return model::CylinderCharge(cylinder.water_volume_m3, cylinder.fill_pressure_pa,
                                 problem.ambient.temperature_k);
  }
  if (family == Family::kTank) return LeastTankCharge(problem, part);
  return family == Family::kCo2 ? problem.parts.co2[part].co2_mass_kg : 0.0;
}

}  // namespace plenum::optimizer
