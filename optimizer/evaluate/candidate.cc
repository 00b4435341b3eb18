#include "optimizer/evaluate/candidate.h"

#include <algorithm>
#include <cmath>

#include "model/flow/scalar.h"
#include "model/physics/storage.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

// Whether valves keep what pumps without a reservoir gave, and switch without pressure.
bool SuitDirectPumps(const Problem& problem, const Candidate& candidate) {
  return std::all_of(candidate.lines.begin(), candidate.lines.end(), [&](const Line* line) {
    return line->holds &&
           problem.parts.valves[line->valve].pressure_min_pa <= problem.ambient.pressure_pa;
  });
}

Window WindowOfRegulator(const Problem& problem, const Option& option, Window window) {
  if (option.index == kNone) return window;
  const model::Regulator& regulator = problem.parts.regulators[option.index];
  return {std::max(window.low_pa, regulator.outlet_pressure_min_pa),
          std::min(window.high_pa, regulator.outlet_pressure_max_pa)};
}

// The highest of the pressures of all groups.
Window HighestOfGroups(const Problem& problem, const Candidate& candidate) {
  Window highest{candidate.source_floor_pa, 0.0};
  for (int g = 0; g < static_cast<int>(candidate.lines.size()); ++g) {
    const Window window = GroupWindow(problem, candidate, g);
    if (window.empty()) return {kUnlimited, 0.0};
    highest.low_pa = std::max(highest.low_pa, window.low_pa);
    highest.high_pa = std::max(highest.high_pa, window.high_pa);
  }
  highest.high_pa = std::min(highest.high_pa, candidate.source_cap_pa);
  return highest;
}

// Room for rounding where a fill is just enough: relative, of what the tank gives.
constexpr double kRoom = 1.0 + 1e-9;

}  // namespace

bool AllHold(const Candidate& candidate) {
  return std::all_of(candidate.lines.begin(), candidate.lines.end(),
                     [](const Line* line) { return line->holds; });
}

std::vector<const model::Regulator*> RegulatorsOf(const Problem& problem,
                                                  const Candidate& candidate) {
  std::vector<const model::Regulator*> regulators;
  const auto add = [&](const Option& option) {
    if (option.index != kNone) regulators.push_back(&problem.parts.regulators[option.index]);
  };
  add(candidate.regulator);
  for (const Option& own : candidate.own_regulators) add(own);
  return regulators;
}

double InletMinPa(const Problem& problem, const Candidate& candidate) {
  double least_pa = 0.0;
  for (const model::Regulator* regulator : RegulatorsOf(problem, candidate))
    least_pa = std::max(least_pa, regulator->inlet_pressure_min_pa);
  return least_pa;
}

double InletMaxPa(const Problem& problem, const Candidate& candidate) {
  double most_pa = kUnlimited;
  for (const model::Regulator* regulator : RegulatorsOf(problem, candidate))
    most_pa = std::min(most_pa, regulator->inlet_pressure_max_pa);
  return most_pa;
}

Window GroupWindow(const Problem& problem, const Candidate& candidate, int g) {
  const Line& line = *candidate.lines[g];
  Window window{std::max(problem.ambient.pressure_pa, line.source_min_pa),
                std::min(problem.source_pressure_max_pa, line.source_max_pa)};
  if (candidate.configuration == Configuration::kMains)
    window.high_pa = std::min(window.high_pa, problem.mains.pressure_pa);
  return WindowOfRegulator(problem, RegulatorOf(candidate, g), window);
}

