#include "optimizer/evaluate/refilled_tank.h"

#include <algorithm>

#include "model/physics/storage.h"
#include "optimizer/evaluate/root.h"

namespace plenum::optimizer {
namespace {

constexpr double kTolerance = 1e-9;        // of the fill
constexpr double kAboveKept = 1.0 + 1e-4;  // a fill that is just what is kept decides nothing

double StopCurrent(const Problem& problem, const Candidate& candidate, double stop_pa) {
  return candidate.compressor.quantity * model::LargestCurrent(ChosenPump(problem, candidate).curve,
                                                               problem.ambient.pressure_pa,
                                                               stop_pa);
}

double CapacityM3PerPa(const Problem& problem, const Candidate& candidate) {
  return model::StandardVolume(TankVolume(problem, candidate), problem.ambient.temperature_k);
}

// Objective that the next pascal of the fill saves by the energy of pumps, less what its air
// weighs.
double WorthPerPa(const Problem& problem, const Candidate& candidate, double stop_pa) {
  const model::CompressorCurve& curve = ChosenPump(problem, candidate).curve;
  const double flow_m3_per_s = model::FreeAirDelivery(curve, stop_pa);
  const double power_w =
      curve.voltage_v * model::LargestCurrent(curve, problem.ambient.pressure_pa, stop_pa);
  const double saved = problem.objective.energy_wh / kJoulePerWattHour * power_w / flow_m3_per_s;
  const double weight = problem.objective.mass_kg * model::kReferenceDensityKgPerM3;
  return CapacityM3PerPa(problem, candidate) * (saved - weight);
}

}  // namespace

bool RefillsTank(const Candidate& candidate) {
  return candidate.configuration == Configuration::kTankAndPump &&
         candidate.compressor.index != kNone && candidate.bottle.index != kNone;
}

model::Refill RefillOf(const Problem& problem, const Candidate& candidate,
                       const OperatingPoint& point, double air_per_cycle_m3) {
  const model::Compressor& pump = ChosenPump(problem, candidate);
  model::RefillInput input;
  input.compressor = &pump.curve;
  input.compressors = candidate.compressor.quantity;
  input.duty = pump.duty_max;
  input.capacity_m3_per_pa = CapacityM3PerPa(problem, candidate);
  input.fill_pa = point.tank_fill_pa;
  input.kept_pa = TankInletPa(problem, candidate, point.source_pa) +
                  TankFallPa(problem, candidate, air_per_cycle_m3);
  input.draw_m3_per_s = air_per_cycle_m3 * problem.frequency_hz;
  input.seconds = (problem.actuations - 1.0) / problem.frequency_hz;
  input.stop_pa = point.pump_stop_pa;
  return model::RefillTank(input);
}

double BestFillPa(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                  const AtHighestFill& at_highest) {
  OperatingPoint filled = point;
  filled.tank_fill_pa = TankFillMaxPa(problem, candidate);
  const double highest_pa = filled.tank_fill_pa;
  const double seconds = (problem.actuations - 1.0) / problem.frequency_hz;
  const double air_m3 = at_highest.air_per_cycle_m3;
  const model::Refill most = RefillOf(problem, candidate, filled, air_m3);
  const double other_j = at_highest.energy_total_j - most.energy_j;
  const double other_a =
      at_highest.battery_current_a - StopCurrent(problem, candidate, most.stop_pa);
  const double current_max_a =
      candidate.battery.index == kNone
          ? kUnlimited
          : candidate.battery.quantity *
                problem.parts.batteries[candidate.battery.index].current_max_a;
  // > 0: more is wanted. Does not rise with the fill.
  const auto excess = [&](double fill_pa) {
    filled.tank_fill_pa = fill_pa;
    const model::Refill refill = RefillOf(problem, candidate, filled, air_m3);
    const double lacking = std::max(
        {seconds - refill.lasts_s, other_j + refill.energy_j - at_highest.energy_available_j,
         other_a + StopCurrent(problem, candidate, refill.stop_pa) - current_max_a});
    if (lacking > 0.0 || problem.objective.energy_wh == 0.0 || refill.on_s == 0.0) return lacking;
    return std::max(lacking, WorthPerPa(problem, candidate, refill.stop_pa));
  };
  if (excess(highest_pa) > 0.0) return highest_pa;
  const double low_pa = kAboveKept * (TankInletPa(problem, candidate, point.source_pa) +
                                      TankFallPa(problem, candidate, air_m3));
  const double fill_pa =
      SmallestFeasible(excess, std::min(low_pa, highest_pa), highest_pa, kTolerance);
  return std::min(highest_pa, fill_pa * (1.0 + kTolerance));
}

}  // namespace plenum::optimizer
