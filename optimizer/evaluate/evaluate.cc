#include "optimizer/evaluate/evaluate.h"

#include <algorithm>
#include <cmath>

#include "model/flow/scalar.h"
#include "model/physics/storage.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/refilled_tank.h"
#include "optimizer/evaluate/strokes/effect_strokes.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

constexpr double kDutyRounding = 1.0 + 1e-9;

// Gas on board that reaches the regulator's outlet, m³ ANR.
double AirAvailable(const Problem& problem, const Candidate& candidate, double source_pa) {
  if (candidate.bottle.index == kNone) return kUnlimited;  // wall supply, or not chosen yet
  const double temperature_k = problem.ambient.temperature_k;
  const int quantity = candidate.bottle.quantity;
  const double inlet_pa = std::max(source_pa, InletMinPa(problem, candidate));
  if (candidate.configuration == Configuration::kCylinder) {
    const model::Cylinder& cylinder = problem.parts.cylinders[candidate.bottle.index];
    return quantity * model::CylinderUsableVolume(cylinder.water_volume_m3,
                                                  cylinder.fill_pressure_pa, inlet_pa,
                                                  temperature_k);
  }
  if (candidate.configuration == Configuration::kCo2) {
    const model::Co2Bottle& bottle = problem.parts.co2[candidate.bottle.index];
    return quantity * model::Co2UsableVolume(bottle.co2_mass_kg, bottle.water_volume_m3, inlet_pa,
                                             temperature_k);
  }
  return kUnlimited;
}

// Highest frequency at which each stroke ends within its window.
template <class T>
T StrokeFrequency(const Problem& problem, const EvaluationOf<T>& evaluation) {
  T highest = T(kUnlimited);
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const auto& [inflating, strokes] =
        std::pair{problem.groups[g].gait.inflate_fraction,
                  static_cast<double>(problem.groups[g].gait.strokes_per_period)};
    const GroupPerformanceOf<T>& group = evaluation.groups[g];
    highest = std::min({highest, T(inflating / strokes / group.inflate_time_s),
                        T((1.0 - inflating) / strokes / group.fall_time_s)});
  }
  return highest;
}

// The same of pumps without a reservoir, where each ends within its turn.
template <class T>
T TurnFrequency(const Problem& problem, const EvaluationOf<T>& evaluation) {
  T highest = T(kUnlimited);
  for (const FedSquad& fed : FedSquadsOf(problem))
    highest = std::min(highest, T(fed.turn_s * problem.frequency_hz /
                                  evaluation.groups[fed.squad.group].inflate_time_s));
  return highest;
}

// Highest frequency that the source sustains, by thermal duty, by evaporation or by turns.
template <class T>
T SourceFrequency(const Problem& problem, const Candidate& candidate,
                  const EvaluationOf<T>& evaluation) {
  if (IsPumped(candidate.configuration)) {
    const double duty_max = ChosenPump(problem, candidate).duty_max;
    T by_duty = problem.frequency_hz * duty_max / evaluation.compressor_duty;
    if (KeepsReservoir(candidate.configuration)) return by_duty;
    // Pumps that hold on run for the same share of each period, however long it is.
    if (PumpsHoldOn(problem) &&
        model::ValueOf(evaluation.compressor_duty) <= duty_max * kDutyRounding)
      by_duty = T(kUnlimited);
    return std::min(by_duty, TurnFrequency(problem, evaluation));
  }
  if (candidate.configuration == Configuration::kCo2 && candidate.bottle.index != kNone)
    return candidate.bottle.quantity *
           problem.parts.co2[candidate.bottle.index].flow_sustained_m3_per_s /
           evaluation.air_per_cycle_m3;
  return T(kUnlimited);
}

// The same that the pumps of a vacuum beside the source sustain.
template <class T>
T RailFrequency(const Problem& problem, const Candidate& candidate,
                const EvaluationOf<T>& evaluation) {
  const RailSource source = RailSourceOf(problem, candidate);
  if (!source.curve) return T(kUnlimited);
  return T(problem.frequency_hz * (source.duty_max / evaluation.rail.duty));
}

