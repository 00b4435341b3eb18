// How far an evaluation is from each requirement.
#include <algorithm>
#include <cmath>

#include "model/flow/scalar.h"
#include "optimizer/evaluate/closing.h"
#include "optimizer/evaluate/evaluate.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

constexpr double kPaPerKpa = 1e3, kLPerMinPerM3PerS = 6e4;

template <class T>
MarginOf<T> AtMost(std::string pointer, double limit, const T& achieved) {
  return {std::move(pointer), limit, achieved, (limit - achieved) / limit};
}

template <class T>
MarginOf<T> AtLeast(std::string pointer, double limit, const T& achieved) {
  return {std::move(pointer), limit, achieved, achieved / limit - 1.0};
}

template <class T>
MarginOf<T> CompressedAirMargin(const Problem& problem, const Candidate& candidate) {
  const model::Compressor& ejector = ChosenPump(problem, candidate);
  return AtMost<T>(
      "/supply/mains/flow_l_per_min_anr_max",
      kLPerMinPerM3PerS * problem.compressed_air.flow_max_m3_per_s,
      T(kLPerMinPerM3PerS * CompressedAir(problem, ejector, candidate.compressor.quantity)));
}

// The wall gives energy without end, and a robot that names no energy.
bool IsUnlimited(const Power& power) {
  return power.kind == PowerKind::kWall ||
         (power.kind == PowerKind::kRobot && !power.energy_wh_max);
}

// The source window keeps peaks within their limits (closing.h): who asks for the least margin
// alone needs no number of them.
enum class Peaks { kTold, kKept };

// Every margin but the strokes'.
template <class T>
std::vector<MarginOf<T>> SupplyMargins(const Problem& problem, const Candidate& candidate,
                                       const OperatingPointOf<T>& point,
                                       const EvaluationOf<T>& evaluation, Peaks peaks) {
  std::vector<MarginOf<T>> margins;
  const double ambient_pa = problem.ambient.pressure_pa;
  const double pa_per_kpa = Evacuated(problem) ? -kPaPerKpa : kPaPerKpa;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const ActuatorGroup& group = problem.groups[g];
    const T at_group_pa = PressureOf(point, g);
    const T full_pa = peaks == Peaks::kTold       ? PeakOf(problem, candidate, g, at_group_pa)
                      : candidate.lines[g]->holds ? T(group.chamber.operating_pressure_pa)
                                                  : at_group_pa;
    const T highest_pa = std::max(evaluation.groups[g].highest_pressure_pa, full_pa);
    margins.push_back(AtMost<T>(PressureLimitPointer(problem, g),
                                KpaGauge(problem, group.pressure_max_pa),
                                T((highest_pa - ambient_pa) / pa_per_kpa)));
    if (std::isfinite(group.fall_time_max_s))
      margins.push_back(AtMost<T>(GroupPointer(problem, g) + "/fall_time_s_max",
                                  group.fall_time_max_s, evaluation.groups[g].fall_time_s));
  }
  margins.push_back(
      AtLeast<T>("/duty/frequency_hz", problem.frequency_hz, evaluation.frequency_sustained_hz));
  // A pump needs energy without end to come to the pressure at which it delivers nothing.
  const bool endless = std::isinf(model::ValueOf(evaluation.energy_total_j));
  const T by_energy = endless ? T(0.0)
                      : evaluation.energy_per_cycle_j > 0.0 && !IsUnlimited(problem.power)
                          ? T((evaluation.energy_available_j - evaluation.energy_first_fill_j) /
                              evaluation.energy_per_cycle_j)
                          : T(kUnlimited);
  const T actuations =
      std::min(T(evaluation.air_available_m3 / evaluation.air_per_cycle_m3), by_energy);
  if (std::isfinite(model::ValueOf(actuations)))
    margins.push_back(AtLeast<T>("/duty/actuations", problem.actuations, actuations));
  if (std::isfinite(problem.source_pressure_max_pa))
    margins.push_back(AtMost<T>(SourceLimitPointer(problem),
                                KpaGauge(problem, problem.source_pressure_max_pa),
                                T((point.source_pa - ambient_pa) / pa_per_kpa)));
  if (problem.rail_floor_pa > model::kDeepestVacuumPa)
    margins.push_back(AtMost<T>("/supply/vacuum/vacuum_kpa_gauge_min",
                                KpaGauge(problem, problem.rail_floor_pa),
                                T((evaluation.rail.stop_pa - ambient_pa) / kPaPerKpa)));
  const OperatingPointOf<T> filled = Filled(problem, candidate, point, evaluation);
  if (filled.tank_fill_pa > 0.0 && std::isfinite(problem.tank_fill_max_pa))
    margins.push_back(AtMost<T>("/supply/tank_fill_kpa_gauge_max",
                                (problem.tank_fill_max_pa - ambient_pa) / kPaPerKpa,
                                T((filled.tank_fill_pa - ambient_pa) / kPaPerKpa)));
  if (IsEjector(candidate.configuration) && std::isfinite(problem.compressed_air.flow_max_m3_per_s))
    margins.push_back(CompressedAirMargin<T>(problem, candidate));
  const AmountsOf<T> total = TotalAmounts(problem, candidate, filled);
  if (std::isfinite(problem.mass_max_kg))
    margins.push_back(
        AtMost<T>("/supply/mass_kg_max", problem.mass_max_kg, total.mass_kg + total.mass_slack_kg));
  if (std::isfinite(problem.volume_max_l))
    margins.push_back(AtMost<T>("/supply/volume_l_max", problem.volume_max_l,
                                (total.volume_m3 + total.volume_slack_m3) * 1e3));
  if (std::isfinite(problem.cost_max_eur))
    margins.push_back(AtMost<T>("/supply/cost_eur_max", problem.cost_max_eur, total.cost_eur));
  return margins;
}

}  // namespace

