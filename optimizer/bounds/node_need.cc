#include "optimizer/bounds/node_need.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/flow/series.h"
#include "model/strokes/stroke.h"
#include "model/strokes/stroke_enclosure.h"

namespace plenum::optimizer {
namespace {

constexpr double kSlack = 1e-4;  // of a simulated stroke, and the grid of rounded means
constexpr int kPanels = 16;

double Drawn(const Problem& problem, const Line& line, double pressure_pa) {
  return model::StandardVolume(model::Content(line.chamber, pressure_pa) -
                                   model::Content(line.chamber, model::RestPa(line.chamber)),
                               problem.ambient.temperature_k);
}

// q(r) from above, by tangents: where neighbours meet, 1/q and r/q there.
struct Corners {
  std::size_t size = 0;
  std::array<double, model::kEnclosureNodes + 1> inverse{}, ratio{};

  void Add(double r, double q) {
    inverse[size] = 1.0 / q;
    ratio[size++] = r / q;
  }
  // h at μ/P.
  double Least(double mu_per_pa) const {
    double least = kUnlimited;
    for (std::size_t i = 0; i < size; ++i)
      least = std::min(least, inverse[i] - mu_per_pa * ratio[i]);
    return least;
  }
};

Corners CornersOf(const model::CurveNodes& nodes) {
  Corners corners;
  double level = nodes.flow_max, slope = 0.0;  // q = level + slope·r, of the last tangent
  for (std::size_t j = 0; j < nodes.size; ++j) {
    const double next_slope = 1.0 / nodes.slope[j];
    const double next_level = nodes.flow[j] - next_slope * nodes.ratio[j];
    if (!(next_slope < slope)) continue;
    const double r = (next_level - level) / (slope - next_slope);
    if (r >= 1.0) break;
    corners.Add(r, level + slope * r);
    level = next_level;
    slope = next_slope;
  }
  if (level + slope > 0.0) corners.Add(1.0, level + slope);
  return corners;
}

// Content taken up to each of the pressures that divide the filling up to `to_pa`.
struct Filled {
  std::array<double, kPanels + 1> pressure_pa{}, drawn_m3{};
};

Filled FilledUpTo(const Problem& problem, const Line& line, double to_pa) {
  Filled filled;
  const double from_pa = model::RestPa(line.chamber);
  for (int i = 0; i <= kPanels; ++i) {
    filled.pressure_pa[i] = from_pa + (to_pa - from_pa) * i / kPanels;
    filled.drawn_m3[i] = Drawn(problem, line, filled.pressure_pa[i]);
  }
  return filled;
}

// Largest over μ of what bounds the mean over `time_s`: concave in μ.
double LeastMean(const Corners& corners, const Filled& filled, double time_s, bool linear) {
  const auto mean = [&](double mu_pa) {
    double sum = 0.0, before = corners.Least(mu_pa / filled.pressure_pa[0]);
    for (int i = 0; i < kPanels; ++i) {
      const double after = corners.Least(mu_pa / filled.pressure_pa[i + 1]);
      sum += (filled.drawn_m3[i + 1] - filled.drawn_m3[i]) *
             (linear ? 0.5 * (before + after) : before);
      before = after;
    }
    return mu_pa + sum / time_s;
  };
  constexpr int kThirds = 8;
  double low_pa = 0.0, high_pa = filled.pressure_pa[0];
  double best = std::max(mean(low_pa), mean(high_pa));
  for (int i = 0; i < kThirds; ++i) {
    const double third_pa = (high_pa - low_pa) / 3.0;
    const double left = mean(low_pa + third_pa), right = mean(high_pa - third_pa);
    best = std::max({best, left, right});
    if (left < right)
      low_pa += third_pa;
    else
      high_pa -= third_pa;
  }
  return best;
}

double RoundedUp(double pressure_pa) {
  return std::exp(kSlack * std::ceil(std::log(pressure_pa) / kSlack + 1.0));
}

// When a group must have taken how much air, ANR, at least.
struct Due {
  double time_s, air_m3;
};

std::array<Due, 2> DuesOf(const Problem& problem, int g, const Line& line) {
  const ActuatorGroup& group = problem.groups[g];
  const auto air = [&](double pressure_pa) {
    return group.count * Drawn(problem, line, pressure_pa);
  };
  return {Due{group.rise_time_max_s, air(RiseTarget(problem, group))},
          Due{InflateWindow(problem, g), air(group.chamber.operating_pressure_pa)}};
}

// Air that a group has taken by then, at least: what is due later may still come, no faster than
// the line lets pass out of the source.
double TakenBy(double time_s, const std::array<Due, 2>& dues, double fastest_m3_per_s) {
  double air_m3 = 0.0;
  for (const Due& due : dues) {
    if (!std::isfinite(due.time_s)) continue;
    const double later_s = std::max(0.0, due.time_s - time_s);
    air_m3 = std::max(air_m3, later_s > 0.0 ? due.air_m3 - later_s * fastest_m3_per_s : due.air_m3);
  }
  return air_m3;
}

// Largest flow of a group per pressure at the node.
double Choked(const Problem& problem, int g, double factor, const Line& line) {
  double conductance = kUnlimited;
  for (const model::FlowElement& element : line.fill)
    conductance = std::min(conductance, element.sonic_conductance_m3_per_s_pa);
  return problem.groups[g].count * factor * conductance;
}

// Of an evacuated chamber: the vacuum that does so in time while it stays.
NodeMeans SteadyVacua(const Problem& problem, int g, model::Gas gas, const Line& line) {
  constexpr int kHalvings = 14;
  const model::Series fill = model::MakeSeries(line.fill, FlowFactor(problem, gas));
  const auto least = [&](double to_pa, double time_s) {
    if (!std::isfinite(time_s)) return 0.0;
    double low = to_pa, high = model::MirrorPa(line.chamber) - model::kDeepestVacuumPa;
    const auto in_time = [&](double source_pa) {
      return model::FillTime(fill, line.chamber, source_pa, problem.ambient.pressure_pa, to_pa,
                             problem.ambient.temperature_k) <= time_s;
    };
    if (!in_time(high)) return kUnlimited;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (in_time(middle) ? high : low) = middle;
    }
    return high;
  };
  return {least(RiseTarget(problem, problem.groups[g]), problem.groups[g].rise_time_max_s),
          least(line.chamber.operating_pressure_pa, InflateWindow(problem, g))};
}

}  // namespace

