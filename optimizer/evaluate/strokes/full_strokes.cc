#include "optimizer/evaluate/strokes/full_strokes.h"

#include <algorithm>
#include <cmath>

#include "model/simulate/simulate.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"
#include "optimizer/evaluate/strokes/turn_strokes.h"

namespace plenum::optimizer {
namespace {

constexpr double kSlack = 1.0 + 5e-5;  // of times, what they may be off by

double RiseLimit(const Problem& problem, int group) {
  return kSlack * std::min(problem.groups[group].rise_time_max_s, InflateWindow(problem, group));
}

}  // namespace

bool TooSlowWhenFull(const Problem& problem, const Candidate& candidate,
                     const OperatingPoint& point) {
  if (!KeepsReservoir(candidate.configuration) || MeetingOf(problem) != Meeting::kTogether ||
      HasEffects(problem))
    return false;
  const int groups = static_cast<int>(problem.groups.size());
  if (const std::optional<ReservoirStrokes> first = FirstAtOnce(problem, candidate, point)) {
    for (int g = 0; g < groups; ++g)
      if (std::isinf(first->inflate_s[g]) || first->rise_s[g] > RiseLimit(problem, g)) return true;
    return false;
  }
  model::SimulateOptions options = StrokeOptions(problem);
  if (candidate.bench != nullptr) options.cancelled = candidate.bench->stop;
  for (int g = 0; g < groups; ++g) options.end_s = std::max(options.end_s, RiseLimit(problem, g));
  const model::Response response = model::Simulate(MakeRig(problem, candidate, point), options);
  if (response.status != model::SimulateStatus::kDone) return false;
  return std::any_of(
      response.strokes.begin(), response.strokes.end(), [&](const model::Stroke& stroke) {
        return stroke.state == model::ValveState::kInflate && stroke.command_s == 0.0 &&
               !(stroke.to_target_s <= RiseLimit(problem, stroke.group));
      });
}

}  // namespace plenum::optimizer
