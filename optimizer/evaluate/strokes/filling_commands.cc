#include "optimizer/evaluate/strokes/filling_commands.h"

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {

std::vector<Command> CommandsOf(const Problem& problem, const std::vector<Squad>& squads) {
  const bool burst = IsBurst(problem);
  const double period_s = 1.0 / problem.frequency_hz;
  std::vector<Command> commands;
  const auto add = [&](double begin_s, int squad, int period) {
    const auto s = static_cast<std::size_t>(squad);
    commands.push_back({begin_s, true, s, period});
    commands.push_back({begin_s + InflateWindow(problem, squads[s].group), false, s, period});
  };
  if (burst)
    for (std::size_t s = 0; s < squads.size(); ++s) add(0.0, static_cast<int>(s), 0);
  else
    for (const auto& [at, squad] : BeginsOf(problem, squads))
      for (int period = 0; period < kPeriodsMax; ++period)
        add((period + at) * period_s, squad, period);
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