NodeMeans LeastNodeMeans(const Problem& problem, int g, model::Gas gas, const Line& line) {
  if (line.chamber.evacuated) return SteadyVacua(problem, g, gas, line);
  const ActuatorGroup& group = problem.groups[g];
  constexpr double kNearOne = 0.99;  // ratio up to which the line's curve is enclosed
  const Corners corners =
      CornersOf(model::MarchNodes(line.fill, FlowFactor(problem, gas), kNearOne));
  NodeMeans least;
  if (corners.size == 0) return least;
  const bool linear = line.chamber.volume_curve.empty();
  const auto mean = [&](double to_pa, double time_s) {
    return std::isfinite(time_s)
               ? LeastMean(corners, FilledUpTo(problem, line, to_pa), time_s, linear)
               : 0.0;
  };
  least.rise_pa = mean(RiseTarget(problem, group), group.rise_time_max_s);
  least.inflate_pa = mean(group.chamber.operating_pressure_pa, InflateWindow(problem, g));
  return least;
}

std::vector<NodeMeans> HighestNodeMeans(const Problem& problem, model::Gas gas,
                                        const NodeSource& source,
                                        const std::vector<const Line*>& lines) {
  const double factor = FlowFactor(problem, gas);
  const model::FlowElement elements[] = {source.regulator};
  const model::Series regulator = model::MakeSeries(elements, factor);
  const int groups = static_cast<int>(lines.size());
  const bool meet = MeetingOf(problem) == Meeting::kTogether;
  const auto taken = [&](int g, double time_s) {
    return TakenBy(time_s, DuesOf(problem, g, *lines[g]),
                   source.source_pa * Choked(problem, g, factor, *lines[g]));
  };
  const auto mean = [&](int g, double time_s) {
    if (!std::isfinite(time_s)) return kUnlimited;
    double air_m3 = 0.0;
    for (int other = 0; other < groups; ++other)
      if (meet || other == g) air_m3 += taken(other, time_s);
    const double flow = air_m3 / time_s * (1.0 - kSlack);
    if (flow >
        std::min(source.flow_max_m3_per_s, regulator.choked_flow_m3_per_s_pa * source.source_pa))
      return 0.0;
    return RoundedUp(source.source_pa * model::RatioAtFlow(regulator, flow / source.source_pa));
  };
  std::vector<NodeMeans> highest;
  highest.reserve(lines.size());
  for (int g = 0; g < groups; ++g)
    highest.push_back(
        {mean(g, problem.groups[g].rise_time_max_s), mean(g, InflateWindow(problem, g))});
  return highest;
}

}  // namespace plenum::optimizer