Window SourceWindow(const Problem& problem, const Candidate& candidate) {
  if (HasOwnRegulators(candidate)) return HighestOfGroups(problem, candidate);
  Window window{std::max(problem.ambient.pressure_pa, candidate.source_floor_pa),
                std::min(problem.source_pressure_max_pa, candidate.source_cap_pa)};
  for (const Line* line : candidate.lines) {
    window.low_pa = std::max(window.low_pa, line->source_min_pa);
    window.high_pa = std::min(window.high_pa, line->source_max_pa);
  }
  window = WindowOfRegulator(problem, candidate.regulator, window);
  if (IsOpenTank(candidate) && candidate.bottle.index != kNone) {
    if (!AllHold(candidate)) return {kUnlimited, 0.0};
    window.low_pa = std::max(window.low_pa, LeastOpenFillPa(problem, candidate));
    window.high_pa = std::min(window.high_pa, TankFillMaxPa(problem, candidate));
  }
  if (IsDirect(candidate.configuration)) {
    if (FeedsMeet(problem) || !SuitDirectPumps(problem, candidate)) return {kUnlimited, 0.0};
  }
  if (candidate.configuration == Configuration::kMains)
    window.high_pa = std::min(window.high_pa, problem.mains.pressure_pa);
  if (candidate.compressor.index != kNone && IsPumped(candidate.configuration)) {
    const model::CompressorCurve& curve = ChosenPump(problem, candidate).curve;
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
  if (HasTank(candidate.configuration)) return TankVolume(problem, candidate);
  const Option& reservoir = candidate.reservoir;
  return reservoir.index < 0
             ? 0.0
             : reservoir.quantity * problem.parts.reservoirs[reservoir.index].volume_m3;
}

OperatingPoint PointAt(const Problem& problem, const Candidate& candidate, double source_pa,
                       double reservoir_m3) {
  if (HasOwnRegulators(candidate)) {
    OperatingPoint point{source_pa, reservoir_m3, reservoir_m3};
    for (int g = 0; g < static_cast<int>(candidate.lines.size()); ++g) {
      const Window window = GroupWindow(problem, candidate, g);
      point.group_pa.push_back(std::max(window.low_pa, std::min(source_pa, window.high_pa)));
    }
    return point;
  }
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
  for (const Option* option :
       {&candidate.regulator, &candidate.bottle, &candidate.compressor, &candidate.battery,
        &candidate.reservoir, &candidate.rail.pump, &candidate.rail.reservoir})
    total += option->amounts;
  for (const Option& own : candidate.own_regulators) total += own.amounts;
  total.cost_eur += candidate.pack_surplus_eur;
  if (point.tank_fill_pa > 0.0)
    total.mass_kg += ChargeBeyondLeast(problem, candidate, point.tank_fill_pa);
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

model::PumpStroke DirectStroke(const Problem& problem, const Candidate& candidate, int g,
                               int count) {
  const Line& line = *candidate.lines[g];
  const model::Series fill = model::MakeSeries(line.fill, FlowFactor(problem, model::Gas::kAir));
  model::PumpStrokeInput input;
  input.fill = &fill;
  input.chamber = &line.chamber;
  input.count = count;
  input.compressor = &ChosenPump(problem, candidate).curve;
  input.compressors = candidate.compressor.quantity;
  input.from_pa = problem.ambient.pressure_pa;
  input.target_pa = RiseTarget(problem, problem.groups[g]);
  input.operating_pa = line.chamber.operating_pressure_pa;
  input.temperature_k = problem.ambient.temperature_k;
  return model::FillFromPumps(input);
}

double HoldingEnergy(const Problem& problem, const Candidate& candidate, const FedSquad& fed,
                     double filling_s) {
  const double held_s = fed.Seconds(PumpsHoldOn(problem), filling_s) - filling_s;
  return held_s * candidate.compressor.quantity *
         model::ElectricalPower(ChosenPump(problem, candidate).curve,
                                problem.groups[fed.squad.group].chamber.operating_pressure_pa);
}

OperatingPoint DirectPoint(const Problem& problem, const Candidate& candidate) {
  OperatingPoint point{problem.ambient.pressure_pa};
  for (const FedSquad& fed : FedSquadsOf(problem)) {
    const model::PumpStroke stroke = DirectStroke(problem, candidate, fed.squad.group, fed.count);
    point.source_pa = std::max(point.source_pa, stroke.reached ? stroke.node_end_pa : kUnlimited);
  }
  return point;
}

bool IsOpenTank(const Candidate& candidate) {
  return candidate.configuration == Configuration::kTank && candidate.regulator.index == kNone &&
         !HasOwnRegulators(candidate);
}

double TankVolume(const Problem& problem, const Candidate& candidate) {
  const Option& tank = candidate.bottle;
  if (!HasTank(candidate.configuration) || tank.index == kNone) return 0.0;
  return tank.quantity * problem.parts.tanks[tank.index].volume_m3;
}

double TankRatingPa(const Problem& problem, int part) {
  return std::min(problem.tank_fill_max_pa, problem.parts.tanks[part].pressure_max_pa);
}

double HighestTankPa(const Problem& problem) {
  double highest_pa = 0.0;
  for (int i = 0; i < static_cast<int>(problem.parts.tanks.size()); ++i)
    highest_pa = std::max(highest_pa, TankRatingPa(problem, i));
  return highest_pa;
}

double TankFillMaxPa(const Problem& problem, const Candidate& candidate) {
  return std::min(TankRatingPa(problem, candidate.bottle.index), InletMaxPa(problem, candidate));
}

double TankFallPa(const Problem& problem, const Candidate& candidate, double air_m3) {
  return air_m3 /
         model::StandardVolume(TankVolume(problem, candidate), problem.ambient.temperature_k);
}

double TankAir(const Problem& problem, const Candidate& candidate, double from_pa, double to_pa) {
  return model::StandardVolume(TankVolume(problem, candidate) * std::max(0.0, from_pa - to_pa),
                               problem.ambient.temperature_k);
}

double AirPerCycle(const Problem& problem, const Candidate& candidate) {
  double air_m3 = 0.0;
  for (int g = 0; g < static_cast<int>(candidate.lines.size()); ++g)
    air_m3 += problem.groups[g].gait.strokes_per_period *
              LeastAirPerStroke(problem, g, *candidate.lines[g]);
  return air_m3;
}

double KeptPa(const Problem& problem, const Candidate& candidate) {
  double kept_pa = LeastSourcePa(problem);
  for (const Line* line : candidate.lines)
    kept_pa = std::max(kept_pa, problem.parts.valves[line->valve].pressure_min_pa);
  return kept_pa;
}

double LeastOpenFillPa(const Problem& problem, const Candidate& candidate) {
  return KeptPa(problem, candidate) +
         kRoom *
             TankFallPa(problem, candidate, problem.actuations * AirPerCycle(problem, candidate));
}

double LastPeriodPa(const Problem& problem, const Candidate& candidate, double fill_pa) {
  return fill_pa - TankFallPa(problem, candidate,
                              (problem.actuations - 1.0) * AirPerCycle(problem, candidate));
}

double TankInletPa(const Problem& problem, const Candidate& candidate, double source_pa) {
  if (IsOpenTank(candidate)) return KeptPa(problem, candidate);
  return std::max(source_pa, InletMinPa(problem, candidate));
}

double FillForPa(const Problem& problem, const Candidate& candidate, double inlet_pa,
                 double air_m3) {
  return std::min(TankFillMaxPa(problem, candidate),
                  inlet_pa + kRoom * TankFallPa(problem, candidate, air_m3));
}

double LeastTankCharge(const Problem& problem, int part) {
  return model::TankCharge(problem.parts.tanks[part].volume_m3, LeastSourcePa(problem),
                           problem.ambient.temperature_k);
}

double ChargeBeyondLeast(const Problem& problem, const Candidate& candidate, double fill_pa) {
  return model::TankCharge(TankVolume(problem, candidate), fill_pa - LeastSourcePa(problem),
                           problem.ambient.temperature_k);
}

}  // namespace plenum::optimizer
