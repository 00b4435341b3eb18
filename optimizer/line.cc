#include "optimizer/line.h"

#include <cmath>

namespace plenum::optimizer {

namespace {

constexpr double kDiameterToleranceM = 0.05e-3;

}  // namespace

bool DiametersMate(double tube_outer_m, double fitting_outer_m) {
  return std::abs(tube_outer_m - fitting_outer_m) <= kDiameterToleranceM;
}

bool PartsMate(const Problem& problem, const Line& line) {
  if (line.fitting < 0) return true;
  const model::Fitting& fitting = problem.parts.fittings[line.fitting];
  return DiametersMate(problem.parts.tubing[line.tubing].outer_diameter_m,
                       fitting.tube_outer_diameter_m) &&
         fitting.thread == problem.parts.valves[line.valve].port;
}

Amounts& Amounts::operator+=(const Amounts& other) {
  mass_kg += other.mass_kg;
  volume_m3 += other.volume_m3;
  cost_eur += other.cost_eur;
  return *this;
}

Amounts operator*(double quantity, const model::PartBasics& basics) {
  return {quantity * basics.mass_kg, quantity * basics.body_volume_m3,
          quantity * basics.cost_eur.value_or(0.0)};
}

double ObjectiveOf(const Objective& objective, const Amounts& amounts) {
  return objective.mass_kg * amounts.mass_kg + objective.volume_l * amounts.volume_m3 * 1e3 +
         objective.cost_eur * amounts.cost_eur;
}

bool CostMatters(const Problem& problem) {
  return problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur);
}

double RiseTarget(const Problem& problem, const ActuatorGroup& group) {
  const double ambient_pa = problem.ambient.pressure_pa;
  return ambient_pa + problem.rise_fraction * (group.chamber.operating_pressure_pa - ambient_pa);
}

double FallTarget(const Problem& problem, const ActuatorGroup& group) {
  const double ambient_pa = problem.ambient.pressure_pa;
  return ambient_pa + problem.fall_fraction * (group.chamber.operating_pressure_pa - ambient_pa);
}

double FlowFactor(const Problem& problem, model::Gas gas) {
  return model::FlowFactor(gas) *
         std::sqrt(model::kReferenceTemperatureK / problem.ambient.temperature_k);
}

double AirPerStroke(const Problem& problem, int group, const Line& line, double source_pa) {
  const ActuatorGroup& actuators = problem.groups[group];
  const double full_pa = line.holds ? actuators.chamber.operating_pressure_pa : source_pa;
  const double content = model::Content(line.chamber, full_pa) -
                         model::Content(line.chamber, problem.ambient.pressure_pa);
  return actuators.count * model::StandardVolume(content, problem.ambient.temperature_k);
}

double CoilEnergyPerCycle(const Problem& problem, const Line& line, double inflate_time_s) {
  const double on_s = HalfPeriod(problem) + (line.holds ? inflate_time_s : 0.0);
  return line.coil_power_w * on_s;
}

}  // namespace plenum::optimizer