// Energy to fill the reservoir the first time: ∫ P/Q grows by its integrand with the upper end.
template <class T>
T FirstFill(const Problem& problem, const model::CompressorCurve& curve,
            const OperatingPointOf<T>& point) {
  const double source_pa = model::ValueOf(point.source_pa);
  const double temperature_k = problem.ambient.temperature_k;
  const double unit_j =
      model::EnergyToFill(curve, 1.0, problem.ambient.pressure_pa, source_pa, temperature_k);
  if constexpr (model::kIsDual<T>) {
    const double slope = model::ElectricalPower(curve, source_pa) /
                         curve.free_air_m3_per_s(source_pa) *
                         model::StandardVolume(1.0, temperature_k);
    return point.reservoir_rising_m3 * model::Chain(point.source_pa, unit_j, slope);
  }
  return point.reservoir_rising_m3 * unit_j;
}

// Over the pressures up to a stop pressure; moves with it where the largest is at the end.
template <class T>
T LargestCurrent(const model::CompressorCurve& curve, double low_pa, const T& stop_pa) {
  const double value_pa = model::ValueOf(stop_pa);
  const double largest_a = model::LargestCurrent(curve, low_pa, value_pa);
  const model::MonotoneCurve& current = curve.current_a;
  const bool at_end = !current.empty() && value_pa > current.front() && value_pa < current.back() &&
                      largest_a <= current(value_pa);
  return model::Chain(stop_pa, largest_a, at_end ? current.Slope(value_pa) : 0.0);
}

template <class T>
void AddPump(const Problem& problem, const Candidate& candidate, const OperatingPointOf<T>& point,
             const StrokesOf<T>& strokes, EvaluationOf<T>& evaluation) {
  const model::CompressorCurve& curve = ChosenPump(problem, candidate).curve;
  const double ambient_pa = problem.ambient.pressure_pa;
  evaluation.compressor_duty = strokes.pump_on_s * problem.frequency_hz;
  evaluation.energy_per_cycle_j += strokes.pump_energy_j;
  if (KeepsReservoir(candidate.configuration)) {
    evaluation.energy_first_fill_j = FirstFill(problem, curve, point);
    evaluation.air_total_m3 += point.reservoir_rising_m3 * (point.source_pa - ambient_pa) *
                               model::StandardVolume(1.0, problem.ambient.temperature_k);
  }
  const int pumps = candidate.compressor.quantity * FeedsAtOnce(problem);
  evaluation.battery_current_a +=
      static_cast<double>(pumps) * LargestCurrent(curve, ambient_pa, point.source_pa);
}

// Pumps that go on filling a tank, as full as may be where its fill is not given; they draw most at
// their stop pressure.
template <class T>
void AddRefill(const Problem& problem, const Candidate& candidate, const OperatingPointOf<T>& point,
               EvaluationOf<T>& evaluation) {
  const model::CompressorCurve& curve = ChosenPump(problem, candidate).curve;
  const double air_m3 = model::ValueOf(evaluation.air_per_cycle_m3);
  OperatingPoint at{model::ValueOf(point.source_pa)};
  at.pump_stop_pa = point.pump_stop_pa;
  at.tank_fill_pa =
      point.tank_fill_pa > 0.0 ? point.tank_fill_pa : TankFillMaxPa(problem, candidate);
  const model::Refill refill = RefillOf(problem, candidate, at, air_m3);
  evaluation.air_available_m3 = (refill.lasts_s * problem.frequency_hz + 1.0) * air_m3;
  evaluation.compressor_duty = T(refill.on_s * problem.frequency_hz / problem.actuations);
  evaluation.energy_per_cycle_j += refill.energy_j / problem.actuations;
  evaluation.battery_current_a +=
      candidate.compressor.quantity *
      model::LargestCurrent(curve, problem.ambient.pressure_pa, refill.stop_pa);
}

