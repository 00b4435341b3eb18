#include "verify/corner/verify_node.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/flow/series.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_finding.h"

namespace plenum::verify {
namespace {

constexpr double kSlack = 1e-4;  // of simulated strokes and of the flow table
constexpr int kPanels = 16;
constexpr std::array kShares{0.0, 0.4, 0.7, 0.9, 1.0};  // μ in parts of where strokes begin
constexpr double kRatioWidth = 1e-3;

// h(P), or a little less.
double LeastPerAir(const model::FlowTable& flow, double mu_per_pa) {
  const auto per_air = [&](double r) {
    const double q = flow(r);
    return q > 0.0 ? (1.0 - mu_per_pa * r) / q : kUnlimited;
  };
  double low = 0.0, high = 1.0;
  while (high - low > kRatioWidth) {
    const double left = low + (high - low) / 3.0, right = high - (high - low) / 3.0;
    (per_air(left) < per_air(right) ? high : low) = per_air(left) < per_air(right) ? right : left;
  }
  return (1.0 - mu_per_pa * high) / flow(low);
}

double Air(const Problem& problem, const BestLine& line, double pressure_pa) {
  return model::StandardVolume(model::Content(line.chamber, pressure_pa) -
                                   model::Content(line.chamber, model::RestPa(line.chamber)),
                               problem.ambient.temperature_k);
}

// Of the panel's air all at its lower end, where h is least.
double LeastMean(const Problem& problem, const BestLine& line, double to_pa, double time_s) {
  if (!std::isfinite(time_s)) return 0.0;
  const double rest_pa = model::RestPa(line.chamber);
  double most_pa = 0.0;
  for (const double share : kShares) {
    const double mu_pa = share * rest_pa;
    double sum = 0.0;
    for (int i = 0; i < kPanels; ++i) {
      const double from_pa = rest_pa + (to_pa - rest_pa) * i / kPanels;
      const double next_pa = rest_pa + (to_pa - rest_pa) * (i + 1) / kPanels;
      sum += (Air(problem, line, next_pa) - Air(problem, line, from_pa)) *
             LeastPerAir(line.filling.flow, mu_pa / from_pa);
    }
    most_pa = std::max(most_pa, mu_pa + sum / time_s);
  }
  return most_pa * (1.0 - kSlack);
}

// Air that a group must have taken by then, its lines passing no more than `fastest`.
double TakenBy(const Problem& problem, int g, const BestLine& line, double time_s,
               double fastest_m3_per_s) {
  const ActuatorGroup& group = problem.groups[g];
  const auto by = [&](double due_s, double pressure_pa) {
    const double later_s = std::max(0.0, due_s - time_s);
    if (std::isinf(later_s)) return 0.0;
    return group.count * Air(problem, line, pressure_pa) - later_s * fastest_m3_per_s;
  };
  return std::max({0.0, by(group.rise_time_max_s, PressureAt(problem, g, problem.rise_fraction)),
                   by(FillWindow(problem, g), group.chamber.operating_pressure_pa)});
}

}  // namespace

NodeMeans LeastMeans(const Problem& problem, int g, const BestLine& line) {
  const ActuatorGroup& group = problem.groups[g];
  return {LeastMean(problem, line, PressureAt(problem, g, problem.rise_fraction),
                    group.rise_time_max_s),
          LeastMean(problem, line, group.chamber.operating_pressure_pa, FillWindow(problem, g))};
}

bool TooSlowTogether(const Problem& problem, const NodeSource& source,
                     const std::vector<const BestLine*>& lines) {
  const model::FlowElement elements[] = {source.regulator};
  const model::Series regulator = model::MakeSeries(elements, source.factor);
  const int groups = static_cast<int>(lines.size());
  // Highest mean until then.
  const auto highest = [&](double time_s) {
    if (!std::isfinite(time_s)) return kUnlimited;
    double air_m3 = 0.0;
    for (int g = 0; g < groups; ++g)
      air_m3 += TakenBy(problem, g, *lines[g], time_s,
                        problem.groups[g].count * source.source_pa *
                            lines[g]->series.fill.choked_flow_m3_per_s_pa);
    const double flow = air_m3 / time_s * (1.0 - kSlack);
    if (flow >
        std::min(source.flow_max_m3_per_s, regulator.choked_flow_m3_per_s_pa * source.source_pa))
      return 0.0;
    return source.source_pa * model::RatioAtFlow(regulator, flow / source.source_pa);
  };
  const double by_half_pa = highest(FillWindow(problem, 0));
  for (int g = 0; g < groups; ++g)
    if (lines[g]->least_means.inflate_pa > by_half_pa * (1.0 + kSlack) ||
        lines[g]->least_means.rise_pa > highest(problem.groups[g].rise_time_max_s) * (1.0 + kSlack))
      return true;
  return false;
}

}  // namespace plenum::verify
