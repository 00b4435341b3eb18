#include "optimizer/bounds/refill_bound.h"

#include <algorithm>

#include "model/strokes/refill.h"
#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {
namespace {

constexpr double kRounding = 1.0 + 1e-6;  // with room for the error of RefillTank()

double FillPa(const TankAt& at) { return std::min(at.tank.fill_max_pa, at.fill_max_pa); }

double CapacityM3PerPa(const TankAt& at) {
  return model::StandardVolume(at.tank.water_m3, at.problem.ambient.temperature_k);
}

void Narrow(const TankAt& at, double cycle_m3, double kept_pa, const Option& chosen,
            Refilling& refilling) {
  const Problem& problem = at.problem;
  const model::Compressor& pump = PumpsOf(problem, Configuration::kTankAndPump)[chosen.index];
  const double seconds = (problem.actuations - 1.0) / problem.frequency_hz / kRounding;
  const model::RefillInput input{.compressor = &pump.curve,
                                 .compressors = chosen.quantity,
                                 .duty = pump.duty_max,
                                 .capacity_m3_per_pa = CapacityM3PerPa(at),
                                 .fill_pa = FillPa(at),
                                 .kept_pa = kept_pa,
                                 .draw_m3_per_s = cycle_m3 * problem.frequency_hz,
                                 .seconds = seconds};
  refilling.works = model::LastingSeconds(input) * kRounding >= seconds;
  if (!refilling.works) return;
  const model::Refill refill = model::RefillTank(input);
  refilling.energy_j = std::max(refilling.energy_j, refill.energy_j / kRounding);
  refilling.current_a =
      chosen.quantity *
      model::LargestCurrent(pump.curve, problem.ambient.pressure_pa, refill.stop_pa / kRounding);
}

}  // namespace

double GivenM3(const TankAt& at) { return CapacityM3PerPa(at) * (FillPa(at) - at.inlet_pa); }

bool Gives(const TankAt& at, double air_m3, double open_m3) {
  const TankAt open{at.problem, at.tank, at.fill_max_pa, LeastSourcePa(at.problem)};
  return GivenM3(at) >= air_m3 && GivenM3(open) >= open_m3;
}

double LeftM3(const TankAt& at) {
  return CapacityM3PerPa(at) * (at.inlet_pa - LeastSourcePa(at.problem)) / kRounding;
}

double LeftPa(const TankAt& at, double air_m3) {
  return (FillPa(at) - air_m3 / CapacityM3PerPa(at)) * kRounding;
}

Refilling LeastRefilling(const TankAt& at, double cycle_m3, const CompressorCorner& pumps,
                         const PumpRates& rates, const Option* chosen) {
  const Problem& problem = at.problem;
  const double kept_pa = at.inlet_pa + cycle_m3 / CapacityM3PerPa(at);
  const PerAir per_air = rates.At(kept_pa);
  const double seconds = (problem.actuations - 1.0) / problem.frequency_hz;
  Refilling refilling;
  if (kept_pa <= pumps.pressure_max_pa * kRounding)
    refilling.most_m3 = pumps.duty_max * seconds / per_air.seconds * kRounding;
  const double lacking_m3 = problem.actuations * cycle_m3 - GivenM3(at);
  refilling.energy_j = std::max(0.0, lacking_m3) * per_air.energy_j;
  refilling.current_a = rates.CurrentAt(kept_pa);
  if (chosen != nullptr) Narrow(at, cycle_m3, kept_pa, *chosen, refilling);
  return refilling;
}

}  // namespace plenum::optimizer