// The vacuum that pumps keep beside the source; false where they keep none at which falls are in
// time.
template <class T>
bool AddRail(const Problem& problem, const Candidate& candidate, double given_pa,
             EvaluationOf<T>& evaluation) {
  const RailSource source = RailSourceOf(problem, candidate);
  if (!source.curve) return true;
  const model::Gas gas = GasOf(candidate.configuration);
  const auto found_pa = given_pa > 0.0 ? std::optional(given_pa)
                        : candidate.rail.weakest_pa > 0.0
                            ? std::optional(candidate.rail.weakest_pa)
                            : WeakestRailPa(problem, source, candidate.lines, gas);
  if (!found_pa) return false;
  evaluation.rail = LoadOf(problem, source, RailAir(problem, candidate.lines), *found_pa);
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    GroupPerformanceOf<T>& group = evaluation.groups[g];
    group.fall_time_s = T(FallAtRail(problem, g, *candidate.lines[g], gas, *found_pa));
    group.frequency_max_hz = 1.0 / (group.rise_time_s + group.fall_time_s);
  }
  evaluation.energy_first_fill_j += evaluation.rail.first_fill_j;
  evaluation.energy_per_cycle_j += evaluation.rail.energy_per_cycle_j;
  evaluation.battery_current_a += evaluation.rail.current_a;
  return std::isfinite(evaluation.rail.duty);
}

template <class T>
void AddBattery(const Problem& problem, const Candidate& candidate, double coil_power_w,
                EvaluationOf<T>& evaluation) {
  evaluation.energy_available_j = kUnlimited;
  if (candidate.battery.index == kNone) return;
  const model::Battery& battery = problem.parts.batteries[candidate.battery.index];
  evaluation.energy_available_j =
      candidate.battery.quantity *
      model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v);
  evaluation.battery_current_a += coil_power_w / battery.nominal_voltage_v;
}

template <class T>
double BestFillOf(const Problem& problem, const Candidate& candidate,
                  const OperatingPointOf<T>& point, const EvaluationOf<T>& evaluation) {
  if constexpr (std::is_same_v<T, double>)
    return BestFillPa(problem, candidate, point,
                      {evaluation.air_per_cycle_m3, evaluation.energy_total_j,
                       evaluation.energy_available_j, evaluation.battery_current_a});
  else
    return TankFillMaxPa(problem, candidate);  // no such candidate is differentiated
}

}  // namespace

template <class T>
OperatingPointOf<T> Filled(const Problem& problem, const Candidate& candidate,
                           OperatingPointOf<T> point, const EvaluationOf<T>& evaluation) {
  point.rail_pa = evaluation.rail.weakest_pa;
  if (TankVolume(problem, candidate) == 0.0) return point;
  const double source_pa = model::ValueOf(point.source_pa);
  if (IsOpenTank(candidate))
    point.tank_fill_pa = source_pa;
  else if (point.tank_fill_pa == 0.0 && RefillsTank(candidate))
    point.tank_fill_pa = BestFillOf(problem, candidate, point, evaluation);
  else if (point.tank_fill_pa == 0.0)
    point.tank_fill_pa = FillForPa(problem, candidate, TankInletPa(problem, candidate, source_pa),
                                   model::ValueOf(evaluation.air_total_m3));
  return point;
}

template <class T>
T ObjectiveValue(const Problem& problem, const Candidate& candidate,
                 const OperatingPointOf<T>& point, const EvaluationOf<T>& evaluation) {
  return ObjectiveOf(
             problem.objective,
             TotalAmounts(problem, candidate, Filled(problem, candidate, point, evaluation))) +
         problem.objective.energy_wh * evaluation.energy_total_j / kJoulePerWattHour;
}

Evaluation EvaluateFilled(const Problem& problem, const Candidate& candidate,
                          OperatingPoint& point) {
  Evaluation evaluation = Evaluate(problem, candidate, point);
  if (!evaluation.works || !RefillsTank(candidate) || point.tank_fill_pa > 0.0) return evaluation;
  point = Filled(problem, candidate, point, evaluation);
  return Evaluate(problem, candidate, point);
}

Evaluation Evaluate(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    const EvaluateOptions& options) {
  return EvaluateWith(EvaluateStrokes(problem, candidate, point), problem, candidate, point,
                      options);
}

