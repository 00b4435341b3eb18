#include "optimizer/evaluate/strokes/filling_commands.h"

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {

std::vector<Command> CommandsOf(const Problem& problem, const std::vector<Squad>& squads) {
  const bool burst = IsBurst(problem);
  const double period_s = 1.0 / problem.frequency_hz;
  std::vector<Command> commands;
  for (std::size_t s = 0; s < squads.size(); ++s) {
    const int strokes = problem.groups[squads[s].group].gait.strokes_per_period;
    for (int period = 0; period < (burst ? 1 : kPeriodsMax); ++period)
      for (int k = 0; k < (burst ? 1 : strokes); ++k) {
        const double share = std::fmod(squads[s].phase + static_cast<double>(k) / strokes, 1.0);
        const double begin_s = burst ? 0.0 : (period + share) * period_s;
        commands.push_back({begin_s, true, s, period});
        commands.push_back({begin_s + InflateWindow(problem, squads[s].group), false, s, period});
      }
  }
  std::sort(commands.begin(), commands.end());
  return commands;
}

constexpr double kRepeats = 1e-8;  // of a stroke's time: it is that of the period before

bool SameTimes(const std::vector<Filled>& a, const std::vector<Filled>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Filled& x, const Filled& y) {
    return x.of == y.of && std::abs(x.rise_s - y.rise_s) <= kRepeats * y.rise_s &&
           std::abs(x.inflate_s - y.inflate_s) <= kRepeats * y.inflate_s;
  });
}

}  // namespace plenum::optimizer
