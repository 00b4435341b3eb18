#include "optimizer/pump/settings_bounds.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"

namespace plenum::optimizer {
namespace {

constexpr double kLessThanAlways = 1.0 - 1e-6;  // share of the period that pumps run

OperatingPoint Fastest(const SettingsBox& box, double source_pa) {
  return {source_pa, box.high_m3, box.low_m3};
}

double StrokesExcess(const Problem& problem, const Strokes& strokes) {
  if (!strokes.works) return kUnlimited;
  double excess = -kUnlimited;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    excess = std::max({excess, strokes.inflate_s[g] / InflateWindow(problem, g) - 1.0,
                       strokes.rise_s[g] / problem.groups[g].rise_time_max_s - 1.0});
  return excess;
}

// Whether no squad draws while another does.
bool OneAtATime(const Problem& problem, const Candidate& candidate, const Strokes& strokes) {
  return AllHold(candidate) && EndInTurn(problem, strokes.inflate_s);
}

double AirPerCycle(const Problem& problem, const Candidate& candidate, const Strokes& strokes) {
  double air_m3 = 0.0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    air_m3 += problem.groups[g].gait.strokes_per_period *
              AirPerStroke(problem, g, *candidate.lines[g], strokes.filled_pa[g]);
  return air_m3;
}

double MostAirPerCycle(const Problem& problem, const Candidate& candidate, double source_pa) {
  double air_m3 = 0.0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const Line& line = *candidate.lines[g];
    air_m3 +=
        problem.groups[g].gait.strokes_per_period *
        AirPerStroke(problem, g, line, line.holds ? line.chamber.operating_pressure_pa : source_pa);
  }
  return air_m3;
}

double CoilEnergy(const Problem& problem, const Candidate& candidate, const Strokes& strokes) {
  double energy_j = 0.0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    energy_j += CoilEnergyPerCycle(problem, g, *candidate.lines[g], strokes.inflate_s[g]);
  return problem.actuations * energy_j;
}

// How far the reservoir may be above the low run, Pa; +∞ where that is not known.
double MostAbove(const Problem& problem, const Candidate& candidate, const SettingsBox& box,
                 const Strokes& low) {
  const bool alone = MeetingOf(problem) == Meeting::kAlone;
  const bool once_full = alone || low.pump_on_s * problem.frequency_hz < kLessThanAlways;
  const bool apart = IsBurst(problem) || OneAtATime(problem, candidate, low);
  if (!once_full || !apart) return kUnlimited;
  const double air_m3 = MostAirPerCycle(problem, candidate, box.high_pa) + low.pump_air_m3;
  const double content = air_m3 * model::kReferencePressurePa * problem.ambient.temperature_k /
                         model::kReferenceTemperatureK;
  return box.high_pa - box.low_pa + (1.0 / box.low_m3 - 1.0 / box.high_m3) * content;
}

// Sets the time and energy that the pumps at least take in a cycle, from the low run, and returns
// what of the energy is left out since the pressures of the box lie apart.
double BoundPumps(const Problem& problem, const Candidate& candidate, const PumpTrend& trend,
                  const SettingsBox& box, const Strokes& low, Strokes& least) {
  const model::CompressorCurve& curve = ChosenPump(problem, candidate).curve;
  const double excess_m3 =
      low.from_full || AllHold(candidate)
          ? std::max(0.0, low.pump_air_m3 - AirPerCycle(problem, candidate, low))
          : (1.0 - box.low_m3 / box.high_m3) * low.pump_air_m3;
  const double delivery =
      candidate.compressor.quantity *
      curve.free_air_m3_per_s(std::min(box.low_pa, model::HighestPressure(curve)));
  const double excess_s = excess_m3 > 0.0 ? excess_m3 / delivery : 0.0;
  const double power_w = curve.voltage_v * candidate.compressor.quantity *
                         model::LargestCurrent(curve, problem.ambient.pressure_pa, box.low_pa);
  const double fall_j_per_pa =
      trend.rises ? 0.0 : trend.fall.EnergyPerAir(box.high_pa) * low.pump_air_m3;
  double energy_j = low.pump_energy_j - excess_s * power_w;
  if (fall_j_per_pa > 0.0) energy_j -= fall_j_per_pa * MostAbove(problem, candidate, box, low);
  least.pump_on_s = std::max(0.0, low.pump_on_s - excess_s);
  least.pump_energy_j = std::max(0.0, energy_j);
  return std::min(fall_j_per_pa * (box.high_pa - box.low_pa),
                  low.pump_energy_j - least.pump_energy_j);
}

}  // namespace

PumpTrend MakePumpTrend(const Problem& problem, const Candidate& candidate) {
  PumpTrend trend;
  const model::CompressorCurve& curve = ChosenPump(problem, candidate).curve;
  const double low_pa = problem.ambient.pressure_pa;
  const double high_pa = SourceWindow(problem, candidate).high_pa;
  trend.rises = EnergyPerAirRises(curve, low_pa, high_pa);
  if (!trend.rises) trend.fall = SteepestFall(curve, low_pa, high_pa);
  return trend;
}

Strokes FastestStrokes(const Problem& problem, const Candidate& candidate, const SettingsBox& box) {
  return EvaluateStrokes(problem, candidate, Fastest(box, box.high_pa));
}

LeastEvaluation LeastOver(const Problem& problem, const Candidate& candidate,
                          const PumpTrend& trend, const SettingsBox& box, const Strokes& fastest) {
  LeastEvaluation result;
  const Strokes low = EvaluateStrokes(problem, candidate, {box.low_pa, box.low_m3, box.high_m3});
  Strokes least = fastest;
  least.pump_on_s = least.pump_energy_j = 0.0;
  least.failed = low.failed;
  if (low.works) {
    least.filled_pa = low.filled_pa;
    const double pumps_j =
        problem.actuations * BoundPumps(problem, candidate, trend, box, low, least);
    result.pressures_gap_j =
        CoilEnergy(problem, candidate, low) - CoilEnergy(problem, candidate, fastest) + pumps_j;
    result.volumes_gap_j = problem.actuations * (low.pump_energy_j - least.pump_energy_j) - pumps_j;
  }
  const OperatingPoint judged{box.low_pa, box.low_m3, box.low_m3};
  result.least = EvaluateWith(least, problem, candidate, judged);
  return result;
}

LeafStatus RaisePressure(const Problem& problem, const Candidate& candidate, SettingsBox& box,
                         double tolerance) {
  bool failed = false;
  const auto excess = [&](double source_pa) {
    const Strokes strokes = EvaluateStrokes(problem, candidate, Fastest(box, source_pa));
    failed = failed || strokes.failed;
    if (failed) return 0.0;
    return StrokesExcess(problem, strokes);
  };
  const std::optional<double> raised = RaisedFloor(excess, box.low_pa, box.high_pa, tolerance);
  if (failed) return LeafStatus::kUndecided;
  if (!raised) return LeafStatus::kInfeasible;
  box.low_pa = *raised;
  return LeafStatus::kFeasible;
}

}  // namespace plenum::optimizer