template <class T>
EvaluationOf<T> EvaluateWith(const StrokesOf<T>& strokes, const Problem& problem,
                             const Candidate& candidate, const OperatingPointOf<T>& point,
                             const EvaluateOptions& options) {
  EvaluationOf<T> evaluation;
  evaluation.failed = strokes.failed;
  if (!strokes.works) return evaluation;
  evaluation.works = true;
  evaluation.from_full = strokes.from_full;

  const bool revised = HasEffects(problem);
  evaluation.air_per_cycle_m3 = T(revised ? strokes.air_m3 : 0.0);
  double coil_power_w = 0.0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const Line& line = *candidate.lines[g];
    const double strokes_per_period = problem.groups[g].gait.strokes_per_period;
    const T rise_s = strokes.rise_s[g];
    const T inflate_s = strokes.inflate_s[g];
    const double fall_s = revised ? strokes.fall_s[g] : line.fall_time_s;
    evaluation.groups.push_back({rise_s, T(fall_s), inflate_s, 1.0 / (rise_s + fall_s),
                                 T(revised ? strokes.highest_pa[g] : 0.0)});
    if (!revised)
      evaluation.air_per_cycle_m3 +=
          strokes_per_period * AirPerStroke(problem, g, line, strokes.filled_pa[g]);
    evaluation.energy_coils_j +=
        problem.actuations *
        CoilEnergyPerCycle(problem, g, line,
                           options.least_coil_energy ? T(line.inflate_time_least_s) : inflate_s);
    coil_power_w += line.coil_power_w;
  }
  evaluation.air_total_m3 = problem.actuations * evaluation.air_per_cycle_m3;
  evaluation.energy_per_cycle_j = evaluation.energy_coils_j / problem.actuations;
  for (const model::Regulator* regulator : RegulatorsOf(problem, candidate)) {
    evaluation.energy_per_cycle_j += regulator->electrical_power_w / problem.frequency_hz;
    coil_power_w += regulator->electrical_power_w;
  }
  const bool pumps = candidate.compressor.index != kNone;
  if (pumps && IsPumped(candidate.configuration))
    AddPump(problem, candidate, point, strokes, evaluation);
  if (!HasTank(candidate.configuration) || candidate.bottle.index == kNone)
    evaluation.air_available_m3 = AirAvailable(problem, candidate, model::ValueOf(point.source_pa));
  else if (pumps)
    AddRefill(problem, candidate, point, evaluation);
  else
    evaluation.air_available_m3 =
        TankAir(problem, candidate, Filled(problem, candidate, point, evaluation).tank_fill_pa,
                TankInletPa(problem, candidate, model::ValueOf(point.source_pa)));
  if (!AddRail(problem, candidate, point.rail_pa, evaluation)) {
    evaluation.works = false;
    return evaluation;
  }
  AddBattery(problem, candidate, coil_power_w, evaluation);
  evaluation.energy_total_j =
      evaluation.energy_first_fill_j + problem.actuations * evaluation.energy_per_cycle_j;
  evaluation.frequency_sustained_hz = std::min({SourceFrequency(problem, candidate, evaluation),
                                                RailFrequency(problem, candidate, evaluation),
                                                StrokeFrequency(problem, evaluation)});
  return evaluation;
}

template Evaluation EvaluateWith(const Strokes&, const Problem&, const Candidate&,
                                 const OperatingPoint&, const EvaluateOptions&);
template OperatingPoint Filled(const Problem&, const Candidate&, OperatingPoint, const Evaluation&);
template OperatingPointOf<model::Dual> Filled(const Problem&, const Candidate&,
                                              OperatingPointOf<model::Dual>,
                                              const EvaluationOf<model::Dual>&);
template double ObjectiveValue(const Problem&, const Candidate&, const OperatingPoint&,
                               const Evaluation&);
template EvaluationOf<model::Dual> EvaluateWith(const StrokesOf<model::Dual>&, const Problem&,
                                                const Candidate&,
                                                const OperatingPointOf<model::Dual>&,
                                                const EvaluateOptions&);
template model::Dual ObjectiveValue(const Problem&, const Candidate&,
                                    const OperatingPointOf<model::Dual>&,
                                    const EvaluationOf<model::Dual>&);

}  // namespace plenum::optimizer
