#include "optimizer/sizing/group_pressures.h"

#include <algorithm>

#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/problem/gait.h"

namespace plenum::optimizer {
namespace {

constexpr double kTolerance = 1e-9;  // relative, of a pressure

LeafStatus Need(const Problem& problem, const Candidate& candidate, int g, Window& window) {
  if (window.empty()) return LeafStatus::kInfeasible;
  bool failed = false;
  const auto excess = [&](double pa) {
    const std::optional<double> slow =
        failed ? std::nullopt : GroupExcess(problem, candidate, g, pa);
    failed = !slow;
    return slow.value_or(0.0);
  };
  const double high = excess(window.high_pa);
  if (!failed && high > 0.0) return LeafStatus::kInfeasible;
  const double low = excess(window.low_pa);
  if (!failed && low > 0.0)
    window.low_pa =
        NarrowBracket(excess, window.low_pa, low, window.high_pa, high, kTolerance).high;
  return failed ? LeafStatus::kUndecided : LeafStatus::kFeasible;
}

OperatingPoint PointWith(std::vector<double> group_pa, double tank_m3) {
  OperatingPoint point{*std::max_element(group_pa.begin(), group_pa.end()), tank_m3, tank_m3};
  point.group_pa = std::move(group_pa);
  return point;
}

}  // namespace

std::optional<double> GroupExcess(const Problem& problem, const Candidate& candidate, int g,
                                  double group_pa) {
  OperatingPoint point{group_pa};
  point.group_pa.assign(problem.groups.size(), group_pa);
  Strokes strokes = ToBeKept(problem);
  if (!StrokesOfGroup(problem, candidate, point, g, strokes)) return std::nullopt;
  return std::max(strokes.inflate_s[g] / InflateWindow(problem, g) - 1.0,
                  strokes.rise_s[g] / problem.groups[g].rise_time_max_s - 1.0);
}

double GroupPressures::least_pa() const {
  double least_pa = 0.0;
  for (const Window& window : windows) least_pa = std::max(least_pa, window.low_pa);
  return least_pa;
}

double GroupPressures::most_pa() const {
  double most_pa = 0.0;
  for (const Window& window : windows) most_pa = std::max(most_pa, window.high_pa);
  return most_pa;
}

GroupPressures NeededGroupPressures(const Problem& problem, const Candidate& candidate) {
  GroupPressures pressures;
  pressures.status = LeafStatus::kFeasible;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    pressures.windows.push_back(GroupWindow(problem, candidate, g));
    const LeafStatus status = Need(problem, candidate, g, pressures.windows.back());
    if (status == LeafStatus::kFeasible) continue;
    pressures.status = status;
    if (status == LeafStatus::kInfeasible) break;
  }
  return pressures;
}

OperatingPoint PointAtHighest(const Candidate& candidate, const GroupPressures& pressures,
                              double highest_pa, double tank_m3) {
  std::vector<double> group_pa;
  for (std::size_t g = 0; g < pressures.windows.size(); ++g) {
    const auto& [low_pa, high_pa] = pressures.windows[g];
    group_pa.push_back(candidate.lines[g]->holds ? std::max(low_pa, std::min(highest_pa, high_pa))
                                                 : low_pa);
  }
  return PointWith(std::move(group_pa), tank_m3);
}

OperatingPoint PointAtShare(const std::vector<Window>& windows, double share, double tank_m3) {
  std::vector<double> group_pa;
  group_pa.reserve(windows.size());
  for (const auto& [low_pa, high_pa] : windows)
    group_pa.push_back(low_pa + share * (high_pa - low_pa));
  return PointWith(std::move(group_pa), tank_m3);
}

}  // namespace plenum::optimizer
