#include "optimizer/evaluate/closing.h"

#include <algorithm>
#include <limits>

#include "model/flow/scalar.h"
#include "model/flow/tube.h"
#include "model/strokes/stroke.h"
#include "optimizer/evaluate/line_elements.h"
#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"

namespace plenum::optimizer {
namespace {

constexpr double kPeakTolerance = 1e-12;  // relative

// Seconds from the operating pressure on.
class Beyond {
 public:
  Beyond(const Problem& problem, int group, double flow_factor, const Closing& closing)
      : series_(model::MakeSeries(closing.fill, flow_factor)),
        chamber_(closing.chamber),
        operating_pa_(problem.groups[group].chamber.operating_pressure_pa),
        temperature_k_(problem.ambient.temperature_k) {}

  double Seconds(double source_pa, double to_pa) const {
    return model::FillTime(series_, chamber_, source_pa, operating_pa_, to_pa, temperature_k_);
  }

 private:
  model::Series series_;
  const model::Chamber& chamber_;
  double operating_pa_, temperature_k_;
};

// No element passes more than while it is choked, so that to the limit it takes at least:
double LeastSeconds(const Problem& problem, int group, double flow_factor, const Closing& closing,
                    double source_pa) {
  double conductance = std::numeric_limits<double>::infinity();
  for (const model::FlowElement& element : closing.fill)
    conductance = std::min(conductance, element.sonic_conductance_m3_per_s_pa);
  const ActuatorGroup& of = problem.groups[group];
  const double content_pa_m3 = model::Content(closing.chamber, of.pressure_max_pa) -
                               model::Content(closing.chamber, of.chamber.operating_pressure_pa);
  return model::StandardVolume(content_pa_m3, problem.ambient.temperature_k) /
         (flow_factor * conductance * source_pa);
}

// What the elements of a line of single parts pass at most by their tolerances.
Elements MostFill(const Problem& problem, int group, const Line& line) {
  const model::Parts& parts = problem.parts;
  const model::Valve& valve = parts.valves[line.valve];
  model::FlowElement fitting;
  if (line.fitting >= 0)
    fitting = parts.fittings[line.fitting].flow_most.value_or(parts.fittings[line.fitting].flow);
  const ActuatorGroup& of = problem.groups[group];
  return FillElements(
      of, {valve.fill_most.value_or(valve.fill), fitting,
           model::TubeElement(parts.tubing[line.tubing].inner_diameter_m, of.tube_length_m)});
}

}  // namespace

double PeakPa(const Problem& problem, int group, double flow_factor, const Closing& closing,
              double source_pa) {
  const double operating_pa = problem.groups[group].chamber.operating_pressure_pa;
  if (!(closing.late_s > 0.0) || !(source_pa > operating_pa)) return operating_pa;
  const Beyond beyond(problem, group, flow_factor, closing);
  const auto left_s = [&](double to_pa) {
    return closing.late_s - beyond.Seconds(source_pa, to_pa);
  };
  if (left_s(source_pa) > 0.0) return source_pa;
  return SmallestFeasible(left_s, operating_pa, source_pa, kPeakTolerance);
}

Bracket HighestSourcePa(const Problem& problem, int group, double flow_factor,
                        const Closing& closing, double most_pa, double tolerance) {
  const double limit_pa = problem.groups[group].pressure_max_pa;
  const Bracket most{most_pa, most_pa};
  if (!(closing.late_s > 0.0) || !(most_pa > limit_pa)) return most;
  if (LeastSeconds(problem, group, flow_factor, closing, most_pa) >= closing.late_s) return most;
  const Beyond beyond(problem, group, flow_factor, closing);
  const auto room_s = [&](double source_pa) {
    return beyond.Seconds(source_pa, limit_pa) - closing.late_s;
  };
  const double room_at_most_s = room_s(most_pa);
  if (room_at_most_s >= 0.0) return most;
  const double room_at_limit_s = room_s(limit_pa);
  if (room_at_limit_s <= 0.0) return {limit_pa, limit_pa};
  return NarrowBracket(room_s, limit_pa, room_at_limit_s, most_pa, room_at_most_s, tolerance);
}

template <class T>
T PeakOf(const Problem& problem, const Candidate& candidate, int group, const T& source_pa) {
  const Line& line = *candidate.lines[group];
  if (!line.holds) return source_pa;
  const ActuatorGroup& of = problem.groups[group];
  const double late_s = problem.parts.valves[line.valve].closing_scatter_s;
  if (IsDirect(candidate.configuration) || !(late_s > 0.0))
    return T(of.chamber.operating_pressure_pa);
  model::Chamber chamber = of.least.value_or(of.chamber);
  chamber.dead_volume_m3 += line.chamber.dead_volume_m3 - of.chamber.dead_volume_m3;
  const Elements fill = MostFill(problem, group, line);
  const double factor = FlowFactor(problem, GasOf(candidate.configuration));
  const auto peak_pa = [&](double pa) {
    return PeakPa(problem, group, factor, {fill.span(), chamber, late_s}, pa);
  };
  const double here_pa = model::ValueOf(source_pa);
  if constexpr (model::kIsDual<T>) {
    const double step_pa = 1e-4 * here_pa;
    return model::Chain(source_pa, peak_pa(here_pa),
                        (peak_pa(here_pa + step_pa) - peak_pa(here_pa - step_pa)) / (2 * step_pa));
  } else {
    return peak_pa(here_pa);
  }
}

template double PeakOf(const Problem&, const Candidate&, int, const double&);
template model::Dual PeakOf(const Problem&, const Candidate&, int, const model::Dual&);

}  // namespace plenum::optimizer
