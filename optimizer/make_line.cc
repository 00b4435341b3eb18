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

// How much later than its limits a source of the given pressure makes the line's strokes; positive
// where it is too weak.
class Lateness {
 public:
  Lateness(const Problem& problem, int g, const Line& line, bool exact)
      : problem_(problem),
        group_(problem.groups[g]),
        line_(line),
        slack_(exact ? 1.0 : 1.0 + kRounding) {}

  double operator()(double source_pa) const {
    const double inflate_s = FillTime(source_pa, group_.chamber.operating_pressure_pa);
    const double late = inflate_s - HalfPeriod(problem_) * slack_;
    if (std::isinf(group_.rise_time_max_s)) return late;
    // Reaching the target takes no longer than reaching the operating pressure.
    if (inflate_s <= group_.rise_time_max_s)
      return std::max(late, inflate_s - group_.rise_time_max_s);
    return std::max(
        late, FillTime(source_pa, RiseTarget(problem_, group_)) - group_.rise_time_max_s * slack_);
  }

  double FillTime(double source_pa, double to_pa) const {
    return model::FillTime(line_.fill_series, line_.chamber, source_pa,
                           problem_.ambient.pressure_pa, to_pa, problem_.ambient.temperature_k);
  }

 private:
  const Problem& problem_;
  const ActuatorGroup& group_;
  const Line& line_;
  double slack_;
};

}  // namespace

Constraint ScreenLine(const Problem& problem, int g, model::Gas gas, const LineCorners& corners,
                      bool exact, Line& line) {
  const ActuatorGroup& group = problem.groups[g];
  if (!(corners.tube.diameters & corners.fitting.diameters) ||
      !(corners.fitting.threads & corners.valve.threads))
    return Constraint::kMating;
  line = Assemble(problem, group, corners);
  const double operating_pa = group.chamber.operating_pressure_pa;
  if (line.source_max_pa < std::max(operating_pa, corners.valve.pressure_min_pa))
    return Constraint::kPressure;

  const double factor = FlowFactor(problem, gas);
  const double slack = exact ? 1.0 : 1.0 + kRounding;
  const double fall_max_s = std::min(group.fall_time_max_s, HalfPeriod(problem));
  line.fall_time_s =
      model::EmptyTime(model::MakeSeries(line.exhaust, factor), line.chamber, operating_pa,
                       FallTarget(problem, group), problem.ambient.temperature_k);
  if (!(line.fall_time_s <= fall_max_s * slack)) return Constraint::kFall;

  line.fill_series = model::MakeSeries(line.fill, factor);
  if (!(Lateness(problem, g, line, exact)(line.source_max_pa) <= 0.0)) return Constraint::kRise;
  return Constraint::kNone;
}

void FinishLine(const Problem& problem, int g, const ValveCorner& valve, bool exact,
                bool with_table, Line& line) {
  const double operating_pa = problem.groups[g].chamber.operating_pressure_pa;
  const Lateness late(problem, g, line, exact);
  const Bracket least =
      FeasibleBracket(late, operating_pa, line.source_max_pa, exact ? 1e-9 : kBoxTolerance);
  line.source_min_pa = std::max(valve.pressure_min_pa, exact ? least.high : least.low);
  // A lone 3/2 is energised for half of the period whatever the stroke.
  if (line.all_hold) line.inflate_time_least_s = late.FillTime(line.source_max_pa, operating_pa);
  if (!with_table) return;
  line.fill_table = model::FlowTable(line.fill_series);
  line.panels = MakeStrokePanels(problem, g, line.chamber);
}

Constraint MakeLine(const Problem& problem, int g, model::Gas gas, const LineCorners& corners,
                    bool exact, bool with_table, Line& line) {
  const Constraint missed = ScreenLine(problem, g, gas, corners, exact, line);
  if (missed == Constraint::kNone) FinishLine(problem, g, corners.valve, exact, with_table, line);
  return missed;
}

}  // namespace plenum::optimizer
