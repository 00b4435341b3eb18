#include "optimizer/evaluate/strokes/full_strokes.h"

#include <algorithm>
#include <cmath>

#include "model/simulate/simulate.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"
#include "optimizer/evaluate/strokes/turn_strokes.h"

namespace plenum::optimizer {
namespace {

bool MeetOnReservoir(const Problem& problem, const Candidate& candidate) {
  return KeepsReservoir(candidate.configuration) && MeetingOf(problem) == Meeting::kTogether &&
         !HasEffects(problem);
}

}  // namespace

std::optional<double> ExcessWhenFull(const Problem& problem, const Candidate& candidate,
                                     const OperatingPoint& point) {
  if (!MeetOnReservoir(problem, candidate)) return std::nullopt;
  const std::optional<std::vector<double>> rise_s = FirstAtOnce(problem, candidate, point);
  if (!rise_s) return std::nullopt;
  double excess = -kUnlimited;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
    excess = std::max(excess, (*rise_s)[g] / LatestRise(problem, g) - 1.0);
  return excess;
}

bool TooSlowWhenFull(const Problem& problem, const Candidate& candidate,
                     const OperatingPoint& point) {
  if (!MeetOnReservoir(problem, candidate)) return false;
  if (const std::optional<double> excess = ExcessWhenFull(problem, candidate, point))
    return *excess > 0.0;
  const int groups = static_cast<int>(problem.groups.size());
  model::SimulateOptions options = StrokeOptions(problem);
  if (candidate.bench != nullptr) options.cancelled = candidate.bench->stop;
  for (int g = 0; g < groups; ++g) options.end_s = std::max(options.end_s, LatestRise(problem, g));
  const model::Response response = model::Simulate(MakeRig(problem, candidate, point), options);
  if (response.status != model::SimulateStatus::kDone) return false;
  return std::any_of(
      response.strokes.begin(), response.strokes.end(), [&](const model::Stroke& stroke) {
        return stroke.state == model::ValveState::kInflate && stroke.command_s == 0.0 &&
               !(stroke.to_target_s <= LatestRise(problem, stroke.group));
      });
}

}  // namespace plenum::optimizer
