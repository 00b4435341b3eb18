#include "verify/design/verify_closing.h"

#include <algorithm>
#include <cmath>

#include "model/flow/series.h"
#include "model/flow/tube.h"
#include "model/strokes/stroke.h"
#include "verify/design/cycle/verify_rig.h"

namespace plenum::verify {
namespace {

constexpr int kHalvings = 60;

// What comes in after the operating pressure, from the valve that closes latest at the least.
struct Late {
  double bore_m = 0.0, widest_m = 0.0;  // of what is crossed, and of what is filled
  model::FlowElement fitting, valve;
  double seconds = 0.0;
};

Late LateOf(Configuration configuration, const LineParts& line) {
  Late late{line.tube->inner_diameter_m, line.tube->inner_diameter_m, {}, {}, 0.0};
  if (line.fitting) late.fitting = line.fitting->flow_most.value_or(line.fitting->flow);
  late.valve = line.valve->fill_most.value_or(line.valve->fill);
  if (model::Holds(line.valve->kind) && !IsDirect(configuration))
    late.seconds = line.valve->closing_scatter_s;
  return late;
}

void ToLess(model::FlowElement& flow, const model::FlowElement& other) {
  flow.sonic_conductance_m3_per_s_pa =
      std::min(flow.sonic_conductance_m3_per_s_pa, other.sonic_conductance_m3_per_s_pa);
  flow.critical_ratio = std::min(flow.critical_ratio, other.critical_ratio);
  flow.subsonic_index = std::max(flow.subsonic_index, other.subsonic_index);
}

// A valve that cannot hold stands no higher source than the limit itself, and so no higher one
// than any that may be late.
Late LeastLateOf(Configuration configuration, const LinesParts& lines) {
  if (lines.tubes.empty() || lines.valves.empty()) return {};
  const LineParts first{lines.tubes[0], lines.fittings.empty() ? nullptr : lines.fittings[0],
                        lines.valves[0]};
  Late least = LateOf(configuration, first);
  least.seconds = IsDirect(configuration) ? 0.0 : kUnlimited;
  for (const model::Tubing* tube : lines.tubes) {
    least.bore_m = std::min(least.bore_m, tube->inner_diameter_m);
    least.widest_m = std::max(least.widest_m, tube->inner_diameter_m);
  }
  for (const model::Fitting* fitting : lines.fittings)
    if (fitting) ToLess(least.fitting, fitting->flow_most.value_or(fitting->flow));
  for (const model::Valve* valve : lines.valves) {
    ToLess(least.valve, valve->fill_most.value_or(valve->fill));
    if (model::Holds(valve->kind))
      least.seconds = std::min(least.seconds, valve->closing_scatter_s);
  }
  return std::isfinite(least.seconds) ? least : Late{};
}

// Filling of the chamber that is full first of those that tolerances allow.
class Filling {
 public:
  Filling(const Problem& problem, Configuration configuration, int g, const Late& late)
      : group_(problem.groups[g]),
        chamber_(group_.least ? *group_.least : group_.chamber),
        temperature_k_(problem.ambient.temperature_k) {
    chamber_.dead_volume_m3 += model::BoreVolume(late.widest_m, group_.tube_length_m);
    std::vector<model::FlowElement> crossed{late.valve};
    for (int i = 0; i <= group_.fittings_per_line; ++i) {
      if (i == (group_.fittings_per_line + 1) / 2)
        crossed.push_back(model::TubeElement(late.bore_m, group_.tube_length_m));
      if (i < group_.fittings_per_line) crossed.push_back(late.fitting);
    }
    if (Evacuated(problem)) std::reverse(crossed.begin(), crossed.end());
    fill_ = model::MakeSeries(crossed, FactorOf(problem, configuration));
  }

  double Seconds(double source_pa, double to_pa) const {
    return model::FillTime(fill_, chamber_, source_pa, group_.chamber.operating_pressure_pa, to_pa,
                           temperature_k_);
  }

 private:
  const ActuatorGroup& group_;
  model::Chamber chamber_;
  double temperature_k_;
  model::Series fill_;
};

// Where a condition that holds at `low` and not at `high` changes: the end where it holds.
template <typename Condition>
double LastWhere(const Condition& condition, double low, double high) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (condition(middle) ? low : high) = middle;
  }
  return low;
}

double MostForPeakPa(const Problem& problem, Configuration configuration, int g, const Late& late,
                     double most_pa) {
  const double limit_pa = problem.groups[g].pressure_max_pa;
  if (!(late.seconds > 0.0) || most_pa <= limit_pa) return most_pa;
  const Filling filling(problem, configuration, g, late);
  const auto kept = [&](double pa) { return filling.Seconds(pa, limit_pa) >= late.seconds; };
  return kept(most_pa) ? most_pa : LastWhere(kept, limit_pa, most_pa);
}

}  // namespace

double PeakPa(const Problem& problem, Configuration configuration, int g, const LineParts& line,
              double source_pa) {
  const double operating_pa = problem.groups[g].chamber.operating_pressure_pa;
  if (!model::Holds(line.valve->kind)) return source_pa;
  const Late late = LateOf(configuration, line);
  if (!(late.seconds > 0.0) || source_pa <= operating_pa) return operating_pa;
  const Filling filling(problem, configuration, g, late);
  const auto reached = [&](double pa) { return filling.Seconds(source_pa, pa) <= late.seconds; };
  return reached(source_pa) ? source_pa : LastWhere(reached, operating_pa, source_pa);
}

double MostForPeakPa(const Problem& problem, Configuration configuration, int g,
                     const LineParts& line, double most_pa) {
  return MostForPeakPa(problem, configuration, g, LateOf(configuration, line), most_pa);
}

double MostForPeaksPa(const Problem& problem, Configuration configuration, int g,
                      const LinesParts& lines, double most_pa) {
  return MostForPeakPa(problem, configuration, g, LeastLateOf(configuration, lines), most_pa);
}

}  // namespace plenum::verify
