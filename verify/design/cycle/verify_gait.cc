#include "verify/design/cycle/verify_gait.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace plenum::verify {
namespace {

constexpr double kOne = 1e-9;  // of the period: what is closer is one begin

double Strokes(const Problem& problem, int g) { return problem.groups[g].gait.strokes_per_period; }

// From `from` on to `to`, around the period; 0 where they are one.
double Around(double from, double to) {
  double way = std::fmod(to - from + 2.0, 1.0);
  if (way > 1.0 - kOne || way < kOne) way = 0.0;
  return way;
}

bool SameWindows(const Problem& problem, int a, int b) {
  return problem.groups[a].gait.inflate_fraction == problem.groups[b].gait.inflate_fraction &&
         Strokes(problem, a) == Strokes(problem, b);
}

bool OnOneFeed(const Problem& problem, const Unit& a, const Unit& b) {
  switch (problem.pump_feed) {
    case PumpFeed::kShared:
      return true;
    case PumpFeed::kPerGroup:
      return a.group == b.group;
    case PumpFeed::kPerActuator:
      return false;
  }
  return true;
}

bool BeginTogether(const Unit& a, const Unit& b) {
  return std::any_of(a.begins.begin(), a.begins.end(), [&](double at) {
    return std::any_of(b.begins.begin(), b.begins.end(),
                       [&](double other) { return Around(at, other) == 0.0; });
  });
}

}  // namespace

std::vector<Unit> UnitsOf(const Problem& problem) {
  std::vector<Unit> units;
  const double groups = static_cast<double>(problem.groups.size());
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const ActuatorGroup& group = problem.groups[g];
    std::map<long long, int> counts;  // by phase
    const auto key = [](double phase) { return std::llround(phase / kOne); };
    if (group.gait.phases.empty())
      counts[key(problem.simultaneous ? 0.0 : g / groups / Strokes(problem, g))] = group.count;
    else if (group.gait.phases.size() == 1)
      counts[key(group.gait.phases[0])] = group.count;
    else
      for (const double phase : group.gait.phases) ++counts[key(phase)];
    for (const auto& [phase, count] : counts) {
      Unit unit{g, count, {}};
      for (int k = 0; k < group.gait.strokes_per_period; ++k)
        unit.begins.push_back(
            Around(0.0, static_cast<double>(phase) * kOne + k / Strokes(problem, g)));
      std::sort(unit.begins.begin(), unit.begins.end());
      if (problem.pump_feed == PumpFeed::kPerActuator) unit.feeds = count;
      units.push_back(std::move(unit));
    }
  }
  return units;
}

double FillWindow(const Problem& problem, int g) {
  return problem.groups[g].gait.inflate_fraction / Strokes(problem, g) / problem.frequency_hz;
}

double VentWindow(const Problem& problem, int g) {
  return 1.0 / Strokes(problem, g) / problem.frequency_hz - FillWindow(problem, g);
}

double UntilNext(const Problem& problem, const std::vector<Unit>& units, const Unit& unit) {
  double least = 1.0 / Strokes(problem, unit.group);  // its own next one
  for (const Unit& other : units)
    for (const double at : unit.begins)
      for (const double begin : other.begins)
        if (&other != &unit && OnOneFeed(problem, unit, other))
          least = std::min(least, Around(at, begin));
  return least / problem.frequency_hz;
}

double RunFor(const Problem& problem, const std::vector<Unit>& units, const Unit& unit,
              double begin) {
  double until = FillWindow(problem, unit.group) * problem.frequency_hz;
  for (const Unit& other : units) {
    if (&other != &unit && !OnOneFeed(problem, unit, other)) continue;
    for (const double next : other.begins)
      if (&other != &unit || Around(begin, next) > 0.0)
        until = std::min(until, Around(begin, next));
  }
  return until / problem.frequency_hz;
}

