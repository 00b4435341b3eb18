#include "optimizer/evaluate/candidate.h"

#include <algorithm>
#include <cmath>

#include "model/flow/scalar.h"
#include "model/physics/storage.h"

namespace plenum::optimizer {

Window SourceWindow(const Problem& problem, const Candidate& candidate) {
  Window window{std::max(problem.ambient.pressure_pa, candidate.source_floor_pa),
                std::min(problem.source_pressure_max_pa, candidate.source_cap_pa)};
  for (const Line* line : candidate.lines) {
    window.low_pa = std::max(window.low_pa, line->source_min_pa);
    window.high_pa = std::min(window.high_pa, line->source_max_pa);
  }
  if (candidate.regulator.index != kNone) {
    const model::Regulator& regulator = problem.parts.regulators[candidate.regulator.index];
    window.low_pa = std::max(window.low_pa, regulator.outlet_pressure_min_pa);
    window.high_pa = std::min(window.high_pa, regulator.outlet_pressure_max_pa);
  }
  if (candidate.configuration == Configuration::kMains)
    window.high_pa = std::min(window.high_pa, problem.mains.pressure_pa);
  if (candidate.compressor.index != kNone) {
    const model::CompressorCurve& curve =
        problem.parts.compressors[candidate.compressor.index].curve;
    window.high_pa = std::min(window.high_pa, model::HighestPressure(curve));
  }
  if (candidate.reservoir.index >= 0)
    window.high_pa = std::min(window.high_pa,
                              problem.parts.reservoirs[candidate.reservoir.index].pressure_max_pa);
  if (candidate.reservoir.index == kCustom)
    window.high_pa = std::min(window.high_pa, CustomRatingPa(problem));
  return window;
}

double ReservoirVolume(const Problem& problem, const Candidate& candidate) {
  const Option& reservoir = candidate.reservoir;
  return reservoir.index < 0
             ? 0.0
             : reservoir.quantity * problem.parts.reservoirs[reservoir.index].volume_m3;
}

OperatingPoint PointAt(const Problem& problem, const Candidate& candidate, double source_pa,
                       double reservoir_m3) {
  const Option& reservoir = candidate.reservoir;
  const double spread_m3 =
      reservoir.index < 0
          ? 0.0
          : reservoir.quantity * problem.parts.reservoirs[reservoir.index].volume_spread_m3;
  return {source_pa, reservoir_m3, reservoir_m3 + spread_m3};
}

double CustomRatingPa(const Problem& problem) {
  return std::min(problem.source_pressure_max_pa,
                  problem.ambient.pressure_pa + model::kMadeReservoirPressureMaxGaugePa);
}

double LeastSourcePa(const Problem& problem) {
  double least_pa = problem.ambient.pressure_pa;
  for (const ActuatorGroup& group : problem.groups)
    least_pa = std::max(least_pa, group.chamber.operating_pressure_pa);
  return least_pa;
}

Amounts CustomReservoir(const Problem& problem, double volume_m3, double source_pa) {
  const model::MadeReservoir made =
      model::MakeReservoir(volume_m3, std::max(0.0, source_pa - problem.ambient.pressure_pa));
  const double share = problem.guarantee ? problem.guarantee->made_share : 0.0;
  return {made.mass_kg, made.body_volume_m3, 0.0, share * made.mass_kg,
          share * made.body_volume_m3};
}

template <class T>
AmountsOf<T> TotalAmounts(const Problem& problem, const Candidate& candidate,
                          const OperatingPointOf<T>& point) {
  AmountsOf<T> total;
  for (const Line* line : candidate.lines) total += line->amounts;
  for (const Option* option : {&candidate.regulator, &candidate.bottle, &candidate.compressor,
                               &candidate.battery, &candidate.reservoir})
    total += option->amounts;
  if (candidate.reservoir.index != kCustom) return total;
  // Made to measure, all of it is linear in the volume, and its walls in the pressure.
  const double volume_m3 = model::ValueOf(point.reservoir_m3);
  const double source_pa = model::ValueOf(point.source_pa);
  const Amounts made = CustomReservoir(problem, volume_m3, source_pa);
  const Amounts none = CustomReservoir(problem, 0.0, source_pa);
  const auto grown = [&](double here, double fixed) {
    return model::Chain(point.reservoir_m3, here, (here - fixed) / volume_m3);
  };
  AmountsOf<T> reservoir{grown(made.mass_kg, none.mass_kg), grown(made.volume_m3, none.volume_m3)};
  reservoir.mass_kg += volume_m3 * model::kMadeReservoirMassPerM3Pa * (point.source_pa - source_pa);
  const double share = problem.guarantee ? problem.guarantee->made_share : 0.0;
  reservoir.mass_slack_kg = share * reservoir.mass_kg;
  reservoir.volume_slack_m3 = share * reservoir.volume_m3;
  total += reservoir;
  return total;
}

template Amounts TotalAmounts(const Problem&, const Candidate&, const OperatingPoint&);
template AmountsOf<model::Dual> TotalAmounts(const Problem&, const Candidate&,
                                             const OperatingPointOf<model::Dual>&);

}  // namespace plenum::optimizer
