#include "optimizer/evaluate/source_options.h"

#include "model/physics/storage.h"
#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {
namespace {

Option Candidate::*PlaceOf(Configuration configuration, Family family) {
  switch (family) {
    case Family::kVacuumPump:
      return IsVacuum(configuration) ? &Candidate::compressor : &Candidate::rail_pump;
    case Family::kVacuumReservoir:
      return &Candidate::rail_reservoir;
    case Family::kCompressor:
    case Family::kEjector:
      return &Candidate::compressor;
    case Family::kBattery:
      return &Candidate::battery;
    case Family::kRegulator:
      return &Candidate::regulator;
    case Family::kReservoir:
      return &Candidate::reservoir;
    default:
      return &Candidate::bottle;
  }
}

}  // namespace

Option& OptionOf(Candidate& candidate, Family family) {
  return candidate.*PlaceOf(candidate.configuration, family);
}
const Option& OptionOf(const Candidate& candidate, Family family) {
  return candidate.*PlaceOf(candidate.configuration, family);
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