template <class T>
std::vector<MarginOf<T>> Margins(const Problem& problem, const Candidate& candidate,
                                 const OperatingPointOf<T>& point,
                                 const EvaluationOf<T>& evaluation) {
  std::vector<MarginOf<T>> margins;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    if (std::isfinite(problem.groups[g].rise_time_max_s))
      margins.push_back(AtMost<T>(GroupPointer(problem, g) + "/rise_time_s_max",
                                  problem.groups[g].rise_time_max_s,
                                  evaluation.groups[g].rise_time_s));
  for (MarginOf<T>& margin : SupplyMargins(problem, candidate, point, evaluation, Peaks::kTold))
    margins.push_back(std::move(margin));
  return margins;
}

double StrokeExcess(const Problem& problem, const Evaluation& evaluation) {
  if (!evaluation.works) return kUnlimited;
  double excess = -kUnlimited;
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const GroupPerformance& group = evaluation.groups[g];
    excess =
        std::max(excess, group.inflate_time_s / InflateWindow(problem, static_cast<int>(g)) - 1.0);
    if (std::isfinite(problem.groups[g].rise_time_max_s))
      excess = std::max(excess, group.rise_time_s / problem.groups[g].rise_time_max_s - 1.0);
  }
  return excess;
}

template <class T>
T CurrentMargin(const Problem& problem, const Candidate& candidate,
                const EvaluationOf<T>& evaluation) {
  if (candidate.battery.index == kNone) return T(kUnlimited);
  const double current_max_a =
      candidate.battery.quantity * problem.parts.batteries[candidate.battery.index].current_max_a;
  return 1.0 - evaluation.battery_current_a / current_max_a;
}

double SupplyMargin(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    const Evaluation& evaluation) {
  if (!evaluation.works) return -kUnlimited;
  double smallest = kUnlimited;
  for (const Margin& margin : SupplyMargins(problem, candidate, point, evaluation, Peaks::kKept))
    smallest = std::min(smallest, margin.relative_margin);
  return std::min(smallest, CurrentMargin(problem, candidate, evaluation));
}

template std::vector<Margin> Margins(const Problem&, const Candidate&, const OperatingPoint&,
                                     const Evaluation&);
template double CurrentMargin(const Problem&, const Candidate&, const Evaluation&);
template std::vector<MarginOf<model::Dual>> Margins(const Problem&, const Candidate&,
                                                    const OperatingPointOf<model::Dual>&,
                                                    const EvaluationOf<model::Dual>&);
template model::Dual CurrentMargin(const Problem&, const Candidate&,
                                   const EvaluationOf<model::Dual>&);

}  // namespace plenum::optimizer
