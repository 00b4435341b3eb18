#include "optimizer/problem/gait.h"

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {
namespace {

constexpr double kSame = 1e-9;  // of the period: closer begins are one

double PhaseWithout(const Problem& problem, int group) {
  if (problem.simultaneous) return 0.0;
  const double strokes = problem.groups[group].gait.strokes_per_period;
  return group / (static_cast<double>(problem.groups.size()) * strokes);
}

// From one point of a period to another after it, in [0, 1).
double Ahead(double from, double to) {
  const double ahead = to - from - std::floor(to - from);
  return ahead > kSame && ahead < 1.0 - kSame ? ahead : 0.0;
}

bool WithoutPhases(const Problem& problem) {
  const Gait& first = problem.groups.front().gait;
  return std::all_of(problem.groups.begin(), problem.groups.end(), [&](const ActuatorGroup& group) {
    return group.gait.phases.empty() && group.gait.strokes_per_period == first.strokes_per_period &&
           group.gait.inflate_fraction == first.inflate_fraction;
  });
}

bool AllBeginTogether(const Problem& problem, const std::vector<Squad>& squads) {
  const Gait& first = problem.groups.front().gait;
  return std::all_of(squads.begin(), squads.end(), [&](const Squad& squad) {
    const Gait& gait = problem.groups[squad.group].gait;
    return Ahead(squads.front().phase, squad.phase) < kSame &&
           gait.strokes_per_period == first.strokes_per_period &&
           gait.inflate_fraction == first.inflate_fraction;
  });
}

}  // namespace

std::vector<Squad> SquadsOf(const Problem& problem) {
  std::vector<Squad> squads;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const ActuatorGroup& group = problem.groups[g];
    std::vector<double> phases = group.gait.phases;
    if (phases.empty()) phases.push_back(PhaseWithout(problem, g));
    if (phases.size() == 1) {
      squads.push_back({g, group.count, phases.front()});
      continue;
    }
    std::sort(phases.begin(), phases.end());
    const std::size_t first = squads.size();
    for (const double phase : phases) {
      if (squads.size() > first && phase - squads.back().phase < kSame)
        ++squads.back().count;
      else
        squads.push_back({g, 1, phase});
    }
  }
  return squads;
}

std::vector<Begin> BeginsOf(const Problem& problem, const std::vector<Squad>& squads) {
  std::vector<Begin> begins;
  for (int s = 0; s < static_cast<int>(squads.size()); ++s) {
    const int strokes = problem.groups[squads[s].group].gait.strokes_per_period;
    for (int k = 0; k < strokes; ++k)
      begins.push_back({Ahead(0.0, squads[s].phase + static_cast<double>(k) / strokes), s});
  }
  std::sort(begins.begin(), begins.end(), [](const Begin& a, const Begin& b) {
    return a.at != b.at ? a.at < b.at : a.squad < b.squad;
  });
  return begins;
}

int FilledAtOnce(const Problem& problem, int group) {
  if (problem.groups[group].gait.phases.size() <= 1) return problem.groups[group].count;
  int most = 0;
  for (const Squad& squad : SquadsOf(problem))
    if (squad.group == group) most = std::max(most, squad.count);
  return most;
}

int BegunAtOnce(const Problem& problem) {
  const std::vector<Squad> squads = SquadsOf(problem);
  int most = 0, at_once = 0;
  double last = -1.0;
  for (const Begin& begin : BeginsOf(problem, squads)) {
    if (begin.at - last > kSame) at_once = 0;
    at_once += squads[begin.squad].count;
    most = std::max(most, at_once);
    last = begin.at;
  }
  return most;
}

double InflateWindow(const Problem& problem, int group) {
  const Gait& gait = problem.groups[group].gait;
  return gait.inflate_fraction / (problem.frequency_hz * gait.strokes_per_period);
}

double RiseWindow(const Problem& problem, int group) {
  return std::min(problem.groups[group].rise_time_max_s, InflateWindow(problem, group));
}

double DeflateWindow(const Problem& problem, int group) {
  const Gait& gait = problem.groups[group].gait;
  return (1.0 - gait.inflate_fraction) / (problem.frequency_hz * gait.strokes_per_period);
}

Meeting MeetingOf(const Problem& problem) {
  if (WithoutPhases(problem))
    return problem.groups.size() == 1 ? Meeting::kAlone
           : problem.simultaneous     ? Meeting::kTogether
                                      : Meeting::kApart;
  const std::vector<Squad> squads = SquadsOf(problem);
  if (squads.size() == 1) return Meeting::kAlone;
  if (AllBeginTogether(problem, squads)) return Meeting::kTogether;
  const std::vector<double> turns_s = TurnSeconds(problem, squads);
  return *std::min_element(turns_s.begin(), turns_s.end()) > 0.0 ? Meeting::kApart
                                                                 : Meeting::kMixed;
}

bool IsBurst(const Problem& problem) {
  const Meeting meeting = MeetingOf(problem);
  return meeting == Meeting::kAlone || meeting == Meeting::kTogether;
}

int BurstsPerPeriod(const Problem& problem) {
  return IsBurst(problem) ? problem.groups.front().gait.strokes_per_period : 1;
}

bool Alternates(const Problem& problem) {
  if (problem.groups.size() != 2) return false;
  for (const ActuatorGroup& group : problem.groups)
    if (group.gait.inflate_fraction != 0.5 || group.gait.strokes_per_period != 1) return false;
  const std::vector<Squad> squads = SquadsOf(problem);
  return squads.size() == 2 && std::abs(std::abs(squads[1].phase - squads[0].phase) - 0.5) < kSame;
}

bool WindowsOverlap(const Problem& problem) {
  const std::vector<Squad> squads = SquadsOf(problem);
  const std::vector<Begin> begins = BeginsOf(problem, squads);
  for (const Begin& begin : begins) {
    const double window = InflateWindow(problem, squads[begin.squad].group) * problem.frequency_hz;
    for (const Begin& other : begins)
      if (other.squad != begin.squad && Ahead(begin.at, other.at) < window - kSame) return true;
  }
  return false;
}

bool EndInTurn(const Problem& problem, const std::vector<double>& inflate_s) {
  const std::vector<Squad> squads = SquadsOf(problem);
  const std::vector<double> turns_s = TurnSeconds(problem, squads);
  for (std::size_t s = 0; s < squads.size(); ++s)
    if (!(inflate_s[squads[s].group] <= turns_s[s])) return false;
  return true;
}

std::vector<double> TurnSeconds(const Problem& problem, const std::vector<Squad>& squads) {
  const std::vector<Begin> begins = BeginsOf(problem, squads);
  std::vector<double> turns_s(squads.size(), 1.0 / problem.frequency_hz);
  for (std::size_t i = 0; i < begins.size(); ++i) {
    double& turn_s = turns_s[begins[i].squad];
    for (std::size_t j = 0; j < begins.size(); ++j)
      if (j != i)
        turn_s = std::min(turn_s, Ahead(begins[i].at, begins[j].at) / problem.frequency_hz);
  }
  return turns_s;
}

}  // namespace plenum::optimizer
