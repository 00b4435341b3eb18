#include "optimizer/candidate.h"

#include <algorithm>
#include <cmath>

#include "model/storage.h"
#include "optimizer/effect_strokes.h"
#include "optimizer/evaluate_strokes.h"

namespace plenum::optimizer {
namespace {

constexpr double kPaPerKpa = 1e3;

const model::Regulator& RegulatorOf(const Problem& problem, const Candidate& candidate) {
  return problem.parts.regulators[candidate.regulator.index];
}

const model::Compressor& CompressorOf(const Problem& problem, const Candidate& candidate) {
  return problem.parts.compressors[candidate.compressor.index];
}

// Gas on board that reaches the regulator's outlet, m³ ANR.
double AirAvailable(const Problem& problem, const Candidate& candidate, double source_pa) {
  if (candidate.bottle.index == kNone) return kUnlimited;  // wall supply, or not chosen yet
  const double temperature_k = problem.ambient.temperature_k;
  const int quantity = candidate.bottle.quantity;
  if (candidate.configuration == Configuration::kCylinder) {
    const model::Cylinder& cylinder = problem.parts.cylinders[candidate.bottle.index];
    const double inlet_pa =
        std::max(source_pa, RegulatorOf(problem, candidate).inlet_pressure_min_pa);
    return quantity * model::CylinderUsableVolume(cylinder.water_volume_m3,
                                                  cylinder.fill_pressure_pa, inlet_pa,
                                                  temperature_k);
  }
  if (candidate.configuration == Configuration::kCo2) {
    const model::Co2Bottle& bottle = problem.parts.co2[candidate.bottle.index];
    const double inlet_pa =
        std::max(source_pa, RegulatorOf(problem, candidate).inlet_pressure_min_pa);
    return quantity * model::Co2UsableVolume(bottle.co2_mass_kg, bottle.water_volume_m3, inlet_pa,
                                             temperature_k);
  }
  return kUnlimited;
}

// Highest frequency that the source sustains, by thermal duty or by evaporation.
double SourceFrequency(const Problem& problem, const Candidate& candidate,
                       const Evaluation& evaluation) {
  if (candidate.configuration == Configuration::kCompressor)
    return problem.frequency_hz * CompressorOf(problem, candidate).duty_max /
           evaluation.compressor_duty;
  if (candidate.configuration == Configuration::kCo2 && candidate.bottle.index != kNone)
    return candidate.bottle.quantity *
           problem.parts.co2[candidate.bottle.index].flow_sustained_m3_per_s /
           evaluation.air_per_cycle_m3;
  return kUnlimited;
}

void AddPump(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
             const Strokes& strokes, Evaluation& evaluation) {
  const model::CompressorCurve& curve = CompressorOf(problem, candidate).curve;
  const double ambient_pa = problem.ambient.pressure_pa;
  const double temperature_k = problem.ambient.temperature_k;
  evaluation.compressor_duty = strokes.pump_on_s * problem.frequency_hz;
  evaluation.energy_per_cycle_j += strokes.pump_energy_j;
  evaluation.energy_first_fill_j = model::EnergyToFill(curve, point.reservoir_rising_m3, ambient_pa,
                                                       point.source_pa, temperature_k);
  evaluation.air_total_m3 += model::StandardVolume(
      point.reservoir_rising_m3 * (point.source_pa - ambient_pa), temperature_k);
  evaluation.battery_current_a +=
      candidate.compressor.quantity * model::LargestCurrent(curve, ambient_pa, point.source_pa);
}

void AddBattery(const Problem& problem, const Candidate& candidate, double coil_power_w,
                Evaluation& evaluation) {
  evaluation.energy_available_j = kUnlimited;
  if (candidate.battery.index == kNone) return;
  const model::Battery& battery = problem.parts.batteries[candidate.battery.index];
  evaluation.energy_available_j =
      candidate.battery.quantity *
      model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v);
  evaluation.battery_current_a += coil_power_w / battery.nominal_voltage_v;
}

std::string Pointer(int group, const char* field) {
  return "/actuators/" + std::to_string(group) + "/" + field;
}

Margin AtMost(std::string pointer, double limit, double achieved) {
  return {std::move(pointer), limit, achieved, (limit - achieved) / limit};
}

Margin AtLeast(std::string pointer, double limit, double achieved) {
  return {std::move(pointer), limit, achieved, achieved / limit - 1.0};
}

// Every margin but the strokes'.
std::vector<Margin> SupplyMargins(const Problem& problem, const Candidate& candidate,
                                  const OperatingPoint& point, const Evaluation& evaluation) {
  std::vector<Margin> margins;
  const double ambient_pa = problem.ambient.pressure_pa;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const ActuatorGroup& group = problem.groups[g];
    const double highest_pa =
        std::max(evaluation.groups[g].highest_pressure_pa,
                 candidate.lines[g]->holds ? group.chamber.operating_pressure_pa : point.source_pa);
    margins.push_back(AtMost(Pointer(g, "pressure_kpa_gauge_max"),
                             (group.pressure_max_pa - ambient_pa) / kPaPerKpa,
                             (highest_pa - ambient_pa) / kPaPerKpa));
    if (std::isfinite(group.fall_time_max_s))
      margins.push_back(AtMost(Pointer(g, "fall_time_s_max"), group.fall_time_max_s,
                               evaluation.groups[g].fall_time_s));
  }
  margins.push_back(
      AtLeast("/duty/frequency_hz", problem.frequency_hz, evaluation.frequency_sustained_hz));
  const double actuations =
      std::min(evaluation.air_available_m3 / evaluation.air_per_cycle_m3,
               evaluation.energy_per_cycle_j > 0.0
                   ? (evaluation.energy_available_j - evaluation.energy_first_fill_j) /
                         evaluation.energy_per_cycle_j
                   : kUnlimited);
  if (std::isfinite(actuations))
    margins.push_back(AtLeast("/duty/actuations", problem.actuations, actuations));
  if (std::isfinite(problem.source_pressure_max_pa))
    margins.push_back(AtMost("/supply/source_pressure_kpa_gauge_max",
                             (problem.source_pressure_max_pa - ambient_pa) / kPaPerKpa,
                             (point.source_pa - ambient_pa) / kPaPerKpa));
  const Amounts total = TotalAmounts(problem, candidate, point.reservoir_m3);
  if (std::isfinite(problem.mass_max_kg))
    margins.push_back(AtMost("/supply/mass_kg_max", problem.mass_max_kg, total.mass_kg));
  if (std::isfinite(problem.volume_max_l))
    margins.push_back(AtMost("/supply/volume_l_max", problem.volume_max_l, total.volume_m3 * 1e3));
  if (std::isfinite(problem.cost_max_eur))
    margins.push_back(AtMost("/supply/cost_eur_max", problem.cost_max_eur, total.cost_eur));
  return margins;
}

}  // namespace

