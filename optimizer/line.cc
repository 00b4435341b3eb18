#include "optimizer/line.h"

#include <algorithm>
#include <cmath>

#include "model/stroke.h"
#include "model/tube.h"
#include "optimizer/root.h"

namespace plenum::optimizer {
namespace {

// Tubes and fittings mate when their diameters agree to this.
constexpr double kDiameterToleranceM = 0.05e-3;

bool Compatible(const model::Tubing& tubing, const model::Fitting& fitting,
                const model::Valve& valve) {
  return std::abs(tubing.outer_diameter_m - fitting.tube_outer_diameter_m) <= kDiameterToleranceM &&
         fitting.thread == valve.port;
}

int Pieces(const ActuatorGroup& group, const model::Valve& valve) {
  return (group.count + valve.channels - 1) / valve.channels;
}

Line Assemble(const Problem& problem, const ActuatorGroup& group, int tubing_index,
              int fitting_index, int valve_index) {
  const model::Tubing& tubing = problem.parts.tubing[tubing_index];
  const model::Valve& valve = problem.parts.valves[valve_index];
  Line line;
  line.tubing = tubing_index;
  line.fitting = fitting_index;
  line.valve = valve_index;
  line.amounts += group.count * group.tube_length_m * tubing.per_metre;
  line.amounts += static_cast<double>(Pieces(group, valve)) * valve.basics;
  line.source_max_pa =
      std::min({tubing.pressure_max_pa, valve.pressure_max_pa, problem.source_pressure_max_pa});

  const model::FlowElement tube = model::TubeElement(tubing.inner_diameter_m, group.tube_length_m);
  const int near_valve = (group.fittings_per_line + 1) / 2;
  const int near_actuator = group.fittings_per_line - near_valve;
  line.fill.push_back(valve.fill);
  if (fitting_index >= 0) {
    const model::Fitting& fitting = problem.parts.fittings[fitting_index];
    line.amounts += static_cast<double>(group.count * group.fittings_per_line) * fitting.basics;
    line.source_max_pa = std::min(line.source_max_pa, fitting.pressure_max_pa);
    line.fill.insert(line.fill.end(), near_valve, fitting.flow);
    line.fill.push_back(tube);
    line.fill.insert(line.fill.end(), near_actuator, fitting.flow);
  } else {
    line.fill.push_back(tube);
  }
  line.exhaust.assign(line.fill.rbegin(), line.fill.rend());
  line.exhaust.back() = valve.exhaust;

  line.holds = model::Holds(valve.kind);
  if (!line.holds) line.source_max_pa = std::min(line.source_max_pa, group.pressure_max_pa);
  line.coil_power_w = valve.coil_power_w * group.count;
  line.chamber = group.chamber;
  line.chamber.dead_volume_m3 += model::BoreVolume(tubing.inner_diameter_m, group.tube_length_m);
  return line;
}

// Fills in the times; false if no source can make the line meet the group's limits.
bool Qualify(const Problem& problem, const ActuatorGroup& group, model::Gas gas, Line& line) {
  const double factor = FlowFactor(problem, gas);
  const double temperature_k = problem.ambient.temperature_k;
  const double operating_pa = group.chamber.operating_pressure_pa;
  const double switches_pa = problem.parts.valves[line.valve].pressure_min_pa;
  if (line.source_max_pa < std::max(operating_pa, switches_pa)) return false;

  const double fall_max_s = std::min(group.fall_time_max_s, HalfPeriod(problem));
  line.fall_time_s = model::EmptyTime(model::MakeSeries(line.exhaust, factor), line.chamber,
                                      operating_pa, FallTarget(problem, group), temperature_k);
  if (!(line.fall_time_s <= fall_max_s)) return false;

  line.fill_series = model::MakeSeries(line.fill, factor);
  line.fill_table = model::FlowTable(line.fill_series);
  const double ambient_pa = problem.ambient.pressure_pa;
  // Positive where the source is too weak, by the worse of the two limits.
  const auto excess = [&](double source_pa) {
    const double rise_s = model::FillTime(line.fill_series, line.chamber, source_pa, ambient_pa,
                                          RiseTarget(problem, group), temperature_k);
    const double inflate_s = model::FillTime(line.fill_series, line.chamber, source_pa, ambient_pa,
                                             operating_pa, temperature_k);
    return std::max(std::isinf(group.rise_time_max_s) ? -1.0 : rise_s - group.rise_time_max_s,
                    inflate_s - HalfPeriod(problem));
  };
  if (!(excess(line.source_max_pa) <= 0.0)) return false;
  line.source_min_pa =
      std::max(switches_pa, SmallestFeasible(excess, operating_pa, line.source_max_pa));
  line.inflate_time_least_s = model::FillTime(line.fill_series, line.chamber, line.source_max_pa,
                                              ambient_pa, operating_pa, temperature_k);
  return true;
}

}  // namespace

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

LineSet EnumerateLines(const Problem& problem, int group_index, model::Gas gas) {
  const ActuatorGroup& group = problem.groups[group_index];
  const model::Parts& parts = problem.parts;
  const bool cost_matters = CostMatters(problem);
  const bool needs_fittings = group.fittings_per_line > 0;
  const int fittings = needs_fittings ? static_cast<int>(parts.fittings.size()) : 1;

  LineSet set;
  for (int t = 0; t < static_cast<int>(parts.tubing.size()); ++t) {
    for (int f = 0; f < fittings; ++f) {
      for (int v = 0; v < static_cast<int>(parts.valves.size()); ++v) {
        ++set.total;
        if (needs_fittings && !Compatible(parts.tubing[t], parts.fittings[f], parts.valves[v])) {
          ++set.incompatible;
          continue;
        }
        if (cost_matters &&
            !(parts.tubing[t].per_metre.cost_eur && parts.valves[v].basics.cost_eur &&
              (!needs_fittings || parts.fittings[f].basics.cost_eur))) {
          ++set.unpriced;
          continue;
        }
        Line line = Assemble(problem, group, t, needs_fittings ? f : -1, v);
        if (Qualify(problem, group, gas, line))
          set.lines.push_back(std::move(line));
        else
          ++set.infeasible;
      }
    }
  }
  return set;
}

}  // namespace plenum::optimizer
