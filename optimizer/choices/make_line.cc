#include "optimizer/choices/make_line.h"

#include <algorithm>
#include <optional>
#include <span>

#include "model/flow/tube.h"
#include "model/strokes/stroke.h"
#include "optimizer/evaluate/closing.h"
#include "optimizer/evaluate/filling.h"
#include "optimizer/evaluate/line_elements.h"
#include "optimizer/evaluate/root.h"

namespace plenum::optimizer {
namespace {

constexpr double kBoxTolerance = 2e-3;  // of the least source pressure; its lower end is used
constexpr double kPeakTolerance = 1e-10, kBoxPeakTolerance = 1e-3;  // of the highest
constexpr double kRounding = 1e-9;  // of what the best of many comes to

struct Crossed {
  Elements fill, exhaust;
};

Crossed ElementsOf(const ActuatorGroup& group, const LineCorners& corners) {
  const model::FlowElement& fitting = corners.fitting.flow;
  const model::FlowElement bore =
      model::TubeElement(corners.tube.inner_high_m, group.tube_length_m);
  return {FillElements(group, {corners.valve.fill, fitting, bore}),
          ExhaustElements(group, {corners.valve.exhaust, fitting, bore})};
}

model::Chamber WithBore(model::Chamber chamber, const ActuatorGroup& group, double inner_m) {
  chamber.dead_volume_m3 += model::BoreVolume(inner_m, group.tube_length_m);
  return chamber;
}

// Where the peak of some line whose valve holds keeps the limit: of the one that fills slowest,
// through the narrowest bore into the largest volume.
double SourceOfPeak(const Problem& problem, int g, model::Gas gas, const LineCorners& corners,
                    double stands_pa, bool exact) {
  const ActuatorGroup& group = problem.groups[g];
  const auto& [tube, fitting, valve] = corners;
  const Elements slowest =
      FillElements(group, {valve.late_fill, fitting.late_flow,
                           model::TubeElement(tube.inner_low_m, group.tube_length_m)});
  const model::Chamber least =
      WithBore(group.least.value_or(group.chamber), group, tube.inner_high_m);
  const Bracket highest_pa =
      HighestSourcePa(problem, g, FlowFactor(problem, gas), {slowest.span(), least, valve.late_s},
                      stands_pa, exact ? kPeakTolerance : kBoxPeakTolerance);
  return exact ? highest_pa.low : std::min(stands_pa, highest_pa.high * (1.0 + kRounding));
}

double SourceMax(const Problem& problem, int g, model::Gas gas, const LineCorners& corners,
                 bool exact) {
  const ActuatorGroup& group = problem.groups[g];
  const auto& [tube, fitting, valve] = corners;
  const double stands_pa = std::min({tube.pressure_max_pa, valve.pressure_max_pa,
                                     fitting.pressure_max_pa, problem.source_pressure_max_pa});
  if (!valve.some_hold) return std::min(stands_pa, group.pressure_max_pa);
  return valve.late_s > 0.0 ? SourceOfPeak(problem, g, gas, corners, stands_pa, exact) : stands_pa;
}

double FallTime(const Problem& problem, const ActuatorGroup& group,
                std::span<const model::FlowElement> exhaust, double factor,
                const model::Chamber& chamber) {
  return model::EmptyTime(model::MakeSeries(exhaust, factor), chamber,
                          group.chamber.operating_pressure_pa, FallTarget(problem, group),
                          problem.ambient.temperature_k);
}

// FallTime() ≤ limit, by an enclosure where that decides.
bool FallsInTime(const Problem& problem, const ActuatorGroup& group,
                 std::span<const model::FlowElement> exhaust, double factor,
                 const model::Chamber& chamber, double limit_s) {
  const double to_pa = FallTarget(problem, group);
  if (model::EmptyTimeAtMost(exhaust, factor, chamber, group.chamber.operating_pressure_pa, to_pa,
                             problem.ambient.temperature_k) <= limit_s)
    return true;
  const model::Enclosure enclosure = model::EncloseEmptyTime(
      model::MarchNodes(
          exhaust, factor,
          model::PressureRatio(model::MirrorPa(chamber), to_pa, model::ExhaustPa(chamber))),
      chamber, group.chamber.operating_pressure_pa, to_pa, problem.ambient.temperature_k);
  if (enclosure.low_s > limit_s) return false;
  return enclosure.high_s <= limit_s ||
         FallTime(problem, group, exhaust, factor, chamber) <= limit_s;
}

bool SamePath(const LineCorners& a, const LineCorners& b) {
  return a.tube.inner_low_m == b.tube.inner_low_m && a.tube.inner_high_m == b.tube.inner_high_m &&
         a.fitting.flow == b.fitting.flow;
}

}  // namespace

Constraint ScreenLine(const Problem& problem, int g, model::Gas gas, const LineCorners& corners,
                      bool exact, const LineCorners* wider) {
  const ActuatorGroup& group = problem.groups[g];
  if (!(corners.tube.diameters & corners.fitting.diameters) ||
      !(corners.fitting.threads & corners.valve.threads))
    return Constraint::kMating;
  const double source_max_pa = SourceMax(problem, g, gas, corners, exact);
  if (source_max_pa < std::max(group.chamber.operating_pressure_pa, corners.valve.pressure_min_pa))
    return Constraint::kPressure;

  const bool same = !exact && wider && SamePath(corners, *wider);
  const bool falls = same && corners.valve.exhaust == wider->valve.exhaust;
  const bool rises = same && corners.valve.fill == wider->valve.fill &&
                     source_max_pa == SourceMax(problem, g, gas, *wider, false);
  if (falls && rises) return Constraint::kNone;

  const double factor = FlowFactor(problem, gas);
  const double slack = exact ? 1.0 : kBoxSlack;
  const model::Chamber chamber = WithBore(group.chamber, group, corners.tube.inner_low_m);
  const Crossed elements = ElementsOf(group, corners);
  const double fall_max_s = std::min(group.fall_time_max_s, DeflateWindow(problem, g));
  if (!falls &&
      !FallsInTime(problem, group, elements.exhaust.span(), factor, chamber, fall_max_s * slack))
    return Constraint::kFall;
  if (!rises &&
      !Filling(problem, g, elements.fill.span(), factor, chamber, slack).InTime(source_max_pa))
    return Constraint::kRise;
  return Constraint::kNone;
}

Line AssembleLine(const Problem& problem, int g, model::Gas gas, const LineCorners& corners,
                  bool exact) {
  const auto& [tube, fitting, valve] = corners;
  const ActuatorGroup& group = problem.groups[g];
  Line line;
  line.amounts += tube.amounts;
  line.amounts += valve.amounts;
  line.amounts += fitting.amounts;
  line.objective = tube.objective + valve.objective + fitting.objective;
  line.source_max_pa = SourceMax(problem, g, gas, corners, exact);
  line.holds = valve.some_hold;
  line.all_hold = valve.all_hold;
  const Crossed elements = ElementsOf(group, corners);
  line.fill.assign(elements.fill.span().begin(), elements.fill.span().end());
  line.exhaust.assign(elements.exhaust.span().begin(), elements.exhaust.span().end());
  line.coil_power_w = valve.coil_power_w;
  line.chamber = WithBore(group.chamber, group, tube.inner_low_m);
  line.dead_volume_spread_m3 = model::BoreVolume(tube.inner_high_m, group.tube_length_m) -
                               model::BoreVolume(tube.inner_low_m, group.tube_length_m);
  return line;
}

void FinishLine(const Problem& problem, int g, model::Gas gas, const ValveCorner& valve, bool exact,
                bool with_curve, Line& line) {
  const ActuatorGroup& group = problem.groups[g];
  const double operating_pa = group.chamber.operating_pressure_pa;
  const double factor = FlowFactor(problem, gas);
  Filling filling(problem, g, line.fill, factor, line.chamber, exact ? 1.0 : kBoxSlack);
  const bool found = exact && with_curve;
  const auto late = [&](double source_pa) {
    const std::optional<double> least = found ? std::nullopt : filling.LatenessAtLeast(source_pa);
    return least ? *least : filling.Lateness(source_pa);
  };
  const Bracket least =
      FeasibleBracket(late, operating_pa, line.source_max_pa, found ? 1e-9 : kBoxTolerance);
  line.source_min_pa = std::max(valve.pressure_min_pa, found ? least.high : least.low);
  // A lone 3/2 is energised while its window lasts, whatever the stroke.
  if (line.all_hold && (exact || with_curve))
    line.inflate_time_least_s = filling.InflateTime(line.source_max_pa);
  if (exact) line.fall_time_s = FallTime(problem, group, line.exhaust, factor, line.chamber);
  if (!with_curve) return;
  line.curve = std::make_shared<const FillCurve>(
      FillCurve{model::FlowTable(filling.series(), model::MirrorPa(line.chamber)),
                MakeStrokePanels(problem, g, line.chamber)});
}

bool FinishLike(const Line& wider, const ValveCorner& valve, Line& line) {
  if (line.fill != wider.fill || line.chamber != wider.chamber ||
      line.dead_volume_spread_m3 != wider.dead_volume_spread_m3 || line.holds != wider.holds ||
      line.all_hold != wider.all_hold || line.source_max_pa != wider.source_max_pa)
    return false;
  line.source_min_pa = std::max(valve.pressure_min_pa, wider.source_min_pa);
  line.inflate_time_least_s = wider.inflate_time_least_s;
  line.curve = wider.curve;
  line.strokes = wider.strokes;
  return true;
}

Constraint MakeLine(const Problem& problem, int g, model::Gas gas, const LineCorners& corners,
                    bool exact, bool with_curve, Line& line) {
  const Constraint missed = ScreenLine(problem, g, gas, corners, exact);
  line = AssembleLine(problem, g, gas, corners, exact);
  if (missed == Constraint::kNone)
    FinishLine(problem, g, gas, corners.valve, exact, with_curve, line);
  return missed;
}

}  // namespace plenum::optimizer