Window SourceWindow(const Problem& problem, const Candidate& candidate) {
  Window window{std::max(problem.ambient.pressure_pa, candidate.source_floor_pa),
                std::min(problem.source_pressure_max_pa, candidate.source_cap_pa)};
  for (const Line* line : candidate.lines) {
    window.low_pa = std::max(window.low_pa, line->source_min_pa);
    window.high_pa = std::min(window.high_pa, line->source_max_pa);
  }
  if (candidate.regulator.index != kNone) {
    const model::Regulator& regulator = RegulatorOf(problem, candidate);
    window.low_pa = std::max(window.low_pa, regulator.outlet_pressure_min_pa);
    window.high_pa = std::min(window.high_pa, regulator.outlet_pressure_max_pa);
  }
  if (candidate.configuration == Configuration::kMains)
    window.high_pa = std::min(window.high_pa, problem.mains_pressure_pa);
  if (candidate.compressor.index != kNone) {
    const model::CompressorCurve& curve = CompressorOf(problem, candidate).curve;
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

double CustomRatingPa(const Problem& problem) {
  return std::min(problem.source_pressure_max_pa,
                  problem.ambient.pressure_pa + model::kMadeReservoirPressureMaxGaugePa);
}

Amounts CustomReservoir(const Problem& problem, double volume_m3) {
  const model::MadeReservoir made =
      model::MakeReservoir(volume_m3, CustomRatingPa(problem) - problem.ambient.pressure_pa);
  return {made.mass_kg, made.body_volume_m3, 0.0};
}

Amounts TotalAmounts(const Problem& problem, const Candidate& candidate, double reservoir_m3) {
  Amounts total;
  for (const Line* line : candidate.lines) total += line->amounts;
  for (const Option* option : {&candidate.regulator, &candidate.bottle, &candidate.compressor,
                               &candidate.battery, &candidate.reservoir})
    total += option->amounts;
  if (candidate.reservoir.index == kCustom) total += CustomReservoir(problem, reservoir_m3);
  return total;
}

double ObjectiveValue(const Problem& problem, const Candidate& candidate,
                      const OperatingPoint& point, const Evaluation& evaluation) {
  constexpr double kJoulePerWattHour = 3600.0;
  return ObjectiveOf(problem.objective, TotalAmounts(problem, candidate, point.reservoir_m3)) +
         problem.objective.energy_wh * evaluation.energy_total_j / kJoulePerWattHour;
}

Evaluation Evaluate(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    const EvaluateOptions& options) {
  return EvaluateWith(EvaluateStrokes(problem, candidate, point), problem, candidate, point,
                      options);
}

Evaluation EvaluateWith(const Strokes& strokes, const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point, const EvaluateOptions& options) {
  Evaluation evaluation;
  evaluation.failed = strokes.failed;
  if (!strokes.works) return evaluation;
  evaluation.works = true;
  evaluation.from_full = strokes.from_full;

  const bool revised = HasEffects(problem);
  evaluation.air_per_cycle_m3 = revised ? strokes.air_m3 : 0.0;
  double coil_power_w = 0.0;
  double slowest_s = 0.0;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const Line& line = *candidate.lines[g];
    const double rise_s = strokes.rise_s[g];
    const double inflate_s = strokes.inflate_s[g];
    const double fall_s = revised ? strokes.fall_s[g] : line.fall_time_s;
    evaluation.groups.push_back({rise_s, fall_s, inflate_s, 1.0 / (rise_s + fall_s),
                                 revised ? strokes.highest_pa[g] : 0.0});
    evaluation.air_per_cycle_m3 += revised ? 0.0 : AirPerStroke(problem, g, line, point.source_pa);
    evaluation.energy_coils_j +=
        problem.actuations *
        CoilEnergyPerCycle(problem, line,
                           options.least_coil_energy ? line.inflate_time_least_s : inflate_s);
    coil_power_w += line.coil_power_w;
    slowest_s = std::max({slowest_s, inflate_s, fall_s});
  }
  evaluation.air_total_m3 = problem.actuations * evaluation.air_per_cycle_m3;
  evaluation.energy_per_cycle_j = evaluation.energy_coils_j / problem.actuations;
  if (candidate.regulator.index != kNone) {
    const double power_w = RegulatorOf(problem, candidate).electrical_power_w;
    evaluation.energy_per_cycle_j += power_w / problem.frequency_hz;
    coil_power_w += power_w;
  }
  if (candidate.compressor.index != kNone) AddPump(problem, candidate, point, strokes, evaluation);
  evaluation.air_available_m3 = AirAvailable(problem, candidate, point.source_pa);
  AddBattery(problem, candidate, coil_power_w, evaluation);
  evaluation.energy_total_j =
      evaluation.energy_first_fill_j + problem.actuations * evaluation.energy_per_cycle_j;
  evaluation.frequency_sustained_hz =
      std::min(SourceFrequency(problem, candidate, evaluation), 0.5 / slowest_s);
  return evaluation;
}

std::vector<Margin> Margins(const Problem& problem, const Candidate& candidate,
                            const OperatingPoint& point, const Evaluation& evaluation) {
  std::vector<Margin> margins;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    if (std::isfinite(problem.groups[g].rise_time_max_s))
      margins.push_back(AtMost(Pointer(g, "rise_time_s_max"), problem.groups[g].rise_time_max_s,
                               evaluation.groups[g].rise_time_s));
  for (Margin& margin : SupplyMargins(problem, candidate, point, evaluation))
    margins.push_back(std::move(margin));
  return margins;
}

double StrokeExcess(const Problem& problem, const Evaluation& evaluation) {
  if (!evaluation.works) return kUnlimited;
  double excess = -kUnlimited;
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const GroupPerformance& group = evaluation.groups[g];
    excess = std::max(excess, group.inflate_time_s / HalfPeriod(problem) - 1.0);
    if (std::isfinite(problem.groups[g].rise_time_max_s))
      excess = std::max(excess, group.rise_time_s / problem.groups[g].rise_time_max_s - 1.0);
  }
  return excess;
}

double CurrentMargin(const Problem& problem, const Candidate& candidate,
                     const Evaluation& evaluation) {
  if (candidate.battery.index == kNone) return kUnlimited;
  const double current_max_a =
      candidate.battery.quantity * problem.parts.batteries[candidate.battery.index].current_max_a;
  return 1.0 - evaluation.battery_current_a / current_max_a;
}

double SupplyMargin(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    const Evaluation& evaluation) {
  if (!evaluation.works) return -kUnlimited;
  double smallest = kUnlimited;
  for (const Margin& margin : SupplyMargins(problem, candidate, point, evaluation))
    smallest = std::min(smallest, margin.relative_margin);
  return std::min(smallest, CurrentMargin(problem, candidate, evaluation));
}

}  // namespace plenum::optimizer