double RunSeconds(const Problem& problem, const std::vector<Unit>& units, const Unit& unit) {
  double sum_s = 0.0;
  for (const double begin : unit.begins) sum_s += RunFor(problem, units, unit, begin);
  return sum_s;
}

int Feeds(const Problem& problem) {
  int feeds = 0;
  for (const ActuatorGroup& group : problem.groups)
    feeds += problem.pump_feed == PumpFeed::kPerActuator ? group.count : 1;
  return problem.pump_feed == PumpFeed::kShared ? 1 : feeds;
}

int TimesBought(const Problem& problem, Family family) {
  return IsPump(family) ? Feeds(problem) : 1;
}

int FeedsRunning(const Problem& problem) {
  const std::vector<Unit> units = UnitsOf(problem);
  int most = 0;
  for (const Unit& one : units)
    for (const double now : one.begins) {
      int running = 0;
      for (const Unit& unit : units) {
        const double window = FillWindow(problem, unit.group) * problem.frequency_hz;
        for (const double at : unit.begins)
          if (Around(at, now) < window - kOne) running += unit.feeds;
      }
      most = std::max(most, running);
    }
  return std::min(most, Feeds(problem));
}

int MostAtOnce(const Problem& problem, int group) {
  if (problem.groups[group].gait.phases.size() < 2) return problem.groups[group].count;
  int most = 0;
  for (const Unit& unit : UnitsOf(problem))
    if (unit.group == group) most = std::max(most, unit.count);
  return most;
}

double CoilSeconds(const Problem& problem, int group, bool holds) {
  const double seconds =
      Strokes(problem, group) * (holds ? VentWindow(problem, group) : FillWindow(problem, group));
  if (!PumpsHoldOn(problem) || !holds || problem.groups[group].fed_past_valve) return seconds;
  const std::vector<Unit> units = UnitsOf(problem);
  double open_s = 0.0;  // while pumps fill and hold, in the mean over the actuators
  for (const Unit& unit : units)
    if (unit.group == group)
      open_s += RunSeconds(problem, units, unit) * unit.count / problem.groups[group].count;
  return seconds + open_s;
}

bool AllAtOnce(const Problem& problem) {
  const std::vector<Unit> units = UnitsOf(problem);
  return units.size() > 1 && std::all_of(units.begin(), units.end(), [&](const Unit& unit) {
           return Around(unit.begins.front(), units.front().begins.front()) == 0.0 &&
                  SameWindows(problem, unit.group, units.front().group);
         });
}

bool SomeAtOnce(const Problem& problem) {
  const std::vector<Unit> units = UnitsOf(problem);
  for (const Unit& unit : units)
    for (const Unit& other : units)
      if (&unit != &other && OnOneFeed(problem, unit, other) && BeginTogether(unit, other))
        return true;
  return false;
}

int Bursts(const Problem& problem) {
  const bool burst = UnitsOf(problem).size() == 1 || AllAtOnce(problem);
  return burst ? problem.groups.front().gait.strokes_per_period : 0;
}

bool Alternate(const Problem& problem) {
  if (problem.groups.size() != 2) return false;
  const std::vector<Unit> units = UnitsOf(problem);
  return units.size() == 2 && SameWindows(problem, 0, 1) && Strokes(problem, 0) == 1.0 &&
         problem.groups[0].gait.inflate_fraction == 0.5 &&
         std::abs(Around(units[0].begins[0], units[1].begins[0]) - 0.5) < kOne;
}

bool MayOverlap(const Problem& problem) {
  const std::vector<Unit> units = UnitsOf(problem);
  for (const Unit& unit : units) {
    const double window = FillWindow(problem, unit.group) * problem.frequency_hz;
    for (const Unit& other : units)
      for (const double at : unit.begins)
        for (const double begin : other.begins)
          if (&other != &unit && Around(at, begin) < window - kOne) return true;
  }
  return false;
}

}  // namespace plenum::verify
