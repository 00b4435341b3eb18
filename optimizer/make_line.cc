#include "optimizer/make_line.h"

#include <algorithm>
#include <cmath>

#include "model/stroke.h"
#include "model/tube.h"
#include "optimizer/root.h"

namespace plenum::optimizer {
namespace {

constexpr double kBoxTolerance = 2e-3;  // of the least source pressure; its lower end is used
// Corners are compared with limits a hair wider than what they bound, so that rounding in a corner
// never decides.
constexpr double kRounding = 1e-9;

Line Assemble(const Problem& problem, const ActuatorGroup& group, const LineCorners& corners) {
  const auto& [tube, fitting, valve] = corners;
  Line line;
  line.amounts += tube.amounts;
  line.amounts += valve.amounts;
  line.amounts += fitting.amounts;
  line.objective = tube.objective + valve.objective + fitting.objective;
  line.source_max_pa = std::min({tube.pressure_max_pa, valve.pressure_max_pa,
                                 fitting.pressure_max_pa, problem.source_pressure_max_pa});
  line.holds = valve.some_hold;
  line.all_hold = valve.all_hold;
  if (!line.holds) line.source_max_pa = std::min(line.source_max_pa, group.pressure_max_pa);

  const int near_valve = (group.fittings_per_line + 1) / 2;
  const int near_actuator = group.fittings_per_line - near_valve;
  line.fill.push_back(valve.fill);
  line.fill.insert(line.fill.end(), near_valve, fitting.flow);
  line.fill.push_back(model::TubeElement(tube.inner_high_m, group.tube_length_m));
  line.fill.insert(line.fill.end(), near_actuator, fitting.flow);
  line.exhaust.assign(line.fill.rbegin(), line.fill.rend());
  line.exhaust.back() = valve.exhaust;

  line.coil_power_w = valve.coil_power_w;
  line.chamber = group.chamber;
  const double bore_m3 = model::BoreVolume(tube.inner_low_m, group.tube_length_m);
  line.chamber.dead_volume_m3 += bore_m3;
  line.dead_volume_spread_m3 = model::BoreVolume(tube.inner_high_m, group.tube_length_m) - bore_m3;
  return line;
}

}  // namespace

Constraint MakeLine(const Problem& problem, int g, model::Gas gas, const LineCorners& corners,
                    bool exact, bool with_table, Line& line) {
  const ActuatorGroup& group = problem.groups[g];
  if (!(corners.tube.diameters & corners.fitting.diameters) ||
      !(corners.fitting.threads & corners.valve.threads))
    return Constraint::kMating;
  line = Assemble(problem, group, corners);
  const double factor = FlowFactor(problem, gas);
  const double temperature_k = problem.ambient.temperature_k;
  const double operating_pa = group.chamber.operating_pressure_pa;
  const double switches_pa = corners.valve.pressure_min_pa;
  if (line.source_max_pa < std::max(operating_pa, switches_pa)) return Constraint::kPressure;

  const double slack = exact ? 1.0 : 1.0 + kRounding;
  const double fall_max_s = std::min(group.fall_time_max_s, HalfPeriod(problem));
  line.fall_time_s = model::EmptyTime(model::MakeSeries(line.exhaust, factor), line.chamber,
                                      operating_pa, FallTarget(problem, group), temperature_k);
  if (!(line.fall_time_s <= fall_max_s * slack)) return Constraint::kFall;

  line.fill_series = model::MakeSeries(line.fill, factor);
  const auto fill_time = [&](double source_pa, double to_pa) {
    return model::FillTime(line.fill_series, line.chamber, source_pa, problem.ambient.pressure_pa,
                           to_pa, temperature_k);
  };
  // Positive where the source is too weak, by the worse of the two limits.
  const auto excess = [&](double source_pa) {
    const double inflate_s = fill_time(source_pa, operating_pa);
    const double late = inflate_s - HalfPeriod(problem) * slack;
    if (std::isinf(group.rise_time_max_s)) return late;
    // Reaching the target takes no longer than reaching the operating pressure.
    if (inflate_s <= group.rise_time_max_s)
      return std::max(late, inflate_s - group.rise_time_max_s);
    return std::max(
        late, fill_time(source_pa, RiseTarget(problem, group)) - group.rise_time_max_s * slack);
  };
  if (!(excess(line.source_max_pa) <= 0.0)) return Constraint::kRise;
  const Bracket least =
      FeasibleBracket(excess, operating_pa, line.source_max_pa, exact ? 1e-9 : kBoxTolerance);
  line.source_min_pa = std::max(switches_pa, exact ? least.high : least.low);
  // A lone 3/2 is energised for half of the period whatever the stroke.
  if (line.all_hold) line.inflate_time_least_s = fill_time(line.source_max_pa, operating_pa);
  if (with_table) line.fill_table = model::FlowTable(line.fill_series);
  return Constraint::kNone;
}

}  // namespace plenum::optimizer
