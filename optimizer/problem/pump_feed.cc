#include "optimizer/problem/pump_feed.h"

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {
namespace {

constexpr double kSame = 1e-9;  // of the period, as in gait.cc

int FeedsOf(const Problem& problem, const Squad& squad) {
  return problem.pump_feed == PumpFeed::kPerActuator ? squad.count : 1;
}

// Whether one feed fills both, in turn.
bool OnOneFeed(const Problem& problem, const Squad& a, const Squad& b) {
  return problem.pump_feed == PumpFeed::kShared ||
         (problem.pump_feed == PumpFeed::kPerGroup && a.group == b.group);
}

// From one point of the period to a later one, in (0, 1); 0 where they are one.
double Until(double from, double to) {
  const double ahead = to - from - std::floor(to - from);
  return ahead > kSame && ahead < 1.0 - kSame ? ahead : 0.0;
}

// Of the first of the squads that a feed fills in turn.
double RunSeconds(const Problem& problem, const std::vector<Squad>& in_turn) {
  const std::vector<Begin> begins = BeginsOf(problem, in_turn);
  const double window = InflateWindow(problem, in_turn.front().group) * problem.frequency_hz;
  double run = 0.0;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    double until = window;
    for (std::size_t j = 0; j < begins.size() && begins[i].squad == 0; ++j)
      if (j != i) until = std::min(until, Until(begins[i].at, begins[j].at));
    if (begins[i].squad == 0) run += until;
  }
  return run / problem.frequency_hz;
}

}  // namespace

int FeedsOf(const Problem& problem) {
  if (problem.pump_feed == PumpFeed::kShared) return 1;
  if (problem.pump_feed == PumpFeed::kPerGroup) return static_cast<int>(problem.groups.size());
  int actuators = 0;
  for (const ActuatorGroup& group : problem.groups) actuators += group.count;
  return actuators;
}

int FeedsOf(const Problem& problem, Family family) { return IsPump(family) ? FeedsOf(problem) : 1; }

int FeedsAtOnce(const Problem& problem) {
  if (problem.pump_feed == PumpFeed::kShared) return 1;
  const std::vector<Squad> squads = SquadsOf(problem);
  const std::vector<Begin> begins = BeginsOf(problem, squads);
  int most = 0;
  for (const Begin& now : begins) {  // as many as at any time run when one of them begins
    int running = 0;
    for (const Begin& begin : begins) {
      const double since = now.at - begin.at - std::floor(now.at - begin.at);
      const double window =
          InflateWindow(problem, squads[begin.squad].group) * problem.frequency_hz;
      if (since < window - kSame || since > 1.0 - kSame)
        running += FeedsOf(problem, squads[begin.squad]);
    }
    most = std::max(most, running);
  }
  return std::min(most, FeedsOf(problem));
}

std::vector<FedSquad> FedSquadsOf(const Problem& problem) {
  const std::vector<Squad> squads = SquadsOf(problem);
  std::vector<FedSquad> fed;
  for (const Squad& squad : squads) {
    std::vector<Squad> in_turn{squad};
    for (const Squad& other : squads)
      if (&other != &squad && OnOneFeed(problem, squad, other)) in_turn.push_back(other);
    const int feeds = FeedsOf(problem, squad);
    const double turn_s =
        std::min(TurnSeconds(problem, in_turn).front(), InflateWindow(problem, squad.group));
    const int feed = problem.pump_feed == PumpFeed::kShared ? 0 : squad.group;
    fed.push_back({squad, feed, feeds, squad.count / feeds, turn_s, RunSeconds(problem, in_turn)});
  }
  return fed;
}

double HeldOpenSeconds(const Problem& problem, int group) {
  if (!problem.groups[group].held_by_pumps || problem.groups[group].fed_past_valve) return 0.0;
  double open_s = 0.0;
  for (const FedSquad& fed : FedSquadsOf(problem))
    if (fed.squad.group == group)
      open_s += fed.run_s * fed.squad.count / problem.groups[group].count;
  return open_s;
}

bool FeedsMeet(const Problem& problem) {
  const std::vector<FedSquad> fed = FedSquadsOf(problem);
  return std::any_of(fed.begin(), fed.end(),
                     [](const FedSquad& squad) { return squad.turn_s == 0.0; });
}

}  // namespace plenum::optimizer
